/// The right half of the video: what the robot knows, and what it may look at next.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include <limits>
#include <string>
#include <vector>

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/planners/tours/planned_tour.hpp"

namespace vantage {

struct MapPanelInput {
  const OccupancyGrid* grid = nullptr;   ///< required
  std::vector<Pose> T_world_candidates;  ///< sensor poses, x forward
  std::vector<Pose> T_world_chosen;      ///< sensor poses in order; the last is the current goal
  Pose2 T_world_base;                    ///< where the robot is
  std::vector<Eigen::Vector2d> path_m;   ///< world, where it was
  /// From the goal on, its stops where the sensor is to be; without stops nothing is planned.
  PlannedTour tour;
  std::vector<double> observable_unobserved_cells;  ///< after each scan so far; may hold NaN
  int scans_planned = 0;                            ///< 0: not known in advance
  std::string method;
  double predicted_new_cells = std::numeric_limits<double>::quiet_NaN();  ///< of the last scan
  double actual_new_cells = std::numeric_limits<double>::quiet_NaN();     ///< of the last scan
  double azimuth_rad = -0.9;    ///< of the viewpoint round the map; raise it slowly to turn
  double elevation_rad = 0.72;  ///< of the viewpoint; higher looks more from above
};

/// A dark panel of `size`, drawn at twice its resolution. Deterministic.
/// @return CV_8UC3, BGR
cv::Mat draw_map_panel(const MapPanelInput& input, cv::Size size);

}  // namespace vantage
