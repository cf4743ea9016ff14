#include "vantage/tasks/object_flight/object_flight_evaluator.hpp"

#include "vantage/belief/objects/object_belief.hpp"
#include "vantage/tasks/object_flight/simulated_orbit_robot.hpp"

namespace vantage {

void ObjectFlightEvaluator::measure(const ObjectStates& states, int object, int state,
                                    std::size_t target, ObservationRecord& record) const {
  const OrbitGroundTruth truth = robot_.ground_truth(target);
  record.position_error_m = truth.position_error_m;
  record.angle_error_rad = truth.angle_error_rad;
  record.true_yaw_rad = truth.object_angle_rad;
  const int true_bin = states.bin_of_yaw(truth.object_angle_rad);
  record.bin_error = bin_error(states, state, states.state(object, true_bin));
  record.collisions = truth.collisions;
}

}  // namespace vantage
