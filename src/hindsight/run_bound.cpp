#include "vantage/hindsight/run_bound.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "vantage/bound/schedule_bound.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/log.hpp"
#include "vantage/report/report_data.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/runtime/scratch_folder.hpp"
#include "vantage/tasks/run.hpp"

namespace vantage {
namespace {

/// The true pose of the base at each scan, at the end of which it stands still.
std::vector<Pose2> scan_poses(const RecordedRun& run) {
  const auto samples = read_tum(run.directory / "trajectory.tum");
  std::vector<Pose2> poses;
  for (const RecordedScan& scan : run.scans) {
    const auto later =
        std::ranges::upper_bound(samples, scan.time_s + 1e-6, {}, &TrajectorySample::time_s);
    if (later == samples.begin()) {
      throw InputError((run.directory / "trajectory.tum").string() +
                       ": begins after the first scan");
    }
    const TrajectorySample& at = *std::prev(later);
    poses.push_back({at.p_world_m.x(), at.p_world_m.y(), at.yaw_rad});
  }
  return poses;
}

template <class T>
constexpr bool kHasCoverage = requires(const T& task, const EpisodeSetup& setup,
                                       const std::vector<Pose2>& poses) {
  task.coverage(setup, poses);
};

ViewCoverage coverage_of(const RecordedRun& run) {
  const auto of_task = [&]<class T>(const T& task) -> ViewCoverage {
    if constexpr (kHasCoverage<T>) {
      return task.coverage(run.episode.setup, scan_poses(run));
    } else {
      throw InputError(run.directory.string() + ": no run that maps");
    }
  };
  return std::visit(of_task, run.episode.task);
}

double speed_m_s(const Task& task) {
  const auto of_task = []<class T>(const T& t) {
    if constexpr (std::derived_from<T, MappingOptions>) {
      return t.drive.controller.speed_m_s;
    } else {
      return 0.0;
    }
  };
  return std::visit(of_task, task);
}

/// The most that may be left where that share is reached, as metrics.json decides it.
std::size_t most_left(std::size_t observable_cells, int percent) {
  const double share = 0.01 * (100 - percent);
  auto left = static_cast<std::size_t>(share * static_cast<double>(observable_cells)) + 1;
  while (left > 0 && static_cast<double>(left) / static_cast<double>(observable_cells) > share) {
    --left;
  }
  return left;
}

/// The first scan that leaves no more than that; none: there is no such scan.
std::optional<std::size_t> scan_that_leaves(const RecordedRun& run, std::size_t cells) {
  const auto there = std::ranges::find_if(
      run.scans, [&](const RecordedScan& scan) { return scan.cells_left <= cells; });
  if (there == run.scans.end()) return std::nullopt;
  return static_cast<std::size_t>(there - run.scans.begin());
}

std::size_t shown_up_to(const CoverProblem& problem, std::size_t scan) {
  CellBits shown = problem.shows.front();
  for (std::size_t view = 1; view <= scan; ++view) unite(shown, problem.shows[view]);
  return count_cells(shown);
}

/// Views 0, 1, ... are those of the run.
CoverProblem cover_problem(const RecordedRun& run, ViewCoverage coverage) {
  CoverProblem problem;
  problem.shows = std::move(coverage.shows);
  problem.way_m = std::move(coverage.way_m);
  problem.speed_m_s = speed_m_s(run.episode.task);
  problem.scan_s = std::ranges::min_element(run.scans, {}, &RecordedScan::scan_time_s)->scan_time_s;
  return problem;
}

ShareReached at_scan(const RecordedRun& run, std::size_t scan) {
  return {scan + 1, run.scans[scan].path_length_m, run.scans[scan].time_s};
}

void set_least(const std::optional<ScheduleBound>& bound, const ShareReached& first,
               ShareBound& share) {
  if (!bound) return;
  share.least = ShareReached{first.scans + bound->least.scans, first.way_m + bound->least.way_m,
                             first.time_s + bound->least.time_s};
  share.exact_scans = bound->exact_scans;
  share.exact_way = bound->exact_way;
  share.exact_time = bound->exact_time;
}

}  // namespace

std::optional<ShareReached> progress_to(const RecordedRun& run, int percent) {
  const auto scan = scan_that_leaves(run, most_left(run.observable_cells, percent));
  if (!scan) return std::nullopt;
  return at_scan(run, *scan);
}

RunBound bound_of_run(const RecordedRun& run) {
  ViewCoverage coverage = coverage_of(run);
  if (coverage.observable_cells != run.observable_cells) {
    throw InputError(fmt::format(
        "{}: {} observable cells were recorded, there are {}: scene, robot "
        "or version have changed since (recorded by {})",
        run.directory.string(), run.observable_cells, coverage.observable_cells, run.version));
  }
  const CoverProblem problem = cover_problem(run, std::move(coverage));
  RunBound bound{.poses = problem.views(),
                 .observable_cells = run.observable_cells,
                 .speed_m_s = problem.speed_m_s,
                 .scan_s = problem.scan_s,
                 .first_scan = at_scan(run, 0),
                 .has_oracle_tour = false,
                 .shares = {}};
  std::vector<std::size_t> needed;
  for (const int percent : kBoundShares_percent) {
    const std::size_t left = most_left(run.observable_cells, percent);
    ShareBound share;
    share.percent = percent;
    share.run = progress_to(run, percent);
    needed.push_back(run.observable_cells - left);
    if (const auto scan = scan_that_leaves(run, left)) {
      const std::size_t shown = shown_up_to(problem, *scan);
      if (shown < needed.back()) share.given_cells = needed.back() - shown;
    }
    needed.back() -= share.given_cells;
    bound.shares.push_back(share);
  }
  Progress progress("bounds", static_cast<double>(needed.size()));
  const auto told = [&](std::size_t bounds) { progress.update(static_cast<double>(bounds)); };
  const auto least = schedule_bounds(problem, needed, {.done = told});
  told(needed.size());
  for (std::size_t i = 0; i < least.size(); ++i) {
    set_least(least[i], bound.first_scan, bound.shares[i]);
  }
  return bound;
}

void add_oracle_tour(const RecordedRun& run, RunBound& bound) {
  const ScratchFolder scratch;
  const std::filesystem::path folder = scratch.path() / "oracle_tour";
  const ResolvedEpisode episode =
      load_episode(run.directory / "config.yaml", {"choice=oracle_tour"});
  RunOptions options;
  options.directory = folder;
  options.lean = true;
  const RunOutcome outcome = vantage::run(episode, options);
  throw_if_interrupted();
  if (outcome.code != ExitCode::done) {
    throw Error(outcome.code, run.directory.string() + ": --oracle-tour: its run did not complete");
  }
  bound.has_oracle_tour = true;
  const RecordedRun oracle = read_recorded_run(folder);
  for (ShareBound& share : bound.shares) share.oracle_tour = progress_to(oracle, share.percent);
}

}  // namespace vantage
