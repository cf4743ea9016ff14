#include "bench/claims/mapping_claims.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

#include "bench/tables/paired_difference.hpp"

namespace vantage::bench {
namespace {

std::string not_ahead(const std::vector<std::string>& level_in,
                      const std::vector<std::string>& behind_in) {
  std::vector<std::string> parts;
  if (!level_in.empty()) parts.push_back(fmt::format("level in {}", fmt::join(level_in, ", ")));
  if (!behind_in.empty())
    parts.push_back(fmt::format("`simple` is ahead in {}", fmt::join(behind_in, ", ")));
  return fmt::format("{}", fmt::join(parts, "; "));
}

/// Of the oracles that the study has, and in how many episodes the reference does better.
std::string headroom(const StudyTables& study) {
  std::vector<std::string> parts;
  const std::vector<double> reference = study.values("area", kAllPanels, study.reference());
  for (const std::string& level : study.levels()) {
    if (!level.starts_with("oracle")) continue;
    const std::vector<double> area = study.values("area", kAllPanels, level);
    std::size_t beaten = 0;
    for (std::size_t i = 0; i < std::min(area.size(), reference.size()); ++i) {
      beaten += reference[i] < area[i] ? 1 : 0;
    }
    parts.push_back(fmt::format("`{}` {}, beaten by `{}` in {} of {}", level,
                                study.ratio_text("area", kAllPanels, level), study.reference(),
                                beaten, area.size()));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace

Finding adaptive_against_simple(const StudyTables& study, const std::vector<const char*>& tables) {
  return held(
      "goal",
      fmt::format("`adaptive` is ahead of `simple`, in area and in what it predicts, beyond "
                  "the intervals, p < {}",
                  kSignificant),
      [&]() -> Measured {
        const bool to_simple = study.reference() == "simple";
        const std::string other = to_simple ? "adaptive" : "simple";
        std::vector<std::string> parts;
        std::vector<std::string> level_in, behind_in;
        for (const char* table : tables) {
          const Difference paired = study.difference(table, kAllPanels, other);
          const bool ahead = to_simple ? is_below(paired) : is_above(paired);
          const bool behind = to_simple ? is_above(paired) : is_below(paired);
          if (!ahead) (behind ? behind_in : level_in).push_back(fmt::format("`{}`", table));
          parts.push_back(fmt::format("`{}` {}", table, ratio_text(paired)));
        }
        std::vector<std::string> panels;
        for (const std::string& panel : study.panels()) {
          panels.push_back(fmt::format("{} {:.2f}", panel, study.ratio("area", panel, other)));
        }
        if (!panels.empty())
          parts.push_back("area in " + fmt::format("{}", fmt::join(panels, ", ")));
        return {fmt::format("`{}` in terms of `{}`: {}; how much there was to win: the area of "
                            "those that know what a view shows, none of which is a bound: {}",
                            other, study.reference(), fmt::join(parts, "; "), headroom(study)),
                level_in.empty() && behind_in.empty(), not_ahead(level_in, behind_in)};
      });
}

std::vector<double> all_values(const StudyTables& study, const std::string& table) {
  std::vector<double> all;
  for (const std::string& level : study.levels()) {
    std::ranges::copy(study.values(table, kAllPanels, level), std::back_inserter(all));
  }
  return all;
}

Finding maps_are_right(const StudyTables& study) {
  constexpr double kMost_m = 0.05;
  constexpr double kLeast = 0.98;
  return held(
      "goal",
      fmt::format("the pose of no scan in a map is off by more than {:.0f} mm, and occupied "
                  "cells have a precision of at least {}, in every episode",
                  1000.0 * kMost_m, kLeast),
      [&]() -> Measured {
        const std::vector<double> worst_m = all_values(study, "worst_pose_error_m");
        const std::vector<double> precision = all_values(study, "precision");
        const auto off = std::ranges::count_if(worst_m, [](double m) { return m > kMost_m; });
        const double least = *std::ranges::min_element(precision);
        return {fmt::format("{:.0f} mm at most, more than {:.0f} in {} of {} episodes; "
                            "precision {:.4f} at least",
                            1000.0 * *std::ranges::max_element(worst_m), 1000.0 * kMost_m, off,
                            worst_m.size(), least),
                off == 0 && least >= kLeast, "see `worst_pose_error_m` by episode"};
      });
}

Finding without_collision(const StudyTables& study, const char* compared) {
  return held("goal", fmt::format("no collision in any episode of any {}", compared),
              [&]() -> Measured {
                double collisions = 0.0;
                const auto levels = study.levels();
                for (const std::string& level : levels) {
                  collisions += study.mean("collisions", kAllPanels, level);
                }
                return {fmt::format("{:.3g} an episode, over all {}s",
                                    collisions / static_cast<double>(levels.size()), compared),
                        collisions == 0.0, "see `collisions` by episode"};
              });
}

}  // namespace vantage::bench
