#include "vantage/planners/trajectory/replanning.hpp"

#include <vector>

#include "vantage/core/error.hpp"
#include "vantage/planners/trajectory/optimisers/smoothness.hpp"

namespace vantage {
namespace {

/// The horizon with other points between its ends.
Horizon between_ends(const Horizon& horizon, const Eigen::Matrix4Xd& points) {
  Horizon other = horizon;
  other.points.middleCols(1, horizon.free_points()) = points.middleCols(1, horizon.free_points());
  return other;
}

}  // namespace

OptimisedHorizon replan(const TrajectoryOptimiser& optimiser, const Horizon& plan,
                        const Eigen::Matrix4Xd& nominal, const TurnHeadings& turned,
                        const PathCost& cost, Rng& rng) {
  expects(nominal.cols() == plan.count(), "a nominal point for each of the plan");
  std::vector<Horizon> starts{plan, between_ends(plan, nominal),
                              between_ends(plan, smoothest(plan).points)};
  for (std::size_t i = 0; i < 3; ++i) {
    starts.push_back(between_ends(plan, turned(starts[i].points)));
  }
  const double cost_of_plan = path_cost(plan, cost);
  OptimisedHorizon result = optimise(optimiser, starts[cheapest(starts, cost)], cost, rng);
  result.initial_cost = cost_of_plan;
  result.evaluations += 1 + static_cast<int>(starts.size());
  return result;
}

}  // namespace vantage
