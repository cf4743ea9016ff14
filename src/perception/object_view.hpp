/// One view of one object, cut out of a camera image: what the features are extracted from.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace vantage {

struct ObjectView {
  int width_px = 0;                ///< of the crop
  int height_px = 0;               ///< of the crop
  std::vector<std::uint8_t> rgb;   ///< 3 bytes a pixel, row-major, top row first
  std::vector<float> depth_m;      ///< along the optical axis; 0: no measurement
  std::vector<std::uint8_t> mask;  ///< 1 on the object, 0 beside it; may reach over its edges
  int left_px = 0;                 ///< of the crop's first column in the full image
  int top_px = 0;                  ///< of the crop's first row in the full image
  double focal_px = 570.3;         ///< square pixels
  Eigen::Vector2d centre_px{320.0, 240.0};  ///< principal point in the full image
  /// Against gravity, in the camera frame (x right, y down, z forward), unit length.
  Eigen::Vector3d up{0.0, -1.0, 0.0};
  // Of an object among others, which may stand in front of it:
  /// 1 on the object's edge where something nearer, or the image's border, cuts it off; empty:
  /// nowhere.
  std::vector<std::uint8_t> cut_off = {};
  double seen_share = 1.0;  ///< of the surface that faces the camera, as far as can be told
  /// Of what it stands on, along `up` from the camera; none: seen beside it.
  std::optional<double> support_m = {};

  [[nodiscard]] std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_px) +
           static_cast<std::size_t>(column);
  }
  /// Of a pixel of the crop, camera frame, its z 1.
  [[nodiscard]] Eigen::Vector3d ray(int row, int column) const {
    return {(left_px + column - centre_px.x()) / focal_px,
            (top_px + row - centre_px.y()) / focal_px, 1.0};
  }
  /// The point a pixel of the crop shows, camera frame, metres; meaningless where depth_m is 0.
  [[nodiscard]] Eigen::Vector3d point(int row, int column) const {
    return depth_m[index(row, column)] * ray(row, column);
  }
};

}  // namespace vantage
