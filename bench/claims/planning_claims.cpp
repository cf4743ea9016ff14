// Of choices that plan several views ahead, with the time that everything takes.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <array>

#include "bench/claims/claims.hpp"
#include "bench/claims/race.hpp"

namespace vantage::bench {
namespace {

/// `adaptive` with the reference choice is the best of what there was before.
constexpr const char* kPanel = "adaptive";
constexpr const char* kTour = "tour";

Finding against_greedy(const StudyTables& study, const std::string& table, double limit) {
  return held(
      "goal",
      fmt::format("`{}` of `tour` at most {} x that of `{}`, p < 0.05", table, limit,
                  study.reference()),
      [&]() -> Measured {
        const Race against = bench::race(study, table, kPanel, kTour, study.reference());
        const Race oracle = bench::race(study, table, kPanel, "oracle_tour", study.reference());
        return {
            against.text(),
            against.is_won_by(limit) && against.pairs && against.pairs->p_value < 0.05,
            fmt::format("`oracle_tour`, which knows what every view shows, has {}", oracle.text())};
      });
}

Finding near_oracle(const StudyTables& study, const std::string& table) {
  return held("goal", fmt::format("`{}` of `tour` at most 1.25 x that of `oracle_tour`", table),
              [&]() -> Measured {
                const Race against = bench::race(study, table, kPanel, kTour, "oracle_tour");
                return {against.text(), against.is_won_by(1.25),
                        "the oracle knows the rooms that nobody has seen yet"};
              });
}

Finding ahead_of_peers(const StudyTables& study, const std::string& table) {
  return held("goal", fmt::format("`tour` ahead of its peers in `{}`", table), [&]() -> Measured {
    std::vector<std::string> parts;
    bool ahead = true;
    for (const char* peer : {"receding_horizon", "frontier_tour", "two_level_tour"}) {
      const Race against = bench::race(study, table, kPanel, kTour, peer);
      ahead = against.is_won_by(1.0) && ahead;
      parts.push_back(fmt::format("`{}`: {}", peer, against.text()));
    }
    return {fmt::format("{}", fmt::join(parts, "<br>")), ahead,
            "see the paired differences in the table"};
  });
}

Finding calibration_matters(const StudyTables& study, const std::string& table) {
  return held(
      "goal", fmt::format("`tour` by `adaptive` ahead of `tour` by `simple` in `{}`", table),
      [&]() -> Measured {
        const double ratio =
            quotient(study.mean(table, "adaptive", kTour), study.mean(table, "simple", kTour));
        return {fmt::format("{:.2f}", ratio), ratio < 1.0,
                "where a view shows next to all it could, both plan alike"};
      });
}

Finding never_touches(const StudyTables& study) {
  return held("goal", "no collision in any episode of any choice", [&]() -> Measured {
    double collisions = 0.0;
    for (const std::string& level : study.levels()) {
      collisions += study.mean("collisions", kAllPanels, level);
    }
    return {fmt::format("{:.3g} an episode, over all choices",
                        collisions / static_cast<double>(study.levels().size())),
            collisions == 0.0, "see `collisions` by episode"};
  });
}

}  // namespace

std::vector<Finding> planning_office_findings(const StudyTables& study, double time_limit,
                                              std::optional<double> path_limit) {
  std::vector<Finding> findings{against_greedy(study, "time_to_95_s", time_limit)};
  if (path_limit) findings.push_back(against_greedy(study, "path_to_95_m", *path_limit));
  findings.push_back(near_oracle(study, "time_to_95_s"));
  findings.push_back(ahead_of_peers(study, "time_to_95_s"));
  findings.push_back(calibration_matters(study, "time_to_95_s"));
  findings.push_back(never_touches(study));
  return findings;
}

std::vector<Finding> planning_tabletop_findings(const StudyTables& study) {
  return {against_greedy(study, "path_to_98_m", 0.6),
          held("goal", "`tour` takes no more scans to 98 % than the reference",
               [&]() -> Measured {
                 const double ratio = study.ratio("scans_to_98", kPanel, kTour);
                 return {study.ratio_text("scans_to_98", kPanel, kTour), ratio <= 1.0,
                         "a shorter way is paid for by views that show less"};
               }),
          near_oracle(study, "time_to_98_s"), ahead_of_peers(study, "time_to_98_s"),
          never_touches(study)};
}

}  // namespace vantage::bench
