/// An episode as its YAML file has it: what every episode has, and the keys of its task beside
/// that.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/core/config_node.hpp"
#include "vantage/core/schema.hpp"
#include "vantage/runtime/episode_setup.hpp"
#include "vantage/tasks/task.hpp"

namespace vantage {

class World;

/// An episode as it will run: defaults filled in, overrides applied, files found.
struct ResolvedEpisode {
  EpisodeSetup setup;
  Task task = Tabletop{};
};

/// @throws ConfigError or InputError naming file, line, key and value.
ResolvedEpisode load_episode(const std::filesystem::path& path,
                             const std::vector<std::string>& overrides);

/// The same of a configuration that was read already from `path`.
ResolvedEpisode resolve_episode(const ConfigNode& root, const std::filesystem::path& path);

/// The configuration in a run folder.
/// @throws InputError if it is missing or not one of this version.
ResolvedEpisode load_recorded(const std::filesystem::path& run_dir);

/// The keys that `root` sets, as an episode; no file is looked for.
/// @throws ConfigError naming file, line, key and value of every problem.
void read_episode(const ConfigNode& root, EpisodeOptions& options, Task& task);

/// Every key with its value, defaults included; `task` first.
ConfigNode episode_node(const ResolvedEpisode& resolved);
std::string episode_yaml(const ResolvedEpisode& resolved);
/// The same with what every key means in comments.
std::string commented_episode_yaml(const ResolvedEpisode& resolved);
/// Every key that an episode of this task has, with its default.
std::vector<KeyDescription> describe_episode(const Task& task);

std::string method_name(const Task& task);
/// What the world of the episode is compiled from. @throws InputError, ConfigError
ModelSource model_source(const ResolvedEpisode& resolved);
/// Wind and moved objects of an episode, which act on a world whatever the robot does there.
/// @throws ConfigError if the scene has no such object
void add_outside_effects(const ResolvedEpisode& resolved, World& world);
std::vector<InputFile> inputs(const Task& task);
TaskExtent extent(const ResolvedEpisode& resolved);
/// @throws InputError if the scene publishes no path where the task needs one.
WindowContent window(const ResolvedEpisode& resolved);
ReportSections report_sections(const Task& task);
/// Of the task of a run, wherever its scene is now and whatever version recorded it.
/// @throws InputError
ReportSections recorded_sections(const std::filesystem::path& run_dir);
Measures measures(const Task& task);

}  // namespace vantage
