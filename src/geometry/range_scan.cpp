#include "vantage/geometry/range_scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace vantage {
namespace {

struct Bracket {
  std::size_t low = 0;
  std::size_t high = 0;
  bool inside = false;
};

Bracket bracket(const std::vector<double>& ascending, double value) {
  if (ascending.empty() || value < ascending.front() || value > ascending.back()) return {};
  const auto above = std::ranges::lower_bound(ascending, value);
  const auto high = static_cast<std::size_t>(above - ascending.begin());
  return {*above == value || high == 0 ? high : high - 1, high, true};
}

struct Cell {
  Bracket line;
  Bracket beam;
  [[nodiscard]] bool inside() const { return line.inside && beam.inside; }
};

/// Looks behind itself through beams turned by more than a right angle.
bool wider_than_half_turn(const RangeScan& scan) {
  constexpr double right_angle = std::numbers::pi / 2.0;
  return !scan.azimuth_rad.empty() &&
         (scan.azimuth_rad.front() < -right_angle || scan.azimuth_rad.back() > right_angle);
}

Cell locate(const RangeScan& scan, const BeamAngles& angles) {
  return {bracket(scan.tilt_rad, angles.tilt_rad), bracket(scan.azimuth_rad, angles.azimuth_rad)};
}

}  // namespace

float RangeScan::swept_range(const BeamAngles& angles) const {
  Cell cell = locate(*this, angles);
  if (!cell.inside() && wider_than_half_turn(*this)) cell = locate(*this, turned_over(angles));
  constexpr float invalid = std::numeric_limits<float>::quiet_NaN();
  if (!cell.inside()) return invalid;
  float shortest = std::numeric_limits<float>::infinity();
  for (const std::size_t l : {cell.line.low, cell.line.high}) {
    for (const std::size_t b : {cell.beam.low, cell.beam.high}) {
      const float measured = range(l, b);
      if (std::isnan(measured)) return invalid;
      shortest = std::min(shortest, measured);
    }
  }
  return shortest;
}

double CameraImages::swept_depth_m(const Eigen::Vector3d& p_camera) const {
  const double column = focal_px * p_camera.x() / p_camera.z() + 0.5 * (width_px - 1);
  const double row = focal_px * p_camera.y() / p_camera.z() + 0.5 * (height_px - 1);
  // NaN, of a point in the camera's own plane, compares false.
  if (!(p_camera.z() > 0.0 && column >= 0.0 && row >= 0.0 && column <= width_px - 1 &&
        row <= height_px - 1)) {
    return 0.0;
  }
  const auto width = static_cast<std::size_t>(width_px);
  const auto left = static_cast<std::size_t>(column);
  const auto top = static_cast<std::size_t>(row);
  const std::size_t right = std::min(left + 1, width - 1);
  const std::size_t below = std::min(top + 1, static_cast<std::size_t>(height_px) - 1);
  const float least =
      std::min(std::min(depth_m[top * width + left], depth_m[top * width + right]),
               std::min(depth_m[below * width + left], depth_m[below * width + right]));
  return std::min(static_cast<double>(least), range_max_m);
}

}  // namespace vantage
