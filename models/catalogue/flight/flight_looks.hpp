/// What makes a room to fly through look like a room: a floor of boards, skirting, windows, a door,
/// pictures, drawers and doors of the furniture. For people alone.
#pragma once

#include <string>

#include "vantage/models/catalogue/flight/flight_scene.hpp"

namespace vantage {

/// Nothing stands farther off the solid thing that it belongs to.
inline constexpr double kLooksProud_m = 0.005;

/// The class `looks`, whose geoms touch nothing and are in the group that no sensor draws.
std::string looks_class();
std::string looks_assets();
/// A body `looks` with all that is to be seen on the room, its support surfaces and obstacles.
std::string looks_bodies(const FlightScene& scene);

}  // namespace vantage
