#include "vantage/geometry/upright_cylinder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr int kColumns = 8;
constexpr int kRows = 6;

/// Of the unit disc: rings of equal area to the sample.
constexpr std::array<std::pair<double, int>, 3> kRings{{{0.29, 2}, {0.63, 4}, {0.88, 6}}};
constexpr int kOnTop = 12;

}  // namespace

std::vector<SurfaceSample> facing_samples(const UprightCylinder& cylinder,
                                          const Eigen::Vector3d& p_eye_m) {
  expects(cylinder.radius_m > 0.0 && cylinder.height_m > 0.0, "a cylinder has a surface");
  const Eigen::Vector3d top_m = cylinder.p_foot_m + cylinder.height_m * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d middle_m = 0.5 * (cylinder.p_foot_m + top_m);
  const Eigen::Vector3d to_eye = p_eye_m - middle_m;
  const double bearing_rad = std::atan2(to_eye.y(), to_eye.x());
  const double elevation_rad = std::atan2(to_eye.z(), to_eye.head<2>().norm());
  const double r = cylinder.radius_m;
  const double side = 2.0 * r * cylinder.height_m * std::cos(elevation_rad);
  const double top = std::numbers::pi * r * r * std::max(0.0, std::sin(elevation_rad));
  std::vector<SurfaceSample> samples;
  for (int column = 0; column < kColumns; ++column) {
    // Columns of equal width as they are seen.
    const double angle_rad = bearing_rad + std::asin((2.0 * column + 1.0) / kColumns - 1.0);
    const Eigen::Vector3d out(r * std::cos(angle_rad), r * std::sin(angle_rad), 0.0);
    for (int row = 0; row < kRows; ++row) {
      const double height_m = (row + 0.5) / kRows * cylinder.height_m;
      samples.push_back({cylinder.p_foot_m + out + height_m * Eigen::Vector3d::UnitZ(),
                         side / (side + top) / (kColumns * kRows)});
    }
  }
  if (top == 0.0) return samples;
  for (const auto& [ring, count] : kRings) {
    for (int i = 0; i < count; ++i) {
      const double angle_rad = bearing_rad + (i + 0.5) * 2.0 * std::numbers::pi / count;
      const Eigen::Vector3d out(ring * r * std::cos(angle_rad), ring * r * std::sin(angle_rad),
                                0.0);
      samples.push_back({top_m + out, top / (side + top) / kOnTop});
    }
  }
  return samples;
}

}  // namespace vantage
