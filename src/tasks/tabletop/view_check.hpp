/// What keeps the views of a ring from being of use, found before anything runs.
#pragma once

#include <string>
#include <vector>

#include "vantage/sim/sensors/ray_scene.hpp"
#include "vantage/tasks/mapping/simulated/simulated_mobile_base.hpp"
#include "vantage/tasks/tabletop/tabletop.hpp"

namespace vantage {

/// "map.centre_m, map.size_m: x -0.5 to 0.5, y -0.5 to 0.5, z 0.730 to 1.234"
std::string region_text(const Tabletop& task);

/// Of a circle of views from which the robot clears the region on all sides.
double clear_radius_m(const Tabletop& task);

/// @throws ConfigError if the floor map ends before a view, or no view reaches the region, could it
/// see through things.
void check_views(const MobileBase& robot, const Tabletop& task);

/// With the robot where it starts: which positions of the ring it can drive to, and which see any
/// of the region past what stands between. `geometry` is the scene's without the robot.
/// @throws ConfigError if there is no position that is both.
/// @return a note with numbers if some are not
std::vector<std::string> check_positions(const World& world, const RayScene& geometry,
                                         const MobileBase& robot, const Tabletop& task);

}  // namespace vantage
