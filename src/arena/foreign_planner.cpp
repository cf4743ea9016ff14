#include "vantage/arena/foreign_planner.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/runtime/process/command_files.hpp"
#include "vantage/runtime/scratch_folder.hpp"
#include "vantage/study/results.hpp"
#include "vantage/study/study_reading.hpp"
#include "vantage/tasks/episode_planner.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

ConfigNode text_node(const std::string& text) { return ConfigNode::make_scalar(text, true); }

ConfigNode level_of(const ForeignPlanner& planner) {
  ConfigNode command = ConfigNode::make_list();
  for (const std::string& word : settled_command(planner.command, fs::current_path())) {
    command.items.push_back(text_node(word));
  }
  ConfigNode choice = ConfigNode::make_map();
  choice.set("name", ConfigNode::make_scalar("external"));
  choice.set("command", std::move(command));
  choice.set("timeout_s", ConfigNode::make_scalar(fmt::format("{}", planner.timeout_s)));
  ConfigNode level = ConfigNode::make_map();
  level.set("choice", std::move(choice));
  return level;
}

ConfigNode& child(ConfigNode& node, const std::string& name) {
  return *const_cast<ConfigNode*>(node.find(name));
}

/// A split that names planners has this one too.
void add_to_split(ConfigNode& root, const Study& study, const std::string& name) {
  if (study.split.empty()) return;
  ConfigNode& split = child(child(root, "splits"), study.split);
  if (split.find(study.report.compare) == nullptr) return;
  auto& names = child(split, study.report.compare).items;
  if (std::ranges::find(names, name, &ConfigNode::scalar) == names.end()) {
    names.push_back(text_node(name));
  }
}

}  // namespace

Study study_with(const fs::path& arena, const ForeignPlanner& planner, bool replace) {
  if (!is_study_name(planner.name)) {
    throw ConfigError(fmt::format("NAME: '{}' {}", planner.name, kStudyNameRule));
  }
  runnable_command(planner.command);
  const fs::path file = arena / "study.yaml";
  const Study before = read_study(file);
  ConfigNode root = read_yaml(file);
  ConfigNode* factors = const_cast<ConfigNode*>(root.find("factors"));
  if (factors == nullptr || factors->find(before.report.compare) == nullptr) {
    throw ConfigError(
        fmt::format("{}: it compares '{}', which is no factor with planners for levels",
                    file.string(), before.report.compare));
  }
  ConfigNode& planners = child(*factors, before.report.compare);
  if (planners.find(planner.name) != nullptr && !replace) {
    throw ConfigError(fmt::format(
        "{}: the arena has a planner '{}' already; --overwrite puts this one in its place",
        file.string(), planner.name));
  }
  planners.set(planner.name, level_of(planner));
  add_to_split(root, before, planner.name);
  const ScratchFolder scratch;
  const fs::path made = scratch.path() / "study.yaml";
  write_file(made, to_yaml(root));
  return read_study(made);
}

void try_planner(const std::vector<PlannedEpisode>& plan, const Study& study,
                 const std::string& planner) {
  const std::size_t factor = factor_index(study, study.report.compare);
  const auto is_of = [&](const PlannedEpisode& episode) {
    return study.factors[factor].levels[episode.levels[factor]].name == planner;
  };
  const auto first = std::ranges::find_if(plan, is_of);
  if (first == plan.end()) return;
  const auto program = external_planner(first->resolved);
  program->greet();
  program->part();
}

void forget_episodes(const fs::path& arena, const Study& study, const std::string& planner) {
  const std::size_t factor = factor_index(study, study.report.compare);
  for (const EpisodeLevels& episode : episode_levels(study)) {
    if (study.factors[factor].levels[episode.levels[factor]].name != planner) continue;
    std::error_code ignored;
    fs::remove_all(arena / "episodes" / episode.name, ignored);
  }
}

}  // namespace vantage
