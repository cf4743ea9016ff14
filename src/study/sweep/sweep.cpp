#include "vantage/study/sweep/sweep.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <csignal>
#include <list>
#include <sstream>
#include <thread>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/runtime/json.hpp"
#include "vantage/study/sweep/child_process.hpp"
#include "vantage/study/sweep/work_list.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using namespace std::chrono_literals;

std::string duration_text(double seconds) {
  const auto whole = std::lround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

std::string last_line(const fs::path& file) {
  std::istringstream stream(read_file(file));
  std::string last;
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty()) last = line;
  }
  return last;
}

struct Running {
  pid_t pid = 0;
  std::size_t episode = 0;  ///< index into the plan
  Attempt attempt;
};

class Sweep {
 public:
  Sweep(const std::vector<PlannedEpisode>& plan, const StudySweepOptions& options)
      : plan_(plan),
        options_(options),
        end_{episode_states(options.directory, plan), {}},
        list_(plan, options, end_.states),
        progress_("sweep", static_cast<double>(plan.size())) {
    const std::size_t done = plan.size() - list_.open();
    if (done > 0) log_info(fmt::format("{} of {} episodes have a result", done, plan.size()));
  }

  SweepEnd run() {
    while (true) {
      if (interrupt_signal() != 0) pass_on();
      fill();
      if (running_.empty()) break;
      give_sign();
      bool ended = false;
      while (const auto child = poll_child()) {
        finish(*child);
        ended = true;
      }
      if (!ended) std::this_thread::sleep_for(20ms);
    }
    for (const std::size_t episode : list_.held()) {
      log_warning(plan_[episode].name + ": another worker is at it");
    }
    return std::move(end_);
  }

 private:
  /// Nothing new is started; what runs writes what it has.
  void pass_on() {
    list_.close();
    if (passed_on_) return;
    passed_on_ = true;
    for (const Running& child : running_) ::kill(child.pid, interrupt_signal());
  }

  void fill() {
    while (static_cast<int>(running_.size()) < options_.jobs) {
      auto taken = list_.take();
      if (!taken) return;
      start(std::move(*taken));
    }
  }

  void start(WorkList::Taken taken) {
    const fs::path folder = taken.attempt.folder();
    ResolvedEpisode configuration = plan_[taken.episode].resolved;
    if (options_.jobs > 1 || options_.single_thread) configuration.setup.options.threads = 1;
    write_file(folder / "episode.yaml", episode_yaml(configuration));
    std::vector<std::string> command{"vantage", "run",           (folder / "episode.yaml").string(),
                                     "--out",   folder.string(), "--overwrite"};
    if (!options_.keep_states) command.emplace_back("--lean");
    const pid_t pid = start_self(command, folder / "output.txt");
    running_.push_back({pid, taken.episode, std::move(taken.attempt)});
    end_.run.push_back(taken.episode);
  }

  /// So that no other worker takes over what runs here.
  void give_sign() {
    if (wall_s() - sign_s_ < kHeartbeat_s) return;
    sign_s_ = wall_s();
    for (const Running& child : running_) child.attempt.claim().heartbeat();
  }

  void finish(const ChildEnd& child) {
    const auto found = std::ranges::find(running_, child.pid, &Running::pid);
    if (found == running_.end()) return;
    const PlannedEpisode& episode = plan_[found->episode];
    const fs::path folder = found->attempt.folder();
    EpisodeState state = list_.check().in_folder(folder, episode);
    const bool has_come_to_something = is_result(state) || state == EpisodeState::interrupted;
    if (has_come_to_something) {
      std::error_code ignored;
      fs::remove(folder / "output.txt", ignored);
    } else if (interrupt_signal() == 0 && found->attempt.claim().in_force()) {
      record_failure(folder, child.exit_code);
    }
    if (has_come_to_something || interrupt_signal() == 0) {
      state = found->attempt.publish(list_.check());
    } else {
      found->attempt.drop();
    }
    end_.states[found->episode] = state;
    if (state == EpisodeState::crashed) {
      log_warning(
          fmt::format("{}: exit code {}; see {}", episode.name, child.exit_code,
                      (episode_folder(options_.directory, episode) / "output.txt").string()));
    }
    running_.erase(found);
    if (interrupt_signal() == 0) report(episode);
  }

  static void record_failure(const fs::path& folder, int exit_code) {
    const nlohmann::ordered_json failure = {{"exit_code", exit_code},
                                            {"reason", last_line(folder / "output.txt")}};
    write_file(folder / "failure.json", json_text(failure));
  }

  void report(const PlannedEpisode& episode) {
    ++done_here_;
    const std::size_t left = list_.open() + running_.size();
    const std::size_t done = plan_.size() - left - list_.held().size();
    const double each_s = (wall_s() - start_s_) / static_cast<double>(done_here_);
    const auto failed = std::ranges::count(end_.states, EpisodeState::crashed);
    progress_.update(static_cast<double>(done),
                     fmt::format("{} of {} episodes{}, about {} left; {}", done, plan_.size(),
                                 failed == 0 ? "" : fmt::format(", {} failed", failed),
                                 duration_text(each_s * static_cast<double>(left)), episode.name));
  }

  const std::vector<PlannedEpisode>& plan_;
  const StudySweepOptions& options_;
  SweepEnd end_;
  WorkList list_;
  std::list<Running> running_;
  Progress progress_;
  double start_s_ = wall_s();
  double sign_s_ = wall_s();
  std::size_t done_here_ = 0;
  bool passed_on_ = false;
};

}  // namespace

Shard parse_shard(const std::string& text) {
  Shard shard;
  const auto* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, shard.index);
  const bool slash = first.ec == std::errc{} && first.ptr != end && *first.ptr == '/';
  const auto second = std::from_chars(slash ? first.ptr + 1 : end, end, shard.count);
  if (!slash || second.ec != std::errc{} || second.ptr != end || shard.index < 1 ||
      shard.index > shard.count) {
    throw ConfigError(fmt::format("--shard {}: expected i/N with 1 <= i <= N", text));
  }
  return shard;
}

std::vector<PlannedEpisode> shard_of(std::vector<PlannedEpisode> plan, const Shard& shard) {
  std::vector<PlannedEpisode> part;
  for (std::size_t i = shard.index - 1; i < plan.size(); i += shard.count) {
    part.push_back(std::move(plan[i]));
  }
  return part;
}

void prepare_study_folder(const Study& study, const StudySweepOptions& options) {
  const fs::path file = options.directory / "study.yaml";
  std::error_code error;
  if (fs::exists(file, error)) {
    if (read_file(file) == study.yaml) return;
    if (!options.overwrite) {
      refuse_to_replace(
          fmt::format("--out {}", options.directory.string()),
          "holds another study, or an older state of this one (results that still fit are kept)");
    }
  }
  if (fs::exists(options.directory / "config.yaml", error)) {
    throw ConfigError(fmt::format("--out {}: the folder of a run; a study needs one of its own",
                                  options.directory.string()));
  }
  make_writable_directory(options.directory);
  // Shards that begin together each write a file of their own.
  const Worker self = this_worker();
  const fs::path own = options.directory / fmt::format("study-{}-{}.yaml", self.host, self.pid);
  write_file(own, study.yaml);
  fs::rename(own, file, error);
  if (error) {
    throw OutputError(fmt::format("{}: cannot write: {}", file.string(), error.message()));
  }
}

SweepEnd run_sweep(const std::vector<PlannedEpisode>& plan, const StudySweepOptions& options) {
  return Sweep(plan, options).run();
}

}  // namespace vantage
