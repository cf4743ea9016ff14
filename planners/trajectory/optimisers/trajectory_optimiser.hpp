/// Optimisers of a path's next waypoints, behind one interface.
#pragma once

#include <string_view>
#include <variant>

#include "vantage/planners/trajectory/optimisers/cem.hpp"
#include "vantage/planners/trajectory/optimisers/chomp.hpp"
#include "vantage/planners/trajectory/optimisers/mppi.hpp"
#include "vantage/planners/trajectory/optimisers/stomp.hpp"

namespace vantage {

using TrajectoryOptimiser = std::variant<Stomp, Mppi, Cem, Chomp>;
template <>
inline constexpr std::string_view strategy_family<TrajectoryOptimiser> = "trajectory optimiser";

/// Minimises the sum of `cost` over the points and 1/2 |A Q + b|^2, the cost of control, in x, y, z
/// and yaw. The first and the last point stay; yaw differences are taken the short way round. By
/// default all optimisers take the same number of evaluations, 20 x 50 + 1 (covariant_gradient: at
/// most), and return the best path they saw, so never one that is worse than what they were given.
OptimisedHorizon optimise(const TrajectoryOptimiser& optimiser, const Horizon& horizon,
                          const PathCost& cost, Rng& rng);

}  // namespace vantage
