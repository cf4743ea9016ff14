/// The right half of the video of recognition: what the robot sees, believes and where it goes.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include <span>
#include <string>
#include <vector>

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/belief/objects/object_belief.hpp"
#include "vantage/geometry/range_scan.hpp"
#include "vantage/perception/object_view.hpp"
#include "vantage/planners/objects/orbit.hpp"
#include "vantage/tasks/object_flight/observation_record.hpp"

namespace vantage {

struct RecognitionPanelInput {
  std::span<const ObservationRecord> observation_records;
  Orbit orbit;                                 ///< of the camera
  std::vector<double> bearings_rad = {};       ///< to choose from
  double goal_rad = 0.0;                       ///< bearing it is at or flies to
  Pose T_world_body = Pose::Identity();        ///< as estimated
  const CameraImages* camera_image = nullptr;  ///< the last one; null or empty: none yet
  const ObjectView* cut = nullptr;             ///< the object in it; null: not found
  std::vector<std::string> objects = {};       ///< of the model, and unknown if it tells that
  Eigen::VectorXd p_object = {};               ///< of each
  std::string expected = {};  ///< what the map says is there; empty: it says nothing
  double threshold = 0.0;     ///< of P(u), above which it is changed
  std::string method = {};
  std::vector<Eigen::Vector3d> targets_m = {};  ///< on the table, as the robot is told
  std::size_t target = 0;                       ///< that is looked at
  const OccupancyGrid* map = nullptr;           ///< of the table; null: none is kept
  std::vector<double> visible = {};  ///< of each bearing, share of the target; empty: no map

  void set_belief(const ObjectStates& states, const ObjectBelief& belief);
};

/// A dark panel of `size`: image with the object's outline, most probable objects, entropy over
/// views, and the places round the object seen from above. Deterministic.
/// @return CV_8UC3, BGR
cv::Mat draw_recognition_panel(const RecognitionPanelInput& input, cv::Size size);

/// The image, the mask's outline drawn round the object if there is one.
/// @return CV_8UC3, BGR
cv::Mat outlined(const CameraImages& camera_image, const ObjectView* cut);

}  // namespace vantage
