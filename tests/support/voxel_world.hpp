/// A world made of voxels and a noise-free laser in it: episodes without physics.
#pragma once

#include <string_view>
#include <vector>

#include "vantage/geometry/grid_frame.hpp"
#include "vantage/geometry/range_scan.hpp"

namespace vantage {

struct VoxelWorld {
  GridFrame frame;
  std::vector<bool> solid;
};

/// Columns from an ASCII plan, north (+y) first: '.' empty, '1'-'9' so many voxels high.
VoxelWorld voxel_world(const std::vector<std::string_view>& plan, double cell_m, int layers);

/// Ranges to the middle of the first solid voxel along each beam; infinity where there is none.
RangeScan scan_voxels(const VoxelWorld& world, const Pose& T_world_sensor, const FieldOfView& field,
                      double step_rad);

}  // namespace vantage
