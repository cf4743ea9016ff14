/// The parts of the loop for a flight along waypoints that are planned anew at each of them.
/// [Potthast2016, chapter 5]
#pragma once

#include <string>
#include <vector>

#include "vantage/belief/map/flight_map.hpp"
#include "vantage/belief/tracking/object_tracker.hpp"
#include "vantage/planners/trajectory/flight_planner.hpp"
#include "vantage/recognition/observation_buffer.hpp"
#include "vantage/tasks/flight/image_gate.hpp"
#include "vantage/tasks/trajectory/trajectory_evaluator.hpp"
#include "vantage/tasks/trajectory/trajectory_flight.hpp"
#include "vantage/tasks/trajectory/trajectory_recorder.hpp"
#include "vantage/tasks/trajectory/trajectory_robot_interface.hpp"

namespace vantage {

/// What the parts work with; all of it outlives them.
struct TrajectoryContext {
  const EpisodeOptions& options;
  const TrajectoryFlight& task;
  const Recogniser& recogniser;  ///< knows the database
  TrajectoryRobotInterface& robot;
  const TrajectoryEvaluator& evaluator;  ///< asked when recording
  TrajectoryRecorder& recorder;
};

/// A waypoint that was flown to. Images were looked at on the way.
struct WaypointReached {
  int waypoint = 0;
  double time_s = 0.0;
  Pose T_world_body = Pose::Identity();  ///< as estimated
};

class TrajectoryParts {
 public:
  /// @param path as given
  TrajectoryParts(const TrajectoryContext& context, const std::vector<FlightWaypoint>& path);

  WaypointReached observe();
  void update(const WaypointReached& reached);
  void record();
  [[nodiscard]] std::string finished() const;
  std::vector<CandidatePlan> propose();
  void score(std::vector<CandidatePlan>& candidates);
  std::size_t choose(const std::vector<CandidatePlan>& candidates);
  void act(const CandidatePlan& candidate);

  [[nodiscard]] const std::vector<WaypointRecord>& waypoints() const { return records_; }
  [[nodiscard]] const ObjectObservations& observations() const { return observations_; }
  [[nodiscard]] const std::vector<Eigen::Vector4d>& nominal() const { return nominal_; }
  [[nodiscard]] const std::vector<Eigen::Vector4d>& plan() const { return plan_; }
  [[nodiscard]] const FlightMap& map() const { return map_; }

 private:
  void process_image(const FlightImage& taken);
  void buffer_observations(const FlightImage& image, const std::vector<int>& ids,
                           const std::vector<SeenObject>& seen);
  void apply_observations(const std::vector<BufferedObservation>& due);
  [[nodiscard]] std::vector<Eigen::Vector4d> plan_with(const CandidatePlan& candidate,
                                                       int missed) const;
  [[nodiscard]] int at_after(int missed) const;
  [[nodiscard]] std::vector<FlightWaypoint> followed(const std::vector<Eigen::Vector4d>& plan,
                                                     int from) const;
  [[nodiscard]] std::vector<PlannableObject> plannable() const;
  [[nodiscard]] TrajectoryPanelInput panel() const;

  TrajectoryFlight task_;
  TrajectoryRobotInterface& robot_;
  const TrajectoryEvaluator& evaluator_;
  TrajectoryRecorder& recorder_;
  std::vector<Eigen::Vector4d> nominal_;  ///< the path as given
  std::vector<Eigen::Vector4d> plan_;     ///< as it is flown
  FlightMap map_;
  ObjectTracker tracker_;
  ObjectObservations observations_;
  FlightPlanner planner_;
  Rng observation_rng_;
  ObservationBuffer buffer_;
  ImageGate gate_{20};             ///< two seconds among obstacles, at the default rate
  int at_ = -1;                    ///< the waypoint reached last
  double planning_since_s_ = 0.0;  ///< wall
  WaypointRecord current_;         ///< filled in from the decision to the end of its segment
  std::vector<WaypointRecord> records_;
};

}  // namespace vantage
