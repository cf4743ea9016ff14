#include "vantage/tasks/validate.hpp"

#include <fmt/format.h>

#include <type_traits>

#include "vantage/belief/map/octomap_io.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/data_root.hpp"
#include "vantage/core/error.hpp"
#include "vantage/sim/robots/robot_check.hpp"
#include "vantage/sim/world/level_surfaces.hpp"
#include "vantage/sim/world/settle.hpp"
#include "vantage/sim/world/world.hpp"
#include "vantage/tasks/tabletop/table_region.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

/// A table top with defaults, as `vantage run --set scene=FILE` has it.
Validation validate_as_table_top(const fs::path& file) {
  ConfigNode root = ConfigNode::make_map();
  root.set("scene", ConfigNode::make_scalar(fs::absolute(file).string(), true));
  try {
    return {{}, require_start(file, resolve_episode(root, file)), ExitCode::done};
  } catch (const ConfigError& error) {
    return {{}, {fmt::format("{}: note: not with defaults: {}", file.string(), error.what())}};
  }
}

/// It loads beside the robot, and its free bodies come to rest without it.
Validation validate_scene(const fs::path& file) {
  const RobotOptions robot;
  World(ModelSource{file, read_robot(find_input(robot.model, {}, "robot.model")).mjcf});
  World world(ModelSource{.scene = file, .robot = {}});
  try {
    settle_free_bodies(world);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
  const TableOptions table;
  const auto surfaces = level_surfaces(world.model(), world.snapshot(), table_surfaces(table));
  if (!surfaces.empty()) return validate_as_table_top(file);
  return {{},
          {fmt::format("{}: note: {}; rooms are for task: exploration", file.string(),
                       no_table_text(world.model(), world.snapshot(), table))}};
}

Validation validate_map(const fs::path& file) {
  const OctomapContent content = read_octomap(file);
  if (content.occupied + content.free == 0) {
    throw InputError(file.string() + ": the map holds no cells");
  }
  return {};
}

}  // namespace

Validation validation_of(const std::function<Validation()>& check) {
  try {
    return check();
  } catch (const ConfigError& error) {
    return {error.problems(), {}, error.code()};
  } catch (const Error& error) {
    return {{error.what()}, {}, error.code()};
  }
}

std::vector<std::string> require_start(const fs::path& file, const ResolvedEpisode& resolved) {
  std::vector<std::string> notes;
  try {
    std::visit(
        [&](const auto& task) {
          if constexpr (std::is_void_v<decltype(task.require_start(resolved.setup))>) {
            task.require_start(resolved.setup);
          } else {
            notes = task.require_start(resolved.setup);
          }
        },
        resolved.task);
  } catch (const ConfigError& error) {
    throw ConfigError(file.string() + ": " + error.what());
  } catch (const InputError& error) {
    throw InputError(file.string() + ": " + error.what());
  }
  for (std::string& note : notes) note = fmt::format("{}: note: {}", file.string(), note);
  return notes;
}

Validation validate_episode(const fs::path& file, const std::vector<std::string>& overrides) {
  return validation_of([&] {
    return Validation{{}, require_start(file, load_episode(file, overrides)), ExitCode::done};
  });
}

Validation validate_file(const fs::path& file) {
  return validation_of([&]() -> Validation {
    const std::string type = file.extension().string();
    std::error_code error;
    if (!fs::exists(file, error)) throw InputError(file.string() + ": no such file");
    if (fs::exists(file / "robot.yaml", error) || file.filename() == "robot.yaml") {
      check_robot(read_robot(file));
      return {};
    }
    if (fs::is_directory(file, error)) {
      throw InputError(file.string() + ": is a directory, expected a file");
    }
    if (type == ".yaml" || type == ".yml") return validate_episode(file);
    if (type == ".xml" || type == ".mjcf") return validate_scene(file);
    if (type == ".bt" || type == ".ot") return validate_map(file);
    throw InputError(fmt::format("{}: unknown kind of file '{}'; known: .yaml, .xml, .bt, .ot",
                                 file.string(), type));
  });
}

}  // namespace vantage
