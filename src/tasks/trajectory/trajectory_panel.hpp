/// The right half of the video of a trajectory flight: what the camera sees, the path from above,
/// and what is believed of each object.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include <optional>
#include <string>
#include <vector>

#include "vantage/recognition/object_observations.hpp"
#include "vantage/tasks/trajectory/waypoint_record.hpp"

namespace vantage {

struct TrajectoryPanelInput {
  const ObjectObservations& observations;
  const std::vector<Eigen::Vector4d>& nominal;  ///< the path as given
  const std::vector<Eigen::Vector4d>& plan;     ///< as it was flown and will be
  int at = 0;                                   ///< the waypoint reached last
  Pose T_world_body = Pose::Identity();         ///< as estimated
  std::optional<ViewTarget> target = {};
  std::string method = {};
  double range_m = 2.0;         ///< within which looks count
  double half_width_rad = 0.5;  ///< of what the camera sees
};

/// A dark panel of `size`. Deterministic.
/// @param image of the camera on board, CV_8UC3, BGR; empty: none
/// @return CV_8UC3, BGR
cv::Mat draw_trajectory_panel(const TrajectoryPanelInput& input, const cv::Mat& camera_image,
                              cv::Size size);

}  // namespace vantage
