#include "vantage/tasks/trajectory/simulated_trajectory_robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "vantage/runtime/episode_loop.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/sim/faults/fault_schedule.hpp"

namespace vantage {
namespace {

/// Between measurements of the true clearance.
constexpr double kClearanceEvery_s = 0.1;

Quadrotor hovering(World& world, const RobotFolder& robot, const FlightWaypoint& start,
                   double camera_pitch_rad) {
  Quadrotor vehicle(world.model(), quadrotor_of(robot, "robot.model"), robot.description.string(),
                    world.source().scene.string());
  vehicle.place(world, make_pose(start.p_world_m, start.yaw_rad), camera_pitch_rad);
  return vehicle;
}

}  // namespace

SimulatedTrajectoryRobot::SimulatedTrajectoryRobot(const EpisodeSetup& setup,
                                                   const ModelSource& source,
                                                   const TrajectoryFlight& task,
                                                   const FlightWaypoint& start)
    : limits_(task.tracking.limits),
      image_period_s_(1.0 / task.image_rate_hz),
      quadrotor_(
          setup.options, source, task.tracking, {task.camera, task.exposure, task.colour_noise},
          [&](World& world) { return hovering(world, setup.robot, start, task.camera_pitch_rad); }),
      clearance_(quadrotor_.world()),
      depth_noise_(Rng::stream(setup.options.seed, "camera")),
      colour_noise_(Rng::stream(setup.options.seed, "colour")) {
  clearance_.update(quadrotor_.world());
}

void SimulatedTrajectoryRobot::follow(std::span<const FlightWaypoint> waypoints) {
  path_.emplace(quadrotor_.tracking().reference(), waypoints, limits_);
  path_start_s_ = time_s();
}

void SimulatedTrajectoryRobot::fly_for(double duration_s, const ImageCallback& on_image) {
  const double end_s = time_s() + duration_s;
  while (time_s() < end_s - kSameMoment_s) {
    throw_if_interrupted();
    tick();
    if (time_s() >= next_image_s_ - kSameMoment_s) capture_now(on_image);
  }
}

void SimulatedTrajectoryRobot::fly_past(int waypoints, const ImageCallback& on_image) {
  expects(path_.has_value(), "a plan to follow");
  const auto last = path_->knots_s().size() - 1;
  const auto goal = std::min(last, static_cast<std::size_t>(passed() + waypoints));
  fly_for(path_start_s_ + path_->knots_s()[goal] - time_s(), on_image);
}

MinimumJerkTrajectory SimulatedTrajectoryRobot::path_in(
    double delay_s, std::span<const FlightWaypoint> waypoints) const {
  const FlightReference from =
      path_ ? path_->at(time_s() - path_start_s_ + delay_s) : quadrotor_.tracking().reference();
  return {from, waypoints, limits_};
}

std::optional<MinimumJerkTrajectory> SimulatedTrajectoryRobot::path_on(double delay_s) const {
  constexpr std::size_t kMinWaypoints = 3;  // it is at rest at the last
  if (!path_) return std::nullopt;
  const std::size_t waypoints = path_->knots_s().size() - 1;
  if (waypoints < static_cast<std::size_t>(passed(delay_s)) + kMinWaypoints) return std::nullopt;
  return path_->from(time_s() - path_start_s_ + delay_s);
}

int SimulatedTrajectoryRobot::passed(double in_s) const {
  if (!path_) return 0;
  const double since_s = time_s() - path_start_s_ + in_s + kSameMoment_s;
  const auto& knots_s = path_->knots_s();
  return static_cast<int>(std::upper_bound(knots_s.begin() + 1, knots_s.end(), since_s) -
                          (knots_s.begin() + 1));
}

void SimulatedTrajectoryRobot::tick() {
  const double period_s = quadrotor_.world().options().control_period_s;
  const Eigen::Vector3d before_m = quadrotor_.true_body().translation();
  quadrotor_.tracking().tick(path_ ? path_->at(time_s() - path_start_s_ + period_s)
                                   : quadrotor_.tracking().reference());
  const Eigen::Vector3d after_m = quadrotor_.true_body().translation();
  const double error_m = (after_m - quadrotor_.tracking().reference().p_world_m).norm();
  flown_s_ += period_s;
  flown_m_ += (after_m - before_m).norm();
  error_m_s_ += period_s * error_m;
  error_max_m_ = std::max(error_max_m_, error_m);
  energy_j_ += period_s * induced_power_W(quadrotor_.vehicle().thrusts_N(quadrotor_.world()),
                                          quadrotor_.vehicle().rotor_radius_m());
  if (time_s() >= next_clearance_s_ - kSameMoment_s) {
    clearance_.update(quadrotor_.world());
    next_clearance_s_ = time_s() + kClearanceEvery_s;
  }
  if (quadrotor_.collisions() > 0) {
    clearance_.touched();
    throw EpisodeFailed(fmt::format("touched {} at {:.2f} s, ({:.2f}, {:.2f}, {:.2f}) m",
                                    quadrotor_.touched(), time_s(), after_m.x(), after_m.y(),
                                    after_m.z()));
  }
}

void SimulatedTrajectoryRobot::capture_now(const ImageCallback& on_image) {
  next_image_s_ = time_s() + image_period_s_;
  FlightImage image;
  image.time_s = time_s();
  auto depth = quadrotor_.faults().arriving(quadrotor_.depth_image(depth_noise_), time_s());
  image.arrived = depth.has_value();
  if (depth) image.depth = std::move(*depth);
  image.T_world_camera = estimated_body() * T_body_camera();
  image.with_colour = [&] {
    CameraImages images = quadrotor_.colour_image(colour_noise_);
    images.depth_m = image.depth.depth_m;
    return images;
  };
  on_image(image);
}

TrajectoryGroundTruth SimulatedTrajectoryRobot::ground_truth() const {
  return {.collisions = quadrotor_.collisions(),
          .minimum_clearance_m = clearance_.min_m(),
          .tracking_error_mean_m = flown_s_ > 0.0 ? error_m_s_ / flown_s_ : 0.0,
          .tracking_error_max_m = error_max_m_,
          .energy_j = energy_j_,
          .flown_m = flown_m_};
}

}  // namespace vantage
