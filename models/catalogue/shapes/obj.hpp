/// Meshes as Wavefront OBJ files.
#pragma once

#include <filesystem>
#include <string>

#include "vantage/models/catalogue/shapes/mesh.hpp"

namespace vantage {

/// v, vt, vn and f lines with fixed decimals (10 um, 1e-4, 1e-3), equal entries written once, one
/// unnamed shape: the same bytes on every machine. Triangles that the rounding makes degenerate are
/// left out.
std::string to_obj(const TriangleMesh& mesh);

/// @throws OutputError if the file cannot be written.
void write_obj(const TriangleMesh& mesh, const std::filesystem::path& path);

}  // namespace vantage
