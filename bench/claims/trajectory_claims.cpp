#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "bench/claims/claims.hpp"

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

class FlightStudy {
 public:
  explicit FlightStudy(const StudySummary& study) : study_(study) {}

  [[nodiscard]] double mean(const char* table, const std::string& panel, const char* level) const {
    return study_.mean(table, panel, level).value_or(0.0);
  }
  /// "trajectory_1 60.0 to 96.0": from `initial` to `stomp`.
  [[nodiscard]] std::string from_to(const char* table, double scale, int digits) const {
    std::vector<std::string> parts;
    for (const std::string& panel : study_.panels(table)) {
      parts.push_back(fmt::format("{} {:.{}f} to {:.{}f}", panel,
                                  scale * mean(table, panel, "initial"), digits,
                                  scale * mean(table, panel, "stomp"), digits));
    }
    return fmt::format("{}", fmt::join(parts, ", "));
  }
  [[nodiscard]] bool everywhere(const char* table, auto&& holds) const {
    return std::ranges::all_of(study_.panels(table), holds);
  }
  [[nodiscard]] Finding against(const char* level) const {
    const std::string claim =
        fmt::format("the difference of `stomp` to `{}` is told, whatever it is", level);
    if (!study_.mean("accuracy", "all", level)) return {"goal", claim, "", false, "not flown yet"};
    return {"goal", claim,
            fmt::format("accuracy {} points, mean entropy {} nats, observations {}; {} pairs",
                        study_.less_text("accuracy", "all", level, 100.0, 1),
                        study_.less_text("mean_entropy_nats", "all", level, 1.0, 3),
                        study_.less_text("observations", "all", level, 1.0, 1),
                        study_.pairs("accuracy", "all", level)),
            true, ""};
  }

 private:
  const StudySummary& study_;
};

Finding accuracy_goal(const FlightStudy& study) {
  const auto rises = [&](const std::string& panel) {
    const double initial = study.mean("accuracy", panel, "initial");
    const double stomp = study.mean("accuracy", panel, "stomp");
    return stomp >= initial + 0.15 || stomp >= 0.95;
  };
  return {"goal", "`stomp` recognises at least 15 points more than `initial`, or 95 %, everywhere",
          study.from_to("accuracy", 100.0, 1), study.everywhere("accuracy", rises),
          "what is mistaken are near twins of one size that differ by a shade"};
}

Finding published_gain(const FlightStudy& study) {
  std::string published;
  for (const Published& p : kPublished) {
    published +=
        fmt::format("{}{} {} to {} %, {} to {} nats", published.empty() ? "" : ", ", p.panel,
                    p.initial_percent, p.optimised_percent, p.initial_nats, p.optimised_nats);
  }
  const auto both = [&](const std::string& panel) {
    return study.mean("accuracy", panel, "stomp") > study.mean("accuracy", panel, "initial") &&
           study.mean("mean_entropy_nats", panel, "stomp") <
               study.mean("mean_entropy_nats", panel, "initial");
  };
  return {
      "Tables 5.1-5.3", "optimised trajectories recognise more, at less entropy: " + published,
      study.from_to("accuracy", 100.0, 1) + " %; " + study.from_to("mean_entropy_nats", 1.0, 2) +
          " nats",
      study.everywhere("accuracy", both),
      "where the given path comes by every stand two to four times, as in trajectory_1, it tells "
      "as much; what either gets wrong are near twins"};
}

}  // namespace

std::vector<Finding> trajectory_findings(const StudySummary& summary) {
  for (const char* level : {"initial", "stomp"}) {
    if (summary.mean("accuracy", "all", level)) continue;
    return {{"goal", fmt::format("the flights of `{}`", level), "", false, "not flown yet"}};
  }
  const FlightStudy study(summary);
  const auto stomp = [&](const char* table, const std::string& panel) {
    return study.mean(table, panel, "stomp");
  };
  std::vector<Finding> findings{published_gain(study), accuracy_goal(study)};
  findings.push_back({"goal", "its mean entropy is at most half of `initial`'s, everywhere",
                      study.from_to("mean_entropy_nats", 1.0, 3),
                      study.everywhere("mean_entropy_nats",
                                       [&](const std::string& p) {
                                         return stomp("mean_entropy_nats", p) <=
                                                0.5 * study.mean("mean_entropy_nats", p, "initial");
                                       }),
                      "where the given path sees every object, stomp stops looking at twins that "
                      "further looks are not expected to tell apart"});
  findings.push_back({"goal", "with no more observations, everywhere",
                      study.from_to("observations", 1.0, 1),
                      study.everywhere("observations",
                                       [&](const std::string& p) {
                                         return stomp("observations", p) <=
                                                study.mean("observations", p, "initial");
                                       }),
                      "what `initial` flies past without seeing it whole costs it no observation"});
  findings.push_back({"goal", "no collision in any flight of `stomp`",
                      fmt::format("share of flights {:.3f}", stomp("collided", "all")),
                      stomp("collided", "all") == 0.0, "see `collided`"});
  const double min_m = summary.least("minimum_clearance_m", "all", "stomp").value_or(0.0);
  findings.push_back({"goal", "`stomp` comes no nearer to anything than 0.3 m, in any flight",
                      fmt::format("least {:.2f} m; mean of a flight's least {}", min_m,
                                  study.from_to("minimum_clearance_m", 1.0, 2)),
                      min_m >= 0.3, "see `minimum_clearance_m` by episode"});
  findings.push_back({"goal", "mean tracking error at most 0.05 m",
                      fmt::format("{:.4f} m", stomp("tracking_error_m", "all")),
                      stomp("tracking_error_m", "all") <= 0.05, ""});
  findings.push_back({"goal", "replans never miss the next waypoint",
                      fmt::format("{:.2f} a flight", stomp("missed_deadlines", "all")),
                      stomp("missed_deadlines", "all") == 0.0, ""});
  for (const char* level : {"initial", "initial_stopping", "initial_yaw", "greedy_detour"}) {
    findings.push_back(study.against(level));
  }
  return findings;
}

}  // namespace vantage::bench
