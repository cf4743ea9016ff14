#include "vantage/planners/tours/information_rate.hpp"

#include <algorithm>

namespace vantage {

PlannedViews InformationRate::operator()(const PlanningProblem& problem, Rng& /*rng*/) const {
  const std::vector<std::size_t> views = affordable_views(problem);
  if (views.empty()) return {};
  const auto rate = [&](std::size_t view) {
    return gain_of(problem, view) / (problem.leg_s(problem.here(), view) + problem.scan_s_of(view));
  };
  return {.order = {*std::ranges::max_element(views, {}, rate)}};  // of equals the first
}

}  // namespace vantage
