/// A building as triangles.
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <vector>

namespace vantage {

using Triangle = std::array<int, 3>;  ///< indices of vertices

/// z up, metres. Vertices at the same place are one.
struct BuildingMesh {
  std::vector<Eigen::Vector3d> vertices_m;
  std::vector<Triangle> triangles;
  std::vector<Eigen::Vector3f> colours;  ///< rgb, 0 to 1, of each triangle; below 0: none
  std::vector<int> objects;              ///< of the file, which each triangle belongs to

  [[nodiscard]] const Eigen::Vector3d& corner(const Triangle& triangle, std::size_t which) const {
    return vertices_m[static_cast<std::size_t>(triangle[which])];
  }
  /// Perpendicular to the triangle, twice its area long.
  [[nodiscard]] Eigen::Vector3d normal(const Triangle& triangle) const {
    const Eigen::Vector3d& a = corner(triangle, 0);
    return (corner(triangle, 1) - a).cross(corner(triangle, 2) - a);
  }
};

}  // namespace vantage
