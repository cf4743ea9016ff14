/// The simulated quadrotor that flies round a table.
#pragma once

#include "vantage/sim/world/model_source.hpp"
#include "vantage/tasks/flight/simulated_quadrotor.hpp"
#include "vantage/tasks/object_flight/object_flight.hpp"
#include "vantage/tasks/object_flight/object_on_table.hpp"
#include "vantage/tasks/object_flight/orbit_ground_truth.hpp"
#include "vantage/tasks/object_flight/orbit_robot_interface.hpp"

namespace vantage {

class SimulatedOrbitRobot : public OrbitRobotInterface {
 public:
  /// Hovers at a bearing drawn by the seed.
  /// @param objects truth: what it looks at, the first of it at the start
  /// @throws ConfigError or InputError if the episode cannot begin, RendererError
  SimulatedOrbitRobot(const EpisodeSetup& setup, const ModelSource& source,
                      const ObjectFlight& task, std::span<const ObjectOnTable> objects);

  [[nodiscard]] double time_s() const override { return quadrotor_.world().time_s(); }
  FlightObservation observe() override;
  FlightResult fly_along(std::span<const Pose> T_world_places) override;
  [[nodiscard]] FlightPlan plan(std::span<const Pose> T_world_places) const override;
  [[nodiscard]] double start_bearing_rad() const override { return start_bearing_rad_; }
  [[nodiscard]] Pose estimated_body() const override { return quadrotor_.estimated_body(); }

  /// @param object it looks at
  [[nodiscard]] OrbitGroundTruth ground_truth(std::size_t object = 0) const;
  SimulatedQuadrotor& quadrotor() { return quadrotor_; }

 private:
  void require_untouched(const FlightResult& flight) const;
  [[nodiscard]] FlightWaypoint waypoint(const Pose& T_world_place) const;

  struct Object {
    Orbit orbit;  ///< of the camera, round where it is told to be
    // Truth:
    Eigen::Vector3d p_world_m;
    double yaw_rad = 0.0;
  };
  static std::vector<Object> objects_of(const ObjectFlight& task,
                                        std::span<const ObjectOnTable> objects);

  ObjectFlight task_;
  std::vector<Object> objects_;
  double start_bearing_rad_;
  Pose T_world_place_;  ///< of the camera, flown to last
  SimulatedQuadrotor quadrotor_;
  Rng camera_noise_;
};

}  // namespace vantage
