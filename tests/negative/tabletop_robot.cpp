// The robot interface of the table-top task has no ground truth.
// expected error: no member named .ground_truth.
#include "vantage/tasks/tabletop/tabletop_robot_interface.hpp"

double what_it_learns(vantage::TabletopRobotInterface& robot) {
#ifdef USE_TRUTH
  return robot.ground_truth().collisions();
#else
  return robot.time_s();
#endif
}
