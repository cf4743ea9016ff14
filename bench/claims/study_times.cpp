// How long studies take, by the wall time of their episodes.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <numeric>

#include "bench/claims/claims.hpp"

namespace vantage::bench {
namespace {
namespace fs = std::filesystem;

constexpr int kAtOnce = 2;
constexpr double kSecondsOfMinute = 60.0;

/// Those of sweep collect have no status: each row is of an episode that ended.
CsvTable timings_of(const fs::path& study) {
  const fs::path file = study / "timings.csv";
  const fs::path results = study / "results.csv";
  if (!fs::exists(file) || !fs::exists(results)) return {};
  CsvTable timings = of_results(read_csv(file), read_csv(results));
  timings.columns.emplace_back("status");
  for (auto& row : timings.rows) row.emplace_back("completed");
  return timings;
}

/// @throws NotRun if an episode that is planned has none
double minutes_of(const std::string& study, const fs::path& studies, const fs::path& results) {
  const StudyTables tables(studies / (study + ".yaml"), timings_of(results / study));
  double sum_s = 0.0;
  for (const std::string& level : tables.levels()) {
    const std::vector<double> wall_s = tables.values("wall_time_s", kAllPanels, level);
    sum_s = std::accumulate(wall_s.begin(), wall_s.end(), sum_s);
  }
  return sum_s / kAtOnce / kSecondsOfMinute;
}

}  // namespace

std::vector<Finding> study_time_findings(const fs::path& studies, const fs::path& results) {
  constexpr double kTable_min = 30.0;
  constexpr double kOffices_min = 240.0;
  const auto minutes = [&](const char* study) { return minutes_of(study, studies, results); };
  return {held("goal",
               fmt::format("the study of worktops takes at most {} min, {} episodes at a time",
                           kTable_min, kAtOnce),
               [&]() -> Measured {
                 const double table_min = minutes("tabletop");
                 return {fmt::format("{:.0f} min, half the wall time of its episodes", table_min),
                         table_min <= kTable_min,
                         "the time is the machine's: 25 min on another, to the same state hashes"};
               }),
          held("goal",
               fmt::format("those of both offices take at most {} min, {} episodes at a time",
                           kOffices_min, kAtOnce),
               [&]() -> Measured {
                 const double small_min = minutes("office_small");
                 const double large_min = minutes("office_large");
                 return {
                     fmt::format("{:.0f} and {:.0f} min, half the wall time of their episodes",
                                 small_min, large_min),
                     small_min + large_min <= kOffices_min,
                     "other work ran on the machine meanwhile; how long they take alone was not "
                     "measured"};
               })};
}

}  // namespace vantage::bench
