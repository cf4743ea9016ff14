/// A room of analytic surfaces and the range sensors that see it, for tests without a simulator.
#pragma once

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/geometry/grid_frame.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/geometry/range_scan.hpp"

namespace vantage::support {

struct Sphere {
  Eigen::Vector3d centre_m;
  double radius_m;
};

/// Surfaces: the inside of `room` (floor and walls, open at the top), boxes and spheres.
struct SyntheticScene {
  Eigen::AlignedBox3d room{Eigen::Vector3d(-3, -3, 0), Eigen::Vector3d(3, 3, 2.5)};
  std::vector<Eigen::AlignedBox3d> boxes;
  std::vector<Sphere> spheres;
};

inline Eigen::AlignedBox3d box_at(const Eigen::Vector3d& centre_m, const Eigen::Vector3d& size_m) {
  return {centre_m - 0.5 * size_m, centre_m + 0.5 * size_m};
}

/// Distance to the first surface along the unit vector `direction`; +inf if the ray leaves through
/// the top.
inline double cast_ray(const SyntheticScene& scene, const Eigen::Vector3d& p,
                       const Eigen::Vector3d& direction) {
  constexpr double kFar = 100.0;
  const Eigen::Vector3d p_far = p + kFar * direction;
  const double wall = clip_segment(scene.room, p, p_far).leave * kFar;
  const bool through_top = (p + wall * direction).z() > scene.room.max().z() - 1e-6;
  double nearest = through_top ? std::numeric_limits<double>::infinity() : wall;
  for (const auto& box : scene.boxes) {
    const SegmentClip clip = clip_segment(box, p, p_far);
    if (!clip.empty()) nearest = std::min(nearest, clip.enter * kFar);
  }
  for (const auto& sphere : scene.spheres) {
    const Eigen::Vector3d to_centre = sphere.centre_m - p;
    const double along = to_centre.dot(direction);
    const double half_chord2 =
        sphere.radius_m * sphere.radius_m - to_centre.squaredNorm() + along * along;
    if (along > 0.0 && half_chord2 >= 0.0) {
      nearest = std::min(nearest, along - std::sqrt(half_chord2));
    }
  }
  return nearest;
}

inline std::vector<double> evenly_spaced(double low, double high, std::size_t count) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    values[i] = low + (high - low) * static_cast<double>(i) / static_cast<double>(count - 1);
  }
  return values;
}

/// A 15 deg sector of a tilting laser, 61 beams a line, with Gaussian noise on the range.
inline RangeScan sector_scan(const SyntheticScene& scene, const Pose& T_world_sensor,
                             std::size_t lines, double range_sigma_m, Rng& rng) {
  constexpr double half_width = 7.5 * std::numbers::pi / 180.0;
  RangeScan scan;
  scan.tilt_rad = evenly_spaced(-0.36, 0.62, lines);
  scan.azimuth_rad = evenly_spaced(-half_width, half_width, 61);
  scan.field_of_view = {.half_width_rad = half_width, .tilt_min_rad = -0.36, .tilt_max_rad = 0.62};
  for (const double tilt : scan.tilt_rad) {
    for (const double azimuth : scan.azimuth_rad) {
      const Eigen::Vector3d direction = T_world_sensor.linear() * beam_direction({azimuth, tilt});
      const double range = cast_ray(scene, T_world_sensor.translation(), direction);
      scan.range_m.push_back(static_cast<float>(range + range_sigma_m * rng.normal()));
    }
  }
  return scan;
}

/// 270 deg in half-degree steps, 0.25 m above the floor.
inline PlanarScan floor_scan(const SyntheticScene& scene, const Pose2& T_world_base,
                             double range_sigma_m, Rng& rng) {
  PlanarScan scan;
  scan.T_base_sensor = {0.275, 0.0, 0.0};
  scan.azimuth_rad = evenly_spaced(-0.75 * std::numbers::pi, 0.75 * std::numbers::pi, 540);
  scan.range_max_m = 10.0;
  const Pose T_world_sensor = to_se3(compose(T_world_base, scan.T_base_sensor), 0.25);
  for (const double azimuth : scan.azimuth_rad) {
    const Eigen::Vector3d direction = T_world_sensor.linear() * beam_direction({azimuth, 0.0});
    const double range = cast_ray(scene, T_world_sensor.translation(), direction);
    scan.range_m.push_back(static_cast<float>(range + range_sigma_m * rng.normal()));
  }
  return scan;
}

inline constexpr double kTableHeight = 0.72;

/// A 1 x 1 m table on four legs in the middle of the room, with six objects on it.
inline SyntheticScene table_scene() {
  SyntheticScene scene;
  scene.boxes.push_back(box_at({0, 0, kTableHeight - 0.02}, {1.0, 1.0, 0.04}));
  for (const double x : {-0.45, 0.45}) {
    for (const double y : {-0.45, 0.45})
      scene.boxes.push_back(box_at({x, y, 0.34}, {0.05, 0.05, 0.68}));
  }
  scene.boxes.push_back(box_at({0.20, 0.10, 0.82}, {0.12, 0.08, 0.20}));
  scene.boxes.push_back(box_at({-0.25, 0.20, 0.79}, {0.10, 0.20, 0.14}));
  scene.boxes.push_back(box_at({-0.10, -0.28, 0.85}, {0.07, 0.07, 0.26}));
  scene.spheres.push_back({{0.30, -0.25, 0.79}, 0.07});
  scene.spheres.push_back({{-0.32, -0.10, 0.77}, 0.05});
  scene.spheres.push_back({{0.02, 0.33, 0.80}, 0.08});
  return scene;
}

/// A base on a circle of 1.2 m round the table, looking at its centre.
inline Pose2 view_of_table(double angle_rad) {
  return {1.2 * std::cos(angle_rad), 1.2 * std::sin(angle_rad),
          wrap_angle(angle_rad + std::numbers::pi)};
}

}  // namespace vantage::support
