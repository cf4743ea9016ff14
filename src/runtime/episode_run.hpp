/// An episode from its beginning to its run folder: what is the same for every task.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "vantage/planners/choice/outside_choice.hpp"
#include "vantage/runtime/episode_loop.hpp"
#include "vantage/runtime/episode_setup.hpp"
#include "vantage/runtime/log/spectator.hpp"
#include "vantage/runtime/run_summary.hpp"

namespace vantage {

class EpisodeRecorder;

struct RunOptions {
  std::filesystem::path directory;  ///< empty: out/<episode>-<seed>
  bool overwrite = false;
  bool video = false;
  std::vector<std::string> command;  ///< as typed, for the manifest
  bool lean = false;  ///< metrics, steps, trajectories, configuration, manifest and nothing else
  Spectator spectator = {};
  std::optional<OutsideChoice> outside =
      {};  ///< of a task that chooses views: chooses in its place
};

struct RunOutcome {
  std::filesystem::path directory;
  ExitCode code = ExitCode::done;       ///< failed, diverged and interrupted runs have results too
  std::string metrics;                  ///< the JSON text
  std::exception_ptr video_error = {};  ///< why there is no video; nothing else is missing
};

/// A file that an episode reads beside its scene and its robot.
struct InputFile {
  std::string key;  ///< that names it
  std::filesystem::path path;
};

/// Of the files that an episode is made of, as they are when it begins.
struct InputHashes {
  std::string scene;
  std::map<std::string, std::string> assets;  ///< see asset_hashes()
};

/// An episode that is to run.
struct RunRequest {
  const EpisodeSetup& setup;
  std::string task;    ///< as metrics.json calls it
  std::string method;  ///< as metrics.json calls it
  std::string config;  ///< the whole configuration, YAML
  InputHashes inputs;  ///< see input_hashes()
  RunOptions options;
};

/// What is said of an episode when it has ended.
struct RunTotals {
  double simulated_time_s = 0.0;
  int collisions = 0;
};

/// How the episode ended. A failure, a divergence and an interruption are recorded results.
struct Ending {
  EpisodeStatus status = EpisodeStatus::completed;
  ExitCode code = ExitCode::done;
  std::string reason;  ///< why it ended then, never empty
};

/// The ending that `run` comes to, which returns why it was completed (see run_episode()), or
/// throws DivergedError, EpisodeFailed or Interrupted.
Ending ending_of(const std::function<std::string()>& run);

class EpisodeRun {
 public:
  /// Makes the run folder, which nothing else runs into while this lives, and no other process
  /// until release_run_directory().
  /// @throws ConfigError if the folder holds a run that is not to be replaced, OutputError
  explicit EpisodeRun(const RunRequest& request);
  ~EpisodeRun();
  EpisodeRun(const EpisodeRun&) = delete;
  EpisodeRun& operator=(const EpisodeRun&) = delete;

  /// After this a former run in the folder is gone: what may fail or takes long comes before.
  /// @throws OutputError
  void begin();

  [[nodiscard]] const RunRequest& request() const { return request_; }
  [[nodiscard]] const std::filesystem::path& directory() const { return directory_; }

  /// Writes what every run folder has, the video last.
  /// @param add_metrics adds what the task measured
  /// @param write_more writes what the task has beside
  RunOutcome finish(const Ending& ending, const RunTotals& totals, EpisodeRecorder& recorder,
                    const std::function<void(nlohmann::ordered_json&)>& add_metrics,
                    const std::function<void()>& write_more = {});

 private:
  const RunRequest& request_;
  std::filesystem::path directory_;
  double start_s_;  ///< wall
  bool begun_ = false;
};

/// Other processes may run into it again: all results are written.
void release_run_directory(const std::filesystem::path& directory);

/// out/<episode>-<seed>, unless the options say otherwise.
std::filesystem::path run_directory(const EpisodeSetup& setup, const RunOptions& options);

}  // namespace vantage
