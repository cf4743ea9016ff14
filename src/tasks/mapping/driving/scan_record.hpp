/// What is recorded at every scan.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "vantage/planners/candidate.hpp"
#include "vantage/planners/prediction_bands.hpp"
#include "vantage/planners/views/forecast_interval.hpp"

namespace vantage {

/// Cells that `adaptive` said the scan would show, and within what they were to be.
struct ForecastRecord {
  double cells = 0.0;
  CellInterval interval;
};

/// What the robot held for unseen after the scan.
struct LeftRecord {
  double expected_cells = 0.0;  ///< that its candidates show together
  double share = 0.0;           ///< of all that can be seen
  double confidence = 0.0;      ///< that as much has been seen as was asked for
};

struct ScanRecord {
  double time_s = 0.0;  ///< simulated, at the end of the scan
  std::size_t unobserved_cells = 0;
  std::size_t observable_unobserved_cells = 0;
  std::vector<std::pair<std::string, double>> predicted_cells;  ///< per gain, for the view taken
  double actual_new_cells = 0.0;
  std::vector<PredictionBand> by_distance;  ///< the same of `adaptive`, from the pose predicted for
  std::optional<ForecastRecord> forecast;   ///< none of the first scan
  std::optional<LeftRecord> left;           ///< where it was asked whether exploring is done
  double hazard_scale = 1.0;                ///< of the forecasts after this scan
  int chosen_view = -1;                     ///< candidate id; -1: the scan at the start
  std::size_t candidates = 0;
  double plan_time_s = 0.0;    ///< wall, of the decision that led here
  double map_time_s = 0.0;     ///< wall, of registration and map update
  double scan_time_s = 0.0;    ///< simulated
  double scan_share = 1.0;     ///< of a whole scan that was taken
  int images_on_the_way = 0;   ///< that came, while driving there
  double energy_j = 0.0;       ///< used up to here
  double scan_energy_j = 0.0;  ///< of that, by the scan itself
  double path_length_m = 0.0;  ///< truly travelled up to here
  double leg_length_m = 0.0;   ///< of that, since the scan before
  double planned_way_m = 0.0;  ///< to the view, as planned when it was chosen; infinite: none
  double pose_error_m = 0.0;
  double pose_error_before_registration_m = 0.0;  ///< of the wheels alone since the scan before
  double pose_error_tracked_m = 0.0;  ///< of the pose that registration of the scan started from
  double yaw_error_rad = 0.0;
  double pose_error_at_scan_m = 0.0;  ///< before what later loops have corrected
  Pose2 T_true_kept;                  ///< error of the pose that the scan is in the map at
  double pose_sigma_m = 0.0;          ///< of its position, by what all scans say of each other
  std::size_t keyframe = 0;           ///< of the navigator's, at the scan
  double map_sigma_m = 0.0;           ///< how far off the robot believes what it maps to be, RMS
  bool registered = true;
  int unconstrained = 0;  ///< directions of (x, y, yaw) in which the tracked pose was kept
  bool fallback = false;
  int collisions = 0;  ///< up to here
  double precision = 0.0;
  double recall = 0.0;
  Pose2 T_world_base;                      ///< as the robot believes it
  Pose T_world_sensor = Pose::Identity();  ///< as the robot believes it
};

}  // namespace vantage
