/// The simulated quadrotor that flies round a table.
#pragma once

#include "vantage/sim/world/model_source.hpp"
#include "vantage/tasks/flight/simulated_quadrotor.hpp"
#include "vantage/tasks/object_flight/object_flight.hpp"
#include "vantage/tasks/object_flight/orbit_ground_truth.hpp"
#include "vantage/tasks/object_flight/orbit_robot_interface.hpp"

namespace vantage {

class SimulatedOrbitRobot : public OrbitRobotInterface {
 public:
  /// Hovers at a bearing drawn by the seed.
  /// @param object_yaw_rad truth
  /// @throws ConfigError or InputError if the episode cannot begin, RendererError
  SimulatedOrbitRobot(const EpisodeSetup& setup, const ModelSource& source,
                      const ObjectFlight& task, double object_yaw_rad);

  [[nodiscard]] double time_s() const override { return quadrotor_.world().time_s(); }
  FlightObservation observe() override;
  FlightResult fly_to(double bearing_rad) override;
  [[nodiscard]] FlightPlan plan(double bearing_rad) const override;
  [[nodiscard]] double start_bearing_rad() const override { return start_bearing_rad_; }
  [[nodiscard]] double bearing_rad() const override { return bearing_rad_; }
  [[nodiscard]] Pose estimated_body() const override { return quadrotor_.estimated_body(); }

  [[nodiscard]] OrbitGroundTruth ground_truth() const;
  SimulatedQuadrotor& quadrotor() { return quadrotor_; }

 private:
  void require_untouched(const FlightResult& flight) const;
  [[nodiscard]] FlightWaypoint waypoint(const Pose& T_world_place) const;

  ObjectFlight task_;
  Orbit orbit_;  ///< of the camera
  double start_bearing_rad_;
  double bearing_rad_;
  SimulatedQuadrotor quadrotor_;
  double object_yaw_rad_;  ///< truth
  Rng camera_noise_;
};

}  // namespace vantage
