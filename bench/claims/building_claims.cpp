// Of buildings that are hard to get about in, or to know one's place in.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include "bench/claims/claims.hpp"
#include "bench/claims/mapping_claims.hpp"

namespace vantage::bench {
namespace {

/// "doors_85_a: `greedy` 98.9, `tour` 99.1 %; .."
std::string by_building(const StudyTables& study, const std::string& table, double scale,
                        const std::string& format) {
  std::vector<std::string> parts;
  for (const std::string& building : study.panels()) {
    std::vector<std::string> levels;
    for (const std::string& level : study.levels()) {
      const double value = scale * study.mean(table, building, level);
      levels.push_back(fmt::format("`{}` {}", level, fmt::format(fmt::runtime(format), value)));
    }
    parts.push_back(fmt::format("{}: {}", building, fmt::join(levels, ", ")));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace

std::vector<Finding> building_findings(const StudyTables& study) {
  return {held("goal",
               "every room that has a door is entered, behind doors of 0.80 m too: at least 95 % "
               "of the observable cells in every episode, where a room is a tenth",
               [&]() -> Measured {
                 return {by_building(study, "observed_share", 100.0, "{:.1f} %"),
                         std::ranges::min(all_values(study, "observed_share")) >= 0.95,
                         "see `observed_share` by building"};
               }),
          held("goal", "the pose of no scan in the map is off by more than 50 mm",
               [&]() -> Measured {
                 return {
                     by_building(study, "worst_pose_error_m", 1000.0, "{:.0f} mm"),
                     std::ranges::max(all_values(study, "worst_pose_error_m")) <= 0.05,
                     "where both ends of a corridor of plain walls are out of the scanner's sight, "
                     "wheels alone tell how far the robot is along it; a run that doubts its map "
                     "ends as failed"};
               }),
          held("goal", "precision of occupied cells at least 0.98",
               [&]() -> Measured {
                 return {by_building(study, "precision", 1.0, "{:.4f}"),
                         std::ranges::min(all_values(study, "precision")) >= 0.98, "see the poses"};
               }),
          without_collision(study, "choice")};
}

}  // namespace vantage::bench
