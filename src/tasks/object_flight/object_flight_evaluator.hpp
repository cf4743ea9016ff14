/// Holds what is believed of an object on a table against the truth.
#pragma once

#include <cstddef>

#include "vantage/belief/objects/object_states.hpp"
#include "vantage/tasks/object_flight/observation_record.hpp"

namespace vantage {

class SimulatedOrbitRobot;

/// Whoever decides may hand it a record to fill in, and learns nothing by that.
class ObjectFlightEvaluator {
 public:
  /// `robot`, which knows the truth, must outlive it.
  explicit ObjectFlightEvaluator(const SimulatedOrbitRobot& robot) : robot_(robot) {}

  /// Fills in what the record says of the pose and of the object, held against the truth.
  /// @param object the most probable one
  /// @param state that is estimated
  /// @param target that was looked at, of several
  void measure(const ObjectStates& states, int object, int state, std::size_t target,
               ObservationRecord& record) const;

 private:
  const SimulatedOrbitRobot& robot_;
};

}  // namespace vantage
