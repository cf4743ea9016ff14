#include "vantage/tasks/validate.hpp"

#include <fmt/format.h>

#include "vantage/belief/map/octomap_io.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/data_root.hpp"
#include "vantage/core/error.hpp"
#include "vantage/sim/robots/robot_check.hpp"
#include "vantage/sim/world/world.hpp"
#include "vantage/tasks/tabletop/start_check.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

/// As it will be loaded, beside the robot.
Validation validate_scene(const fs::path& file) {
  const RobotOptions robot;
  const World world({file, read_robot(find_input(robot.model, {}, "robot.model")).mjcf}, {});
  const RayScene geometry(world.model(), world.snapshot(), kWithoutRobot);
  if (has_table(geometry, Tabletop{})) return {};
  return {{},
          {file.string() + ": note: no table where map.centre_m and map.size_m are by default"}};
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

void require_start(const fs::path& file, const ResolvedEpisode& resolved) {
  try {
    std::visit([&](const auto& task) { task.require_start(resolved.setup); }, resolved.task);
  } catch (const ConfigError& error) {
    throw ConfigError(file.string() + ": " + error.what());
  } catch (const InputError& error) {
    throw InputError(file.string() + ": " + error.what());
  }
}

Validation validate_episode(const fs::path& file, const std::vector<std::string>& overrides) {
  return validation_of([&] {
    require_start(file, load_episode(file, overrides));
    return Validation{};
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
