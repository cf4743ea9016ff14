/// What is recorded at every waypoint of a flight along a path.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

#include "vantage/geometry/pose.hpp"
#include "vantage/planners/trajectory/candidate_plan.hpp"

namespace vantage {

struct WaypointRecord {
  int waypoint = 0;  ///< of the path, 0 is where it starts
  double time_s = 0.0;
  Pose T_world_body = Pose::Identity();  ///< as estimated, when it was passed
  // The plan that was flown to here; nothing at the first waypoint:
  std::string planner;
  double plan_time_s = 0.0;  ///< measured
  double latency_s = 0.0;    ///< charged
  bool late = false;         ///< measured above charged
  bool missed = false;       ///< one came before the plan
  double cost = 0.0;
  double planned_clearance_m = 0.0;
  std::optional<ViewTarget> target;
  std::vector<Eigen::Vector4d> plan;  ///< from the waypoint on that it was made for
  // What is known:
  int objects = 0;                 ///< found
  int known = 0;                   ///< of those
  int observations = 0;            ///< observations so far
  double mean_entropy_nats = 0.0;  ///< of the objects found
  // Truth:
  double clearance_m = 0.0;       ///< least so far
  double tracking_error_m = 0.0;  ///< mean so far
  double flown_m = 0.0;
  int collisions = 0;
};

}  // namespace vantage
