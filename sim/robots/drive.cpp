#include "vantage/sim/robots/drive.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "vantage/control/differential_controller.hpp"

namespace vantage {
namespace {

constexpr double kPushing_m_s = 0.01;
constexpr double kMoving_m_s = 0.02;
constexpr double kMovingShare = 0.2;  ///< of what is commanded, where that is slow
constexpr double kLongestBraking_s = 3.0;
constexpr double kGrace_s = 10.0;

using Following = std::variant<PathFollowing, DifferentialFollowing>;

/// What the controller of that drive remembers at `arc_m` of the path, at rest.
Following following_of(const MobileBase& robot, const DriveOptions& options, double arc_m) {
  // Well within the tolerance, so that the turn at the end does not leave it.
  constexpr double kArrivalShare = 0.3;
  if (robot.is_holonomic()) return PathFollowing{.arc_m = arc_m};
  return DifferentialFollowing{.arc_m = arc_m,
                               .arrival_m = kArrivalShare * options.goal_tolerance_m};
}

double arc_m(const Following& following) {
  return std::visit([](const auto& f) { return f.arc_m; }, following);
}

class Driver {
 public:
  Driver(World& world, const MobileBase& robot, Odometry& odometry, const DriveOptions& options)
      : world_(world), robot_(robot), odometry_(odometry), options_(options) {}

  DriveResult run(const DrivePath& path, const KeepDriving& keep_driving) {
    const double start_s = world_.time_s();
    result_.status = follow(path, start_s + allowed_s(path), keep_driving);
    brake();
    result_.duration_s = world_.time_s() - start_s;
    return result_;
  }

  void stand_until(double time_s) {
    while (world_.time_s() < time_s) tick({});
  }

 private:
  [[nodiscard]] double allowed_s(const DrivePath& path) const {
    const BaseControllerOptions& control = options_.controller;
    const double ideal_s =
        path.length_m() / control.speed_m_s + std::abs(path.turn_rad()) / control.turn_rate_rad_s;
    return kGrace_s + options_.timeout_factor * ideal_s;
  }

  DriveStatus follow(const DrivePath& path, double deadline_s, const KeepDriving& keep_driving) {
    Following following = following_of(robot_, options_, 0.0);
    double pushing_s = 0.0;
    while (world_.time_s() < deadline_s) {
      const Twist2 command = std::visit(
          [&](auto& f) {
            return follow_path(path, odometry_.estimate(), world_.options().control_period_s,
                               options_.controller, f);
          },
          following);
      tick(command);
      if (keep_driving && !keep_driving(world_, odometry_.estimate())) return DriveStatus::stopped;
      pushing_s = is_pushing(command) ? pushing_s + world_.options().control_period_s : 0.0;
      if (pushing_s >= options_.stuck_time_s) return DriveStatus::stuck;
      if (!is_at(path.goal(), 0.5)) continue;
      brake();
      if (is_at(path.goal(), 1.0) && is_at_rest()) return DriveStatus::arrived;
      following = following_of(robot_, options_, arc_m(following));
    }
    return DriveStatus::timeout;
  }

  /// Within `share` of the tolerance of the goal.
  [[nodiscard]] bool is_at(const Pose2& goal, double share) const {
    const Pose2 error = compose(inverse(odometry_.estimate()), goal);
    return std::hypot(error.x_m, error.y_m) < share * options_.goal_tolerance_m &&
           std::abs(error.yaw_rad) < share * options_.goal_tolerance_rad;
  }

  /// Makes one speed of turning and moving: that of the footprint's corners.
  [[nodiscard]] double corner_speed(const Twist2& twist) const {
    return std::hypot(twist.vx_m_s, twist.vy_m_s) +
           robot_.footprint().circumscribed_radius_m * std::abs(twist.wz_rad_s);
  }

  /// By what the wheels measure: the robot has no sense of touch. Close to where it is to go it
  /// pushes slowly.
  [[nodiscard]] bool is_pushing(const Twist2& command) const {
    const double commanded_m_s = corner_speed(command);
    return commanded_m_s > kPushing_m_s &&
           measured_m_s_ < std::min(kMoving_m_s, kMovingShare * commanded_m_s);
  }

  [[nodiscard]] bool is_at_rest() const {
    return corner_speed(robot_.twist(world_)) < options_.rest_speed_m_s;
  }

  void brake() {
    const double latest_s = world_.time_s() + kLongestBraking_s;
    do {
      tick({});
    } while (!is_at_rest() && world_.time_s() < latest_s);
  }

  void tick(const Twist2& command) {
    const Pose2 before = robot_.T_world_base(world_);
    robot_.command_twist(world_, command);
    world_.advance_tick();
    const Pose2 after = robot_.T_world_base(world_);
    const Pose2 estimate = odometry_.estimate();
    odometry_.update(after);
    const Pose2 step = compose(inverse(estimate), odometry_.estimate());
    measured_m_s_ =
        corner_speed({step.x_m, step.y_m, step.yaw_rad}) / world_.options().control_period_s;
    result_.path_length_m += std::hypot(after.x_m - before.x_m, after.y_m - before.y_m);
  }

  World& world_;
  const MobileBase& robot_;
  Odometry& odometry_;
  const DriveOptions& options_;
  DriveResult result_;
  double measured_m_s_ = 0.0;  ///< of the footprint's corners, by odometry
};

}  // namespace

std::string_view to_string(DriveStatus status) {
  switch (status) {
    case DriveStatus::arrived: return "arrived";
    case DriveStatus::stuck: return "stuck";
    case DriveStatus::stopped: return "stopped";
    case DriveStatus::timeout: return "timeout";
  }
  return "unknown";
}

DriveResult drive(World& world, const MobileBase& robot, Odometry& odometry,
                  std::span<const Pose2> path, const DriveOptions& options,
                  const KeepDriving& keep_driving) {
  check_options(options, "drive");
  return Driver(world, robot, odometry, options)
      .run(DrivePath(odometry.estimate(), path), keep_driving);
}

void hold_still(World& world, const MobileBase& robot, Odometry& odometry, double duration_s) {
  const DriveOptions options;
  Driver(world, robot, odometry, options).stand_until(world.time_s() + duration_s);
}

}  // namespace vantage
