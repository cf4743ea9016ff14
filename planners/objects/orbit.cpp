#include "vantage/planners/objects/orbit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vantage/core/error.hpp"

namespace vantage {

Orbit Orbit::at_elevation(const Eigen::Vector3d& centre_m, double distance_m,
                          double elevation_rad) {
  return {.centre_m = centre_m,
          .radius_m = distance_m * std::cos(elevation_rad),
          .height_m = distance_m * std::sin(elevation_rad)};
}

Pose Orbit::place(double bearing_rad) const {
  const Eigen::Vector3d offset_m(radius_m * std::cos(bearing_rad), radius_m * std::sin(bearing_rad),
                                 height_m);
  return make_pose(centre_m + offset_m, wrap_angle(bearing_rad + std::numbers::pi));
}

double Orbit::bearing_rad(const Eigen::Vector3d& p_world_m) const {
  return std::atan2(p_world_m.y() - centre_m.y(), p_world_m.x() - centre_m.x());
}

std::vector<Pose> orbit_arc(const Orbit& orbit, double from_bearing_rad, double to_bearing_rad,
                            double step_rad) {
  expects(step_rad > 0.0, "a step along an arc is above 0");
  const double turn_rad = wrap_angle(to_bearing_rad - from_bearing_rad);
  const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(turn_rad) / step_rad - 1e-9)));
  std::vector<Pose> places;
  for (int i = 1; i <= steps; ++i) {
    places.push_back(orbit.place(from_bearing_rad + turn_rad * i / steps));
  }
  return places;
}

}  // namespace vantage
