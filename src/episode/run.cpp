#include "src/episode/run.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>

#include "src/core/atomic_file.hpp"
#include "src/core/log.hpp"
#include "src/episode/manifest.hpp"
#include "src/episode/report.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

double wall_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// An old run is removed file by file, and only what a run writes: the folder may hold notes.
void prepare_directory(const fs::path& directory, bool overwrite) {
  const bool used =
      fs::exists(directory / "metrics.json") || fs::exists(directory / "manifest.json");
  if (used && !overwrite) {
    throw ConfigError(
        fmt::format("--out {}: holds a run already; --overwrite replaces it", directory.string()));
  }
  make_writable_directory(directory);
  for (const char* name :
       {"manifest.json", "config.yaml", "steps.csv", "metrics.json", "trajectory.tum",
        "trajectory_estimated.tum", "states.bin", "actions.csv", "map.bt", "map.ot", "cloud.ply",
        "voxels.bin", "video.mp4", "report.html", "log.txt", "frames"}) {
    std::error_code error;
    fs::remove_all(directory / name, error);
    if (error)
      throw OutputError(fmt::format("{}: {}", (directory / name).string(), error.message()));
  }
}

/// @return how the episode ended; a divergence is a recorded result, its reason in `divergence`.
EpisodeStatus run_to_end(NextBestView& parts, std::string& divergence) {
  try {
    return run_episode(parts);
  } catch (const DivergedError& error) {
    divergence = error.what();
    return EpisodeStatus::diverged;
  }
}

}  // namespace

RunOutcome run(const ResolvedEpisode& resolved, const RunOptions& options) {
  RunOutcome outcome;
  outcome.directory =
      options.directory.empty()
          ? fs::path("out") / fmt::format("{}-{}", resolved.name, resolved.episode.seed)
          : options.directory;
  prepare_directory(outcome.directory, options.overwrite);
  log_to_file(outcome.directory / "log.txt");
  write_file(outcome.directory / "config.yaml", episode_yaml(resolved.episode));

  const double start_s = wall_s();
  TabletopRig rig(resolved);
  Recorder recorder(resolved, rig, outcome.directory, options.video);
  NextBestView parts(resolved, rig, recorder);
  std::string divergence;
  outcome.status = run_to_end(parts, divergence);

  RunSummary summary;
  summary.status = outcome.status;
  summary.simulated_time_s = rig.world().time_s();
  summary.wall_time_s = wall_s() - start_s;
  summary.path_length_m = recorder.path_length_m();
  summary.collisions = rig.truth().collisions;
  summary.state_hash = recorder.state_hash();
  outcome.metrics = metrics_json(resolved, summary, parts).dump(2) + "\n";
  recorder.commit(parts.belief().grid(), parts.belief().object_cloud());
  write_file(outcome.directory / "manifest.json",
             manifest_json(resolved, options.command, summary));
  write_file(outcome.directory / "metrics.json", outcome.metrics);
  write_report(outcome.directory);
  log_to_file({});
  if (!divergence.empty()) throw DivergedError(divergence);
  return outcome;
}

}  // namespace vantage
