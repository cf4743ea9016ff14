/// `vantage validate`: everything wrong with a file, nothing run.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "vantage/core/error.hpp"
#include "vantage/tasks/episode.hpp"

namespace vantage {

struct Validation {
  std::vector<std::string> problems;  ///< one line each, naming the file; empty: the file is good
  std::vector<std::string> notes;     ///< what is worth knowing about a good file, the same way
  ExitCode code = ExitCode::done;     ///< usage for a configuration, bad_input for anything else
};

/// What `check` finds, or the error that it throws.
Validation validation_of(const std::function<Validation()>& check);

/// @return what is worth a warning, `file` in front
/// @throws ConfigError or InputError, `file` in front, if the episode cannot start.
std::vector<std::string> require_start(const std::filesystem::path& file,
                                       const ResolvedEpisode& resolved);

/// Of the episode as it would run.
Validation validate_episode(const std::filesystem::path& file,
                            const std::vector<std::string>& overrides = {});

/// @param overrides of an episode, or of the table-top episode that a scene is tried in
/// @return a problem if the file is neither and there are any, or of no known kind: an episode, a
/// scene, a map, a robot, a model of recognition
Validation validate_file(const std::filesystem::path& file,
                         const std::vector<std::string>& overrides = {});

}  // namespace vantage
