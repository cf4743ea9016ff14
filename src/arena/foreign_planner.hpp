/// A planner of somebody's that enters an arena.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vantage/study/study.hpp"

namespace vantage {

struct ForeignPlanner {
  std::string name;
  std::vector<std::string> command;  ///< its files as the caller knows them
  double timeout_s = 10.0;           ///< for a decision
};

/// The study of an arena's folder with one level more of the factor that it compares; study.yaml is
/// not touched.
/// @param replace a level of that name is another program from now on
/// @throws ConfigError if the name cannot be used or is taken, or there is no such program
Study study_with(const std::filesystem::path& arena, const ForeignPlanner& planner, bool replace);

/// Starts the planner of that name as its first episode does and hears its first line.
/// @throws EpisodeFailed with the reason why it does not get there
void try_planner(const std::vector<PlannedEpisode>& plan, const Study& study,
                 const std::string& planner);

/// Removes what is there of a planner's episodes: its program may have changed.
void forget_episodes(const std::filesystem::path& arena, const Study& study,
                     const std::string& planner);

}  // namespace vantage
