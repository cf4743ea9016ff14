/// Offices as MJCF, readable by MuJoCo 2.2.2 and its viewer.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vantage/models/catalogue/office/office_scene.hpp"

namespace vantage {

/// The text of scene.xml. Bodies have no joints: one for the furniture and walls on each tile of
/// the floor ("tile_2_3"). MuJoCo sorts bodies along one axis and then tests each geom of one
/// against each of the other: a body apiece for every chair, or one for all of them, takes several
/// times as long. Furniture is called after its kind ("desk_03"); contacts with it are those of its
/// convex hull or, where that would fill a recess, of unseen convex pieces
/// ("partition_01_solid_0"). Door posts and what hangs on walls have none. Sites `start_0` ...
/// `start_4` on the floor, turned by their yaw, are where a robot may begin.
std::string to_mjcf(const OfficeScene& scene);

/// Names of the scene's furniture in order, unique.
std::vector<std::string> furniture_names(const OfficeScene& scene);

/// Writes scene.xml, meshes/ and textures/ into `directory`; what was in the latter two is removed.
/// @throws OutputError if a file cannot be written.
void write_scene(const OfficeScene& scene, const std::filesystem::path& directory);

}  // namespace vantage
