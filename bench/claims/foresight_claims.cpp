// Of what an exploration knows of what it does not see yet: intervals, when it is done, and how far
// it was from what any policy could have done.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "bench/claims/claims.hpp"
#include "bench/claims/mapping_claims.hpp"
#include "bench/claims/race.hpp"

namespace vantage::bench {
namespace {

constexpr double kLeastCovered = 0.88;
constexpr double kMostCovered = 0.92;
constexpr double kFewestDecisions = 500.0;

constexpr const char* kStop = "stop";
constexpr const char* kEnough = "enough";
constexpr double kSure = 0.9;
constexpr double kAskedFor = 0.95;

/// Of the episodes of a level of the end, those in which it said that it is done.
struct SaidDone {
  std::size_t episodes = 0;
  std::size_t said = 0;
  std::size_t wrong = 0;
  std::vector<double> delays;  ///< scans, of those that were right
};

SaidDone said_done(const StudyTables& study, const std::string& panel) {
  const auto of = [&](const char* table) { return study.values(table, panel, kStop); };
  const auto sure = of("stop_confidence");
  const auto seen = of("observed_share");
  const auto scans = of("scans");
  const auto needed = of("scans_to_95");
  SaidDone done;
  done.episodes = sure.size();
  for (std::size_t i = 0; i < sure.size(); ++i) {
    if (sure[i] < kSure) continue;
    ++done.said;
    if (seen[i] < kAskedFor) {
      ++done.wrong;
    } else {
      done.delays.push_back(scans[i] - needed[i]);
    }
  }
  if (done.said == 0)
    throw NotRun(fmt::format("it says in no episode of {} that it is done", panel));
  return done;
}

Finding is_seldom_wrong(const StudyTables& study) {
  return held(
      "goal",
      "`stop` says, 90 % sure, that 95 % has been seen: wrongly in at most 10 % of episodes",
      [&]() -> Measured {
        const SaidDone all = said_done(study, kAllPanels);
        std::vector<std::string> parts;
        for (const std::string& panel : study.panels()) {
          const SaidDone done = said_done(study, panel);
          parts.push_back(fmt::format("`{}` {} of {}", panel, done.wrong, done.said));
        }
        return {fmt::format("wrongly in {} of the {} in which it says so, of {}: {}", all.wrong,
                            all.said, all.episodes, fmt::join(parts, ", ")),
                static_cast<double>(all.wrong) <= 0.1 * static_cast<double>(all.said),
                "what is behind a door that no scan has looked through is not known of"};
      });
}

Finding says_so_soon(const StudyTables& study) {
  return held("goal", "it says so at most 2 scans after it is true, in the median",
              [&]() -> Measured {
                std::vector<double> delays = said_done(study, kAllPanels).delays;
                if (delays.empty()) throw NotRun("it is right in no episode");
                std::ranges::sort(delays);
                const double median = delays[delays.size() / 2];
                return {fmt::format("{:g} scans, {:g} at most", median, delays.back()),
                        median <= 2.0, "the last of what is left is forecast too high"};
              });
}

/// It is to be the default end if it holds.
Finding ends_better(const StudyTables& study) {
  return held("goal",
              "in place of `enough` it ends explorations sooner, beyond the interval, and no fewer "
              "of them see 95 %",
              [&]() -> Measured {
                std::vector<std::string> parts;
                bool better = true;
                for (const std::string& panel : study.panels()) {
                  const double here = study.mean("reached_95", panel, kStop);
                  const double there = study.mean("reached_95", panel, kEnough);
                  const Difference time =
                      study.difference("simulated_time_s", panel, kStop, kEnough);
                  better = better && here >= there && time.interval.high < 0.0;
                  parts.push_back(fmt::format("`{}`: {:.0f} and {:.0f} % see 95 %, time {}", panel,
                                              100.0 * here, 100.0 * there, ratio_text(time)));
                }
                return {fmt::format("{}", fmt::join(parts, "<br>")), better,
                        "so it stays an option, and `enough` the default"};
              });
}

}  // namespace

Finding intervals_cover(const StudyTables& study) {
  return held(
      "goal",
      fmt::format("90 % intervals of what a scan is forecast to show cover {:.0f} to {:.0f} "
                  "% of at least {:.0f} decisions",
                  100.0 * kLeastCovered, 100.0 * kMostCovered, kFewestDecisions),
      [&]() -> Measured {
        double decisions = 0.0;
        double covered = 0.0;
        for (const std::string& level : study.levels()) {
          const auto shares = study.values("interval_coverage", kAllPanels, level);
          const auto scans = study.values("scans", kAllPanels, level);
          for (std::size_t i = 0; i < shares.size(); ++i) {
            decisions += scans[i] - 1.0;  // nothing is forecast of the first
            covered += shares[i] * (scans[i] - 1.0);
          }
        }
        const double share = quotient(covered, decisions);
        return {fmt::format("{:.1f} % of {:.0f}", 100.0 * share, decisions),
                share >= kLeastCovered && share <= kMostCovered && decisions >= kFewestDecisions,
                "errors are more alike within an episode than the next episode is to it"};
      });
}

Finding above_the_bound(const StudyTables& bounds) {
  return held(
      "goal",
      "no run is below what `vantage bound` says that any policy needs, at 80, 90, 95 and "
      "97 %; how far above it is, at 95 %",
      [&]() -> Measured {
        constexpr const char* kPanel = "adaptive";
        std::vector<std::string> parts;
        double least = std::numeric_limits<double>::infinity();
        for (const char* level : {"greedy", "tour"}) {
          least = std::min(least, bounds.least("least_ratio", kPanel, level));
          std::vector<std::string> means;
          for (const char* counted : {"scans", "way", "time"}) {
            const std::string table = fmt::format("{}_over_least_95", counted);
            std::vector<double> ratios;
            for (const Sample& sample : bounds.arrivals(table, kPanel, level)) {
              ratios.push_back(sample.value);
            }
            if (!ratios.empty()) {
              means.push_back(fmt::format("{:.2f} x the {}", vantage::mean(ratios), counted));
            }
          }
          parts.push_back(fmt::format("`{}` {}", level, fmt::join(means, ", ")));
        }
        return {fmt::format("{}; {:.3f} of all at least", fmt::join(parts, "; "), least),
                least >= 1.0, "then the bound is wrong"};
      });
}

std::vector<Finding> stop_findings(const StudyTables& study) {
  return {is_seldom_wrong(study), says_so_soon(study), ends_better(study),
          without_collision(study, "end")};
}

}  // namespace vantage::bench
