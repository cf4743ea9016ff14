#include "vantage/cli/hints/episode_file.hpp"

#include <fmt/format.h>

#include "vantage/core/data_root.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/study/study.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

bool is_scene(const fs::path& file) {
  return file.extension() == ".xml" || file.extension() == ".mjcf";
}

/// YAML of a map that has none of a study's keys.
bool is_episode(const fs::path& file) {
  try {
    return read_yaml(file).kind == ConfigNode::Kind::map && !is_study(file);
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

fs::path find_episode(const std::string& name) {
  const fs::path found = find_input(name, {}, "episode");
  if (is_study(found)) {
    throw ConfigError(fmt::format("{}: this is a study: use vantage sweep run {} --out DIR",
                                  found.string(), name));
  }
  if (is_scene(found)) {
    throw ConfigError(fmt::format(
        "{}: this is a scene; an episode is a YAML file of what a robot does in one: use "
        "vantage run --set scene={}, or write scene: {} into an episode",
        found.string(), name, name));
  }
  std::error_code error;
  if (fs::is_directory(found, error)) {
    throw InputError(fmt::format(
        "{}: this is a folder; an episode is a YAML file, such as those of vantage list episodes",
        found.string()));
  }
  return found;
}

fs::path find_study(const std::string& name) {
  const fs::path found = find_input(name, {}, "study");
  if (is_scene(found)) {
    throw ConfigError(fmt::format(
        "{}: this is a scene; a study is a YAML file with `episode`, the file that every episode "
        "begins with, and `factors` or `seeds` that vary it; `set: {{scene: {}}}` names the scene",
        found.string(), name));
  }
  if (is_episode(found)) {
    throw ConfigError(fmt::format(
        "{}: this is an episode: use vantage run {}; a study is a YAML file that names an episode "
        "and the factors that vary it",
        found.string(), name));
  }
  return found;
}

}  // namespace vantage
