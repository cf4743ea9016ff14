#include "vantage/planners/tours/rollout.hpp"

#include <algorithm>
#include <utility>

#include "vantage/core/error.hpp"

namespace vantage {

PlannedViews Rollout::operator()(const PlanningProblem& problem, Rng& rng) const {
  expects(static_cast<bool>(problem.draw), "rollout needs maps to draw");
  const std::vector<Tour> tours = search_tours(problem, objective(), search());
  if (tours.empty()) return {};
  std::vector<double> sum_s(tours.size(), 0.0);
  for (int k = 0; k < draws; ++k) {
    const PlanningProblem drawn = problem.draw(rng);
    for (std::size_t i = 0; i < tours.size(); ++i) {
      sum_s[i] += search_tour(drawn, objective(), search(), tours[i].order.front()).cost_s;
    }
  }
  const auto best = std::ranges::min_element(sum_s);  // of equals the better tour
  PlanCosts costs{.taken_s = *best / draws};
  for (std::size_t i = 0; i < tours.size(); ++i) {
    if (tours[i].order.front() == problem.intended) costs.intended_s = sum_s[i] / draws;
  }
  return {tours[static_cast<std::size_t>(best - sum_s.begin())].order, costs};
}

}  // namespace vantage
