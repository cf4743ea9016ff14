/// The next waypoints again, at each waypoint.
#pragma once

#include <functional>

#include "vantage/planners/trajectory/optimisers/trajectory_optimiser.hpp"

namespace vantage {

/// The same places, headed for what there is to see.
using TurnHeadings = std::function<Eigen::Matrix4Xd(const Eigen::Matrix4Xd& waypoints)>;

/// Optimises from the cheapest of six starts: the plan at hand, the nominal points and the
/// smoothest between the fixed ones, each also as `turned` heads it. A plan once bent is slow to
/// straighten when its target is known, and a camera that looks elsewhere slow to turn.
/// @param plan what was planned before, its ends where they are to stay
/// @param nominal K points; the ends are not looked at
/// @return initial_cost is that of `plan`; the evaluations of the starts count
OptimisedHorizon replan(const TrajectoryOptimiser& optimiser, const Horizon& plan,
                        const Eigen::Matrix4Xd& nominal, const TurnHeadings& turned,
                        const PathCost& cost, Rng& rng);

}  // namespace vantage
