#include "vantage/tasks/trajectory/trajectory_evaluator.hpp"

#include "vantage/tasks/trajectory/simulated_trajectory_robot.hpp"

namespace vantage {

void TrajectoryEvaluator::measure(WaypointRecord& record) const {
  const TrajectoryGroundTruth truth = robot_.ground_truth();
  record.clearance_m = truth.minimum_clearance_m;
  record.tracking_error_m = truth.tracking_error_mean_m;
  record.flown_m = truth.flown_m;
  record.collisions = truth.collisions;
}

}  // namespace vantage
