#include "vantage/hindsight/hindsight_records.hpp"

namespace vantage {
namespace {

constexpr std::string_view kBound = "bound.json";
constexpr std::string_view kBranches = "branches.json";

RecordTexts bound_records() {
  return {
      {kBound, "poses", "that any policy may scan from: those of observability and of the run"},
      {kBound, "observable_cells", "that shares are of"},
      {kBound, "speed_m_s", "that no policy drives faster than"},
      {kBound, "scan_s", "that no scan takes less than: the shortest of the run"},
      {kBound, "first_scan", "scans, way_m and time_s of the first scan, the same of any policy"},
      {kBound, "has_oracle_tour",
       "whether the episode was run by oracle_tour, too (--oracle-tour)"},
      {kBound, "shares[].percent", "of the observable cells, observed"},
      {kBound, "shares[].run", "scans, way_m and time_s until then, of the run; null: never"},
      {kBound, "shares[].oracle_tour", "the same of the run by oracle_tour"},
      {kBound, "shares[].least",
       "the least scans, way_m and time_s of any policy, each on its own; null: no policy can"},
      {kBound, "shares[].exact",
       "whether the least scans, way_m and time_s are those of some policy, not only below all"},
      {kBound, "shares[].given_cells",
       "that the map of the run had by then beyond what noise-free scans from its poses show: any "
       "policy is given as many"},
      {kBound, "shares[].run_over_least", "ratios of scans, way_m and time_s; null: there is none"},
      {kBound, "shares[].run_over_oracle_tour", "the same ratios to the run by oracle_tour"},
  };
}

RecordTexts branches_records() {
  return {
      {kBranches, "decisions[].scan", "that the decision was taken after, the first is 1"},
      {kBranches, "decisions[].then", "further scans by the episode's own choice (--then)"},
      {kBranches, "decisions[].gain_unit", "what gain counts"},
      {kBranches, "decisions[].regret",
       "what the chosen view showed less than the best one: best_view and cells, and fastest_view "
       "and cells_per_s; null if no scan came of the chosen one"},
      {kBranches, "decisions[].branches[].view", "number of the view that was taken"},
      {kBranches, "decisions[].branches[].chosen", "whether the run took it"},
      {kBranches, "decisions[].branches[].gain", "as the gain in use predicted it"},
      {kBranches, "decisions[].branches[].planned_m", "length of the planned way; null: none"},
      {kBranches, "decisions[].branches[].fallback", "whether the robot did not get there"},
      {kBranches, "decisions[].branches[].new_cells",
       "observable cells newly observed; null: no scan came of it"},
      {kBranches, "decisions[].branches[].seconds", "from the decision to the end of the scan"},
      {kBranches, "decisions[].branches[].way_m", "truly driven"},
      {kBranches, "decisions[].branches[].new_cells_then", "with the scans that came after it"},
      {kBranches, "decisions[].branches[].seconds_then", "until the end of those"},
  };
}

}  // namespace

RecordTexts hindsight_records() { return joined(bound_records(), branches_records()); }

}  // namespace vantage
