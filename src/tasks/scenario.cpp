#include "vantage/tasks/scenario.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "vantage/core/data_root.hpp"
#include "vantage/core/strategy_label.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/tasks/flight/recognition_model_setting.hpp"

namespace vantage {
namespace {

constexpr double kMaxCells = 67108864.0;
/// What each view truly sees is worked out cell by cell.
constexpr double kMaxCellsOfAllViews = 2147483648.0;

std::string labels(const std::vector<Gain>& gains) {
  std::vector<std::string> names;
  for (const Gain& gain : gains) names.push_back(strategy_label(gain));
  return fmt::format("{}", fmt::join(names, ", "));
}

void check_flight(const Episode& episode) {
  if (episode.simulation.steps_per_tick() == 1) return;
  throw ConfigError(fmt::format(
      "simulation.control_period_s: {} must equal simulation.timestep_s = {}: a quadrotor is "
      "commanded at every step",
      episode.simulation.control_period_s, episode.simulation.timestep_s));
}

/// What stands on the table is what is expected there, unless it is another object.
void check_change(const Episode& episode) {
  const ChangeDetectionTask& task = episode.change_detection;
  const std::string& there = episode.recognition.object;
  if (task.scenario == to_string(Change::object)) {
    if (there.empty() || there != task.expected_object) return;
    throw ConfigError(fmt::format(
        "recognition.object: '{}' is what change_detection.expected_object says, so that scenario "
        "object changes nothing",
        there));
  }
  if (there.empty()) return;
  throw ConfigError(fmt::format(
      "recognition.object: '{}' is another object, which change_detection.scenario: {} has not; "
      "what should stand there is change_detection.expected_object",
      there, task.scenario));
}

/// A model that is not there yet is missed where it is needed: to replay an episode it is not.
void settle_recognition_model(ResolvedEpisode& resolved, const std::filesystem::path& base) {
  Episode& episode = resolved.episode;
  std::string& model = recognition_model_of(episode);
  if (!episode.flies() || model.empty()) return;
  try {
    model = lasting_name(find_input(model, base, recognition_model_key(episode)));
  } catch (const InputError&) {
    return;
  }
}

}  // namespace

double MapOptions::count() const { return static_cast<double>(cells[0]) * cells[1] * cells[2]; }

void MapOptions::check() const {
  if (count() > kMaxCells) {
    throw ConfigError(
        fmt::format("cells: {} x {} x {} is more than 2^26 cells", cells[0], cells[1], cells[2]));
  }
}

void MetricsOptions::check() const {
  for (const Gain& gain : predictors) {
    if (predicts_cells(gain)) continue;
    throw ConfigError(fmt::format("predictors: '{}' does not predict cells; those that do: {}",
                                  strategy_name_of(gain), labels(cell_predictors())));
  }
}

void ChangeDetectionTask::check() const {
  if (!change_named(scenario)) {
    throw ConfigError(fmt::format(
        "scenario: unknown scenario '{}'; known: none, object, pose, removed", scenario));
  }
  options.check();
}

void Episode::check() const {
  if (task != "next_best_view" && !flies()) {
    throw ConfigError(fmt::format(
        "task: unknown task '{}'; known: next_best_view, recognition, change_detection, trajectory",
        task));
  }
  if (detects_change()) check_change(*this);
  if (flies()) {
    check_flight(*this);
    return;
  }
  if (setting != "table_top" && setting != "office") {
    throw ConfigError(
        fmt::format("setting: unknown setting '{}'; known: table_top, office", setting));
  }
  if (in_office()) {
    swept_field(exploration.sweep, exploration.camera);
    return;
  }
  const double lines_per_tick = laser.line_rate_hz * simulation.control_period_s;
  if (std::abs(lines_per_tick - 1.0) > 1e-9) {
    throw ConfigError(fmt::format(
        "laser.line_rate_hz: {} must be 1 / simulation.control_period_s = {}: a line per tick",
        laser.line_rate_hz, 1.0 / simulation.control_period_s));
  }
  const double views = static_cast<double>(candidates.positions) *
                       static_cast<double>(candidates.yaw_offsets_rad.size());
  if (map.count() * views > kMaxCellsOfAllViews) {
    throw ConfigError(
        fmt::format("map.cells: {:.3g} cells times {} views of candidates.positions and "
                    "candidates.yaw_offsets_rad is more than 2^31",
                    map.count(), views));
  }
  if (robot.start_view >= candidates.positions) {
    throw ConfigError(fmt::format("robot.start_view: {} is not below candidates.positions = {}",
                                  robot.start_view, candidates.positions));
  }
}

ResolvedEpisode load_episode(const std::filesystem::path& path,
                             const std::vector<std::string>& overrides) {
  ConfigNode root = read_yaml(path);
  if (root.kind == ConfigNode::Kind::null) {
    throw ConfigError(path.string() + ": empty; an episode sets at least one key, as scans: 10");
  }
  for (const auto& assignment : overrides) apply_override(root, assignment);
  return resolve_episode(root, path);
}

ResolvedEpisode resolve_episode(const ConfigNode& root, const std::filesystem::path& path) {
  ResolvedEpisode resolved;
  resolved.name = path.stem().string();
  read_into(root, resolved.episode);
  const auto key = [&](const char* name, const ConfigNode* node) {
    return node == nullptr ? fmt::format("{}: {}", path.string(), name) : node->where();
  };
  const ConfigNode* robot = root.find("robot");
  const ConfigNode* model = robot == nullptr ? nullptr : robot->find("model");
  const auto base = path.parent_path();
  resolved.scene = find_input(resolved.episode.scene, base, key("scene", root.find("scene")));
  resolved.robot = find_input(resolved.episode.robot.model, base, key("robot.model", model));
  resolved.episode.scene = lasting_name(resolved.scene);
  settle_recognition_model(resolved, base);
  resolved.episode.robot.model = lasting_name(resolved.robot);
  return resolved;
}

std::string method_name(const Episode& episode) {
  if (episode.flies_trajectory()) {
    return trajectory_method_name(episode.trajectory.method, episode.trajectory.planner.cost);
  }
  if (episode.flies()) return strategy_label(episode.recognition.decision.views.choice);
  if (std::holds_alternative<GreedyGain>(episode.choice)) return strategy_label(episode.gain);
  const std::string choice = strategy_label(episode.choice);
  return weighs_gain(episode.choice) ? choice + " of " + strategy_label(episode.gain) : choice;
}

std::string episode_yaml(const Episode& episode) { return to_yaml(write_node(episode)); }

}  // namespace vantage
