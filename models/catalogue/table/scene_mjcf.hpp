/// Table scenes as MJCF, readable by MuJoCo 2.2.2 and its viewer.
#pragma once

#include <filesystem>
#include <string>

#include "vantage/models/catalogue/table/table_scene.hpp"

namespace vantage {

/// The text of scene.xml: room, table, furniture, objects, lights and cameras. Bodies are named by
/// the object ("mug_03"), their geoms "<object>/mesh"; the table's top is "table/top".
std::string to_mjcf(const TableScene& scene);

/// Writes scene.xml, meshes/ and textures/ into `directory`; what was in the latter two is removed.
/// @throws OutputError if a file cannot be written.
void write_scene(const TableScene& scene, const std::filesystem::path& directory);

}  // namespace vantage
