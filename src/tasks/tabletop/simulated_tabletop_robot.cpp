#include "vantage/tasks/tabletop/simulated_tabletop_robot.hpp"

#include <algorithm>
#include <cmath>

#include "vantage/planners/views/view_candidates.hpp"
#include "vantage/tasks/tabletop/start_check.hpp"

namespace vantage {
namespace {

/// Time for the lift and the tilt joint to come to rest before and between scans.
constexpr double kSettle_s = 0.5;
constexpr double kMostToReach_s = 10.0;
constexpr double kTiltReached_rad = 0.01;

/// The lift that brings the laser to the height of the views.
double laser_lift_m(const World& world, const MobileBase& robot, const Tabletop& task) {
  const double lowest_m = robot.T_base_laser_mount(world).translation().z() - robot.lift_m(world);
  return std::max(task.candidates.height_m - lowest_m, 0.0);
}

/// The robot, standing where the episode starts: at or behind a position on the ring of views.
MobileBase placed_robot(World& world, const EpisodeSetup& setup, const Tabletop& task) {
  const RobotOptions& options = setup.options.robot;
  require_table(world, setup, task);
  MobileBase robot = mobile_base(world, setup, task.navigation);
  check_reach(world, robot, task);
  RingOfViews ring = task.candidates;
  ring.yaw_offsets_rad = {0.0};
  ring.radius_m += options.start_behind_m;
  const auto views = ring_of_views(ring, task.map.centre());
  const auto& start = views[static_cast<std::size_t>(options.start_view)];
  robot.place(world, robot.base_for_laser(start.T_world_sensor), laser_lift_m(world, robot, task));
  return robot;
}

}  // namespace

SimulatedTabletopRobot::SimulatedTabletopRobot(const EpisodeSetup& setup, const Tabletop& task)
    : DrivenByBase(setup.options, task, ModelSource{setup.scene, setup.robot.mjcf},
                   [&](World& world) { return placed_robot(world, setup, task); }),
      laser_(task.laser),
      laser_noise_(Rng::stream(setup.options.seed, "laser")) {
  const MobileBase& robot = base_.robot();
  robot.command_lift(world(), laser_lift_m(world(), robot, task));
  start_notes_ = check_start(world(), base_.ground_truth().geometry(), robot, setup, task);
  base_.note_localisation(task.registration, setup.options.seed, start_notes_);
}

void SimulatedTabletopRobot::move_laser_to(double tilt_rad) {
  const MobileBase& robot = base_.robot();
  robot.command_laser_tilt(world(), tilt_rad);
  const double period_s = world().options().control_period_s;
  const auto settled = std::lround(kSettle_s / period_s);
  const auto most = std::lround(kMostToReach_s / period_s);
  for (long i = 0; i < most; ++i) {
    if (i >= settled && std::abs(robot.laser_tilt_rad(world()) - tilt_rad) < kTiltReached_rad) {
      return;
    }
    base_.tick();
  }
}

TabletopObservation SimulatedTabletopRobot::observe() {
  const MobileBase& robot = base_.robot();
  World& world = base_.world();
  robot.command_twist(world, {});
  move_laser_to(laser_.tilt_min_rad);
  ScanBuilder builder(laser_);
  const double rate = (laser_.tilt_max_rad - laser_.tilt_min_rad) / laser_.scan_duration_s;
  const double period_s = world.options().control_period_s;
  const int ticks = static_cast<int>(std::ceil(laser_.scan_duration_s / period_s));
  const auto spoil = [&](std::vector<float>& range_m) {
    base_.faults().spoil_line(range_m, laser_.range_max_m, world.time_s());
  };
  for (int i = 0; i <= ticks; ++i) {
    const double target = laser_.tilt_min_rad + rate * period_s * static_cast<double>(i);
    robot.command_laser_tilt(world, std::min(target, laser_.tilt_max_rad));
    base_.tick();
    builder.add_line(base_.seen_geometry(), robot.T_world_laser(world), robot.laser_tilt_rad(world),
                     robot.laser_body_id(), laser_noise_, spoil);
  }
  return {builder.finish(), robot.T_base_laser_mount(world), read_base_scanner(),
          base_scan_height_m(), estimated_base()};
}

Pose2 SimulatedTabletopRobot::base_for_sensor(const Pose& T_world_laser) const {
  return base_.robot().base_for_laser(T_world_laser);
}

Pose SimulatedTabletopRobot::estimated_sensor() const {
  return to_se3(estimated_base()) * base_.robot().T_base_laser_mount(base_.world());
}

}  // namespace vantage
