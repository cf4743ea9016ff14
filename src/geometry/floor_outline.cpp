#include "vantage/geometry/floor_outline.hpp"

#include <Eigen/Geometry>

#include <numbers>

namespace vantage {
namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

FloorOutline convex_outline(std::vector<Vector2d> points) {
  // Of an edge along y rounding must not decide which end comes first.
  const auto place = [](const Vector2d& p) { return std::pair(std::round(1e9 * p.x()), p.y()); };
  std::ranges::sort(points, {}, place);
  FloorOutline hull;
  const auto add = [&](const Vector2d& p, std::size_t keep) {
    while (hull.size() >= keep + 2 &&
           cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 1e-12) {
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const Vector2d& p : points) add(p, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) add(*p, lower);
  hull.pop_back();
  return hull;
}

FloorOutline moved(std::span<const Vector2d> outline, const Pose2& T_new_old) {
  const Eigen::Rotation2Dd rotation(T_new_old.yaw_rad);
  FloorOutline result;
  for (const Vector2d& p : outline) {
    result.emplace_back(rotation * p + Vector2d(T_new_old.x_m, T_new_old.y_m));
  }
  return result;
}

FloorOutline grown(std::span<const Vector2d> outline, double margin_m) {
  constexpr int kCorners = 16;
  const double reach_m = margin_m / std::cos(std::numbers::pi / kCorners);
  std::vector<Vector2d> points;
  for (const Vector2d& p : outline) {
    for (int i = 0; i < kCorners; ++i) {
      const double angle_rad = std::numbers::pi * (2 * i + 1) / kCorners;
      points.emplace_back(p + reach_m * Vector2d(std::cos(angle_rad), std::sin(angle_rad)));
    }
  }
  return convex_outline(std::move(points));
}

double inscribed_radius_m(std::span<const Vector2d> outline) {
  double radius_m = 1e300;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d edge = outline[(i + 1) % outline.size()] - outline[i];
    radius_m = std::min(radius_m, cross(edge, -outline[i]) / edge.norm());
  }
  return radius_m;
}

double circumscribed_radius_m(std::span<const Vector2d> outline) {
  double radius_m = 0.0;
  for (const Vector2d& p : outline) radius_m = std::max(radius_m, p.norm());
  return radius_m;
}

}  // namespace vantage
