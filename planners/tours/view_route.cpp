#include "vantage/planners/tours/view_route.hpp"

namespace vantage {

RouteCosts travel_between(const PlanningProblem& problem, std::span<const std::size_t> views,
                          std::size_t from) {
  const auto n = static_cast<Eigen::Index>(views.size());
  RouteCosts costs{Eigen::MatrixXd(n + 1, n)};
  for (Eigen::Index to = 0; to < n; ++to) {
    const std::size_t view = views[static_cast<std::size_t>(to)];
    for (Eigen::Index i = 0; i < n; ++i) {
      costs.cost(i, to) = problem.leg_s(views[static_cast<std::size_t>(i)], view);
    }
    costs.cost(n, to) = problem.leg_s(from, view);
  }
  return costs;
}

std::vector<std::size_t> route_through(const PlanningProblem& problem,
                                       std::span<const std::size_t> views) {
  std::vector<std::size_t> order = shortest_route(travel_between(problem, views, problem.here()));
  for (std::size_t& place : order) place = views[place];
  return order;
}

std::vector<std::size_t> affordable_part(const PlanningProblem& problem,
                                         std::vector<std::size_t> order) {
  while (!order.empty() && !is_affordable(problem, order)) order.pop_back();
  return order;
}

}  // namespace vantage
