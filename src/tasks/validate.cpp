#include "vantage/tasks/validate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <type_traits>

#include "vantage/belief/map/octomap_file.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/data_root.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/sim/robots/quadrotor.hpp"
#include "vantage/sim/robots/robot_check.hpp"
#include "vantage/sim/world/level_surfaces.hpp"
#include "vantage/sim/world/settle.hpp"
#include "vantage/sim/world/world.hpp"
#include "vantage/tasks/flight/recognition_model_file.hpp"
#include "vantage/tasks/robot_defaults.hpp"
#include "vantage/tasks/tabletop/table_region.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

/// A table top with defaults but for `overrides`, as `vantage run --set scene=FILE` has it.
Validation validate_as_table_top(const fs::path& file, const ConfigNode& root, bool defaults) {
  try {
    return {{}, require_start(file, resolve_episode(root, file)), ExitCode::done};
  } catch (const ConfigError& error) {
    if (!defaults) throw;
    return {{}, {fmt::format("{}: note: not with defaults: {}", file.string(), error.what())}};
  }
}

/// It loads beside the robot, and its free bodies come to rest without it.
Validation validate_scene(const fs::path& file, const std::vector<std::string>& overrides) {
  ConfigNode root = ConfigNode::make_map();
  root.set("scene", ConfigNode::make_scalar(fs::absolute(file).string(), true));
  apply_overrides(root, overrides);
  ResolvedEpisode tried;
  read_episode(root, tried.setup.options, tried.task);
  {
    const fs::path robot = find_input(RobotOptions{}.model, {}, "robot.model");
    const World beside(ModelSource{file, read_robot(robot).mjcf});
  }
  World world(ModelSource{.scene = file, .robot = {}});
  try {
    settle_free_bodies(world);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
  const auto* table_top = std::get_if<Tabletop>(&tried.task);
  if (table_top == nullptr ||
      !level_surfaces(world.model(), world.snapshot(), table_surfaces(table_top->table)).empty()) {
    return validate_as_table_top(file, root, overrides.empty());
  }
  return {{},
          {fmt::format("{}: note: {}; rooms are for task: exploration", file.string(),
                       no_table_text(world.model(), world.snapshot(), table_top->table))}};
}

/// A task's options for that robot, if an episode says nothing else.
Task task_of(const RobotFolder& robot, std::string_view name) {
  ConfigNode root = ConfigNode::make_map();
  root.set("task", ConfigNode::make_scalar(std::string(name)));
  if (std::holds_alternative<QuadrotorDescription>(robot.kind)) {
    root.set("simulation", write_node(kFlightWorld));
  }
  ResolvedEpisode resolved;
  read_episode(root, resolved.setup.options, resolved.task);
  read_episode(with_robot_defaults(root, episode_node(resolved), robot, name),
               resolved.setup.options, resolved.task);
  return resolved.task;
}

/// What keeps task T from this robot, by the heights of its sensors and its `episode_defaults`.
template <class T>
std::vector<std::string> misfits(const World& alone, const RobotFolder& robot) {
  try {
    const Task task = task_of(robot, T::name);
    if constexpr (requires(const T& t) { t.check_robot(alone, robot); }) {
      std::get<T>(task).check_robot(alone, robot);
    }
  } catch (const ConfigError& error) {
    return error.problems();
  }
  return {};
}

void check_names_of_tasks(const RobotFolder& robot, Validation& found) {
  const auto known = strategy_names<Task>();
  for (const auto& [name, keys] : robot.episode_defaults.entries) {
    if (std::ranges::find(known, name) != known.end()) continue;
    found.code = ExitCode::usage;
    found.problems.push_back(fmt::format("{}: episode_defaults: no task '{}'; known: {}",
                                         robot.description.string(), name, fmt::join(known, ", ")));
  }
}

/// Its model, and what tasks ask of it: a problem where robot.yaml has `episode_defaults` for
/// the task, else a note.
Validation validate_robot(const fs::path& file) {
  const RobotFolder robot = read_robot(file);
  check_robot(robot);
  const World alone(ModelSource{.scene = robot.mjcf, .robot = {}});
  const std::string where = robot.description.string();
  Validation found;
  check_names_of_tasks(robot, found);
  for_each_task([&]<class T>(const T&) {
    if (T::robot_kind() != strategy_name_of(robot.kind)) return;
    const bool meant = robot.episode_defaults.find(T::name) != nullptr;
    for (const std::string& misfit : misfits<T>(alone, robot)) {
      const std::string text =
          misfit.starts_with(where)
              ? misfit
              : fmt::format("{}: {}task {}: {}", where, meant ? "" : "note: ", T::name, misfit);
      (meant ? found.problems : found.notes).push_back(text);
      if (meant) found.code = ExitCode::usage;
    }
  });
  return found;
}

Validation validate_map(const fs::path& file) {
  if (OctomapFile(file).known().empty()) {
    throw InputError(file.string() + ": the map holds no cells");
  }
  return {};
}

Validation validate_model(const fs::path& file) {
  check_recognition_model(file);
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

Validation validate_file(const fs::path& file, const std::vector<std::string>& overrides) {
  return validation_of([&]() -> Validation {
    const std::string type = file.extension().string();
    std::error_code error;
    if (!fs::exists(file, error)) throw InputError(file.string() + ": no such file");
    const bool is_episode = type == ".yaml" || type == ".yml";
    const bool is_scene = type == ".xml" || type == ".mjcf";
    const bool is_robot = fs::exists(file / "robot.yaml", error) || file.filename() == "robot.yaml";
    if (!overrides.empty() && (is_robot || !(is_episode || is_scene))) {
      throw ConfigError(file.string() + ": --set is for episodes and scenes");
    }
    if (is_robot) return validate_robot(file);
    if (fs::is_directory(file, error)) {
      throw InputError(file.string() +
                       ": is a directory, and no robot: there is no robot.yaml in it");
    }
    if (is_episode) return validate_episode(file, overrides);
    if (is_scene) return validate_scene(file, overrides);
    if (type == ".bt" || type == ".ot") return validate_map(file);
    if (type == ".model") return validate_model(file);
    throw InputError(
        fmt::format("{}: unknown kind of file '{}'; known: .yaml, .xml, .bt, .ot, .model",
                    file.string(), type));
  });
}

}  // namespace vantage
