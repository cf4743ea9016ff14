#include <cmath>
#include <numeric>
#include <vector>

#include "vantage/core/error.hpp"
#include "vantage/models/catalogue/shapes/mesh_builders.hpp"

namespace vantage {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

bool inside_triangle(const Vector2d& p, const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return cross(b - a, p - a) >= 0.0 && cross(c - b, p - b) >= 0.0 && cross(a - c, p - c) >= 0.0;
}

bool is_ear(std::span<const Vector2d> outline, const std::vector<int>& left, std::size_t k) {
  const std::size_t n = left.size();
  const auto point = [&](std::size_t i) { return outline[static_cast<std::size_t>(left[i % n])]; };
  const Vector2d a = point(k + n - 1);
  const Vector2d b = point(k);
  const Vector2d c = point(k + 1);
  if (cross(b - a, c - b) <= 0.0) return false;
  for (std::size_t i = 0; i < n; ++i) {
    if (i == k || i == (k + 1) % n || i == (k + n - 1) % n) continue;
    if (inside_triangle(point(i), a, b, c)) return false;
  }
  return true;
}

/// Ear clipping [Meisters1975]; counter-clockwise triangles of a simple polygon.
std::vector<std::array<int, 3>> triangulate(std::span<const Vector2d> outline) {
  std::vector<int> left(outline.size());
  std::iota(left.begin(), left.end(), 0);
  std::vector<std::array<int, 3>> triangles;
  while (left.size() > 3) {
    std::size_t k = 0;
    while (k < left.size() && !is_ear(outline, left, k)) ++k;
    expects(k < left.size(), "the outline is a simple counter-clockwise polygon");
    const std::size_t n = left.size();
    triangles.push_back({left[(k + n - 1) % n], left[k], left[(k + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
  }
  triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

Vector2d outward(const Vector2d& edge) { return Vector2d(edge.y(), -edge.x()).normalized(); }

/// Every edge moved inward by `distance`.
std::vector<Vector2d> inset(std::span<const Vector2d> outline, double distance) {
  std::vector<Vector2d> moved;
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2d before = outward(outline[i] - outline[(i + n - 1) % n]);
    const Vector2d after = outward(outline[(i + 1) % n] - outline[i]);
    const Vector2d bisector = before + after;  // (before + after) . before = 1 + before . after
    moved.emplace_back(outline[i] - distance / (1.0 + before.dot(after)) * bisector);
  }
  return moved;
}

void add_cap(TriangleMesh& mesh, std::span<const Vector2d> outline, double z_m, bool up,
             const UvRect& uv) {
  Eigen::AlignedBox2d box;
  for (const Vector2d& p : outline) box.extend(p);
  const int first = static_cast<int>(mesh.positions_m.size());
  for (const Vector2d& p : outline) {
    const Vector2d f = (p - box.min()).cwiseQuotient(box.sizes());
    mesh.add_vertex({p.x(), p.y(), z_m}, Vector3d(0, 0, up ? 1 : -1),
                    uv.at(up ? f.x() : 1.0 - f.x(), f.y()));
  }
  for (const auto& [a, b, c] : triangulate(outline)) {
    if (up) {
      mesh.triangles.push_back({first + a, first + b, first + c});
    } else {
      mesh.triangles.push_back({first + a, first + c, first + b});
    }
  }
}

/// A flat-shaded band between a lower and an upper outline.
void add_band(TriangleMesh& mesh, std::span<const Vector2d> low, double z_low,
              std::span<const Vector2d> high, double z_high, const UvRect& uv) {
  const std::size_t n = low.size();
  std::vector<double> along{0.0};
  for (std::size_t i = 0; i < n; ++i) {
    along.push_back(along.back() + (low[(i + 1) % n] - low[i]).norm());
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = (i + 1) % n;
    const Vector3d a(low[i].x(), low[i].y(), z_low);
    const Vector3d b(low[k].x(), low[k].y(), z_low);
    const Vector3d c(high[k].x(), high[k].y(), z_high);
    const Vector3d d(high[i].x(), high[i].y(), z_high);
    const Vector3d normal = (b - a).cross(d - a);
    const double s0 = along[i] / along.back();
    const double s1 = along[i + 1] / along.back();
    const int first = mesh.add_vertex(a, normal, uv.at(s0, 0.0));
    mesh.add_vertex(b, normal, uv.at(s1, 0.0));
    mesh.add_vertex(c, normal, uv.at(s1, 1.0));
    mesh.add_vertex(d, normal, uv.at(s0, 1.0));
    mesh.add_quad(first, first + 1, first + 2, first + 3);
  }
}

}  // namespace

TriangleMesh make_extrusion(std::span<const Vector2d> outline_m, double height_m, double bevel_m,
                            const ExtrusionUv& uv) {
  expects(outline_m.size() >= 3 && height_m > 2.0 * bevel_m, "an extrusion has an outline");
  TriangleMesh mesh;
  if (bevel_m <= 0.0) {
    add_cap(mesh, outline_m, 0.0, false, uv.bottom);
    add_band(mesh, outline_m, 0.0, outline_m, height_m, uv.side);
    add_cap(mesh, outline_m, height_m, true, uv.top);
    return mesh;
  }
  const std::vector<Vector2d> cap_m = inset(outline_m, bevel_m);
  const double t = bevel_m / height_m;
  add_cap(mesh, cap_m, 0.0, false, uv.bottom);
  add_band(mesh, cap_m, 0.0, outline_m, bevel_m, part_of(uv.side, 0.0, 0.0, 1.0, t));
  add_band(mesh, outline_m, bevel_m, outline_m, height_m - bevel_m,
           part_of(uv.side, 0.0, t, 1.0, 1.0 - t));
  add_band(mesh, outline_m, height_m - bevel_m, cap_m, height_m,
           part_of(uv.side, 0.0, 1.0 - t, 1.0, 1.0));
  add_cap(mesh, cap_m, height_m, true, uv.top);
  return mesh;
}

}  // namespace vantage
