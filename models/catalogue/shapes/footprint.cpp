#include "vantage/models/catalogue/shapes/footprint.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vantage {
namespace {

using Eigen::Vector2d;

double turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b - a).x() * (c - b).y() - (b - a).y() * (c - b).x();
}

/// Gap between the outlines along the outward normals of a's edges, the largest one.
double gap_along_edges(std::span<const Vector2d> a, std::span<const Vector2d> b) {
  double largest = -1e9;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vector2d edge = a[(i + 1) % a.size()] - a[i];
    const Vector2d normal = Vector2d(edge.y(), -edge.x()).normalized();
    double nearest = 1e9;
    for (const Vector2d& p : b) nearest = std::min(nearest, normal.dot(p - a[i]));
    largest = std::max(largest, nearest);
  }
  return largest;
}

}  // namespace

Outline convex_outline(std::vector<Vector2d> points) {
  std::ranges::sort(points, [](const Vector2d& a, const Vector2d& b) {
    return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
  });
  Outline hull;
  const auto add = [&](const Vector2d& p, std::size_t keep) {
    while (hull.size() >= keep + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 1e-12) {
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

Outline convex_footprint(const TriangleMesh& mesh) {
  std::vector<Vector2d> points;
  points.reserve(mesh.positions_m.size());
  for (const auto& p : mesh.positions_m) points.emplace_back(p.head<2>());
  return convex_outline(std::move(points));
}

Outline moved(std::span<const Vector2d> outline, const Pose2& T_new_old) {
  const Eigen::Rotation2Dd rotation(T_new_old.yaw_rad);
  Outline result;
  for (const Vector2d& p : outline) {
    result.emplace_back(rotation * p + Vector2d(T_new_old.x_m, T_new_old.y_m));
  }
  return result;
}

bool too_close(std::span<const Vector2d> a, std::span<const Vector2d> b, double clearance_m) {
  return gap_along_edges(a, b) < clearance_m && gap_along_edges(b, a) < clearance_m;
}

}  // namespace vantage
