#include "vantage/planners/trajectory/optimisers/path_search.hpp"

#include <cmath>

#include "vantage/core/error.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/planners/trajectory/optimisers/smoothness.hpp"

namespace vantage {

double path_cost(const Horizon& horizon, const PathCost& cost) {
  return PathSearch(horizon, cost).best_cost();
}

std::size_t cheapest(std::span<const Horizon> starts, const PathCost& cost) {
  expects(!starts.empty(), "there is a start");
  std::size_t best = 0;
  double least = path_cost(starts[0], cost);
  for (std::size_t i = 1; i < starts.size(); ++i) {
    const double here = path_cost(starts[i], cost);
    if (here >= least) continue;
    best = i;
    least = here;
  }
  return best;
}

PathSearch::PathSearch(const Horizon& nominal, const PathCost& cost)
    : cost_(cost),
      given_(nominal.points),
      tried_(unwrapped(nominal)),
      nominal_free_(
          tried_.points.middleCols(nominal.free_points() > 0 ? 1 : 0, nominal.free_points())),
      best_free_(nominal_free_),
      state_cost_(nominal.count()),
      cost_of_point_(nominal.count()) {
  expects(nominal.count() >= 2, "a horizon has a first and a last point");
  evaluate(nominal_free_);
}

double PathSearch::evaluate(const Eigen::Ref<const Eigen::Matrix4Xd>& free_points) {
  tried_.points.middleCols(1, tried_.free_points()) = free_points;
  state_cost_.setZero();
  cost_(tried_, state_cost_);
  cost_of_point_ = state_cost_;
  add_control_cost(tried_, cost_of_point_);
  const double cost = cost_of_point_.sum();
  if (!std::isfinite(cost)) {
    throw ConfigError(
        "a path has no finite cost: a weight of the cost, or how far paths are varied, is too "
        "large");
  }
  if (evaluations_ == 0) initial_cost_ = cost;
  if (evaluations_ == 0 || cost < best_cost_) {
    best_cost_ = cost;
    best_free_ = free_points;
  }
  ++evaluations_;
  return cost;
}

OptimisedHorizon PathSearch::result() const {
  OptimisedHorizon result{.points = given_,
                          .cost = best_cost_,
                          .initial_cost = initial_cost_,
                          .evaluations = evaluations_};
  for (Eigen::Index t = 0; t < best_free_.cols(); ++t) {
    result.points.col(t + 1) = best_free_.col(t);
    result.points(3, t + 1) = wrap_angle(best_free_(3, t));
  }
  return result;
}

}  // namespace vantage
