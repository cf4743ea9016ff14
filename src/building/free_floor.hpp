/// Where a robot can begin in a building.
#pragma once

#include <Eigen/Geometry>

#include <cstdint>
#include <optional>

#include "vantage/building/fitted_grid.hpp"
#include "vantage/geometry/pose.hpp"

namespace vantage {

struct FreeFloorOptions {
  double clearance_m = 0.6;  ///< from the start to all that stands there
  double headroom_m = 1.6;   ///< free above the floor
  bool floor_everywhere = false;
  /// Of what stands on the floor. Beyond it nothing begins, and an area that meets its edge for
  /// more than a gate's width is outdoors: unless there is no other. Empty: nothing is outdoors.
  Eigen::AlignedBox2d standing_m = {};
};

struct FreeFloor {
  Pose2 start;  ///< in the largest area that is not outdoors, if any, far from what stands there
  double area_m2 = 0.0;      ///< that a disc of the clearance can go round from there
  double clearance_m = 0.0;  ///< of the start
};

/// @param solid of each cell; the floor is at z = 0
/// @return nothing if there is floor nowhere
std::optional<FreeFloor> find_free_floor(const FittedGrid& grid,
                                         const std::vector<std::uint8_t>& solid,
                                         const FreeFloorOptions& options);

}  // namespace vantage
