#include "vantage/planners/tours/tour.hpp"

namespace vantage {
namespace {

PlannedViews best_plan(const PlanningProblem& problem, const TourOptions& options) {
  const auto tours = search_tours(problem, options.objective(), options.search());
  if (tours.empty()) return {};
  PlanCosts costs{.taken_s = tours.front().cost_s};
  if (const auto i = intended_tour(problem, tours)) costs.intended_s = tours[*i].cost_s;
  return {tours.front().order, costs};
}

}  // namespace

PlannedViews TourChoice::operator()(const PlanningProblem& problem, Rng& /*rng*/) const {
  return best_plan(problem, *this);
}

PlannedViews OracleTour::operator()(const PlanningProblem& problem, Rng& /*rng*/) const {
  return best_plan(problem, *this);
}

}  // namespace vantage
