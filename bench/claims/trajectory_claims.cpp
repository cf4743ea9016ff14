// Of flights along a path: chapter 5, and the goals of this project.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <functional>

#include "bench/claims/claims.hpp"
#include "bench/tables/paired_difference.hpp"

namespace vantage::bench {
namespace {

/// What the dissertation measured, by scenario.  [Potthast2016, tables 5.1-5.3]
struct Published {
  const char* panel;
  double initial_percent;
  double optimised_percent;
  double initial_nats;
  double optimised_nats;
};
constexpr Published kPublished[] = {{"trajectory_1", 72.0, 92.0, 0.26, 0.12},
                                    {"trajectory_2", 61.4, 94.3, 0.28, 0.10},
                                    {"trajectory_3", 69.0, 93.0, 0.27, 0.11},
                                    {"trajectory_4", 74.3, 90.0, 0.27, 0.13}};

/// Of the objects observed: one that never was has the prior's entropy, and is counted apart.
constexpr auto kEntropy = "mean_entropy_observed_nats";
constexpr auto kUnseen = "objects_unseen";

double initial(const StudyTables& study, const char* table, const std::string& panel) {
  return study.mean(table, panel, "initial");
}
double stomp(const StudyTables& study, const char* table, const std::string& panel) {
  return study.mean(table, panel, "stomp");
}

/// "trajectory_1 +19.5 [14.7, 24.6]": of `stomp` less `initial`.
std::string differences(const StudyTables& study, const char* table, double scale, int digits) {
  std::vector<std::string> parts;
  for (const Published& p : kPublished) {
    const Difference of = study.difference(table, p.panel, "stomp", "initial");
    parts.push_back(fmt::format("{} {:+.{}f} [{:+.{}f}, {:+.{}f}]", p.panel, scale * of.mean,
                                digits, scale * of.interval.low, digits, scale * of.interval.high,
                                digits));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// "trajectory_1 60.0 to 96.0": from `initial` to `stomp`.
std::string from_to(const StudyTables& study, const char* table, double scale, int digits) {
  std::vector<std::string> parts;
  for (const Published& p : kPublished) {
    parts.push_back(fmt::format("{} {:.{}f} to {:.{}f}", p.panel,
                                scale * initial(study, table, p.panel), digits,
                                scale * stomp(study, table, p.panel), digits));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

using HoldsIn = std::function<bool(const std::string& panel)>;

/// All are asked: a number that is missing is missed wherever it stands.
std::vector<std::string> where_not(const HoldsIn& holds) {
  std::vector<std::string> panels;
  for (const Published& p : kPublished) {
    if (!holds(p.panel)) panels.emplace_back(p.panel);
  }
  return panels;
}

bool everywhere(const HoldsIn& holds) { return where_not(holds).empty(); }

/// "not in trajectory_2, trajectory_4"
std::string not_in(const HoldsIn& holds) {
  return fmt::format("not in {}", fmt::join(where_not(holds), ", "));
}

Finding published_gain(const StudyTables& study) {
  std::vector<std::string> published;
  for (const Published& p : kPublished) {
    published.push_back(fmt::format("{} {} to {} %, {} to {} nats", p.panel, p.initial_percent,
                                    p.optimised_percent, p.initial_nats, p.optimised_nats));
  }
  return held(
      "Tables 5.1-5.3",
      fmt::format("optimised trajectories recognise more, at less entropy, beyond the intervals, p "
                  "< {}: {}",
                  kSignificant, fmt::join(published, ", ")),
      [&]() -> Measured {
        const HoldsIn more = [&](const std::string& panel) {
          return is_above(study.difference("accuracy", panel, "stomp", "initial"));
        };
        const HoldsIn surer = [&](const std::string& panel) {
          return is_below(study.difference(kEntropy, panel, "stomp", "initial"));
        };
        return {
            from_to(study, "accuracy", 100.0, 1) + " %; " + from_to(study, kEntropy, 1.0, 2) +
                " nats of the objects observed<br>points " +
                differences(study, "accuracy", 100.0, 1) + "; nats " +
                differences(study, kEntropy, 1.0, 3),
            everywhere(more) && everywhere(surer),
            fmt::format("points {}; nats {}: ten trials, what is left wrong are near-duplicates, "
                        "and objects that `initial` never sees have no entropy here",
                        everywhere(more) ? "everywhere" : not_in(more),
                        everywhere(surer) ? "everywhere" : not_in(surer))};
      });
}

Finding accuracy_goal(const StudyTables& study) {
  return held("goal",
              "`stomp` recognises at least 15 points more than `initial`, or 95 %, everywhere",
              [&]() -> Measured {
                const HoldsIn holds = [&](const std::string& panel) {
                  const double before = initial(study, "accuracy", panel);
                  const double after = stomp(study, "accuracy", panel);
                  return after >= before + 0.15 || after >= 0.95;
                };
                return {from_to(study, "accuracy", 100.0, 1), everywhere(holds),
                        not_in(holds) +
                            ": what is mistaken are near-duplicates of one size that differ by "
                            "a shade"};
              });
}

Finding entropy_goal(const StudyTables& study) {
  return held(
      "goal",
      "the mean entropy of the objects it observed is at most half of `initial`'s, and no "
      "more are unseen, everywhere",
      [&]() -> Measured {
        const HoldsIn holds = [&](const std::string& panel) {
          return stomp(study, kEntropy, panel) <= 0.5 * initial(study, kEntropy, panel) &&
                 stomp(study, kUnseen, panel) <= initial(study, kUnseen, panel);
        };
        return {
            from_to(study, kEntropy, 1.0, 3) + " nats; unseen " + from_to(study, kUnseen, 1.0, 1),
            everywhere(holds),
            not_in(holds) +
                ": `initial` misses the objects that are hard to see, and `stomp` stops "
                "looking at near-duplicates that further looks are not expected to "
                "tell apart"};
      });
}

Finding observations_goal(const StudyTables& study) {
  return held("goal", "with no more observations, everywhere", [&]() -> Measured {
    std::vector<std::string> stopping;
    for (const Published& p : kPublished) {
      stopping.push_back(
          fmt::format("{:.1f}", study.mean("observations", p.panel, "initial_stopping")));
    }
    return {fmt::format("{}; `initial_stopping`, which observes by the same rules as `stomp`, {}",
                        from_to(study, "observations", 1.0, 1), fmt::join(stopping, ", ")),
            everywhere([&](const std::string& panel) {
              return stomp(study, "observations", panel) <= initial(study, "observations", panel);
            }),
            "what `initial` flies past without seeing it whole costs it no observation"};
  });
}

/// Turning round alone is in the power of a path that is given.
Finding beyond_turning(const StudyTables& study) {
  return held(
      "goal",
      fmt::format(
          "it is the path and not the heading: `stomp` recognises more than `initial_yaw`, "
          "which keeps the given path and turns to the nearest object, beyond the interval, "
          "p < {}",
          kSignificant),
      [&]() -> Measured {
        const Difference points = study.difference("accuracy", kAllPanels, "stomp", "initial_yaw");
        const Difference nats = study.difference(kEntropy, kAllPanels, "stomp", "initial_yaw");
        return {fmt::format("{:+.1f} points [{:+.1f}, {:+.1f}], p {:.2g}; {:+.3f} nats [{:+.3f}, "
                            "{:+.3f}], p {:.2g}",
                            100.0 * points.mean, 100.0 * points.interval.low,
                            100.0 * points.interval.high, points.p_value, nats.mean,
                            nats.interval.low, nats.interval.high, nats.p_value),
                is_above(points),
                "most of what is won over `initial` is won by turning to what is near"};
      });
}

Finding clearance_goal(const StudyTables& study) {
  return held("goal", "`stomp` comes no nearer to anything than 0.3 m, in any flight",
              [&]() -> Measured {
                const double min_m = study.least("minimum_clearance_m", kAllPanels, "stomp");
                return {fmt::format("least {:.2f} m; mean of a flight's least {}", min_m,
                                    from_to(study, "minimum_clearance_m", 1.0, 2)),
                        min_m >= 0.3, "see `minimum_clearance_m` by episode"};
              });
}

/// Of all flights of `stomp`.
Finding at_most(const StudyTables& study, const char* claim, const char* table, double limit,
                const char* unit) {
  return held("goal", claim, [&]() -> Measured {
    const double value = stomp(study, table, kAllPanels);
    return {fmt::format("{:.4g} {}", value, unit), value <= limit,
            fmt::format("see `{}` by episode", table)};
  });
}

}  // namespace

std::vector<Finding> trajectory_findings(const StudyTables& study) {
  return {
      published_gain(study),
      accuracy_goal(study),
      entropy_goal(study),
      observations_goal(study),
      beyond_turning(study),
      at_most(study, "no collision in any flight of `stomp`", "collided", 0.0, "of the flights"),
      clearance_goal(study),
      at_most(study, "mean tracking error at most 0.05 m", "tracking_error_m", 0.05, "m"),
      at_most(study, "replans never miss the next waypoint", "missed_deadlines", 0.0, "a flight")};
}

}  // namespace vantage::bench
