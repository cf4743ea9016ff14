#include "vantage/planners/tours/rollout.hpp"

#include <algorithm>
#include <utility>

#include "vantage/core/error.hpp"

namespace vantage {

PlannedViews Rollout::operator()(const PlanningProblem& problem, Rng& rng) const {
  expects(static_cast<bool>(problem.draw), "rollout needs maps to draw");
  // The first views are compared by the worth that they were proposed by.
  const TourObjective worth = with_raised_worth(problem, objective(), search());
  const std::vector<Tour> tours = search_tours(problem, worth, search());
  if (tours.empty()) return {};
  std::vector<double> sum_s(tours.size(), 0.0);
  PlanningProblem drawn = problem;
  for (int k = 0; k < draws; ++k) {
    ShownBlocks shown = problem.draw(rng);
    drawn.cells = std::move(shown.cells);
    drawn.shows = std::move(shown.shows);
    for (std::size_t i = 0; i < tours.size(); ++i) {
      sum_s[i] += search_tour(drawn, worth, search(), tours[i].order.front()).cost_s;
    }
  }
  std::vector<double> weighed_s = sum_s;  // one that goes on as was planned counts as cheaper
  const auto intended = intended_tour(problem, tours);
  if (intended) weighed_s[*intended] -= draws * keep_s;
  const auto best = static_cast<std::size_t>(  // of equals the better tour
      std::ranges::min_element(weighed_s) - weighed_s.begin());
  PlanCosts costs{.taken_s = sum_s[best] / draws};
  if (intended) costs.intended_s = sum_s[*intended] / draws;
  return {tours[best].order, costs};
}

}  // namespace vantage
