#include "vantage/view/orbit_camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vantage/core/error.hpp"
#include "vantage/geometry/pose.hpp"

namespace vantage {
namespace {

constexpr double kSteepest_rad = 0.5 * std::numbers::pi - 0.01;
constexpr double kNearest_m = 0.05;
constexpr double kMaxDistance_m = 200.0;

}  // namespace

FreeCamera orbited(FreeCamera camera, const Eigen::Vector2d& drag) {
  camera.azimuth_rad = wrap_angle(camera.azimuth_rad - std::numbers::pi * drag.x());
  camera.elevation_rad =
      std::clamp(camera.elevation_rad - std::numbers::pi * drag.y(), -kSteepest_rad, kSteepest_rad);
  return camera;
}

FreeCamera panned(FreeCamera camera, const Eigen::Vector2d& drag) {
  expects(camera.fovy_rad.has_value(), "a camera of known field of view");
  const double a = camera.azimuth_rad;
  const double e = camera.elevation_rad;
  const Eigen::Vector3d forward(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
  const Eigen::Vector3d right(std::sin(a), -std::cos(a), 0.0);
  const double height_m = 2.0 * camera.distance_m * std::tan(0.5 * *camera.fovy_rad);
  camera.lookat_m += height_m * (drag.y() * right.cross(forward) - drag.x() * right);
  return camera;
}

FreeCamera zoomed(FreeCamera camera, double notches) {
  camera.distance_m =
      std::clamp(camera.distance_m * std::pow(0.9, notches), kNearest_m, kMaxDistance_m);
  return camera;
}

}  // namespace vantage
