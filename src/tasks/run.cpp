#include "vantage/tasks/run.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/report/report.hpp"
#include "vantage/runtime/manifest.hpp"
#include "vantage/tasks/exploration/office_exploration.hpp"
#include "vantage/tasks/recognition/object_recognition.hpp"
#include "vantage/tasks/recognition/recognition_metrics.hpp"
#include "vantage/tasks/tabletop/next_best_view.hpp"
#include "vantage/tasks/trajectory/flight_layout.hpp"
#include "vantage/tasks/trajectory/trajectory_metrics.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

constexpr auto kRunFiles = std::to_array<std::string_view>(
    {"manifest.json", "config.yaml", "steps.csv", "metrics.json", "trajectory.tum",
     "trajectory_estimated.tum", "states.bin", "actions.csv", "map.bt", "map.ot", "cloud.ply",
     "voxels.bin", "story.bin", "looks.csv", "video.mp4", "report.html", "log.txt", "frames",
     "views"});

/// What an old run wrote is removed, and only that: the folder may hold other things.
void prepare_directory(const fs::path& directory, bool overwrite) {
  for (const std::string_view name : kRunFiles) {
    if (name != "log.txt" && fs::exists(directory / name) && !overwrite) {
      throw ConfigError(fmt::format("--out {}: holds a {} already; --overwrite replaces it",
                                    directory.string(), name));
    }
  }
  make_writable_directory(directory);
  for (const std::string_view name : kRunFiles) {
    std::error_code error;
    fs::remove_all(directory / name, error);
    if (error) {
      throw OutputError(fmt::format("{}: {}", (directory / name).string(), error.message()));
    }
  }
}

/// How the episode ended. A failure, a divergence and an interruption are recorded results.
struct Ending {
  EpisodeStatus status = EpisodeStatus::completed;
  ExitCode code = ExitCode::done;
  std::string reason;
};

template <class Parts>
Ending run_to_end(Parts& parts) {
  try {
    run_episode(parts);
    return {};
  } catch (const DivergedError& error) {
    log_error(std::string("diverged: ") + error.what());
    return {EpisodeStatus::diverged, error.code(), error.what()};
  } catch (const EpisodeFailed& error) {
    log_error(std::string("failed: ") + error.what());
    return {EpisodeStatus::failed, error.code(), error.what()};
  } catch (const Interrupted& error) {
    log_debug(error.what());
    return {EpisodeStatus::interrupted, error.code(), error.what()};
  }
}

template <class Interface, class Parts>
nlohmann::ordered_json metrics_of(const ResolvedEpisode& resolved, const RunSummary& summary,
                                  const Interface&, const Parts& parts) {
  const auto& belief = parts.belief();
  return metrics_json(
      resolved, summary,
      {belief.grid(), belief.hazard(), parts.truth(), parts.scans(), parts.views()});
}
nlohmann::ordered_json metrics_of(const ResolvedEpisode& resolved, const RunSummary& summary,
                                  const OrbitRobotInterface&, const ObjectRecognition& parts) {
  return recognition_metrics(resolved, summary, parts);
}
nlohmann::ordered_json metrics_of(const ResolvedEpisode& resolved, const RunSummary& summary,
                                  const TrajectoryRobotInterface& robot,
                                  const TrajectoryFlight& parts) {
  return trajectory_metrics(resolved, summary, robot, parts);
}

template <class Parts>
void write_learnt(Recorder& recorder, const Parts& parts) {
  recorder.write_map(parts.belief().grid(), parts.belief().cloud());
}
void write_learnt(RecognitionRecorder&, const ObjectRecognition&) {}
void write_learnt(TrajectoryRecorder&, const TrajectoryFlight&) {}

/// An episode that is about to run.
struct Running {
  const ResolvedEpisode& resolved;
  const RunOptions& options;
  RunOutcome& outcome;
  double start_s;  ///< wall
};

/// Runs the parts made for `robot` and writes everything they come to.
void run_parts(const Running& run, auto& robot, auto& recorder, auto& parts) {
  RunSummary summary;
  const Ending ending = run_to_end(parts);
  summary.status = ending.status;
  summary.reason = ending.reason;
  summary.simulated_time_s = robot.world().time_s();
  summary.wall_time_s = wall_s() - run.start_s;
  summary.path_length_m = recorder.path_length_m();
  summary.collisions = robot.truth().collisions;
  summary.state_hash = recorder.state_hash();

  // What cannot be made again comes first.
  recorder.commit();
  RunOutcome& outcome = run.outcome;
  outcome.code = ending.code;
  outcome.metrics = json_text(metrics_of(run.resolved, summary, robot, parts));
  write_file(outcome.directory / "config.yaml", episode_yaml(run.resolved.episode));
  write_file(outcome.directory / "manifest.json",
             manifest_json(run.resolved, run.options.command, summary));
  write_file(outcome.directory / "metrics.json", outcome.metrics);
  recorder.finish_video();
  if (!run.options.lean) write_learnt(recorder, parts);
}

/// After this an old run is gone: what may fail comes before.
Running begin(const ResolvedEpisode& resolved, const RunOptions& options, RunOutcome& outcome) {
  prepare_directory(outcome.directory, options.overwrite);
  log_to_file(outcome.directory / "log.txt");
  return {resolved, options, outcome, wall_s()};
}

template <class Interface, class Parts>
void run_mapping(const ResolvedEpisode& resolved, const RunOptions& options, RunOutcome& outcome) {
  Interface robot(resolved);
  const Running run = begin(resolved, options, outcome);
  Recorder recorder(resolved, robot, outcome.directory, options.video, options.lean,
                    options.spectator);
  Parts parts(resolved, robot, recorder);
  run_parts(run, robot, recorder, parts);
}

void run_recognition(const ResolvedEpisode& resolved, const RunOptions& options,
                     RunOutcome& outcome) {
  OrbitRobotInterface robot(resolved);
  const Recogniser recogniser = load_episode_recogniser(resolved);
  const Running run = begin(resolved, options, outcome);
  RecognitionRecorder recorder(resolved, robot, outcome.directory, options.video, options.lean,
                               options.spectator);
  ObjectRecognition parts(resolved, recogniser, robot, recorder);
  run_parts(run, robot, recorder, parts);
}

void run_trajectory(const ResolvedEpisode& resolved, const RunOptions& options,
                    RunOutcome& outcome) {
  TrajectoryRobotInterface robot(resolved, read_flight_layout(resolved.scene).path.front());
  const Recogniser recogniser = load_trajectory_recogniser(resolved);
  const Running run = begin(resolved, options, outcome);
  TrajectoryRecorder recorder(resolved, robot, outcome.directory, options.video, options.lean,
                              options.spectator);
  TrajectoryFlight parts(resolved, recogniser, robot, recorder);
  run_parts(run, robot, recorder, parts);
}

}  // namespace

RunOutcome run(const ResolvedEpisode& resolved, const RunOptions& options) {
  RunOutcome outcome;
  outcome.directory =
      options.directory.empty()
          ? fs::path("out") / fmt::format("{}-{}", resolved.name, resolved.episode.seed)
          : options.directory;
  if (resolved.episode.flies_trajectory()) {
    run_trajectory(resolved, options, outcome);
  } else if (resolved.episode.flies()) {
    run_recognition(resolved, options, outcome);
  } else if (resolved.episode.in_office()) {
    run_mapping<ExplorationRobotInterface, OfficeExploration>(resolved, options, outcome);
  } else {
    run_mapping<TabletopRobotInterface, NextBestView>(resolved, options, outcome);
  }
  if (!options.lean) write_report(outcome.directory);
  log_to_file({});
  return outcome;
}

}  // namespace vantage
