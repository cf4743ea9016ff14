#include "vantage/building/line_crossings.hpp"

#include <algorithm>
#include <array>
#include <tuple>

namespace vantage {
namespace {

/// u and v of the corners of a triangle, and what is along the line.
struct Projected {
  std::array<Eigen::Vector2d, 3> uv;
  Eigen::Vector3d along;
};

/// Where the edge from a to b crosses v, from whichever end it is looked at. It crosses if
/// min <= v < max.
bool crosses(Eigen::Vector2d a, Eigen::Vector2d b, double v, double& u) {
  if (std::tuple(b.y(), b.x()) < std::tuple(a.y(), a.x())) std::swap(a, b);
  if (v < a.y() || v >= b.y()) return false;
  u = a.x() + (b.x() - a.x()) * ((v - a.y()) / (b.y() - a.y()));
  return true;
}

std::size_t first_from(const std::vector<double>& values, double at) {
  return static_cast<std::size_t>(std::ranges::lower_bound(values, at) - values.begin());
}

/// Calls `f` with the indices of every line that meets the triangle.
void for_each_line(const Projected& p, const std::vector<double>& u_m,
                   const std::vector<double>& v_m, auto&& f) {
  const auto [low, high] = std::minmax({p.uv[0].y(), p.uv[1].y(), p.uv[2].y()});
  for (std::size_t v = first_from(v_m, low); v < v_m.size() && v_m[v] < high; ++v) {
    std::array<double, 3> at{};
    std::size_t found = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (crosses(p.uv[i], p.uv[(i + 1) % 3], v_m[v], at[found])) ++found;
    }
    if (found != 2) continue;
    const auto [left, right] = std::minmax(at[0], at[1]);
    for (std::size_t u = first_from(u_m, left); u < u_m.size() && u_m[u] < right; ++u) f(u, v);
  }
}

}  // namespace

std::vector<Crossing> line_crossings(const BuildingMesh& mesh,
                                     const std::vector<Triangle>& triangles, int axis,
                                     const std::vector<double>& u_m,
                                     const std::vector<double>& v_m) {
  const int u_axis = (axis + 1) % 3;
  const int v_axis = (axis + 2) % 3;
  std::vector<Crossing> crossings;
  for (const Triangle& triangle : triangles) {
    const Eigen::Vector3d normal = mesh.normal(triangle);
    if (normal[axis] == 0.0) continue;
    Projected p;
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d& corner = mesh.corner(triangle, i);
      p.uv[i] = {corner[u_axis], corner[v_axis]};
      p.along[static_cast<Eigen::Index>(i)] = corner[axis];
    }
    for_each_line(p, u_m, v_m, [&](std::size_t u, std::size_t v) {
      const double rise =
          normal[u_axis] * (u_m[u] - p.uv[0].x()) + normal[v_axis] * (v_m[v] - p.uv[0].y());
      const double at_m =
          std::clamp(p.along[0] - rise / normal[axis], p.along.minCoeff(), p.along.maxCoeff());
      crossings.push_back(
          {static_cast<std::uint32_t>(v * u_m.size() + u), at_m, normal[axis] > 0.0 ? 1 : -1});
    });
  }
  std::ranges::stable_sort(crossings, {},
                           [](const Crossing& c) { return std::tuple(c.line, c.at_m); });
  return crossings;
}

}  // namespace vantage
