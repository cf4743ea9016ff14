// Of a quadrotor that looks at objects: chapter 4.5.7 and 4.5.8, and the goals of this project.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <numbers>

#include "bench/claims/claims.hpp"
#include "bench/tables/paired_difference.hpp"

namespace vantage::bench {
namespace {

constexpr auto kMethod = "mutual_information";

double mean_of(const StudyTables& study, const char* table, const std::string& panel) {
  return study.mean(table, panel, kMethod);
}

Finding no_contact(const StudyTables& study) {
  return held("goal", "no contact with anything, whatever chooses the views", [&]() -> Measured {
    double collisions = 0.0;
    for (const std::string& level : study.levels()) {
      collisions = std::max(collisions, study.mean("collisions", kAllPanels, level));
    }
    return {fmt::format("{:.3g} a flight at most", collisions), collisions == 0.0,
            "see `collisions` by episode"};
  });
}

Finding accurate_views(const StudyTables& study) {
  return held("goal",
              "views by mutual information are taken within 5 cm and 3 deg of where they were "
              "meant, on average",
              [&]() -> Measured {
                const double position_m = mean_of(study, "view_position_error_m", kAllPanels);
                const double angle_deg =
                    mean_of(study, "view_angle_error_rad", kAllPanels) * 180.0 / std::numbers::pi;
                return {fmt::format("{:.1f} cm, {:.2f} deg", 100.0 * position_m, angle_deg),
                        position_m <= 0.05 && angle_deg <= 3.0};
              });
}

struct ChangeClaim {
  const char* scenario;
  const char* published;
  double goal;
};

std::string change_measured(const StudyTables& study, const char* scenario) {
  return fmt::format("{:.1f} % in {:.2f} views; which change it was: {:.1f} %",
                     100.0 * mean_of(study, "changed_correct", scenario),
                     mean_of(study, "views", scenario),
                     100.0 * mean_of(study, "correct", scenario));
}

Finding change_told(const StudyTables& study, const ChangeClaim& claim) {
  return held("goal",
              fmt::format("change `{}`, simple features: at least {:.0f} % (table 4.16: {})",
                          claim.scenario, 100.0 * claim.goal, claim.published),
              [&]() -> Measured {
                return {change_measured(study, claim.scenario),
                        mean_of(study, "changed_correct", claim.scenario) >= claim.goal,
                        "see `change_probability`"};
              });
}

/// Of a ball that is turned no view tells.
Finding turn_told(const StudyTables& study) {
  return held("goal",
              "change `pose`, simple features: at least 95 % of the turns that the model can tell "
              "(table 4.16: 99.4 % in 1.3 views)",
              [&]() -> Measured {
                const double detectable = mean_of(study, "detectable", "pose");
                const double told = mean_of(study, "detectable_correct", "pose");
                const auto flights = static_cast<double>(study.planned("pose", kMethod));
                return {fmt::format("{:.1f} % of those that can be told, {:.0f} of {:.0f}; of all "
                                    "turns {}",
                                    100.0 * told / detectable, told * flights, detectable * flights,
                                    change_measured(study, "pose")),
                        detectable > 0.0 && told >= 0.95 * detectable, "see `change_probability`"};
              });
}

Finding every_turn_told(const StudyTables& study) {
  return held("Table 4.16", "change `pose`, simple features: 99.4 % in 1.3 views; of all turns",
              [&]() -> Measured {
                return {change_measured(study, "pose"),
                        mean_of(study, "changed_correct", "pose") >= 0.994,
                        "bowls look the same turned, and a turn less than a bin shows little"};
              });
}

}  // namespace

std::vector<Finding> flight_recognition_findings(const StudyTables& study) {
  return {held("goal; table 4.8, of 310 objects: 96.5 % in 2.0 views, 99.8 % in 1.6 with chosen "
               "features",
               "at least 95 % of the objects recognised, views by mutual information",
               [&]() -> Measured {
                 const double correct = mean_of(study, "correct", kAllPanels);
                 return {fmt::format("{:.1f} % after {:.2f} views, category {:.1f} %",
                                     100.0 * correct, mean_of(study, "views", kAllPanels),
                                     100.0 * mean_of(study, "category_correct", kAllPanels)),
                         correct >= 0.95,
                         "errors are between near-duplicates: see `category_correct`"};
               }),
          no_contact(study), accurate_views(study)};
}

std::vector<Finding> clutter_findings(const StudyTables& study) {
  constexpr auto kByVisibility = "by_visibility";
  const auto is_ahead = [&]() -> Measured {
    const Difference points = study.difference("targets_correct", kAllPanels, kByVisibility);
    const double time = study.ratio("simulated_time_s", kAllPanels, kByVisibility);
    const bool gains = points.mean >= 0.08 && is_above(points);  // of one time limit
    const bool saves = points.mean >= 0.0 && time <= 0.75;
    std::vector<std::string> distances;
    for (const std::string& distance : study.panels()) {
      const Difference of = study.difference("targets_correct", distance, kByVisibility);
      distances.push_back(fmt::format("{} {:+.1f}", distance, 100.0 * of.mean));
    }
    return {
        fmt::format("{:+.1f} points [{:+.1f}, {:+.1f}], {} starts, p {:.2g}, in {:.2f} x the "
                    "time; {}",
                    100.0 * points.mean, 100.0 * points.interval.low, 100.0 * points.interval.high,
                    points.clusters, points.p_value, time, fmt::join(distances, ", ")),
        gains || saves, "see `targets_correct` and `hidden_views` of all methods"};
  };
  const auto beats_nearest = [&]() -> Measured {
    const Difference points =
        study.difference("targets_correct", kAllPanels, kByVisibility, "nearest_free");
    return {fmt::format("{:+.1f} points [{:+.1f}, {:+.1f}], p {:.2g}", 100.0 * points.mean,
                        100.0 * points.interval.low, 100.0 * points.interval.high, points.p_value),
            is_above(points)};
  };
  const auto sees_more = [&]() -> Measured {
    const Difference hidden = study.difference("hidden_views", kAllPanels, kByVisibility);
    return {fmt::format("{:+.2f} a flight [{:+.2f}, {:+.2f}], p {:.2g}", hidden.mean,
                        hidden.interval.low, hidden.interval.high, hidden.p_value),
            is_below(hidden)};
  };
  return {
      held("goal",
           "information times visibility gains 8 points of accuracy over information alone in "
           "the same time limit, or is as accurate in 0.75 x the time",
           is_ahead),
      held("goal",
           "and more than the nearest free view, one object after the other, beyond the interval",
           beats_nearest),
      held("goal", "it takes fewer views in which the object is hidden", sees_more),
      no_contact(study)};
}

std::vector<Finding> flight_change_findings(const StudyTables& study) {
  return {change_told(study, {"none", "98.3 % in 1.2 views", 0.95}),
          change_told(study, {"object", "92.4 % in 1.9 views", 0.85}),
          turn_told(study),
          every_turn_told(study),
          change_told(study, {"removed", "not in the table", 0.95}),
          no_contact(study),
          accurate_views(study)};
}

}  // namespace vantage::bench
