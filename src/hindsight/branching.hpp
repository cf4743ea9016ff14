/// What another choice would have brought: a run is repeated up to a decision, which is then taken
/// otherwise. A repeated run has the bits of the recorded one, so this is measured, not estimated.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "vantage/hindsight/branch_record.hpp"
#include "vantage/hindsight/recorded_run.hpp"
#include "vantage/runtime/episode_run.hpp"

namespace vantage {

/// What steps.csv says of a scan.
struct StepRow {
  std::size_t scan = 0;
  double time_s = 0.0;
  double path_length_m = 0.0;
  long long cells_left = 0;
  int chosen_view = -1;
  bool fallback = false;
};
StepRow read_step(std::string_view columns, std::string_view row);

/// The repetition is not what was recorded: other software, or files that have changed.
struct ReplayDiffers : Error {
  explicit ReplayDiffers(const std::string& why) : Error(ExitCode::goal_failed, why) {}
};

/// Takes the decisions that were recorded, and sees to it that what comes of them is the same.
class RecordedDecisions {
 public:
  /// `run` outlives this.
  explicit RecordedDecisions(const RecordedRun& run) : run_(run) {}

  /// What the episode's own choice takes, which draws the random numbers that it drew then.
  /// @throws ReplayDiffers
  [[nodiscard]] std::size_t repeated(const DecisionRequest& request) const;
  /// @throws ReplayDiffers if a scan that was recorded is another one
  void check(const StepRow& step) const;

 private:
  [[noreturn]] void differs(std::size_t scan, const std::string& how) const;
  const RecordedRun& run_;
};

/// Whether its views were chosen by a program of the user's, which is not asked again.
bool was_chosen_outside(const RecordedRun& run);
/// @throws ConfigError that says so
[[noreturn]] void refuse_to_go_on(const RecordedRun& run);

/// @throws ConfigError unless a decision was taken after that scan
void require_decision(const RecordedRun& run, long long scan);
/// The same of a view that it did not have, of a decision that was taken.
void require_view(const RecordedRun& run, std::size_t scan, int view);

/// Index of the view of that number. @throws ConfigError if it cannot be taken
std::size_t takeable(const DecisionRequest& request, int view);

/// To the end of the episode, by its own choice but for that one decision.
/// @param view none: as it was recorded
RunOutcome run_branch(const RecordedRun& run, std::size_t scan, std::optional<int> view,
                      RunOptions options);

struct BranchRequest {
  std::vector<std::size_t> scans;  ///< whose decisions are branched, ascending
  bool all = false;                ///< every view that can be taken
  std::optional<int> view = {};    ///< else this one; none: the one that was chosen
  std::size_t then = 0;            ///< scans that are taken after that of the view
};

/// From now on Mesa draws without threads of its own, unless it has begun to draw; images are the
/// same.
void draw_without_threads();

/// Repeats the run once. At each of these decisions the process is forked, once a view; the
/// children go on to their scan and tell what came of it, as many at a time as the episode has
/// threads. If something runs threads, which a fork would lose, each view is a repetition of its
/// own.
std::vector<BranchedDecision> branch_views(const RecordedRun& run, const BranchRequest& request);

}  // namespace vantage
