/// The scene as pages and figures draw it; `scene.bin` of a run folder.
#pragma once

#include <filesystem>
#include <vector>

#include "vantage/geometry/floor_outline.hpp"

namespace vantage {

struct ModelSource;
class World;

/// The scene as it is now, without the robot. @throws OutputError
void write_scene_file(const World& world, const std::filesystem::path& run_dir);

/// Outlines of its walls and furniture, from above. @throws InputError if it does not compile
std::vector<FloorOutline> scene_floor_plan(const ModelSource& source);

}  // namespace vantage
