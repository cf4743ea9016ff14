/// How a building stands in its scene: walls along x and y, the floor at z = 0.
#pragma once

#include <optional>

#include "vantage/building/building_mesh.hpp"

namespace vantage {

/// Heading of the walls, in (-45, 45] deg from the axes; 0 where most of them have no direction in
/// common.
double wall_heading_rad(const BuildingMesh& mesh);

/// Height of the floor: of places with 1.5 m of air above them the lowest level with at least a
/// quarter of the area of the largest one; none if no place has.
std::optional<double> floor_height_m(const BuildingMesh& mesh);

void transform(BuildingMesh& mesh, const Eigen::Isometry3d& T_scene_mesh);

}  // namespace vantage
