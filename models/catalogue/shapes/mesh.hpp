/// Textured triangle meshes: the value, and what can be measured on it.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <vector>

#include "vantage/geometry/pose.hpp"

namespace vantage {

/// Positions, normals and texture coordinates have one entry per vertex. A position occurs several
/// times where the normal or the texture breaks. Triangles are counter-clockwise from outside.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> positions_m;
  std::vector<Eigen::Vector3d> normals;  ///< unit length, outward
  std::vector<Eigen::Vector2d> uvs;      ///< v up
  std::vector<std::array<int, 3>> triangles;

  /// @return the index of the new vertex.
  int add_vertex(const Eigen::Vector3d& p_m, const Eigen::Vector3d& normal,
                 const Eigen::Vector2d& uv);
  /// Two triangles of the quad a, b, c, d (counter-clockwise from outside).
  void add_quad(int a, int b, int c, int d);
};

/// Two vertices nearer than this are one point of the surface; also what the OBJ writer keeps.
inline constexpr double kWeld_m = 1e-5;

void append(TriangleMesh& mesh, const TriangleMesh& part,
            const Pose& T_mesh_part = Pose::Identity());
void transform(TriangleMesh& mesh, const Pose& T_new_old);
/// Per axis, about the origin; factors > 0.
void scale(TriangleMesh& mesh, const Eigen::Vector3d& factors);

Eigen::AlignedBox3d bounds(const TriangleMesh& mesh);
/// By the divergence theorem; positive if the triangles face outward. Overlapping parts count
/// twice.
double signed_volume_m3(const TriangleMesh& mesh);
/// Every edge is used exactly once in each direction, vertices welded at kWeld_m.
bool is_watertight(const TriangleMesh& mesh);
/// Index of the welded point of each vertex, numbered in order of first use.
std::vector<int> weld(const TriangleMesh& mesh);

}  // namespace vantage
