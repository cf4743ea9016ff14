/// What keeps a table-top episode from beginning, found before anything runs.
#pragma once

#include "vantage/runtime/episode_setup.hpp"
#include "vantage/tasks/mapping/simulated_mobile_base.hpp"
#include "vantage/tasks/tabletop/tabletop.hpp"

namespace vantage {

/// @throws ConfigError if the lift cannot bring the laser to `candidates.height_m` or its joint
/// cannot sweep the laser's tilt range.
void check_reach(const World& world, const MobileBase& robot, const Tabletop& task);

/// Whether anything in the region of interest is as high as a table: rays from above, 5 x 5.
/// `geometry` is the scene's without the robot.
bool has_table(const RayScene& geometry, const Tabletop& task);

/// With the robot where it starts at a table.
/// @throws InputError if nothing in the region of interest is as high as a table; ConfigError if
/// the robot would stand in that region or touch something while it turns once.
void check_start(const World& world, const MobileBase& robot, const RayScene& geometry,
                 const EpisodeSetup& setup, const Tabletop& task);

}  // namespace vantage
