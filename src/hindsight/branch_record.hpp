/// What the views of a decision would have brought: `branches.json` of a run folder.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vantage {

/// A view that was taken in place of the chosen one.
struct Branch {
  int view = 0;
  bool chosen = false;              ///< as it was recorded
  double gain = 0.0;                ///< as the gain in use predicted it
  std::optional<double> planned_m;  ///< of the way there; none: out of reach
  bool fallback = false;            ///< the robot went as near as it could
  std::optional<long long> cells;   ///< observable ones newly observed; none: no scan came of it
  double seconds = 0.0;             ///< from the decision to the end of the scan
  double way_m = 0.0;               ///< truly driven
  std::optional<long long> cells_then;  ///< with the scans that were taken after it
  double seconds_then = 0.0;
};

struct BranchedDecision {
  std::size_t scan = 0;  ///< that it was taken after, the first is 1
  std::size_t then = 0;  ///< further scans that the episode's own choice took
  std::string gain_unit;
  std::vector<Branch> branches;  ///< of views that can be taken, by their number
};

/// What the chosen view showed less than the best one, in cells, and in cells a second.
struct Regret {
  int best_view = 0;
  double cells = 0.0;
  int fastest_view = 0;
  double cells_per_s = 0.0;
};
/// None if the chosen view is not among them or brought no scan.
std::optional<Regret> regret_of(const BranchedDecision& decision);

nlohmann::ordered_json branched_json(const BranchedDecision& decision);
std::string branched_text(const BranchedDecision& decision);

/// Adds to what there is of other decisions. @throws OutputError
void keep_branches(const std::filesystem::path& run_dir,
                   const std::vector<BranchedDecision>& decisions);

}  // namespace vantage
