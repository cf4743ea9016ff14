#include "vantage/geometry/field_of_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vantage/geometry/pose.hpp"

namespace vantage {

Eigen::Vector3d beam_direction(const BeamAngles& angles) {
  const double c = std::cos(angles.azimuth_rad);
  return {std::cos(angles.tilt_rad) * c, std::sin(angles.azimuth_rad),
          -std::sin(angles.tilt_rad) * c};
}

BeamAngles beam_angles(const Eigen::Vector3d& p_sensor) {
  return {std::atan2(p_sensor.y(), std::hypot(p_sensor.x(), p_sensor.z())),
          std::atan2(-p_sensor.z(), p_sensor.x())};
}

double depression_rad(const Eigen::Vector3d& p_sensor) {
  return std::atan2(-p_sensor.z(), std::hypot(p_sensor.x(), p_sensor.y()));
}

BeamAngles turned_over(const BeamAngles& angles) {
  return {wrap_angle(std::numbers::pi - angles.azimuth_rad),
          wrap_angle(angles.tilt_rad + std::numbers::pi)};
}

void FieldOfView::check() const {
  if (tilt_min_rad >= tilt_max_rad) throw ConfigError("tilt_min_rad must be below tilt_max_rad");
  if (range_min_m >= range_max_m) throw ConfigError("range_min_m must be below range_max_m");
}

bool FieldOfView::contains(const Eigen::Vector3d& p_sensor) const {
  const double range = p_sensor.norm();
  if (range < range_min_m || range > range_max_m) return false;
  if (panorama) {
    const double tilt_rad = depression_rad(p_sensor);
    return tilt_rad >= tilt_min_rad && tilt_rad <= tilt_max_rad;
  }
  const auto in_sector = [this](const BeamAngles& angles) {
    return std::abs(angles.azimuth_rad) <= half_width_rad && angles.tilt_rad >= tilt_min_rad &&
           angles.tilt_rad <= tilt_max_rad;
  };
  const BeamAngles angles = beam_angles(p_sensor);
  return in_sector(angles) ||
         (half_width_rad > std::numbers::pi / 2.0 && in_sector(turned_over(angles)));
}

Eigen::AlignedBox3d FieldOfView::box_m() const {
  const Eigen::Vector3d all_m = Eigen::Vector3d::Constant(range_max_m);
  if (panorama || half_width_rad >= 0.5 * std::numbers::pi) return {-all_m, all_m};
  const double aside_m = range_max_m * std::sin(half_width_rad);
  const double up_m = range_max_m * std::sin(std::max(-tilt_min_rad, 0.0));
  const double down_m = range_max_m * std::sin(std::max(tilt_max_rad, 0.0));
  return {Eigen::Vector3d(0.0, -aside_m, -down_m), Eigen::Vector3d(range_max_m, aside_m, up_m)};
}

}  // namespace vantage
