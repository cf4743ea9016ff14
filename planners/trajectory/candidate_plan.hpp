/// Candidate plans of a flight, and what they look at.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

#include "vantage/geometry/pose.hpp"

namespace vantage {

/// What an object is looked at from next.
struct ViewTarget {
  int object = 0;     ///< id of TrackedObject
  int direction = 0;  ///< not used yet
  Eigen::Vector3d p_world_object_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d p_world_view_m = Eigen::Vector3d::Zero();
  double entropy_nats = 0.0;
};

/// The next waypoints as one planner wants them, x, y, z, yaw a column; the first is the one that
/// is flown to already.
struct CandidatePlan {
  std::string planner;
  Eigen::Matrix4Xd points;
  double cost = 0.0;
  bool same_spline = false;  ///< the plan as it is flown, without another spline through it
  /// Least of its spline up to the last of the points, or its end, from the body's centre, by the
  /// map.
  double clearance_m = 0.0;
  bool clear = true;  ///< enough of it
};

}  // namespace vantage
