/// What keeps a table-top episode from beginning, found before anything runs.
#pragma once

#include <string>
#include <vector>

#include "vantage/runtime/episode_setup.hpp"
#include "vantage/sim/sensors/ray_scene.hpp"
#include "vantage/tasks/mapping/simulated/simulated_mobile_base.hpp"
#include "vantage/tasks/tabletop/tabletop.hpp"

namespace vantage {

/// @throws ConfigError if the lift cannot bring the laser to `candidates.height_m` or its joint
/// cannot sweep the laser's tilt range.
void check_reach(const World& world, const MobileBase& robot, const Tabletop& task);

/// Before the robot is placed, which goes round the table: a robot amid one would burst the
/// simulation. Free bodies of a scene that has none yet come to rest first, without the robot.
/// @throws InputError naming the surface that comes nearest to a table, and the key that it fails
/// by
void require_table(const World& world, const EpisodeSetup& setup, const Tabletop& task);

/// What is worth a warning about where the table lies in the map.
/// @throws InputError if the scene has no table; ConfigError if the map misses it.
std::vector<std::string> check_table(const World& world, const EpisodeSetup& setup,
                                     const Tabletop& task);

/// With the robot where it starts at a table. `geometry` is the scene's without the robot.
/// @throws InputError or ConfigError as check_table(); ConfigError if no view can see the region or
/// be driven to, a view is off the floor map, or the robot would stand in the region or touch
/// something while it turns once.
/// @return what is worth a warning
std::vector<std::string> check_start(const World& world, const RayScene& geometry,
                                     const MobileBase& robot, const EpisodeSetup& setup,
                                     const Tabletop& task);

}  // namespace vantage
