/// Rays drawn in ASCII: '.' free, '#' occupied, '?' never measured.
#pragma once

#include <string_view>
#include <vector>

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/information/discrete.hpp"

namespace vantage {

inline constexpr double kFreeCell = 0.02;
inline constexpr double kOccupiedCell = 1.0 - 1e-6;

/// Of those two.
inline const double kFreeBits = binary_entropy_bits(kFreeCell);
inline const double kOccupiedBits = binary_entropy_bits(kOccupiedCell);

inline double p_occupied_of(char cell) {
  return cell == '#' ? kOccupiedCell : (cell == '.' ? kFreeCell : 0.5);
}

inline std::vector<double> p_occupied_of(std::string_view ray) {
  std::vector<double> p_occupied;
  for (const char cell : ray) p_occupied.push_back(p_occupied_of(cell));
  return p_occupied;
}

/// A row of unit cells along x from the origin, y and z in [-0.5, 0.5].
inline OccupancyGrid row_of_cells(std::string_view cells) {
  GridFrame frame;
  frame.min_corner_m = {0.0, -0.5, -0.5};
  frame.cells = {static_cast<int>(cells.size()), 1, 1};
  OccupancyGrid grid(frame);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    grid.log_odds[i] = static_cast<float>(log_odds_of(p_occupied_of(cells[i])));
  }
  return grid;
}

}  // namespace vantage
