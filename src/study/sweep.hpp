/// `vantage sweep run`: the episodes of a study, several at a time, as often killed and resumed as
/// need be.
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
  int jobs = 1;              ///< episodes at a time; with more than one each runs on one thread
  bool overwrite = false;    ///< go on in a folder that holds another study
  bool keep_states = false;  ///< whole run folders, to view and replay, instead of lean ones
};

/// Makes the folder and writes study.yaml into it.
/// @throws ConfigError if it holds another study and `overwrite` is not set, OutputError.
void prepare_study_folder(const Study& study, const StudySweepOptions& options);

/// Runs what has no result yet, and returns the states of all of `plan`. Ends early, its children
/// interrupted and waited for, on SIGINT and SIGTERM (see interrupt_signal()).
std::vector<EpisodeState> run_sweep(const std::vector<PlannedEpisode>& plan,
                                    const StudySweepOptions& options);

}  // namespace vantage
