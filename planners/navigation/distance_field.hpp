/// How far each cell of the floor is from the nearest one the robot must not touch.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "vantage/belief/map/floor_map.hpp"

namespace vantage {

/// Distance, or cost, to what cannot be reached.
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Squared Euclidean distance, in cells, from the centre of each of nx x ny cells (x fastest) to
/// the nearest cell with source != 0; infinity if there is none. Exact, O(nx ny).
/// [FelzenszwalbHuttenlocher2012]
std::vector<double> squared_distances_cells(std::span<const std::uint8_t> source, int nx, int ny);

/// Distance in metres from each cell's centre to that of the nearest cell not known to be free;
/// the outside of the map is not. True clearance may be less by up to cell_m / sqrt(2), the half
/// diagonal of that cell.
std::vector<float> clearances_m(const FloorMap& map);

}  // namespace vantage
