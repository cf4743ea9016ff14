/// The record of one observation of an object.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vantage/control/tracking_options.hpp"
#include "vantage/recognition/change_detection.hpp"

namespace vantage {

/// A viewpoint to observe from next, and the cost of getting there.
struct BearingOption {
  int id = 0;                ///< bearings count from the one where the episode began
  double bearing_rad = 0.0;  ///< [0, 2 pi), world
  ObjectViewAction action;
  std::size_t target = 0;              ///< that it looks at, of several
  std::vector<Pose> T_world_way = {};  ///< of the camera, to there
};

/// What is believed of a change, after a view.
struct SuspectedChange {
  double probability = 0.0;       ///< P(u)
  Change verdict = Change::none;  ///< if it had to be said then
};

struct ObservationRecord {
  double time_s = 0.0;  ///< simulated, of the image
  int bearing_id = 0;
  std::size_t target = 0;         ///< that it looked at, of several
  double expected_visible = 1.0;  ///< share of the target, when the view was chosen
  double seen_share = 1.0;        ///< of it that is seen, as told from the image
  ViewReport report;
  double gain_bits = 0.0;  ///< expected of the view; 0 of the first and of blind choices
  std::optional<FlightResult> flight;     ///< that led here; none: the episode began here
  int object_px = 0;                      ///< in the mask
  std::string not_segmented;              ///< why there is no mask; empty: there is one
  std::string estimate;                   ///< ObjectEstimate::object
  std::string category;                   ///< of that
  double map_probability = 0.0;           ///< of that
  double unknown_probability = 0.0;       ///< that it is none of the model's objects
  int estimated_bin = 0;                  ///< its yaw as the camera sees it
  std::optional<SuspectedChange> change;  ///< none where none is looked for
  // Truth:
  double position_error_m = 0.0;           ///< camera, from where it was meant to be
  double angle_error_rad = 0.0;            ///< camera, from how it was meant to be turned
  double true_yaw_rad = 0.0;               ///< of the object as the camera sees it, [0, 2 pi)
  int bin_error = 0;                       ///< of `estimated_bin`, the short way round
  int collisions = 0;                      ///< up to here
  double path_length_m = 0.0;              ///< truly flown up to here
  double leg_length_m = 0.0;               ///< of that, since the view before
  Pose T_world_camera = Pose::Identity();  ///< as estimated
};

}  // namespace vantage
