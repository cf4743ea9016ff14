/// Free bodies come to rest before an episode begins, so that truth is what will be there.
#pragma once

#include <string>
#include <vector>

#include "vantage/sim/world/world.hpp"

namespace vantage {

struct SettleLimits {
  double max_s = 10.0;      ///< simulated; who moves on after that is refused
  double window_s = 0.25;   ///< at rest: hardly any motion in two such windows in a row
  double at_rest_m = 3e-4;  ///< motion in a window
  double moved_m = 1e-3;    ///< less in all is no motion
  double arm_m = 0.1;       ///< a turn counts as the way of a point so far from the axis
};

/// Simulates a copy of the world until the scene's free bodies are at rest, the robot's left out,
/// and starts them there. Where none moves by more than `moved_m` the world keeps its bits. Only
/// before the first tick.
/// @return the bodies that moved
/// @throws InputError naming a body that does not come to rest.
std::vector<std::string> settle_free_bodies(World& world, const SettleLimits& limits = {});

}  // namespace vantage
