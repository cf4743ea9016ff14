#include "bench/pages/study_parts.hpp"

#include <nlohmann/json.hpp>

namespace vantage::bench {

const std::vector<StudyPart>& study_parts() {
  static const std::vector<std::string> tables = {
      "area",           "area_from_scan_2", "scans_to_95", "scans",
      "observed_share", "path_length_m",    "collisions",  "prediction_error_cells",
      "forecast_ratio", "predictors"};
  static const std::vector<std::string> office_tables = [] {
    std::vector<std::string> more = tables;
    more.insert(more.end() - 1,
                {"forecast_ratio_to_1_m", "forecast_ratio_to_2_m", "forecast_ratio_to_3_m",
                 "forecast_ratio_beyond_3_m", "outside_share"});
    return more;
  }();
  static const std::vector<std::string> planning_tables = {
      "time_to_80_s",   "time_to_90_s",       "time_to_95_s", "time_to_97_s",
      "path_to_95_m",   "scans_to_95",        "reached_95",   "area_over_time",
      "observed_share", "worst_pose_error_m", "precision",    "collisions"};
  static const std::vector<StudyPart> parts = {
      {"tabletop", "Worktops (Fig. 3.10)", tables, tabletop_findings},
      {"tabletop_predictors",
       "Predictions on worktops (Fig. 3.11)",
       {"predictors"},
       prediction_findings},
      {"office_small", "Small office (Fig. 3.15)", office_tables,
       [](const StudyTables& study) {
         return office_findings(study, "Fig. 3.15", {20, 25});
       }},
      {"office_large", "Large office (Fig. 3.16)", office_tables,
       [](const StudyTables& study) {
         return office_findings(study, "Fig. 3.16", {60, 70});
       }},
      {"planning_tabletop",
       "Planning ahead round worktops",
       {"time_to_98_s", "path_to_98_m", "scans_to_98", "area_over_time", "observed_share",
        "collisions"},
       planning_tabletop_findings,
       true},
      {"planning_office_small", "Planning ahead in a small office", planning_tables,
       [](const StudyTables& study) { return planning_office_findings(study, 0.92, std::nullopt); },
       true},
      {"planning_office_large", "Planning ahead in a large office", planning_tables,
       [](const StudyTables& study) { return planning_office_findings(study, 0.80, 0.65); }, true},
      {"honest_stop",
       "An honest stop",
       {"observed_share", "reached_95", "scans", "scans_to_95", "simulated_time_s",
        "stop_confidence", "collisions"},
       stop_findings},
      {"budgets",
       "Back in time",
       {"budget_kept", "observed_share", "scans", "simulated_time_s", "path_length_m",
        "worst_pose_error_m", "collisions"},
       budget_findings},
      {"buildings",
       "Narrow doors, and corridors that go round",
       {"observed_share", "time_to_95_s", "path_to_95_m", "worst_pose_error_m", "precision",
        "collisions"},
       building_findings},
      {"recognition_flight",
       "Recognition on the quadrotor (4.5.7): it measures flying, not choices of views",
       {"correct", "category_correct", "views", "bin_error", "path_length_m", "collisions"},
       flight_recognition_findings},
      {"recognition_clutter",
       "Recognition among others on a table (chapters 3 and 4 as one)",
       {"targets_correct", "category_correct", "views", "hidden_views", "seen_share",
        "simulated_time_s", "path_length_m", "collisions"},
       clutter_findings},
      {"change_flight",
       "Change detection on the quadrotor (Table 4.16)",
       {"changed_correct", "correct", "views", "collisions"},
       flight_change_findings},
      {"trajectory",
       "Trajectories for recognition (tables 5.1-5.3)",
       {"accuracy", "observations", "mean_entropy_observed_nats", "objects_unseen",
        "mean_entropy_nats", "flight_time_s", "path_length_m", "minimum_clearance_m", "collided",
        "tracking_error_m", "replan_time_s", "energy_j"},
       trajectory_findings},
      {"faults_tabletop",
       "Faults of a robot at worktops",
       {"observed_share", "area", "precision", "recall", "pose_error_m", "worst_pose_error_m",
        "map_in_doubt", "path_length_m", "collisions"},
       mapping_fault_findings},
      {"faults_office",
       "Faults of a robot that explores small offices",
       {"observed_share", "area", "scans", "precision", "recall", "worst_pose_error_m",
        "map_in_doubt", "path_length_m", "collisions"},
       mapping_fault_findings},
      {"faults_recognition",
       "Faults of a quadrotor that recognises an object",
       {"correct", "category_correct", "map_probability", "entropy_bits", "views",
        "view_position_error_m", "simulated_time_s", "collisions"},
       recognition_fault_findings},
      {"faults_trajectory",
       "Faults of a quadrotor along a path",
       {"accuracy", "observations", "objects_found", "false_objects", "mean_entropy_nats",
        "minimum_clearance_m", "tracking_error_m", "flight_time_s", "collisions"},
       trajectory_fault_findings}};
  return parts;
}

}  // namespace vantage::bench
