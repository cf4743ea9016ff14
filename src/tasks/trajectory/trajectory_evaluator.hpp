/// Holds a flight against the truth.
#pragma once

#include "vantage/tasks/trajectory/waypoint_record.hpp"

namespace vantage {

class SimulatedTrajectoryRobot;

/// Whoever decides may hand it a record to fill in, and learns nothing by that.
class TrajectoryEvaluator {
 public:
  /// `robot` must outlive it.
  explicit TrajectoryEvaluator(const SimulatedTrajectoryRobot& robot) : robot_(robot) {}

  /// Fills in what the record says of clearance, tracking, path and contacts so far.
  void measure(WaypointRecord& record) const;

 private:
  const SimulatedTrajectoryRobot& robot_;
};

}  // namespace vantage
