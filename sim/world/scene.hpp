/// Scene composition: any MJCF scene of the user's and one of our robots, in one model.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/sim/world/model_source.hpp"

struct mjModel_;
using mjModel = mjModel_;

namespace vantage {

struct ModelDeleter {
  void operator()(mjModel* model) const;
};
using ModelPtr = std::unique_ptr<mjModel, ModelDeleter>;

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
