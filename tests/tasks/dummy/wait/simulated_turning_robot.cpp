#include "vantage/tasks/wait/simulated_turning_robot.hpp"

#include <cmath>

#include "vantage/runtime/interrupt.hpp"
#include "vantage/sim/sensors/laser.hpp"

namespace vantage {

SimulatedTurningRobot::SimulatedTurningRobot(const EpisodeSetup& setup, const Wait& task)
    : task_(task),
      world_(task.model_source(setup), setup.options.simulation),
      robot_(world_.model(), mobile_base_of(setup.robot, "robot.model"), setup.options.robot.model),
      geometry_(world_.model(), world_.snapshot()),
      scanner_noise_(Rng::stream(setup.options.seed, "base scanner")) {
  const auto [x_m, y_m, yaw_rad] = setup.options.robot.posed_start();
  estimated_base_ = {x_m, y_m, yaw_rad};
  robot_.place(world_, estimated_base_);
  world_.on_step = [this](const World& world) { collisions_.update(robot_, world); };
}

PlanarScan SimulatedTurningRobot::observe() {
  geometry_.update(world_.snapshot());
  return planar_scan(geometry_, robot_.T_world_base_scan(world_), robot_.T_base_base_scan(),
                     robot_.base_scan_body_id(), task_.base_scanner, scanner_noise_);
}

void SimulatedTurningRobot::turn(double rate_rad_s) {
  robot_.command_twist(world_, {.wz_rad_s = rate_rad_s});
  const double period_s = world_.options().control_period_s;
  for (long tick = std::lround(task_.turning_time_s / period_s); tick > 0; --tick) {
    throw_if_interrupted();
    world_.advance_tick();
    estimated_base_.yaw_rad += rate_rad_s * period_s;
  }
}

RecordedRobot SimulatedTurningRobot::recorded() {
  return {world_, [this] { return to_se3(robot_.T_world_base(world_)); },
          [this] { return to_se3(estimated_base_); }};
}

}  // namespace vantage
