/// The shortest route through some of a problem's views.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "vantage/planners/tours/planning_problem.hpp"
#include "vantage/planners/tours/route.hpp"

namespace vantage {

/// Travel times between those views, and from `from` (a view, or problem.here()).
RouteCosts travel_between(const PlanningProblem& problem, std::span<const std::size_t> views,
                          std::size_t from);

/// The views in the order of the shortest route through them from where the robot is.
std::vector<std::size_t> route_through(const PlanningProblem& problem,
                                       std::span<const std::size_t> views);

/// The longest start of `order` that is affordable.
std::vector<std::size_t> affordable_part(const PlanningProblem& problem,
                                         std::vector<std::size_t> order);

}  // namespace vantage
