/// Meshes of buildings made in memory, corner by corner, whose vertices are not joined.
#pragma once

#include <cmath>
#include <tuple>

#include "vantage/building/building_mesh.hpp"

namespace vantage::test {

struct MadeMesh {
  BuildingMesh mesh;

  void triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    const int first = static_cast<int>(mesh.vertices_m.size());
    for (const Eigen::Vector3d& p_m : {a, b, c}) mesh.vertices_m.push_back(p_m);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.colours.emplace_back(-1.0F, -1.0F, -1.0F);
    mesh.objects.push_back(0);
  }
  /// Faces where its corners go round counter-clockwise.
  void quad(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
            const Eigen::Vector3d& d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }
  void level(double x0, double y0, double x1, double y1, double z, bool up) {
    if (up) {
      quad({x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z});
    } else {
      quad({x0, y1, z}, {x1, y1, z}, {x1, y0, z}, {x0, y0, z});
    }
  }
  /// Across x, from the floor up, facing along x.
  void wall_x(double x, double y0, double y1, double height) {
    quad({x, y0, 0}, {x, y1, 0}, {x, y1, height}, {x, y0, height});
  }
  /// Upright above the line from `from` towards `heading_rad`.
  void wall(const Eigen::Vector2d& from, double heading_rad, double length, double height) {
    const Eigen::Vector2d to =
        from + length * Eigen::Vector2d(std::cos(heading_rad), std::sin(heading_rad));
    quad({from.x(), from.y(), 0}, {to.x(), to.y(), 0}, {to.x(), to.y(), height},
         {from.x(), from.y(), height});
  }
  /// Facing outwards.
  void box(const Eigen::Vector3d& low, const Eigen::Vector3d& high, bool with_top = true) {
    const auto [x0, y0, z0] = std::tuple(low.x(), low.y(), low.z());
    const auto [x1, y1, z1] = std::tuple(high.x(), high.y(), high.z());
    level(x0, y0, x1, y1, z0, false);
    if (with_top) level(x0, y0, x1, y1, z1, true);
    quad({x1, y0, z0}, {x1, y1, z0}, {x1, y1, z1}, {x1, y0, z1});
    quad({x0, y1, z0}, {x0, y0, z0}, {x0, y0, z1}, {x0, y1, z1});
    quad({x0, y0, z0}, {x1, y0, z0}, {x1, y0, z1}, {x0, y0, z1});
    quad({x1, y1, z0}, {x0, y1, z0}, {x0, y1, z1}, {x1, y1, z1});
  }
};

}  // namespace vantage::test
