// The evaluator of a flight round an object keeps the robot that knows the truth.
// expected error: is private within this context|is a private member
#include "vantage/tasks/object_flight/object_flight_evaluator.hpp"

double what_it_learns([[maybe_unused]] const vantage::ObjectFlightEvaluator& evaluator,
                      vantage::ObservationRecord& record, const vantage::ObjectStates& states) {
#ifdef USE_TRUTH
  return evaluator.robot_.ground_truth(0).object_angle_rad;
#else
  evaluator.measure(states, 0, 0, 0, record);
  return record.time_s;
#endif
}
