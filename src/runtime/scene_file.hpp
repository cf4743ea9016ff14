/// `scene.bin` of a run folder: what the page of the run draws of the scene.
#pragma once

#include <filesystem>

namespace vantage {

class World;

/// The scene as it is now, without the robot. @throws OutputError
void write_scene_file(const World& world, const std::filesystem::path& run_dir);

}  // namespace vantage
