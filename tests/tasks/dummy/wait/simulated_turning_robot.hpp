/// The simulated robot of the task `wait`.
#pragma once

#include "vantage/core/rng.hpp"
#include "vantage/runtime/log/run_log.hpp"
#include "vantage/sim/robots/mobile_base.hpp"
#include "vantage/sim/sensors/ray_scene.hpp"
#include "vantage/sim/world/world.hpp"
#include "vantage/tasks/wait/turning_robot_interface.hpp"
#include "vantage/tasks/wait/wait.hpp"

namespace vantage {

class SimulatedTurningRobot : public TurningRobotInterface {
 public:
  /// Stands at `robot.start_pose`. @throws InputError if the model lacks what robot.yaml names
  SimulatedTurningRobot(const EpisodeSetup& setup, const Wait& task);

  [[nodiscard]] double time_s() const override { return world_.time_s(); }
  PlanarScan observe() override;
  void turn(double rate_rad_s) override;

  /// What the recorder follows, the truth among it.
  RecordedRobot recorded();
  [[nodiscard]] int collisions() const { return collisions_.count(); }  ///< truth

 private:
  Wait task_;
  World world_;
  MobileBase robot_;
  RayScene geometry_;
  Pose2 estimated_base_;  ///< as commanded
  CollisionCounter collisions_;
  Rng scanner_noise_;
};

}  // namespace vantage
