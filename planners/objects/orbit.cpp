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

std::vector<Pose> orbit_way(const Orbit& from, double from_bearing_rad, const Orbit& to,
                            double to_bearing_rad, double step_rad, const OrbitWay& how) {
  if (from.centre_m == to.centre_m && !how.long_way && how.rise_m == 0.0) {
    return orbit_arc(to, from_bearing_rad, to_bearing_rad, step_rad);
  }
  expects(step_rad > 0.0, "a step along a way is above 0");
  double turn_rad = wrap_angle(to_bearing_rad - from_bearing_rad);
  if (how.long_way) turn_rad -= std::copysign(2.0 * std::numbers::pi, turn_rad);
  const double shift_m = (to.centre_m - from.centre_m).norm();
  const double steps = std::max(std::abs(turn_rad) / step_rad, shift_m / (to.radius_m * step_rad));
  const int count = std::max(how.rise_m > 0.0 ? 2 : 1, static_cast<int>(std::ceil(steps - 1e-9)));
  std::vector<Pose> places;
  for (int i = 1; i <= count; ++i) {
    const double t = static_cast<double>(i) / count;
    Orbit at = to;
    at.centre_m = from.centre_m + t * (to.centre_m - from.centre_m);
    at.height_m += how.rise_m * std::sin(std::numbers::pi * t);
    places.push_back(at.place(i == count ? to_bearing_rad : from_bearing_rad + t * turn_rad));
  }
  return places;
}

}  // namespace vantage
