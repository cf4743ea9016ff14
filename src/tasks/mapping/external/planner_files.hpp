/// The program of the choice `external` among the files of an episode. Other choices have none.
#pragma once

#include <filesystem>
#include <vector>

#include "vantage/planners/choice/view_choice.hpp"
#include "vantage/runtime/episode_run.hpp"

namespace vantage {

/// Names its files so that they are found again from any directory; `base` is the episode file's.
void find_planner(ViewChoice& choice, const std::filesystem::path& base);

/// Those of the command that are there.
std::vector<InputFile> planner_files(const ViewChoice& choice);

/// @throws ConfigError if there is no such program
void require_planner(const ViewChoice& choice);

}  // namespace vantage
