#include "vantage/models/catalogue/shapes/footprint.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vantage {
namespace {

using Eigen::Vector2d;

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

Outline convex_footprint(const TriangleMesh& mesh) {
  std::vector<Vector2d> points;
  points.reserve(mesh.positions_m.size());
  for (const auto& p : mesh.positions_m) points.emplace_back(p.head<2>());
  return convex_outline(std::move(points));
}

bool too_close(std::span<const Vector2d> a, std::span<const Vector2d> b, double clearance_m) {
  return gap_along_edges(a, b) < clearance_m && gap_along_edges(b, a) < clearance_m;
}

}  // namespace vantage
