#include "vantage/runtime/episode_run.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <map>
#include <mutex>
#include <set>
#include <string_view>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/runtime/json.hpp"
#include "vantage/runtime/manifest.hpp"
#include "vantage/runtime/recorder.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

constexpr auto kRunFiles = std::to_array<std::string_view>(
    {"manifest.json", "config.yaml",  "steps.csv",      "candidates.csv",
     "plans.csv",     "metrics.json", "trajectory.tum", "trajectory_estimated.tum",
     "states.bin",    "actions.csv",  "map.bt",         "map.ot",
     "cloud.ply",     "voxels.bin",   "scene.bin",      "story.bin",
     "looks.csv",     "faults.csv",   "video.mp4",      "report.html",
     "log.txt",       "bound.json",   "branches.json",  "frames",
     "views"});

/// Folders that an episode of this process runs into, so that no other does: its files would end up
/// under the names of ours. Other processes keep out from its beginning until its results are
/// written; of one that throws, until the folder is run into again or the process ends.
class ClaimedFolders {
 public:
  /// @throws OutputError if another episode runs into it.
  void claim(const fs::path& directory) {
    const std::scoped_lock lock(mutex_);
    const std::string name = fs::weakly_canonical(directory).string();
    if (!running_.insert(name).second) {
      throw OutputError(
          fmt::format("{}: another episode of this process runs into it", directory.string()));
    }
    if (descriptors_.contains(name)) return;
    const int folder = ::open(name.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return;  // writing into it will say why
    if (::flock(folder, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      ::close(folder);
      running_.erase(name);
      throw OutputError(fmt::format("{}: another process runs into it", directory.string()));
    }
    descriptors_[name] = folder;
  }
  /// The episode has ended, its folder is not released yet.
  void leave(const fs::path& directory) {
    const std::scoped_lock lock(mutex_);
    running_.erase(fs::weakly_canonical(directory).string());
  }
  void release(const fs::path& directory) {
    const std::scoped_lock lock(mutex_);
    const auto found = descriptors_.find(fs::weakly_canonical(directory).string());
    if (found == descriptors_.end()) return;
    ::close(found->second);
    descriptors_.erase(found);
  }

 private:
  std::mutex mutex_;
  std::map<std::string, int> descriptors_;
  std::set<std::string> running_;
};

ClaimedFolders& claimed_folders() {
  static ClaimedFolders folders;
  return folders;
}

void require_no_run(const fs::path& directory) {
  for (const std::string_view name : kRunFiles) {
    std::error_code ignored;  // what cannot be looked into cannot be written into
    if (name == "log.txt" || !fs::exists(directory / name, ignored)) continue;
    refuse_to_replace(fmt::format("--out {}", directory.string()),
                      fmt::format("holds {} already", name));
  }
}

/// And only that: the folder may hold other things.
void remove_former_run(const fs::path& directory) {
  for (const std::string_view name : kRunFiles) {
    std::error_code error;
    fs::remove_all(directory / name, error);
    if (error) {
      throw OutputError(fmt::format("{}: {}", (directory / name).string(), error.message()));
    }
  }
}

/// What a run that was killed was writing; nobody else writes into a claimed folder.
void remove_parts(const fs::path& directory) {
  for (const std::string_view name : kRunFiles) {
    std::error_code ignored;
    const fs::path part = part_name(directory / name);
    if (fs::is_regular_file(part, ignored)) fs::remove(part, ignored);
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
  if (!request.options.overwrite) require_no_run(directory_);
  make_writable_directory(directory_);
  claimed_folders().claim(directory_);
  remove_parts(directory_);
  start_s_ = wall_s();
}

EpisodeRun::~EpisodeRun() { claimed_folders().leave(directory_); }

void EpisodeRun::begin() {
  remove_former_run(directory_);
  log_to_file(directory_ / "log.txt");
  begun_ = true;
}

RunOutcome EpisodeRun::finish(const Ending& ending, const RunTotals& totals,
                              EpisodeRecorder& recorder,
                              const std::function<void(nlohmann::ordered_json&)>& add_metrics,
                              const std::function<void()>& write_more) {
  expects(begun_, "begin() comes before finish()");
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
  if (write_more) write_more();
  try {
    recorder.finish_video();
  } catch (const OutputError&) {  // which comes easily, and costs nothing else
    outcome.video_error = std::current_exception();
  }
  return outcome;
}

void release_run_directory(const fs::path& directory) { claimed_folders().release(directory); }

}  // namespace vantage
