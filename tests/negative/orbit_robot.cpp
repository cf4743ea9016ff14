// The robot interface of a flight round an object has no ground truth.
// expected error: no member named .ground_truth.
#include "vantage/tasks/object_flight/orbit_robot_interface.hpp"

double what_it_learns(vantage::OrbitRobotInterface& robot) {
#ifdef USE_TRUTH
  return robot.ground_truth().collisions();
#else
  return robot.time_s();
#endif
}
