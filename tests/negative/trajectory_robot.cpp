// The robot interface of a flight along waypoints has no ground truth.
// expected error: no member named .ground_truth.
#include "vantage/tasks/trajectory/trajectory_robot_interface.hpp"

double what_it_learns(vantage::TrajectoryRobotInterface& robot) {
#ifdef USE_TRUTH
  return robot.ground_truth().collisions();
#else
  return robot.time_s();
#endif
}
