#include "vantage/runtime/episode_run.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <string_view>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/runtime/json.hpp"
#include "vantage/runtime/manifest.hpp"
#include "vantage/runtime/recorder.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

constexpr auto kRunFiles = std::to_array<std::string_view>({"manifest.json",
                                                            "config.yaml",
                                                            "steps.csv",
                                                            "candidates.csv",
                                                            "metrics.json",
                                                            "trajectory.tum",
                                                            "trajectory_estimated.tum",
                                                            "states.bin",
                                                            "actions.csv",
                                                            "map.bt",
                                                            "map.ot",
                                                            "cloud.ply",
                                                            "voxels.bin",
                                                            "scene.bin",
                                                            "story.bin",
                                                            "looks.csv",
                                                            "faults.csv",
                                                            "video.mp4",
                                                            "report.html",
                                                            "log.txt",
                                                            "bound.json",
                                                            "branches.json",
                                                            "frames",
                                                            "views"});

/// What an old run wrote is removed, and only that: the folder may hold other things.
void prepare_directory(const fs::path& directory, bool overwrite) {
  for (const std::string_view name : kRunFiles) {
    if (overwrite || name == "log.txt" || !fs::exists(directory / name)) continue;
    refuse_to_replace(fmt::format("--out {}", directory.string()),
                      fmt::format("holds {} already", name));
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

}  // namespace

Ending ending_of(const std::function<std::string()>& run) {
  try {
    return {.reason = run()};
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

fs::path run_directory(const EpisodeSetup& setup, const RunOptions& options) {
  if (!options.directory.empty()) return options.directory;
  return fs::path("out") / fmt::format("{}-{}", setup.name, setup.options.seed);
}

EpisodeRun::EpisodeRun(const RunRequest& request)
    : request_(request), directory_(run_directory(request.setup, request.options)) {
  prepare_directory(directory_, request.options.overwrite);
  log_to_file(directory_ / "log.txt");
  start_s_ = wall_s();
}

RunOutcome EpisodeRun::finish(const Ending& ending, const RunTotals& totals,
                              EpisodeRecorder& recorder,
                              const std::function<void(nlohmann::ordered_json&)>& add_metrics) {
  const EpisodeOptions& options = request_.setup.options;
  const RunSummary summary{.status = ending.status,
                           .reason = ending.reason,
                           .simulated_time_s = totals.simulated_time_s,
                           .wall_time_s = wall_s() - start_s_,
                           .path_length_m = recorder.path_length_m(),
                           .collisions = totals.collisions,
                           .state_hash = recorder.state_hash()};
  recorder.commit();  // what cannot be made again comes first
  nlohmann::ordered_json metrics =
      summary_json({request_.task, options.seed, options.scene, request_.method}, summary);
  metrics["faults"] = nlohmann::ordered_json::object();
  for (const auto& [fault, times] : recorder.faults()) metrics["faults"][fault] = times;
  add_metrics(metrics);
  RunOutcome outcome{directory_, ending.code, json_text(metrics)};
  write_file(directory_ / "config.yaml", request_.config);
  write_file(directory_ / "manifest.json", manifest_json(request_, summary));
  write_file(directory_ / "metrics.json", outcome.metrics);
  recorder.finish_video();
  return outcome;
}

}  // namespace vantage
