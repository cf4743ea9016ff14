#include "vantage/planners/tours/information_rate.hpp"

#include <algorithm>

namespace vantage {
namespace {

constexpr double kLeast_s = 1e-9;  ///< a view may cost nothing

}  // namespace

PlannedViews InformationRate::operator()(const PlanningProblem& problem, Rng& /*rng*/) const {
  const std::vector<std::size_t> views = affordable_views(problem);
  if (views.empty()) return {};
  const auto rate = [&](std::size_t view) {
    const double time_s = problem.leg_s(problem.here(), view) + problem.scan_s_of(view);
    return gain_of(problem, view) / std::max(time_s, kLeast_s);
  };
  return {.order = {*std::ranges::max_element(views, {}, rate)}};  // of equals the first
}

}  // namespace vantage
