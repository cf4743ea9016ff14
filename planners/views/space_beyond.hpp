/// Unknown space that no view shows yet, and which view leads to it.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

#include "vantage/belief/map/occupancy_grid.hpp"

namespace vantage {

/// The columns of a grid, as far as somebody who walks sees them.
enum class ColumnState : std::uint8_t { open, unknown, wall };

/// Per column, x fastest. A column is a wall if at least 0.3 of its cells are occupied, else
/// unknown if at least half of them are unobserved.
std::vector<ColumnState> column_states(const OccupancyGrid& grid);

/// Which place leads to a column of unknown space.
struct SpaceBeyond {
  static constexpr std::int32_t kNone = -1;
  std::vector<std::int32_t> place_of;  ///< per column, x fastest: index of a place, or kNone
  /// Of the cells of open columns, the share that is observed: what may be expected of unknown
  /// ones.
  double seen_share;
};

/// Every unknown column goes to the place with the shortest way to it, through open and unknown
/// columns and no nearer than a column to a wall; of equals to the first. Nothing leads to columns
/// farther than `reach_m` from all places, nor any place outside the grid to a column.
SpaceBeyond space_beyond(const OccupancyGrid& grid, std::span<const Eigen::Vector2d> places_m,
                         double reach_m);

}  // namespace vantage
