/// The outline of a robot on the floor, from its geoms.
#pragma once

#include <array>
#include <span>
#include <string>

#include "vantage/geometry/floor_outline.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage {

/// Convex outline, in the frame of the base, of all that can touch something of the tree of bodies
/// under the base, all joints at 0: 64 straight lines about it, each of them touched.
/// @throws InputError, starting with `where`, if nothing of it can touch anything
FloorOutline outline_of_geoms(const mjModel& model, int base_body, const std::string& where);

/// Their convex hull, which has less than three corners if they enclose nothing.
FloorOutline outline_of_corners(std::span<const std::array<double, 2>> corners_m);

/// That of the corners, or if there are none of the geoms.
FloorOutline robot_outline(const mjModel& model, int base_body,
                           std::span<const std::array<double, 2>> corners_m,
                           const std::string& where);

}  // namespace vantage
