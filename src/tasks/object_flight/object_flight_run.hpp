/// Runs the parts of a flight round an object and writes what they come to.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <functional>

#include "vantage/tasks/object_flight/object_flight_parts.hpp"
#include "vantage/tasks/object_flight/simulated_orbit_robot.hpp"

namespace vantage {

RecordedRobot recorded(SimulatedOrbitRobot& robot);

/// @param add_metrics adds what the task measured
RunOutcome run_object_flight(EpisodeRun& run, SimulatedOrbitRobot& robot,
                             ObjectFlightRecorder& recorder, ObjectFlightParts& parts,
                             const std::function<void(nlohmann::ordered_json&)>& add_metrics);

}  // namespace vantage
