/// What the sensors hand to perception: measurements only, no truth.
#pragma once

#include <cstdint>
#include <vector>

#include "vantage/geometry/field_of_view.hpp"
#include "vantage/geometry/pose.hpp"

namespace vantage {

/// A 3-D scan of a tilting laser that stood still, organised in lines of equal tilt.
struct RangeScan {
  std::vector<double> tilt_rad;     ///< per line, ascending
  std::vector<double> azimuth_rad;  ///< per beam in a line, ascending
  std::vector<float> range_m;       ///< line-major; +inf: no return within range; NaN: invalid
  FieldOfView field_of_view;        ///< of the sensor that made it

  [[nodiscard]] std::size_t lines() const { return tilt_rad.size(); }
  [[nodiscard]] std::size_t beams() const { return azimuth_rad.size(); }
  [[nodiscard]] float range(std::size_t line, std::size_t beam) const {
    return range_m[line * beams() + beam];
  }
  /// The shortest of the up to four beams round a direction, i.e. how far the scan certainly saw
  /// there; NaN outside the swept sector or next to an invalid beam.
  [[nodiscard]] float swept_range(const BeamAngles& angles) const;
};

/// One line of a planar scanner near the floor, for driving.
struct PlanarScan {
  Pose2 T_base_sensor;
  std::vector<double> azimuth_rad;
  std::vector<float> range_m;  ///< +inf: no return within range
  double range_max_m = 0.0;
};

/// Images of a pinhole camera, row-major, top row first.
struct CameraImages {
  int width_px = 0;
  int height_px = 0;
  double focal_px = 0.0;          ///< square pixels; centre at (width - 1) / 2, (height - 1) / 2
  double range_max_m = 0.0;       ///< along the optical axis
  std::vector<std::uint8_t> rgb;  ///< 3 bytes a pixel
  std::vector<float> depth_m;     ///< along the optical axis; 0: no measurement, +inf: beyond range

  [[nodiscard]] float depth_at(int row, int column) const {
    return depth_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_px) +
                   static_cast<std::size_t>(column)];
  }
  /// The point at depth 1 that the middle of a pixel shows (camera frame).
  [[nodiscard]] Eigen::Vector3d ray(int row, int column) const {
    return {(column - 0.5 * (width_px - 1)) / focal_px, (row - 0.5 * (height_px - 1)) / focal_px,
            1.0};
  }
  /// How far the image certainly saw empty space along the ray to a point in front (camera frame),
  /// as depth: the least of the four pixels round it, range_max_m where they are beyond range; 0
  /// outside the image or beside a pixel without measurement.
  [[nodiscard]] double swept_depth_m(const Eigen::Vector3d& p_camera) const;
};

/// A depth image and where it was taken.
struct PosedImage {
  const CameraImages& image;
  Pose T_world_camera;  ///< OpenCV's axes
};

}  // namespace vantage
