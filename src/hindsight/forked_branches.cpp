#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <deque>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/hindsight/branching.hpp"
#include "vantage/planners/gain.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/runtime/scratch_folder.hpp"
#include "vantage/tasks/run.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

/// Leaves an episode from within its decision or its step: nobody wants to know how it ends.
struct Enough {};

bool has_one_thread() {
  const fs::directory_iterator threads("/proc/self/task");
  return std::distance(fs::begin(threads), fs::end(threads)) == 1;
}

/// Processes of which none outlives this.
class Children {
 public:
  Children() = default;
  Children(const Children&) = delete;
  Children& operator=(const Children&) = delete;
  ~Children() {
    for (const pid_t child : running_) ::kill(child, SIGKILL);
    while (!running_.empty()) wait_for_first();
  }
  void add(pid_t child) { running_.push_back(child); }
  /// In a child, of which they are not the children.
  void forget() { running_.clear(); }
  /// @throws Interrupted
  void wait_until_at_most(std::size_t count) {
    while (running_.size() > count) {
      wait_for_first();
      throw_if_interrupted();
    }
  }

 private:
  void wait_for_first() {
    int status = 0;
    while (::waitpid(running_.front(), &status, 0) < 0 && errno == EINTR) {
    }
    running_.pop_front();
  }
  std::deque<pid_t> running_;
};

/// The scans of a branch, from that of its view on.
using Steps = std::vector<StepRow>;

void write_steps(const fs::path& path, const Steps& steps) {
  auto rows = nlohmann::json::array();
  for (const StepRow& s : steps) {
    rows.push_back({s.scan, s.time_s, s.path_length_m, s.cells_left, s.chosen_view, s.fallback});
  }
  write_file(path, rows.dump());
}

Steps read_steps(const fs::path& path) {
  if (!fs::exists(path)) {
    throw OutputError(path.filename().string() +
                      ": its process ended before it told what came of it");
  }
  Steps steps;
  for (const auto& row : nlohmann::json::parse(read_file(path))) {
    steps.push_back({row[0], row[1], row[2], row[3], row[4], row[5]});
  }
  return steps;
}

Branch branch_of(const Candidate& view, bool chosen) {
  Branch branch;
  branch.view = view.id;
  branch.chosen = chosen;
  branch.gain = view.gain_bits;
  if (view.reachable) branch.planned_m = view.path_length_m;
  return branch;
}

void set_result(const RecordedScan& before, const Steps& steps, Branch& branch) {
  if (steps.empty()) return;
  const auto left = static_cast<long long>(before.cells_left);
  const StepRow& first = steps.front();
  branch.fallback = first.fallback;
  branch.cells = left - first.cells_left;
  branch.seconds = first.time_s - before.time_s;
  branch.way_m = first.path_length_m - before.path_length_m;
  if (steps.size() == 1) return;
  branch.cells_then = left - steps.back().cells_left;
  branch.seconds_then = steps.back().time_s - before.time_s;
}

/// The repetition, and what becomes of it in each child.
class Branching {
 public:
  Branching(const RecordedRun& run, const BranchRequest& request, ResolvedEpisode episode)
      : run_(run), request_(request), episode_(std::move(episode)), recorded_(run) {}

  std::vector<BranchedDecision> all() {
    play();
    for (auto& [decision, view] : left_over_) {
      log_debug(fmt::format("view {} after scan {}: repeated", view, decision->scan));
      play_one(*decision, view);
    }
    return {decisions_.begin(), decisions_.end()};
  }

 private:
  /// A branch that this process has become.
  struct Own {
    std::size_t scan;
    int view;
    Steps steps;
  };

  /// Runs the episode until it was left, has ended or has failed.
  void play() {
    RunOptions options;
    options.directory = scratch_.path() / std::to_string(plays_++);
    options.lean = true;
    options.outside = {.name = run_.method,
                       .decide = [this](const DecisionRequest& r) { return decide(r); },
                       .ended = [this](const MapSituation&, bool) { leave(); },
                       .blind = true};
    options.spectator.on_step = [this](std::string_view columns, std::string_view row) {
      take(read_step(columns, row));
    };
    try {
      vantage::run(episode_, options);
      throw_if_interrupted();  // which ends an episode, but is no end of it
    } catch (const Enough&) {
    } catch (...) {
      if (child_) ::_exit(1);
      throw;
    }
    if (child_) leave();
  }

  void play_one(BranchedDecision& decision, int view) {
    own_ = Own{decision.scan, view, {}};
    play();
    Branch& branch = *std::ranges::find(decision.branches, view, &Branch::view);
    set_result(run_.scans[decision.scan - 1], own_->steps, branch);
    own_.reset();
  }

  void take(const StepRow& step) {
    if (!own_ || step.scan <= own_->scan) {
      recorded_.check(step);
      return;
    }
    own_->steps.push_back(step);
    if (own_->steps.size() > request_.then) leave();
  }

  /// A child says what has come of it, and is no more.
  [[noreturn]] void leave() {
    if (child_) {
      write_steps(file_of(own_->scan, own_->view), own_->steps);
      ::_exit(0);
    }
    throw Enough{};
  }

  OutsideDecision decide(const DecisionRequest& request) {
    const std::size_t scans = request.situation.scans;
    if (own_ && scans > own_->scan) return request.own_choice();
    const std::size_t chosen = recorded_.repeated(request);
    if (own_) return scans == own_->scan ? takeable(request, own_->view) : chosen;
    if (!std::ranges::binary_search(request_.scans, scans)) return chosen;
    branch(request, chosen);
    if (child_) return takeable(request, own_->view);
    if (scans == request_.scans.back()) throw Enough{};
    return chosen;
  }

  void branch(const DecisionRequest& request, std::size_t chosen) {
    BranchedDecision& decision = decisions_.emplace_back();
    decision.scan = request.situation.scans;
    decision.then = request_.then;
    decision.gain_unit = unit_of(request.gain);
    for (const std::size_t i : views_of(request, chosen)) {
      decision.branches.push_back(branch_of(request.candidates[i], i == chosen));
    }
    if (!has_one_thread()) {
      for (const Branch& b : decision.branches) left_over_.emplace_back(&decision, b.view);
      return;
    }
    fork_all(decision);
    if (child_) return;
    for (Branch& b : decision.branches) {
      set_result(run_.scans[decision.scan - 1], read_steps(file_of(decision.scan, b.view)), b);
    }
  }

  [[nodiscard]] std::vector<std::size_t> views_of(const DecisionRequest& request,
                                                  std::size_t chosen) const {
    if (request_.all) return open_candidates(request.candidates);
    return {request_.view ? takeable(request, *request_.view) : chosen};
  }

  void fork_all(const BranchedDecision& decision) {
    const auto workers = static_cast<std::size_t>(run_.episode.setup.options.threads);
    Children children;
    Progress progress(fmt::format("branches of scan {}", decision.scan),
                      static_cast<double>(decision.branches.size()));
    for (std::size_t begun = 0; begun < decision.branches.size(); ++begun) {
      const Branch& branch = decision.branches[begun];
      children.wait_until_at_most(workers - 1);
      const pid_t child = ::fork();
      if (child < 0) throw OutputError("no process can be made");
      if (child == 0) {
        children.forget();
        become(decision.scan, branch.view);
        return;
      }
      children.add(child);
      progress.update(static_cast<double>(begun));
    }
    children.wait_until_at_most(0);
    progress.update(static_cast<double>(decision.branches.size()));
  }

  /// What it would say, the other processes say too.
  void become(std::size_t scan, int view) {
    child_ = true;
    own_ = Own{scan, view, {}};
    const int nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, STDERR_FILENO);
    ::dup2(nowhere, STDOUT_FILENO);
  }

  [[nodiscard]] fs::path file_of(std::size_t scan, int view) const {
    return scratch_.path() / fmt::format("branch-{}-{}.json", scan, view);
  }

  const RecordedRun& run_;
  const BranchRequest& request_;
  const ResolvedEpisode episode_;
  const RecordedDecisions recorded_;
  const ScratchFolder scratch_;
  int plays_ = 0;
  bool child_ = false;
  std::optional<Own> own_;
  std::deque<BranchedDecision> decisions_;
  std::vector<std::pair<BranchedDecision*, int>> left_over_;
};

}  // namespace

void draw_without_threads() {
  ::setenv("LP_NUM_THREADS", "0", 0);
  ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
}

std::vector<BranchedDecision> branch_views(const RecordedRun& run, const BranchRequest& request) {
  for (const std::size_t scan : request.scans) {
    require_decision(run, static_cast<long long>(scan));
    if (request.view) require_view(run, scan, *request.view);
  }
  if (request.then > 0 && was_chosen_outside(run)) refuse_to_go_on(run);
  draw_without_threads();
  ResolvedEpisode alone = load_episode(run.directory / "config.yaml", {"threads=1"});
  return Branching(run, request, std::move(alone)).all();
}

}  // namespace vantage
