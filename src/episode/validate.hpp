/// `vantage validate`: everything wrong with a file, nothing run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/world.hpp"
#include "src/core/error.hpp"
#include "src/episode/scenario.hpp"

namespace vantage {

struct Validation {
  std::vector<std::string> problems;  ///< one line each, naming the file; empty: the file is good
  ExitCode code = ExitCode::done;     ///< usage for a configuration, bad_input for anything else
};

/// Whether anything in the region of interest is as high as a table: rays from above, 5 x 5.
bool has_table(const World& world, const Episode& episode);

/// Of the episode as it would run.
Validation validate_episode(const std::filesystem::path& file,
                            const std::vector<std::string>& overrides = {});

Validation validate_file(const std::filesystem::path& file);

}  // namespace vantage
