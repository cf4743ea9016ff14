#include "vantage/tasks/episode.hpp"

#include <fmt/format.h>

#include "vantage/core/data_root.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/runtime/manifest.hpp"
#include "vantage/sim/faults/outside_faults.hpp"
#include "vantage/sim/robots/robot_names.hpp"
#include "vantage/sim/robots/trajectory_tracking_controller.hpp"
#include "vantage/tasks/former_keys.hpp"
#include "vantage/tasks/robot_defaults.hpp"

namespace vantage {
namespace {

/// The task that the file names, with its defaults.
Task named_task(const ConfigNode& root) {
  const ConfigNode* node = root.find("task");
  if (node == nullptr) return Tabletop{};
  std::string name;
  read_into(*node, name);
  try {
    return make_strategy<Task>(name);
  } catch (const ConfigError& error) {
    throw ConfigError(node->where() + ": " + error.what());
  }
}

bool is_auto(const ConfigNode& node) {
  return node.kind == ConfigNode::Kind::scalar && !node.quoted && node.scalar == "auto";
}

/// `map: auto` and `map.centre_m: auto` are what the map has if nothing is said of it.
ConfigNode with_open_map(const ConfigNode& root) {
  ConfigNode open = root;
  const ConfigNode* map = root.find("map");
  if (map == nullptr) return open;
  ConfigNode left = is_auto(*map) ? ConfigNode{} : *map;
  std::erase_if(left.entries, [](const auto& entry) { return is_auto(entry.second); });
  open.set("map", std::move(left));
  return open;
}

/// "episode.yaml" of "episode.yaml:12"
std::string_view file_of(std::string_view origin) { return origin.substr(0, origin.rfind(':')); }

ConfigNode without_start(const ConfigNode& root, std::string_view key) {
  ConfigNode left = *root.find("robot");
  std::erase_if(left.entries, [&](const auto& entry) { return entry.first == key; });
  ConfigNode without = root;
  without.set("robot", std::move(left));
  return without;
}

/// A start that is set over an episode's file takes the place of the one that the file says,
/// whichever of the two keys says it. A site that is set to nothing is none.
/// @throws ConfigError if one place says both
ConfigNode with_one_start(const ConfigNode& root) {
  const ConfigNode* robot = root.find("robot");
  const ConfigNode* site = robot == nullptr ? nullptr : robot->find("start_site");
  const ConfigNode* pose = robot == nullptr ? nullptr : robot->find("start_pose");
  if (site != nullptr && site->kind == ConfigNode::Kind::null) {
    return without_start(root, "start_site");
  }
  if (site == nullptr || site->kind != ConfigNode::Kind::scalar || site->scalar.empty())
    return root;
  if (pose == nullptr || pose->kind == ConfigNode::Kind::null) return root;
  if (file_of(site->origin) == file_of(pose->origin)) {
    throw ConfigError(
        fmt::format("{}: the robot starts at robot.start_site '{}' already; one of the "
                    "two",
                    pose->where(), site->scalar));
  }
  const bool by_pose =
      pose->origin == kOverrideOrigin ||
      (site->origin != kOverrideOrigin && file_of(site->origin) == file_of(root.origin));
  return without_start(root, by_pose ? "start_site" : "start_pose");
}

/// @throws ConfigError of `check`, which begins with the key, with the place of that key
template <class Check>
void check_at_place(const ConfigNode& root, const Check& check) {
  try {
    check();
  } catch (const ConfigError& error) {
    throw ConfigError(detail::place_of(root, error.what()) + error.what());
  }
}

ConfigNode read_episode_yaml(const std::filesystem::path& path) {
  ConfigNode root = read_yaml(path);
  if (root.kind != ConfigNode::Kind::null) return root;
  throw ConfigError(path.string() + ": empty; an episode sets at least one key, as scans: 10");
}

/// @param key what named it
RobotFolder robot_at(const std::filesystem::path& path, const std::string& key) {
  try {
    return read_robot(path);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", key, error.what()));
  }
}

}  // namespace

void read_episode(const ConfigNode& said, EpisodeOptions& options, Task& task) {
  const ConfigNode root = with_one_start(with_open_map(said));
  if (root.kind != ConfigNode::Kind::null) detail::require_kind(root, ConfigNode::Kind::map);
  reject_former_keys(root);
  task = named_task(root);
  FieldReader reader(root);
  reader.allow("task");
  reader.set_owners(detail::owners_of<Task>);
  options.fields(reader);
  std::visit([&](auto& t) { t.fields(reader); }, task);
  reader.finish();
  check_at_place(root, [&] { std::visit([&](const auto& t) { t.check_with(options); }, task); });
}

ResolvedEpisode load_episode(const std::filesystem::path& path,
                             const std::vector<std::string>& overrides) {
  ConfigNode root = read_episode_yaml(path);
  apply_overrides(root, overrides);
  return resolve_episode(root, path);
}

ResolvedEpisode resolve_episode(const ConfigNode& root, const std::filesystem::path& path) {
  ResolvedEpisode resolved;
  EpisodeSetup& setup = resolved.setup;
  setup.name = path.stem().string();
  read_episode(root, setup.options, resolved.task);
  const auto key = [&](const char* name, const ConfigNode* node) {
    return node == nullptr ? fmt::format("{}: {}", path.string(), name) : node->where();
  };
  const ConfigNode* robot = root.find("robot");
  const ConfigNode* model = robot == nullptr ? nullptr : robot->find("model");
  const auto base = path.parent_path();
  setup.scene = find_input(setup.options.scene, base, key("scene", root.find("scene")));
  const auto robot_path = find_input(setup.options.robot.model, base, key("robot.model", model));
  setup.robot = robot_at(robot_path, key("robot.model", model));
  require_kind(setup.robot,
               std::visit([](const auto& task) { return task.robot_kind(); }, resolved.task),
               key("robot.model", model));
  read_episode(with_robot_defaults(root, episode_node(resolved), setup.robot,
                                   strategy_name_of(resolved.task)),
               setup.options, resolved.task);
  setup.options.scene = lasting_name(setup.scene);
  setup.options.robot.model = lasting_name(robot_path);
  std::visit([&](auto& task) { task.find_files(base); }, resolved.task);
  const auto resolve = [&](auto& task) {
    if constexpr (requires { task.resolve(setup); }) task.resolve(setup);
  };
  check_at_place(root, [&] { std::visit(resolve, resolved.task); });
  return resolved;
}

/// Names in it are absolute or of the data root, whatever else the working directory has.
ResolvedEpisode load_recorded(const std::filesystem::path& run_dir) {
  try {
    return resolve_episode(read_episode_yaml(run_dir / "config.yaml"), data_root() / "config.yaml");
  } catch (const ConfigError& error) {
    throw InputError(
        fmt::format("{}: not a configuration of this version, {}; manifest.json names "
                    "the one that recorded it",
                    error.what(), version_text()));
  }
}

std::string method_name(const Task& task) {
  return std::visit([](const auto& t) { return t.method_name(); }, task);
}

ModelSource model_source(const ResolvedEpisode& resolved) {
  return std::visit([&](const auto& task) { return task.model_source(resolved.setup); },
                    resolved.task);
}

void add_outside_effects(const ResolvedEpisode& resolved, World& world) {
  const EpisodeSetup& setup = resolved.setup;
  // Gusts of the task come first, as when it is flown: forces are added up in order.
  std::visit(
      [&](const auto& task) {
        if constexpr (requires { task.tracking.gusts; }) {
          const std::string& base = quadrotor_of(setup.robot, "robot.model").base;
          const RobotNames names(world.model(), setup.robot.description.string());
          add_gusts(world, names.find(ModelObject::body, "base", base), task.tracking.gusts);
        }
      },
      resolved.task);
  add_outside_faults(world, setup.options.faults, setup.options.seed);
}

std::vector<InputFile> inputs(const Task& task) {
  return std::visit([](const auto& t) { return t.inputs(); }, task);
}

TaskExtent extent(const ResolvedEpisode& resolved) {
  return std::visit([&](const auto& task) { return task.extent(resolved.setup); }, resolved.task);
}

WindowContent window(const ResolvedEpisode& resolved) {
  return std::visit(
      [&](const auto& task) {
        if constexpr (requires { task.window(resolved.setup); }) {
          return task.window(resolved.setup);
        } else {
          return task.window();
        }
      },
      resolved.task);
}

ReportSections report_sections(const Task& task) {
  return std::visit([](const auto& t) { return t.report(); }, task);
}

ReportSections recorded_sections(const std::filesystem::path& run_dir) {
  try {
    return report_sections(named_task(read_episode_yaml(run_dir / "config.yaml")));
  } catch (const ConfigError& error) {
    throw InputError(error.what());
  }
}

Measures measures(const Task& task) {
  return std::visit([](const auto& t) { return t.measures(); }, task);
}

}  // namespace vantage
