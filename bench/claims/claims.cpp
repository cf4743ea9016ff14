#include "bench/claims/claims.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <limits>

namespace vantage::bench {
namespace {

/// "objects_4 0.52, objects_8 0.61"
std::string by_panel(const StudySummary& study, const std::string& table,
                     const std::function<double(const std::string&)>& value) {
  std::vector<std::string> parts;
  for (const std::string& panel : study.panels(table)) {
    parts.push_back(fmt::format("{} {:.2f}", panel, value(panel)));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

bool in_every_panel(const StudySummary& study, const std::string& table,
                    const std::function<bool(const std::string&)>& holds) {
  return std::ranges::all_of(study.panels(table), holds);
}

Finding at_most(const std::string& goal, const Json& figures, const char* key, double limit) {
  const double value = figures.at(key).get<double>();
  return {goal, fmt::format("`{}` at most {}", key, limit), fmt::format("{:.4g}", value),
          value <= limit, ""};
}

Finding at_least(const std::string& goal, const Json& figures, const char* key, double limit) {
  const double value = figures.at(key).get<double>();
  return {goal, fmt::format("`{}` at least {}", key, limit), fmt::format("{:.4g}", value),
          value >= limit, ""};
}

constexpr std::string_view kFixed = "beer_lambert";

/// Of the fixed transmissions recorded along the same episodes.
double best_fixed_error(const StudySummary& study, const std::string& panel) {
  double best = std::numeric_limits<double>::infinity();
  for (const std::string& predictor : study.levels("predictors")) {
    if (!predictor.starts_with(kFixed)) continue;
    best = std::min(best, study.mean("predictors", panel, predictor).value_or(best));
  }
  return best;
}

/// The simple features of one view, together.
Finding simple_features(const Json& features) {
  double sum_ms = 0.0;
  for (const char* feature : {"colour_ms", "bbox_ms", "sift_ms", "vfh_ms"}) {
    sum_ms += features.at(feature).get<double>();
  }
  return {"goal", "all simple features of a view at most 25 ms", fmt::format("{:.1f} ms", sum_ms),
          sum_ms <= 25.0, ""};
}

}  // namespace

std::vector<Finding> speed_findings(const Figures& figures) {
  std::vector<Finding> findings;
  if (const auto found = figures.find("decision"); found != figures.end()) {
    const Json& decision = found->second;
    findings.push_back(
        {"Chapter 3", "a decision takes about 30 s; under 10 s is \"a future goal\" (2014 PC)",
         fmt::format("{:.0f} ms for the same 30 views", decision.at("sweep_ms").get<double>()),
         decision.at("sweep_ms").get<double>() < 1e4, ""});
    findings.push_back(at_most("goal", decision, "sweep_ms", 40.0));
    Finding exact = at_least("goal", decision, "exact_over_sweep", 50.0);
    if (!exact.holds) {
      exact.why =
          "the exact evaluator is fast itself: an integer walk on both cores, "
          "`castray_over_sweep / exact_over_sweep` times faster than castRay";
    }
    findings.push_back(exact);
    findings.push_back(at_least("goal", decision, "castray_over_sweep", 1000.0));
    findings.push_back(at_least("goal", decision, "spearman_min", 0.99));
    findings.push_back(at_most("goal", decision, "regret_max", 0.02));
  }
  if (const auto found = figures.find("scaling"); found != figures.end()) {
    findings.push_back(at_most("goal: linear in the cells", found->second, "exponent", 1.05));
  }
  if (const auto found = figures.find("office"); found != figures.end()) {
    findings.push_back(at_most("goal", found->second, "sweep_ms", 150.0));
    findings.back().why =
        "timed on the first map with 30 views: from 111 to 170 ms, by the episode that builds it";
    findings.push_back(at_least("goal", found->second, "spearman_min", 0.99));
    findings.push_back(at_most("goal", found->second, "regret_max", 0.02));
  }
  if (const auto found = figures.find("selection"); found != figures.end()) {
    findings.push_back(at_most("goal", found->second, "mi_ms", 10.0));
    findings.push_back(at_most("goal", found->second, "le_ms", 100.0));
    findings.push_back(at_most("goal", found->second, "jd_ms", 1.0));
  }
  if (const auto found = figures.find("features"); found != figures.end()) {
    findings.push_back(simple_features(found->second));
    findings.push_back(at_most("goal", found->second, "kernel_ms", 200.0));
  }
  if (const auto found = figures.find("trajectory"); found != figures.end()) {
    for (const char* method : {"stomp_ms", "mppi_ms", "cem_ms", "covariant_gradient_ms"}) {
      findings.push_back(at_most("goal", found->second, method, 3.0));
    }
  }
  return findings;
}

std::vector<Finding> tabletop_findings(const StudySummary& study) {
  const auto area = [&](const std::string& panel, const char* level) {
    return study.mean("area", panel, level).value_or(0.0);
  };
  std::vector<Finding> findings;
  findings.push_back(
      {"Fig. 3.10",
       "unobserved cells fall fastest with `probabilistic`, then `simple`, then "
       "`random`, in all four scenes",
       "area of `probabilistic` / `simple`: " +
           by_panel(study, "area",
                    [&](const auto& p) { return area(p, "probabilistic") / area(p, "simple"); }) +
           "; `random` / `simple`: " +
           by_panel(study, "area",
                    [&](const auto& p) { return area(p, "random") / area(p, "simple"); }),
       in_every_panel(study, "area",
                      [&](const auto& p) {
                        return area(p, "probabilistic") < area(p, "simple") &&
                               area(p, "simple") < area(p, "random");
                      }),
       "even the oracle leaves little to win over `simple`: its area is " +
           by_panel(study, "area",
                    [&](const auto& p) { return area(p, "oracle") / area(p, "simple"); }) +
           " of it"});
  findings.push_back(
      {"goal",
       "area of `adaptive` not above `simple`'s beyond its interval, both well below `random`'s",
       fmt::format("random {:.2f}, simple {:.2f}, adaptive {:.2f}, oracle {:.2f}",
                   area("all", "random"), area("all", "simple"), area("all", "adaptive"),
                   area("all", "oracle")),
       !study.above_reference("area", "all", "adaptive") &&
           area("all", "adaptive") < 0.8 * area("all", "random") &&
           area("all", "simple") < 0.8 * area("all", "random"),
       ""});
  return findings;
}

std::vector<Finding> prediction_findings(const StudySummary& study) {
  const auto error = [&](const std::string& panel, const std::string& predictor) {
    return study.mean("predictors", panel, predictor).value_or(0.0);
  };
  const auto to_simple = [&](const std::string& panel, const char* predictor) {
    return error(panel, predictor) / error(panel, "simple");
  };
  std::vector<Finding> findings;
  findings.push_back(
      {"Fig. 3.11",
       "the probabilistic method (a = 0.997) predicts much better than `simple` in "
       "all four scenes",
       "error of `visibility_weighted` / `simple`: " +
           by_panel(study, "predictors",
                    [&](const auto& p) { return to_simple(p, "visibility_weighted"); }),
       in_every_panel(study, "predictors",
                      [&](const auto& p) { return to_simple(p, "visibility_weighted") < 0.7; }),
       "one `a` fits one clutter: with a = 0.997 after N cells the light is a^(1 + 2 + ... + N), "
       "so the prediction falls short where there is little clutter; with another transition "
       "probability, `visibility_weighted a=0.9997`: " +
           by_panel(study, "predictors",
                    [&](const auto& p) { return to_simple(p, "visibility_weighted a=0.9997"); })});
  findings.push_back(
      {"goal",
       "error of `adaptive` at most 0.5 x `simple`'s with 15 and 25 objects, 0.7 x with 8, "
       "1.05 x with 4",
       by_panel(study, "predictors", [&](const auto& p) { return to_simple(p, "adaptive"); }),
       to_simple("objects_4", "adaptive") <= 1.05 && to_simple("objects_8", "adaptive") <= 0.7 &&
           to_simple("objects_15", "adaptive") <= 0.5 && to_simple("objects_25", "adaptive") <= 0.5,
       ""});
  const auto to_best = [&](const std::string& panel) {
    return error(panel, "adaptive") / best_fixed_error(study, panel);
  };
  findings.push_back(
      {"goal",
       "error of `adaptive` at most 1.1 x that of the best fixed `a`, which "
       "differs from scene to scene",
       by_panel(study, "predictors", to_best),
       in_every_panel(study, "predictors", [&](const auto& p) { return to_best(p) <= 1.1; }),
       "the best is picked among those of the study once its errors are known; where there is next "
       "to no clutter a transmission near 1 is ahead of one that is learnt on the run"});
  return findings;
}

namespace {

constexpr const char* kOfficeReference = "adaptive";

/// Area of each method but the reference and the oracle, paired with the reference's.
std::string area_ratios(const StudySummary& study) {
  std::vector<std::string> parts;
  for (const std::string& level : study.levels("area")) {
    const std::string ratio = study.ratio_text("area", "all", level);
    if (!ratio.empty()) parts.push_back(fmt::format("`{}` {}", level, ratio));
  }
  return fmt::format("area in terms of `{}`'s: {}", kOfficeReference, fmt::join(parts, "; "));
}

/// Of the methods that do not know the scene, with 1 for the reference.
double min_area_ratio(const StudySummary& study) {
  double least = 1.0;
  for (const std::string& level : study.levels("area")) {
    if (level == "oracle") continue;
    least = std::min(least, study.ratio("area", "all", level).value_or(1.0));
  }
  return least;
}

/// `above` in terms of `below`, both paired with the reference.
double between(const StudySummary& study, const char* table, const char* above, const char* below) {
  return study.ratio(table, "all", above).value_or(0.0) /
         study.ratio(table, "all", below).value_or(1.0);
}

Finding without_collision(const StudySummary& study) {
  double collisions = 0.0;
  for (const std::string& level : study.levels("collisions")) {
    collisions += study.mean("collisions", "all", level).value_or(0.0);
  }
  return {"goal", "no collision in any episode",
          fmt::format("{:.2f} an episode, over all methods",
                      collisions / static_cast<double>(study.levels("collisions").size())),
          collisions == 0.0, "see `collisions` by episode"};
}

/// Only of methods that have run.
Finding on_par(const StudySummary& study) {
  const auto levels = study.levels("area");
  return {"goal", "`adaptive` on par with or better than every method but the oracle",
          area_ratios(study),
          std::ranges::none_of(levels,
                               [&](const std::string& level) {
                                 return level != "oracle" &&
                                        study.below_reference("area", "all", level);
                               }),
          "an interval below 1 is a method that does better"};
}

}  // namespace

std::vector<Finding> office_findings(const StudySummary& study, const std::string& figure,
                                     const ScansClaimed& claimed) {
  const auto all = [&](const char* table, const char* level) {
    return study.mean(table, "all", level).value_or(0.0);
  };
  const auto was_run = [&](const char* level) {
    return study.mean("area", "all", level).has_value();
  };
  std::vector<Finding> findings;
  constexpr const char* kClaimed = "probabilistic_0.9999";
  if (was_run(kClaimed)) {
    findings.push_back(
        {figure, "a = 0.9999 is on par with or better than all others",
         fmt::format("area {}", study.ratio_text("area", "all", kClaimed)),
         study.ratio("area", "all", kClaimed).value_or(2.0) <= 1.05 * min_area_ratio(study),
         "see the paired differences in the table"});
  }
  const char* const counted = was_run(kClaimed) ? kClaimed : kOfficeReference;
  findings.push_back(
      {figure, fmt::format("it takes {} to {} scans", claimed.fewest, claimed.most),
       fmt::format("`{}`: {:.1f} scans until no view is worth one, {:.1f} until 95 %", counted,
                   all("scans", counted), all("scans_to_95", counted)),
       all("scans", counted) >= claimed.fewest && all("scans", counted) <= claimed.most,
       "other scenes, another sensor and another end"});
  if (was_run("nearest_frontier") && was_run("simple")) {
    findings.push_back(
        {figure, "`nearest_frontier` travels least, but needs about twice the scans",
         fmt::format("in terms of `simple`'s {:.2f} of the way and {:.2f} of the scans to 95 %",
                     between(study, "path_length_m", "nearest_frontier", "simple"),
                     between(study, "scans_to_95", "nearest_frontier", "simple")),
         between(study, "path_length_m", "nearest_frontier", "simple") < 1.0 &&
             between(study, "scans_to_95", "nearest_frontier", "simple") > 1.5,
         "candidates are the same clusters of frontiers for every method"});
  }
  const double least = study.least("observed_share", "all", "adaptive").value_or(0.0);
  findings.push_back({"goal",
                      "`adaptive` observes at least 95 % of the observable cells in every episode",
                      fmt::format("{:.1f} % on average, {:.1f} % at least",
                                  100.0 * all("observed_share", "adaptive"), 100.0 * least),
                      least >= 0.95, "see `observed_share` by episode"});
  findings.push_back(without_collision(study));
  if (study.levels("area").size() > 1) findings.push_back(on_par(study));
  return findings;
}

}  // namespace vantage::bench
