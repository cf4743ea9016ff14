/// Does what was seen fit together? A wall that is drawn twice stands in the way of beams that went
/// through where it is not.
#pragma once

#include <span>

#include "vantage/geometry/pose.hpp"
#include "vantage/geometry/range_scan.hpp"
#include "vantage/perception/clouds/point_cloud.hpp"

namespace vantage {

/// What a scanner at `p_sensor_base` saw from there, with normals; base frame.
struct SeenFrom {
  const PointCloud& scan_base;
  Eigen::Vector2d p_sensor_base;
  Pose2 T_world_base;
};

/// Share of the returns whose beam, at these poses, went through a surface that others see, and
/// that faces the scanner, to behind it: 0 in a map that fits together.
double contradicted_share(std::span<const SeenFrom> scans);

}  // namespace vantage
