// Of choices that plan several views ahead, with the time that everything takes.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include "bench/claims/claims.hpp"
#include "bench/claims/mapping_claims.hpp"
#include "bench/tables/race.hpp"

namespace vantage::bench {
namespace {

/// `adaptive` with the reference choice is the best of what there was before.
constexpr const char* kPanel = "adaptive";
constexpr const char* kTour = "tour";
constexpr const char* kPartialGreedy = "greedy_partial_scans";
constexpr const char* kRate = "information_rate";

bool is_compared(const StudyTables& study, const std::string& choice) {
  return std::ranges::count(study.levels(), choice) > 0;
}

/// "`gain_over_distance` 0.50 [..]; `nearest_frontier` ..": what all others have of the
/// reference's.
std::string beside(const StudyTables& study, const std::string& table) {
  std::vector<std::string> parts;
  for (const std::string& other : study.levels()) {
    if (other == kTour || other == study.reference()) continue;
    const Race against = bench::race(study, table, kPanel, other, study.reference());
    parts.push_back(fmt::format("`{}` has {}", other, against.text()));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

Finding against_greedy(const StudyTables& study, const std::string& table, double limit) {
  const bool partial = is_compared(study, kPartialGreedy);
  return held(
      "goal",
      fmt::format("`{}` of `tour`{} at most {} x that of `{}`{}, p < {}", table,
                  partial ? ", which leaves images out and looks on the way," : "", limit,
                  study.reference(), partial ? " as it was, with whole scans" : "", kSignificant),
      [&]() -> Measured {
        const Race against = bench::race(study, table, kPanel, kTour, study.reference());
        const std::string why = against.why_lost(limit);
        return {against.text() + "<br>" + beside(study, table),
                against.is_won_by(limit) && against.is_significant(),
                why.empty() ? "see what the others have of it, `oracle_tour` among them" : why};
      });
}

/// Of what scans that leave images out make of any choice, and what of `tour`.
Finding ahead_by_planning(const StudyTables& study, const std::string& table) {
  return held(
      "goal",
      fmt::format("of choices that all leave out what is not worth its time and look on the way "
                  "`tour` is ahead of `greedy` in `{}`, beyond the interval, p < {}",
                  table, kSignificant),
      [&]() -> Measured {
        const Race against = bench::race(study, table, kPanel, kTour, kPartialGreedy);
        return {against.text(), against.is_ahead(),
                against.why_not_ahead() + ": it is the scans, and not where they are taken"};
      });
}

/// The oracle plans over what views show in truth, step by step: it is no bound, and may be behind.
/// One that gets there less often is nothing to be near to.
Finding near_oracle(const StudyTables& study, const std::string& table) {
  return held("goal", fmt::format("`{}` of `tour` at most 1.25 x that of `oracle_tour`", table),
              [&]() -> Measured {
                const Race against = bench::race(study, table, kPanel, kTour, "oracle_tour");
                const bool arrives = against.other_arrived >= against.arrived;
                return {
                    against.text() + (against.is_won_by(1.0) ? ": `oracle_tour` is no bound" : ""),
                    arrives && against.is_won_by(1.25),
                    arrives ? "the oracle knows the rooms that nobody has seen yet"
                            : "`oracle_tour` gets there less often: it is nothing to be near to"};
              });
}

Finding ahead_of(const StudyTables& study, const std::string& table, const std::string& what,
                 const std::vector<const char*>& others) {
  return held("goal",
              fmt::format("`tour` ahead of {} in `{}`, beyond the intervals, p < {}", what, table,
                          kSignificant),
              [&]() -> Measured {
                std::vector<std::string> parts;
                std::vector<std::string> reasons;
                for (const char* other : others) {
                  const Race against = bench::race(study, table, kPanel, kTour, other);
                  parts.push_back(fmt::format("`{}`: {}", other, against.text()));
                  if (against.is_ahead()) continue;
                  reasons.push_back(fmt::format("not of `{}`: {}", other, against.why_not_ahead()));
                }
                return {fmt::format("{}", fmt::join(parts, "<br>")), reasons.empty(),
                        fmt::format("{}", fmt::join(reasons, "; "))};
              });
}

Finding ahead_of_peers(const StudyTables& study, const std::string& table) {
  return ahead_of(study, table, "our versions of three published planners, at default options,",
                  {"receding_horizon", "frontier_tour", "two_level_tour"});
}

/// They take the way or the time into account too.
Finding ahead_of_rates(const StudyTables& study, const std::string& table) {
  return ahead_of(study, table, "the other choices of ours that pay for way or time",
                  {"gain_over_distance", kRate, "rollout"});
}

/// What the planners plan for, over all of a run, whether it gets to any share or not.
Finding less_area(const StudyTables& study) {
  return held("goal",
              fmt::format("`area_over_time` of `tour`, what is unobserved summed over time, below "
                          "that of `{}`, beyond the interval, p < {}",
                          study.reference(), kSignificant),
              [&]() -> Measured {
                constexpr const char* kTable = "area_over_time";
                const Difference paired = study.difference(kTable, kPanel, kTour);
                const Difference rate = study.difference(kTable, kPanel, kTour, kRate);
                return {fmt::format("{}; in terms of `{}`'s {}", ratio_text(paired), kRate,
                                    ratio_text(rate)),
                        is_below(paired), "what it saves at the end it has spent before"};
              });
}

Finding calibration_matters(const StudyTables& study, const std::string& table) {
  return held(
      "goal",
      fmt::format("`tour` by `adaptive` ahead of `tour` by `simple` in `{}`, beyond the interval, "
                  "p < {}",
                  table, kSignificant),
      [&]() -> Measured {
        const StudyTables by_gain = study.compared_by("gain", "simple");
        const Race against = bench::race(by_gain, table, kTour, "adaptive", "simple");
        return {
            against.text(), against.is_ahead(),
            against.why_not_ahead() + ": where a view shows next to all it could, both plan alike"};
      });
}

/// A run that never gets there counts with all its scans.
Finding as_few_scans(const StudyTables& study) {
  return held("goal", "`tour` takes no more scans to 98 % than the reference", [&]() -> Measured {
    const Difference paired = study.difference("scans_to_98", kPanel, kTour);
    if (!paired.ratio) throw NotRun("`scans_to_98`: the reference takes none");
    return {ratio_text(paired), *paired.ratio <= 1.0,
            paired.ratio_interval->low <= 1.0
                ? "the interval holds 1: no clear difference"
                : "a shorter way is paid for by views that show less"};
  });
}

}  // namespace

std::vector<Finding> planning_office_findings(const StudyTables& study, double time_limit,
                                              std::optional<double> path_limit) {
  std::vector<Finding> findings{against_greedy(study, "time_to_95_s", time_limit)};
  if (path_limit) findings.push_back(against_greedy(study, "path_to_95_m", *path_limit));
  if (is_compared(study, kPartialGreedy)) {
    findings.push_back(ahead_by_planning(study, "time_to_95_s"));
  }
  findings.push_back(near_oracle(study, "time_to_95_s"));
  findings.push_back(ahead_of_peers(study, "time_to_95_s"));
  findings.push_back(ahead_of_rates(study, "time_to_95_s"));
  findings.push_back(less_area(study));
  findings.push_back(calibration_matters(study, "time_to_95_s"));
  findings.push_back(intervals_cover(study));
  findings.push_back(maps_are_right(study));
  findings.push_back(without_collision(study, "choice"));
  return findings;
}

std::vector<Finding> planning_tabletop_findings(const StudyTables& study) {
  return {against_greedy(study, "path_to_98_m", 0.6), as_few_scans(study),
          near_oracle(study, "time_to_98_s"),         ahead_of_peers(study, "time_to_98_s"),
          ahead_of_rates(study, "time_to_98_s"),      less_area(study),
          calibration_matters(study, "time_to_98_s"), intervals_cover(study),
          without_collision(study, "choice")};
}

}  // namespace vantage::bench
