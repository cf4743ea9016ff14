/// Where a tall robot can drive: what the planar scanner cannot see, from the 3-D map.
#pragma once

#include <cstdint>
#include <span>

#include "vantage/belief/map/floor_map.hpp"
#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/core/fields.hpp"

namespace vantage {

struct HeadroomOptions {
  double low_m = 0.03;
  double high_m = 1.65;
  double seen_low_m = 0.3;
  double max_unseen = 0.25;
  void fields(auto&& f) {
    f("low_m", low_m,
      "world z from which occupied cells are obstacles; those that begin lower are floor");
    f("high_m", high_m, "world z from which cells are above the robot and do not matter");
    f("seen_low_m", seen_low_m,
      "world z from which, up to `high_m`, the cells above a place must have been observed for the "
      "robot to drive there");
    f("max_unseen", max_unseen, "share of those cells that may be unobserved; higher dares more",
      between(0.0, 1.0));
  }
  void check() const;  ///< low_m and seen_low_m below high_m
};

/// Blocks the floor below every column of `grid` that has an occupied cell, or too many unobserved
/// ones, at the robot's height, and unblocks all other floor. The latter do not block where
/// `traversed` (one flag per cell of the floor map) says that the robot knows it otherwise: it has
/// been there, nor where up to four that touch each other are surrounded by open ones: what stands
/// there would stand alone, in a place that was seen past on all sides. A floor cell counts as
/// below a column if they overlap at all.
/// @throws ConfigError if the options are out of range.
void block_columns(FloorMap& floor, const OccupancyGrid& grid,
                   std::span<const std::uint8_t> traversed, const HeadroomOptions& options);

/// A map of the floor, and of each of its cells whether the robot has been there.
struct TraversedFloor {
  FloorMap& map;
  std::span<const std::uint8_t> traversed;
};

/// The same of `floor`, and of the finer `detail` but for walls and posts there: columns occupied
/// at nine tenths of the robot's height, at the scanner's too, and above the robot, where furniture
/// ends; the scanner has measured their faces within the cell. Nor do columns with less in them
/// block there that touch such a one: most hold a face that is near their boundary; nor unseen ones
/// that touch it and an open one, and are free at the scanner's height: the wall's edge hides the
/// rest. Where the robot has been no column blocks the finer map: it has to find its way back.
/// @param scanner_m world z of the planar scanner
void block_columns(const TraversedFloor& floor, const TraversedFloor& detail,
                   const OccupancyGrid& grid, const HeadroomOptions& options, double scanner_m);

}  // namespace vantage
