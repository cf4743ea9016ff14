/// Scene composition: any MJCF scene of the user's and one of our robots, in one model.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

struct mjModel_;
using mjModel = mjModel_;

namespace vantage {

struct ModelDeleter {
  void operator()(mjModel* model) const;
};
using ModelPtr = std::unique_ptr<mjModel, ModelDeleter>;

struct MemoryFile {
  std::string name;  ///< as the MJCF calls it
  std::string content;
};

/// Two MJCF files. The scene may use any `<compiler>` settings and includes. When a robot joins it,
/// its numbers are rounded to six digits and its keyframes dropped (their length would no longer
/// fit), and names starting with `robot/` belong to the robot. The robot brings no files of its
/// own.
struct ModelSource {
  std::filesystem::path scene;
  std::filesystem::path robot;  ///< empty: no robot
  std::vector<MemoryFile> files =
      {};  ///< stand in for files of these names that the scene refers to
};

struct LoadedModel {
  ModelPtr model;
  std::vector<std::string> warnings;  ///< MuJoCo's, while it compiled
};

/// Compiles the scene and the robot, each for itself so that errors name the right file and line,
/// then both together. Thread-safe (one at a time).
/// @throws InputError with the file and MuJoCo's message if one is missing, malformed, holds a
/// number that is not finite, a time step outside (0, 0.1] s, or a scene name like `robot/...`.
LoadedModel load_model(const ModelSource& source);

/// Compiles a scene that is nowhere on disk, with the meshes and textures it names. `name` stands
/// for it in messages. Thread-safe (one at a time).
/// @throws InputError as above.
LoadedModel load_model(std::string_view mjcf, std::span<const MemoryFile> files,
                       const std::string& name);

}  // namespace vantage
