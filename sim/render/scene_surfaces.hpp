/// A scene as coarse coloured triangles, for pages that draw it without a simulator.
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <vector>

#include "vantage/sim/render/outer_walls.hpp"

struct mjData_;
using mjData = mjData_;

namespace vantage {

struct SceneSurfaces {
  using Triangle = std::array<std::uint32_t, 3>;

  Eigen::AlignedBox3d extent_m;                      ///< of OuterWalls
  std::vector<Eigen::Vector3f> vertices_m;           ///< world
  std::vector<std::array<std::uint8_t, 3>> colours;  ///< rgb, one a vertex
  /// What is always drawn, then each side of OuterWalls.
  std::array<std::vector<Triangle>, OuterWalls::kSides + 1> triangles;
};

/// What people see of the scene as `data` has it, but for the robot in it. Meshes of many triangles
/// are joined up; a texture is sampled at the vertices of a mesh, and its mean elsewhere.
SceneSurfaces scene_surfaces(const mjModel& model, const mjData& data);

}  // namespace vantage
