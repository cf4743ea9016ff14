/// Reads a study's file as far as it can be read, and says everything that is wrong with it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/study/kit/problems.hpp"
#include "vantage/study/study.hpp"

namespace vantage {

struct StudyReading {
  Study study;  ///< without what is wrong; `episode` is empty if there is none
  Problems problems;
};

/// Whether a factor or level may be called so: names become folders and columns.
bool is_study_name(std::string_view name);
inline constexpr std::string_view kStudyNameRule = "may hold letters, digits and _ . - + only";

/// @param overrides as of --set, of every episode
/// @param split the one to run, of those that the file has; empty: as the file says
/// @throws ConfigError or InputError if the file is no YAML map or cannot be read
StudyReading read_study_file(const std::filesystem::path& file,
                             const std::vector<std::string>& overrides,
                             const std::string& split = {});

/// The episodes of plan_study() that can be planned.
std::vector<PlannedEpisode> plan_episodes(const Study& study, Problems& problems);

}  // namespace vantage
