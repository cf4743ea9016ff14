/// `vantage validate`: everything wrong with a file, nothing run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "src/core/error.hpp"

namespace vantage {

struct Validation {
  std::vector<std::string> problems;  ///< one line each, naming the file; empty: the file is good
  std::vector<std::string> notes;     ///< what is worth knowing about a good file, the same way
  ExitCode code = ExitCode::done;     ///< usage for a configuration, bad_input for anything else
};

/// Of the episode as it would run.
Validation validate_episode(const std::filesystem::path& file,
                            const std::vector<std::string>& overrides = {});

Validation validate_file(const std::filesystem::path& file);

}  // namespace vantage
