/// Files that commands are given in place of an episode or a study, and what to do with them.
#pragma once

#include <filesystem>
#include <string>

namespace vantage {

/// The file of an episode, found from the working directory or the data root.
/// @throws InputError if it is missing or a folder; ConfigError if it is a study or a scene, saying
/// what takes it
std::filesystem::path find_episode(const std::string& name);

/// The file of a study, likewise; ConfigError if it is an episode.
std::filesystem::path find_study(const std::string& name);

}  // namespace vantage
