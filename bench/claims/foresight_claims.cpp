// Of what an exploration knows of what it does not see yet: intervals, when it is done, and how far
// it was from what any policy could have done.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "bench/claims/claims.hpp"
#include "bench/claims/mapping_claims.hpp"
#include "bench/tables/race.hpp"

namespace vantage::bench {
namespace {

constexpr double kLeastCovered = 0.88;
constexpr double kMostCovered = 0.92;
constexpr double kFewestDecisions = 500.0;

constexpr const char* kStop = "stop";
constexpr const char* kEnough = "enough";
constexpr double kSure = 0.9;
constexpr double kAskedFor = 0.95;
constexpr double kNever = std::numeric_limits<double>::infinity();

/// Decisions whose intervals held what came.
struct Covered {
  double decisions = 0.0;
  double held = 0.0;

  [[nodiscard]] double share() const { return quotient(held, decisions); }
  [[nodiscard]] bool is_as_said() const {
    return share() >= kLeastCovered && share() <= kMostCovered && decisions >= kFewestDecisions;
  }
};

Covered covered(const StudyTables& study, const std::string& panel, const std::string& level) {
  const auto shares = study.values("interval_coverage", panel, level);
  const auto scans = study.values("scans", panel, level);
  Covered all;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    all.decisions += scans[i] - 1.0;  // nothing is forecast of the first
    all.held += shares[i] * (scans[i] - 1.0);
  }
  return all;
}

/// Of one gain, and of the choices that cover least and most: a choice that asks for no gain does
/// the same under each, and would count twice.
struct CoveredByChoice {
  Covered all;
  std::pair<double, std::string> least{kNever, {}};
  std::pair<double, std::string> most{-kNever, {}};
};

CoveredByChoice covered_by_choice(const StudyTables& study, const std::string& panel) {
  CoveredByChoice by;
  for (const std::string& level : study.levels()) {
    const Covered of = covered(study, panel, level);
    by.all.decisions += of.decisions;
    by.all.held += of.held;
    by.least = std::min(by.least, {of.share(), level});
    by.most = std::max(by.most, {of.share(), level});
  }
  return by;
}

/// Of the episodes of a level of the end, those in which it said that it is done.
struct SaidDone {
  std::size_t episodes = 0;
  std::size_t said = 0;
  std::size_t wrong = 0;
  std::vector<Sample> errors;  ///< 1 or 0 of each that said so, with its scene
  std::vector<double> delays;  ///< scans, where it was true in the end
};

SaidDone said_done(const StudyTables& study, const std::string& panel) {
  const auto of = [&](const char* table) { return study.values(table, panel, kStop); };
  const auto sure = of("stop_confidence");
  const auto seen = of("observed_share");
  const auto scans = of("scans");
  const auto needed = of("scans_to_95");
  const std::vector<Sample> episodes = study.arrivals("observed_share", panel, kStop);
  SaidDone done;
  done.episodes = sure.size();
  for (std::size_t i = 0; i < sure.size(); ++i) {
    const bool said = sure[i] >= kSure;
    const bool right = seen[i] >= kAskedFor;
    done.said += said ? 1 : 0;
    done.wrong += said && !right ? 1 : 0;
    if (said) {
      done.errors.push_back(
          {.pair = i, .value = right ? 0.0 : 1.0, .cluster = episodes[i].cluster});
    }
    if (right) done.delays.push_back(said ? scans[i] - needed[i] : kNever);
  }
  if (done.said == 0)
    throw NotRun(fmt::format("it says in no episode of {} that it is done", panel));
  return done;
}

/// "9.4 % [0.0, 18.8]": the interval is over whole scenes.
std::string error_rate(const SaidDone& done) {
  const Comparison rate = compare_levels("errors", "errors", {kAllPanels}, {kStop}, 0, done.errors);
  const ComparisonRow& row = rate.rows.front();
  return fmt::format("{:.1f} % [{:.1f}, {:.1f}]", 100.0 * row.mean, 100.0 * row.interval.low,
                     100.0 * row.interval.high);
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
        return {fmt::format("wrongly in {} of the {} in which it says so, of {}: {}; {}", all.wrong,
                            all.said, all.episodes, fmt::join(parts, ", "), error_rate(all)),
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
                const auto never = std::ranges::count(delays, kNever);
                return {fmt::format("{:g} scans, {}", median,
                                    never > 0 ? fmt::format("never in {}", never)
                                              : fmt::format("{:g} at most", delays.back())),
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
                double least = 1.0;
                bool better = true;
                for (const std::string& panel : study.panels()) {
                  least = std::min(least, study.least("observed_share", panel, kStop));
                  const double here = study.mean("reached_95", panel, kStop);
                  const double there = study.mean("reached_95", panel, kEnough);
                  const Difference time =
                      study.difference("simulated_time_s", panel, kStop, kEnough);
                  better = better && here >= there && is_below(time);
                  parts.push_back(fmt::format("`{}`: {:.0f} and {:.0f} % see 95 %, time {}", panel,
                                              100.0 * here, 100.0 * there, ratio_text(time)));
                }
                return {fmt::format("{}", fmt::join(parts, "<br>")), better,
                        (least < kAskedFor ? fmt::format("the least is {:.1f} %: ", 100.0 * least)
                                           : std::string()) +
                            "it stays an option, and `enough` the default"};
              });
}

}  // namespace

Finding intervals_cover(const StudyTables& study) {
  return held(
      "goal",
      fmt::format("90 % intervals of what a scan is forecast to show cover {:.0f} to {:.0f} "
                  "% of at least {:.0f} decisions, by each gain",
                  100.0 * kLeastCovered, 100.0 * kMostCovered, kFewestDecisions),
      [&]() -> Measured {
        std::vector<std::string> parts;
        bool holds = true;
        for (const std::string& panel : study.panels()) {
          const auto [all, least, most] = covered_by_choice(study, panel);
          parts.push_back(
              fmt::format("`{}` {:.1f} % of {:.0f}, by choice {:.1f} (`{}`) to {:.1f} "
                          "(`{}`)",
                          panel, 100.0 * all.share(), all.decisions, 100.0 * least.first,
                          least.second, 100.0 * most.first, most.second));
          holds = all.is_as_said() && holds;
        }
        return {fmt::format("{}", fmt::join(parts, "; ")), holds,
                "errors are more alike within an episode than the next episode is to it"};
      });
}

Finding above_the_bound(const StudyTables& bounds) {
  return held(
      "goal",
      "no run of `greedy` or `tour` by `adaptive` is below what `vantage bound` says that any "
      "policy needs, at 80, 90, 95 and 97 %; how far above it is, at 95 %. The bound of time has "
      "all scans as short as the shortest of the run: it compares no choices that leave images "
      "out with those that do not",
      [&]() -> Measured {
        constexpr const char* kPanel = "adaptive";
        std::vector<std::string> parts;
        double least = std::numeric_limits<double>::infinity();
        for (const char* level : {"greedy", "tour"}) {
          least = std::min(least, bounds.least("least_ratio", kPanel, level));
          std::vector<std::string> means;
          std::size_t runs = 0;  // that get to 95 %
          for (const char* counted : {"scans", "way", "time"}) {
            const std::string table = fmt::format("{}_over_least_95", counted);
            std::vector<double> ratios;
            for (const Sample& sample : bounds.arrivals(table, kPanel, level)) {
              ratios.push_back(sample.value);
            }
            if (!ratios.empty()) {
              means.push_back(fmt::format("{:.2f} x the {}", vantage::mean(ratios), counted));
              runs = ratios.size();
            }
          }
          parts.push_back(fmt::format("`{}` {}, {} runs", level, fmt::join(means, ", "), runs));
        }
        return {fmt::format("{}; the least ratio of all is {:.3f}", fmt::join(parts, "; "), least),
                least >= 1.0, "then the bound is wrong"};
      });
}

std::vector<Finding> stop_findings(const StudyTables& study) {
  return {is_seldom_wrong(study), says_so_soon(study), ends_better(study),
          without_collision(study, "end")};
}

}  // namespace vantage::bench
