/// Meshes of buildings from files: OBJ, PLY, STL, glTF and what else Assimp reads.
#pragma once

#include <filesystem>
#include <string>

#include "vantage/building/building_mesh.hpp"

namespace vantage {

enum class UpAxis { y, z };

/// What a format's own rules say: y for glTF, z for all others.
UpAxis usual_up_axis(const std::filesystem::path& file);

struct MeshReading {
  double scale = 1.0;  ///< metres that 1 in the file stands for
  UpAxis up = UpAxis::z;
};

/// All meshes of the file where its nodes place them.
/// @throws InputError naming the file if it cannot be read, has no triangles, a coordinate that is
/// not finite, or lies so far from its origin that single precision loses a centimetre.
BuildingMesh read_building_mesh(const std::filesystem::path& file, const MeshReading& reading);

}  // namespace vantage
