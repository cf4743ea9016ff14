/// What a flight keeps away from.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

#include "vantage/belief/map/flight_map.hpp"

namespace vantage {

/// 1 for each cell, `map.grid().frame.index` order: what is in the way, and whatever is above a
/// place of which nothing was ever seen and which lies farther from the given path, level, than
/// the path is known to be clear: something may stand there.
/// @param given waypoints (x, y, z, yaw), 4 x n, n > 0, all at one height
std::vector<std::uint8_t> flight_hazards(const FlightMap& map, const Eigen::Matrix4Xd& given);

}  // namespace vantage
