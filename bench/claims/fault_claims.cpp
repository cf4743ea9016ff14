// Of robots with faults: how far coverage and accuracy fall, and that nothing worse comes of it.
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

constexpr double kKept = 0.75;
constexpr double kPrecision = 0.98;
constexpr double kNoMap = 1.0;  // of a run that failed before there was one: no cell is wrong
constexpr double kLost_m = 0.05;
constexpr double kSureOfObject = 0.9;  // the probability at which a flight takes no further view

/// Of a run that failed before it came to anything nothing is kept.
/// @param table more is better; `what` it says, "is observed"
Finding most_is_kept(const StudyTables& study, const char* table, const char* what) {
  return held(
      "goal",
      fmt::format("under each fault at least {:.2f} of what {} without one {}", kKept, what, what),
      [&]() -> Measured {
        std::vector<std::string> parts;
        const double wanted = kKept * study.mean(table, kAllPanels, study.reference());
        bool kept = true;
        for (const std::string& level : study.levels()) {
          const double with_it = study.mean(table, kAllPanels, level, 0.0);
          parts.push_back(fmt::format("{} {:.1f} %", level, 100.0 * with_it));
          kept = kept && with_it >= wanted;
        }
        return {fmt::format("{}", fmt::join(parts, ", ")), kept,
                "docs/decisions/faults.md tells which fault costs what"};
      });
}

Finding maps_stay_true(const StudyTables& study) {
  return held(
      "goal",
      fmt::format("occupied cells have a precision of at least {} in every map of a world in "
                  "which nothing is moved",
                  kPrecision),
      [&]() -> Measured {
        double least = 1.0;
        std::string of = study.reference();
        for (const std::string& level : study.levels()) {
          if (level == "moved_object") continue;
          const double lowest =
              std::ranges::min(study.values("precision", kAllPanels, level, kNoMap));
          if (lowest < least) of = level;
          least = std::min(least, lowest);
        }
        return {fmt::format("{:.4f} at least, with {}", least, of), least >= kPrecision,
                "see `precision` by episode"};
      });
}

Finding lost_poses_are_told(const StudyTables& study) {
  return held(
      "goal",
      fmt::format("a map with a pose off by more than {:.0f} mm says so: it is in doubt, or there "
                  "is none",
                  1000.0 * kLost_m),
      [&]() -> Measured {
        std::size_t lost = 0;
        std::size_t untold = 0;
        std::size_t doubted = 0;
        for (const std::string& level : study.levels()) {
          const auto worst_m = study.values("worst_pose_error_m", kAllPanels, level, 0.0);
          const auto doubts = study.values("map_in_doubt", kAllPanels, level, 0.0);
          for (std::size_t i = 0; i < worst_m.size(); ++i) {
            lost += worst_m[i] > kLost_m ? 1 : 0;
            untold += worst_m[i] > kLost_m && doubts[i] != 1.0 ? 1 : 0;
            doubted += worst_m[i] <= kLost_m && doubts[i] == 1.0 ? 1 : 0;
          }
        }
        return {fmt::format("{} of {} say nothing; {} maps are in doubt without reason", untold,
                            lost, doubted),
                untold == 0, "see `worst_pose_error_m` and `map_in_doubt` by episode"};
      });
}

Finding nobody_is_sure_and_wrong(const StudyTables& study) {
  return held("goal", "no flight ends sure of an object that it is not, whatever the fault",
              [&]() -> Measured {
                const std::vector<double> correct = all_values(study, "correct");
                const std::vector<double> sure = all_values(study, "map_probability");
                std::size_t wrong = 0;
                for (std::size_t i = 0; i < correct.size(); ++i) {
                  wrong += correct[i] != 1.0 && sure[i] >= kSureOfObject ? 1 : 0;
                }
                return {fmt::format("{} of {} flights", wrong, correct.size()), wrong == 0,
                        "see `map_probability` by episode"};
              });
}

}  // namespace

std::vector<Finding> mapping_fault_findings(const StudyTables& study) {
  return {most_is_kept(study, "observed_share", "is observed"), maps_stay_true(study),
          lost_poses_are_told(study), without_collision(study, "fault")};
}

std::vector<Finding> recognition_fault_findings(const StudyTables& study) {
  return {most_is_kept(study, "correct", "is recognised"), nobody_is_sure_and_wrong(study),
          without_collision(study, "fault")};
}

std::vector<Finding> trajectory_fault_findings(const StudyTables& study) {
  return {most_is_kept(study, "accuracy", "is recognised"), without_collision(study, "fault")};
}

}  // namespace vantage::bench
