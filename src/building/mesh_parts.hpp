/// The parts that a building's mesh falls into, and which of them are solid.
#pragma once

#include "vantage/building/building_mesh.hpp"

namespace vantage {

/// Triangles that hang together by edges that two of them share, or two of one object.
struct MeshPart {
  std::vector<Triangle> triangles;  ///< all wound alike where they can be
  Eigen::Vector3f colour = Eigen::Vector3f::Zero();
  bool closed = false;     ///< every edge has as many triangles on one side as on the other
  double volume_m3 = 0.0;  ///< of a closed one; negative: what is inside is air, as of a room
};

/// In the order of their first triangles. A closed part that is wound inside out is turned, unless
/// it is as large as a room: then it is the surface of one, seen from inside.
std::vector<MeshPart> mesh_parts(const BuildingMesh& mesh);

/// A box in the frame of the mesh.
struct OrientedBox {
  Eigen::Isometry3d T_mesh_box = Eigen::Isometry3d::Identity();
  Eigen::Vector3d half_m = Eigen::Vector3d::Zero();
};

bool is_solid(const MeshPart& part);
/// Solid, of not too many corners, and its own convex hull within a millimetre.
bool is_convex(const BuildingMesh& mesh, const MeshPart& part);
/// Of a convex part: whether it has a box's three directions of faces.
bool is_box(const BuildingMesh& mesh, const MeshPart& part, OrientedBox& box);
/// Corners of a part, each once.
std::vector<Eigen::Vector3d> corners_of(const BuildingMesh& mesh, const MeshPart& part);

}  // namespace vantage
