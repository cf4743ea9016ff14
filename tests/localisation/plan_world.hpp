/// A building seen from above, a planar scanner in it and wheels that drift.
#pragma once

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/localisation/keyframe_graph.hpp"
#include "vantage/perception/clouds/registration.hpp"

namespace vantage::test_plan {

using Segment = std::pair<Eigen::Vector2d, Eigen::Vector2d>;

inline void add_box(std::vector<Segment>& walls, double x0, double y0, double x1, double y1) {
  const Eigen::Vector2d a(x0, y0);
  const Eigen::Vector2d b(x1, y0);
  const Eigen::Vector2d c(x1, y1);
  const Eigen::Vector2d d(x0, y1);
  for (const Segment& side : {Segment{a, b}, {b, c}, {c, d}, {d, a}}) walls.push_back(side);
}

/// A corridor `width_m` wide round a block; the outer edges are `x_m` and `y_m` long. Two piers
/// make no two corners alike.
inline std::vector<Segment> ring(double x_m, double y_m, double width_m) {
  std::vector<Segment> walls;
  add_box(walls, -x_m / 2, -y_m / 2, x_m / 2, y_m / 2);
  add_box(walls, width_m - x_m / 2, width_m - y_m / 2, x_m / 2 - width_m, y_m / 2 - width_m);
  add_box(walls, -x_m / 2, -1.0, 0.3 - x_m / 2, -0.6);
  add_box(walls, 1.0, y_m / 2 - 0.3, 1.4, y_m / 2);
  return walls;
}

inline double range_m(const std::vector<Segment>& walls, const Eigen::Vector2d& from,
                      const Eigen::Vector2d& along) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : walls) {
    const Eigen::Vector2d side = b - a;
    const double det = along.x() * side.y() - along.y() * side.x();
    if (std::abs(det) < 1e-12) continue;
    const Eigen::Vector2d to = a - from;
    const double way = (to.x() * side.y() - to.y() * side.x()) / det;
    const double share = (to.x() * along.y() - to.y() * along.x()) / det;
    if (way > 0.0 && share >= 0.0 && share <= 1.0) nearest = std::min(nearest, way);
  }
  return nearest;
}

/// 270 deg, a beam every half degree, up to 10 m.
inline PointCloud scan(const std::vector<Segment>& walls, const Pose2& T_world_base, double sigma_m,
                       Rng& rng, const RegistrationOptions& options) {
  PointCloud cloud;
  for (double azimuth = -2.356; azimuth <= 2.356; azimuth += 0.0087) {
    const double yaw = T_world_base.yaw_rad + azimuth;
    const double range =
        range_m(walls, {T_world_base.x_m, T_world_base.y_m}, {std::cos(yaw), std::sin(yaw)});
    if (range > 10.0) continue;
    const double measured = range + sigma_m * rng.normal();
    cloud.points.emplace_back(measured * std::cos(azimuth), measured * std::sin(azimuth), 0.25);
  }
  return prepare_scan(cloud, {0.0, 0.0, 0.25}, options);
}

/// From corner to corner in the middle of the corridor, turning at the corners, `laps` times round.
inline std::vector<Pose2> way_round(double x_m, double y_m, double width_m, int laps) {
  const double x = (x_m - width_m) / 2;
  const double y = (y_m - width_m) / 2;
  const std::vector<Eigen::Vector2d> corners{{-x, -y}, {x, -y}, {x, y}, {-x, y}};
  std::vector<Pose2> way;
  for (int side = 0; side < 4 * laps; ++side) {
    const Eigen::Vector2d& from = corners[static_cast<std::size_t>(side % 4)];
    const Eigen::Vector2d& to = corners[static_cast<std::size_t>((side + 1) % 4)];
    const double yaw = std::atan2(to.y() - from.y(), to.x() - from.x());
    const int steps = static_cast<int>((to - from).norm() / 0.5);
    for (int i = 0; i < steps; ++i) {
      const Eigen::Vector2d p = from + (to - from) * i / steps;
      way.push_back({p.x(), p.y(), yaw});
    }
  }
  return way;
}

/// What the wheels say of a step, and how sure they are: 3 % of the way and 2 % of the turn.
inline WheelStep wheels(const Pose2& from, const Pose2& to, Rng& rng) {
  WheelStep step;
  step.T_previous_now = compose(inverse(from), to);
  step.driven_m = std::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
  const double sigma_m = 0.03 * std::sqrt(step.driven_m) + 0.001;
  const double sigma_rad =
      0.015 * std::sqrt(step.driven_m) + 0.02 * std::abs(step.T_previous_now.yaw_rad) + 0.0005;
  step.T_previous_now.x_m += sigma_m * rng.normal();
  step.T_previous_now.y_m += sigma_m * rng.normal();
  step.T_previous_now.yaw_rad += sigma_rad * rng.normal();
  step.covariance = Eigen::Vector3d(sigma_m, sigma_m, sigma_rad).cwiseAbs2().asDiagonal();
  return step;
}

inline double worst_m(const std::vector<Pose2>& found, const std::vector<Pose2>& truth) {
  double worst = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    worst = std::max(worst, std::hypot(found[i].x_m - truth[i].x_m, found[i].y_m - truth[i].y_m));
  }
  return worst;
}

}  // namespace vantage::test_plan
