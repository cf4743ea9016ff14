/// Images of boxes on a table, drawn ray by ray.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/geometry/range_scan.hpp"
#include "vantage/perception/object_view.hpp"

namespace vantage::test {

using Eigen::Vector3d;

inline const Vector3d kTable_m(0.3, -0.2, 0.7);

/// A camera 1 m off that looks down on the table's middle by 45 deg, from that side.
inline Pose camera_at(double bearing_rad) {
  const Vector3d out(std::cos(bearing_rad), std::sin(bearing_rad), 0.0);
  const Vector3d z = -(out + Vector3d::UnitZ()).normalized();
  const Vector3d x = z.cross(Vector3d::UnitZ()).normalized();
  Pose T = Pose::Identity();
  T.linear() << x, z.cross(x), z;
  T.translation() = kTable_m - z;
  return T;
}

/// Along the axes of the world.
struct Box {
  Vector3d middle_m;
  Vector3d half_m;
};

inline std::optional<double> meets(const Box& box, const Vector3d& from, const Vector3d& along) {
  const Eigen::Array3d a = (box.middle_m - box.half_m - from).array() / along.array();
  const Eigen::Array3d b = (box.middle_m + box.half_m - from).array() / along.array();
  const double enters = a.min(b).maxCoeff();
  const double leaves = a.max(b).minCoeff();
  if (enters < leaves && enters > 0.0) return enters;
  return std::nullopt;
}

struct Scene {
  std::vector<Box> boxes;
  double half_table_m = 0.5;
};

struct Drawn {
  CameraImages images;
  std::vector<std::uint8_t> first_box;  ///< 1 where it is seen
};

inline Drawn draw(const Scene& scene, const Pose& T_world_camera, double noise_m = 0.0) {
  Drawn drawn;
  CameraImages& image = drawn.images;
  image.width_px = 320;
  image.height_px = 240;
  image.focal_px = 290.0;
  image.range_max_m = 3.5;
  Rng rng(7);
  for (int row = 0; row < image.height_px; ++row) {
    for (int column = 0; column < image.width_px; ++column) {
      const Vector3d along = T_world_camera.linear() * image.ray(row, column);
      const Vector3d from = T_world_camera.translation();
      double depth_m = -from.z() / along.z();
      const double table_m = (kTable_m.z() - from.z()) / along.z();
      const Vector3d off = from + table_m * along - kTable_m;
      if (off.head<2>().cwiseAbs().maxCoeff() < scene.half_table_m) depth_m = table_m;
      bool first = false;
      for (const Box& box : scene.boxes) {
        const auto hit = meets(box, from, along);
        if (!hit || *hit >= depth_m) continue;
        depth_m = *hit;
        first = &box == scene.boxes.data();
      }
      drawn.first_box.push_back(first ? 1 : 0);
      image.depth_m.push_back(static_cast<float>(depth_m + noise_m * rng.normal()));
      for (int c = 0; c < 3; ++c) image.rgb.push_back(first ? 200 : 60);
    }
  }
  return drawn;
}

inline Box box_at(double x_m, double y_m, const Vector3d& size_m) {
  return {kTable_m + Vector3d(x_m, y_m, 0.5 * size_m.z()), 0.5 * size_m};
}

/// Intersection over union of the mask with the first box.
inline double overlap(const Drawn& drawn, const ObjectView& view) {
  int both = 0;
  int either = 0;
  for (int row = 0; row < drawn.images.height_px; ++row) {
    for (int column = 0; column < drawn.images.width_px; ++column) {
      const int r = row - view.top_px;
      const int c = column - view.left_px;
      const bool in_cut = r >= 0 && c >= 0 && r < view.height_px && c < view.width_px;
      const bool masked = in_cut && view.mask[view.index(r, c)] != 0;
      const auto pixel =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(drawn.images.width_px) +
          static_cast<std::size_t>(column);
      const bool meant = drawn.first_box[pixel] != 0;
      both += masked && meant ? 1 : 0;
      either += masked || meant ? 1 : 0;
    }
  }
  return static_cast<double>(both) / either;
}

}  // namespace vantage::test
