#include "vantage/tasks/tabletop/tabletop_robot_interface.hpp"

#include <algorithm>
#include <cmath>

#include "vantage/planners/views/view_candidates.hpp"
#include "vantage/tasks/start_check.hpp"

namespace vantage {
namespace {

/// Time for the torso and the tilt joint to come to rest before and between scans.
constexpr int kSettleTicks = 20;
constexpr int kMaxTicksToReach = 400;
constexpr double kTiltReached_rad = 0.01;

/// The torso's lift that brings the laser to the height of the views.
double torso_m(const World& world, const Pr2& robot, const Episode& episode) {
  const double lowest_m = robot.T_base_laser_mount(world).translation().z() - robot.torso_m(world);
  return std::max(episode.candidates.height_m - lowest_m, 0.0);
}

/// The robot, standing where the episode starts: at or behind a position on the ring of views.
Pr2 placed_robot(World& world, const Episode& episode) {
  Pr2 robot(world.model());
  check_reach(world, robot, episode);
  RingOfViews ring = episode.candidates;
  ring.yaw_offsets_rad = {0.0};
  ring.radius_m += episode.robot.start_behind_m;
  const auto& centre = episode.map.centre_m;
  const auto views = ring_of_views(ring, {centre[0], centre[1], centre[2]});
  const auto& start = views[static_cast<std::size_t>(episode.robot.start_view)];
  robot.place(world, robot.base_for_laser(start.T_world_sensor), torso_m(world, robot, episode));
  return robot;
}

}  // namespace

TabletopRobotInterface::TabletopRobotInterface(const ResolvedEpisode& resolved)
    : MobileRobotInterface(resolved,
                           [&](World& world) { return placed_robot(world, resolved.episode); }),
      laser_noise_(Rng::stream(episode_.seed, "laser")) {
  robot_.command_torso(world_, torso_m(world_, robot_, episode_));
  check_start(world_, robot_, geometry_without_robot_, resolved);
}

void TabletopRobotInterface::move_laser_to(double tilt_rad) {
  robot_.command_laser_tilt(world_, tilt_rad);
  for (int i = 0; i < kMaxTicksToReach; ++i) {
    if (i >= kSettleTicks &&
        std::abs(robot_.laser_tilt_rad(world_) - tilt_rad) < kTiltReached_rad) {
      return;
    }
    tick();
  }
}

TabletopObservation TabletopRobotInterface::observe() {
  const LaserOptions& laser = episode_.laser;
  robot_.command_twist(world_, {});
  move_laser_to(laser.tilt_min_rad);
  ScanBuilder builder(laser);
  const double rate = (laser.tilt_max_rad - laser.tilt_min_rad) / laser.scan_duration_s;
  const int ticks =
      static_cast<int>(std::ceil(laser.scan_duration_s / world_.options().control_period_s));
  for (int i = 0; i <= ticks; ++i) {
    const double target =
        laser.tilt_min_rad + rate * world_.options().control_period_s * static_cast<double>(i);
    robot_.command_laser_tilt(world_, std::min(target, laser.tilt_max_rad));
    tick();
    geometry_.update(world_.snapshot());
    builder.add_line(geometry_, robot_.T_world_laser(world_), robot_.laser_tilt_rad(world_),
                     robot_.laser_body_id(), laser_noise_);
  }
  return {builder.finish(), robot_.T_base_laser_mount(world_), read_base_scanner(),
          robot_.base_scan_height_m(), odometry_.estimate()};
}

Pose2 TabletopRobotInterface::base_for_view(const Pose& T_world_laser) const {
  return robot_.base_for_laser(T_world_laser);
}

Pose TabletopRobotInterface::estimated_laser() const {
  return to_se3(odometry_.estimate()) * robot_.T_base_laser_mount(world_);
}

}  // namespace vantage
