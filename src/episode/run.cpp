#include "src/episode/run.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>

#include "src/core/atomic_file.hpp"
#include "src/core/log.hpp"
#include "src/episode/manifest.hpp"
#include "src/episode/next_best_view.hpp"
#include "src/episode/office_exploration.hpp"
#include "src/episode/report.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

constexpr auto kRunFiles = std::to_array<std::string_view>(
    {"manifest.json", "config.yaml", "steps.csv", "metrics.json", "trajectory.tum",
     "trajectory_estimated.tum", "states.bin", "actions.csv", "map.bt", "map.ot", "cloud.ply",
     "voxels.bin", "story.bin", "video.mp4", "report.html", "log.txt", "frames"});

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

/// How the episode ended. A divergence and an interruption are recorded results.
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
  } catch (const Interrupted& error) {
    log_debug(error.what());
    return {EpisodeStatus::interrupted, error.code(), error.what()};
  }
}

/// Runs the parts made for `rig` and writes everything they come to.
template <class Parts>
void run_parts(auto& rig, const ResolvedEpisode& resolved, const RunOptions& options,
               RunOutcome& outcome) {
  const double start_s = wall_s();
  Recorder recorder(resolved, rig, outcome.directory, options.video, options.lean,
                    options.spectator);
  Parts parts(resolved, rig, recorder);
  RunSummary summary;
  const Ending ending = run_to_end(parts);
  summary.status = ending.status;
  summary.reason = ending.reason;
  summary.simulated_time_s = rig.world().time_s();
  summary.wall_time_s = wall_s() - start_s;
  summary.path_length_m = recorder.path_length_m();
  summary.collisions = rig.truth().collisions;
  summary.state_hash = recorder.state_hash();

  // What cannot be made again comes first.
  recorder.commit();
  outcome.code = ending.code;
  const auto& belief = parts.belief();
  outcome.metrics = json_text(
      metrics_json(resolved, summary,
                   {belief.grid(), belief.hazard(), parts.truth(), parts.scans(), parts.views()}));
  write_file(outcome.directory / "config.yaml", episode_yaml(resolved.episode));
  write_file(outcome.directory / "manifest.json",
             manifest_json(resolved, options.command, summary));
  write_file(outcome.directory / "metrics.json", outcome.metrics);
  recorder.finish_video();
  if (!options.lean) recorder.write_map(belief.grid(), belief.cloud());
}

template <class Rig, class Parts>
void run_in(const ResolvedEpisode& resolved, const RunOptions& options, RunOutcome& outcome) {
  Rig rig(resolved);  // before an old run is removed: it may fail
  prepare_directory(outcome.directory, options.overwrite);
  log_to_file(outcome.directory / "log.txt");
  run_parts<Parts>(rig, resolved, options, outcome);
}

}  // namespace

RunOutcome run(const ResolvedEpisode& resolved, const RunOptions& options) {
  RunOutcome outcome;
  outcome.directory =
      options.directory.empty()
          ? fs::path("out") / fmt::format("{}-{}", resolved.name, resolved.episode.seed)
          : options.directory;
  if (resolved.episode.in_office()) {
    run_in<OfficeRig, OfficeExploration>(resolved, options, outcome);
  } else {
    run_in<TabletopRig, NextBestView>(resolved, options, outcome);
  }
  if (!options.lean) write_report(outcome.directory);
  log_to_file({});
  return outcome;
}

}  // namespace vantage
