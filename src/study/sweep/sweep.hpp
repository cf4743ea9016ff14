/// `vantage sweep run` and `work`: the episodes of a study, several at a time, on as many machines
/// as share the folder, as often killed and resumed as need be.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vantage/study/results.hpp"
#include "vantage/study/study.hpp"

namespace vantage {

/// The i-th of N parts: every N-th episode.
struct Shard {
  std::size_t index = 1;  ///< 1 .. count
  std::size_t count = 1;
};
/// "2/3". @throws ConfigError
Shard parse_shard(const std::string& text);
std::vector<PlannedEpisode> shard_of(std::vector<PlannedEpisode> plan, const Shard& shard);

struct StudySweepOptions {
  std::filesystem::path directory;
  int jobs = 1;                ///< episodes at a time; with more than one each runs on one thread
  bool overwrite = false;      ///< go on in a folder that holds another study
  bool keep_states = false;    ///< whole run folders, to view and replay, instead of lean ones
  bool retry_crashed = true;   ///< else a crash stands
  bool single_thread = false;  ///< each episode on one thread in any case
};

/// Makes the folder and writes study.yaml into it.
/// @throws ConfigError if it holds another study and `overwrite` is not set, OutputError.
void prepare_study_folder(const Study& study, const StudySweepOptions& options);

struct SweepEnd {
  std::vector<EpisodeState> states;  ///< of all of the plan
  std::vector<std::size_t> run;      ///< indices of the episodes that this sweep ran
};

/// Runs what has no result yet and no other worker is at; takes over what a worker that is gone
/// had begun. Ends early, its children interrupted and waited for, on SIGINT and SIGTERM (see
/// interrupt_signal()). In a task of a Slurm array, begins where the other tasks do not, and leaves
/// what crashed in the same array.
SweepEnd run_sweep(const std::vector<PlannedEpisode>& plan, const StudySweepOptions& options);

}  // namespace vantage
