#include "vantage/planners/trajectory/optimisers/trajectory_optimiser.hpp"

namespace vantage {

OptimisedHorizon optimise(const TrajectoryOptimiser& optimiser, const Horizon& horizon,
                          const PathCost& cost, Rng& rng) {
  return std::visit([&](const auto& method) { return method(horizon, cost, rng); }, optimiser);
}

}  // namespace vantage
