/// Depth images of boxes on a floor, drawn ray by ray: images whose truth is known exactly.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/geometry/range_scan.hpp"

namespace vantage::support {

/// Along the axes of the world.
struct DrawnBox {
  Eigen::Vector3d low_m;
  Eigen::Vector3d high_m;
};

/// `size_m` on a level surface at `z_m`, its middle over (x, y).
inline DrawnBox box_on(double z_m, double x_m, double y_m, const Eigen::Vector3d& size_m) {
  const Eigen::Vector3d foot(x_m, y_m, z_m);
  const Eigen::Vector3d half(0.5 * size_m.x(), 0.5 * size_m.y(), 0.0);
  return {foot - half, foot + half + Eigen::Vector3d(0.0, 0.0, size_m.z())};
}

/// At `p_world_m`, heading along `yaw_rad` and looking `pitch_rad` below the horizon.
inline Pose drawn_camera(const Eigen::Vector3d& p_world_m, double yaw_rad, double pitch_rad) {
  Pose T_body_camera = Pose::Identity();  // x forward, y left, z up -> x right, y down, z forward
  T_body_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return make_pose(p_world_m, yaw_rad, pitch_rad) * T_body_camera;
}

/// Depth along `along` (camera depth 1) to the first box or the floor z = 0; infinity: nothing.
inline double drawn_depth_m(const std::vector<DrawnBox>& boxes, const Eigen::Vector3d& from_m,
                            const Eigen::Vector3d& along) {
  double depth_m =
      along.z() < 0.0 ? -from_m.z() / along.z() : std::numeric_limits<double>::infinity();
  for (const DrawnBox& box : boxes) {
    const Eigen::Array3d a = (box.low_m - from_m).array() / along.array();
    const Eigen::Array3d b = (box.high_m - from_m).array() / along.array();
    const double enters = a.min(b).maxCoeff();
    if (enters > 0.0 && enters < b.max(a).minCoeff()) depth_m = std::min(depth_m, enters);
  }
  return depth_m;
}

/// Depth from 0.8 to 3.5 m with the noise of structured light, or none.
inline CameraImages draw_room(const std::vector<DrawnBox>& boxes, const Pose& T_world_camera,
                              bool noise = true, int width_px = 640) {
  CameraImages image;
  image.width_px = width_px;
  image.height_px = width_px * 3 / 4;
  image.focal_px = 579.4 * width_px / 640.0;
  image.range_max_m = 3.5;
  Rng rng(7);
  for (int row = 0; row < image.height_px; ++row) {
    for (int column = 0; column < image.width_px; ++column) {
      const Eigen::Vector3d along = T_world_camera.linear() * image.ray(row, column);
      double z_m = drawn_depth_m(boxes, T_world_camera.translation(), along);
      if (noise && std::isfinite(z_m)) {
        z_m += (0.0012 + 0.0019 * (z_m - 0.4) * (z_m - 0.4)) * rng.normal();
      }
      image.depth_m.push_back(z_m >= 0.8 && z_m <= 3.5 ? static_cast<float>(z_m) : 0.0F);
      for (int c = 0; c < 3; ++c) image.rgb.push_back(100);
    }
  }
  return image;
}

}  // namespace vantage::support
