// The robot interface of an exploration has no ground truth.
// expected error: no member named .ground_truth.
#include "vantage/tasks/exploration/exploration_robot_interface.hpp"

double what_it_learns(vantage::ExplorationRobotInterface& robot) {
#ifdef USE_TRUTH
  return robot.ground_truth().collisions();
#else
  return robot.time_s();
#endif
}
