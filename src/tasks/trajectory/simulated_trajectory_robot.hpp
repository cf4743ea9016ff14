/// The simulated quadrotor that flies along a path.
#pragma once

#include <optional>

#include "vantage/tasks/flight/simulated_quadrotor.hpp"
#include "vantage/tasks/trajectory/trajectory_flight.hpp"
#include "vantage/tasks/trajectory/trajectory_ground_truth.hpp"
#include "vantage/tasks/trajectory/trajectory_robot_interface.hpp"
#include "vantage/tasks/trajectory/true_clearance.hpp"

namespace vantage {

class SimulatedTrajectoryRobot : public TrajectoryRobotInterface {
 public:
  /// Hovers where `start` is.
  /// @throws ConfigError or InputError if the episode cannot begin, RendererError
  SimulatedTrajectoryRobot(const EpisodeSetup& setup, const ModelSource& source,
                           const TrajectoryFlight& task, const FlightWaypoint& start);

  [[nodiscard]] double time_s() const override { return quadrotor_.world().time_s(); }
  void follow(std::span<const FlightWaypoint> waypoints) override;
  void fly_for(double duration_s, const ImageCallback& on_image) override;
  void fly_past(int waypoints, const ImageCallback& on_image) override;
  [[nodiscard]] MinimumJerkTrajectory path_in(
      double delay_s, std::span<const FlightWaypoint> waypoints) const override;
  [[nodiscard]] std::optional<MinimumJerkTrajectory> path_on(double delay_s) const override;
  using TrajectoryRobotInterface::passed;
  [[nodiscard]] int passed(double in_s) const override;
  void capture_now(const ImageCallback& on_image) override;
  [[nodiscard]] Pose estimated_body() const override { return quadrotor_.estimated_body(); }
  [[nodiscard]] Pose T_body_camera() const override { return quadrotor_.T_body_camera(); }

  [[nodiscard]] TrajectoryGroundTruth ground_truth() const;
  SimulatedQuadrotor& quadrotor() { return quadrotor_; }

 private:
  void tick();

  FlightLimits limits_;
  double image_period_s_;
  SimulatedQuadrotor quadrotor_;
  TrueClearance clearance_;
  Rng depth_noise_;
  Rng colour_noise_;
  std::optional<MinimumJerkTrajectory> path_;
  double path_start_s_ = 0.0;
  double next_image_s_ = 0.0;
  double next_clearance_s_ = 0.0;
  double flown_s_ = 0.0;
  double error_m_s_ = 0.0;
  double error_max_m_ = 0.0;
  double energy_j_ = 0.0;
  double flown_m_ = 0.0;
};

}  // namespace vantage
