/// How far a run was from what any policy could have done.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "vantage/hindsight/recorded_run.hpp"

namespace vantage {

inline constexpr std::array kBoundShares_percent{80, 90, 95, 97};

/// From the start of the episode until a share of the observable cells is observed.
struct ShareReached {
  std::size_t scans = 0;
  double way_m = 0.0;
  double time_s = 0.0;
};
/// None: never.
std::optional<ShareReached> progress_to(const RecordedRun& run, int percent);

struct ShareBound {
  int percent = 0;
  std::optional<ShareReached> run;
  std::optional<ShareReached> oracle_tour;  ///< by a run of that choice, if there is one
  std::optional<ShareReached> least;        ///< each on its own; none: it cannot be reached
  /// The least is that of some schedule, not only below all; ways and times are themselves bounds
  /// of what can be driven.
  bool exact_scans = false;
  bool exact_way = false;
  bool exact_time = false;
  /// Cells that the map of the run had by then beyond what noise-free scans from its poses show:
  /// any policy is given as many.
  std::size_t given_cells = 0;
};

struct RunBound {
  std::size_t poses = 0;  ///< that policies may scan from
  std::size_t observable_cells = 0;
  double speed_m_s = 0.0;        ///< that no policy drives faster than
  double scan_s = 0.0;           ///< that no scan takes less than
  ShareReached first_scan;       ///< the same for every policy
  bool has_oracle_tour = false;  ///< see add_oracle_tour()
  std::vector<ShareBound> shares;
};

/// A policy may scan from the poses that observability is defined by and from those of the run; it
/// starts with the run's first scan; its scans take as long as the shortest of the run, its ways
/// are the shortest of a disc that the robot holds, at full speed and without turns. The run is
/// such a policy: nothing of it is below the bound.
RunBound bound_of_run(const RecordedRun& run);

/// Runs the same episode with the choice `oracle_tour`, keeping nothing, and notes how it did.
/// @throws Interrupted; Error with the run's code if it does not complete
void add_oracle_tour(const RecordedRun& run, RunBound& bound);
/// Takes it over from a former bound of the same run, as run_bound_json() tells it, if that has it.
void keep_oracle_tour(const nlohmann::ordered_json& former, RunBound& bound);

nlohmann::ordered_json run_bound_json(const RunBound& bound);
std::string run_bound_text(const RunBound& bound);

}  // namespace vantage
