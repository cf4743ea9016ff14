#include "vantage/planners/tours/frontier_tour.hpp"

#include "vantage/planners/tours/view_route.hpp"

namespace vantage {

PlannedViews FrontierTour::operator()(const PlanningProblem& problem, Rng& /*rng*/) const {
  return {affordable_part(problem, route_through(problem, affordable_views(problem)))};
}

}  // namespace vantage
