/// What the verbs of `vantage sweep` are given.
#pragma once

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "vantage/study/results.hpp"
#include "vantage/study/study.hpp"

namespace vantage {

struct SweepArguments {
  std::string study;  ///< file or study folder
  std::filesystem::path directory;
  std::vector<std::string> overrides;
  std::string split;  ///< empty: as the study says
  std::string shard = "1/1";
  std::optional<int> jobs = {};  ///< none: see jobs_here()
  bool overwrite = false;
  bool keep_states = false;
  bool json = false;
  int tasks = 16;  ///< of the array
  std::string partition;
  std::string time;
  std::vector<std::string> sbatch_arguments;
};

/// As many as said, else as this machine has cores.
inline int jobs_here(const SweepArguments& arguments) {
  return arguments.jobs.value_or(
      static_cast<int>(std::max(1U, std::thread::hardware_concurrency())));
}

struct OpenedStudy {
  Study study;
  std::filesystem::path directory;
};

/// A study by its file or by the folder of its results.
OpenedStudy open_study(const SweepArguments& arguments);
/// By its folder alone: what other machines share. @throws ConfigError if it is none
OpenedStudy open_study_folder(const SweepArguments& arguments);

/// How it stands: its episodes, and what Slurm knows of it if it was submitted.
void print_status(const SweepArguments& arguments, const std::filesystem::path& directory,
                  const std::vector<PlannedEpisode>& plan, const std::vector<EpisodeState>& states);

}  // namespace vantage
