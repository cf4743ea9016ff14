#include "vantage/tasks/object_flight/object_flight_run.hpp"

namespace vantage {

RecordedRobot recorded(SimulatedOrbitRobot& robot) {
  SimulatedQuadrotor& quadrotor = robot.quadrotor();
  return {quadrotor.world(), [&quadrotor] { return quadrotor.true_body(); },
          [&quadrotor] { return quadrotor.estimated_body(); }, &quadrotor.faults()};
}

RunOutcome run_object_flight(EpisodeRun& run, SimulatedOrbitRobot& robot,
                             ObjectFlightRecorder& recorder, ObjectFlightParts& parts,
                             const std::function<void(nlohmann::ordered_json&)>& add_metrics) {
  run.begin();
  const Ending ending = ending_of([&] { return run_episode(parts); });
  const RunTotals totals{robot.time_s(), robot.ground_truth().collisions};
  return run.finish(ending, totals, recorder, add_metrics);
}

}  // namespace vantage
