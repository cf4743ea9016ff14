/// Driving a path in the world until the robot has arrived, or something is in the way.
#pragma once

#include <functional>
#include <span>
#include <string_view>

#include "vantage/control/base_controller.hpp"
#include "vantage/sim/robots/odometry.hpp"
#include "vantage/sim/robots/pr2.hpp"

namespace vantage {

struct DriveOptions {
  BaseControllerOptions controller = {};
  double goal_tolerance_m = 0.01;      ///< in the estimated frame, at rest
  double goal_tolerance_rad = 0.0105;  ///< 0.6 degrees
  double rest_speed_m_s = 0.002;       ///< slower than this is at rest
  double stuck_time_s = 1.0;           ///< pushing that long without moving is stuck
  double timeout_factor = 4.0;  ///< times the time the path should take; higher is more patient
  void fields(auto&& f) {
    f("controller", controller);
    f("goal_tolerance_m", goal_tolerance_m, Range{0.001, 1.0});
    f("goal_tolerance_rad", goal_tolerance_rad, Range{0.001, 1.0});
    f("rest_speed_m_s", rest_speed_m_s, Range{0.001, 0.1});
    f("stuck_time_s", stuck_time_s, above(0.0));
    f("timeout_factor", timeout_factor, at_least(1.0));
  }
};

enum class DriveStatus { arrived, stuck, stopped, timeout };
std::string_view to_string(DriveStatus status);

struct DriveResult {
  DriveStatus status = DriveStatus::arrived;
  double path_length_m = 0.0;  ///< truly driven
  double duration_s = 0.0;     ///< simulated
};

/// Asked every tick, with the estimated pose; false stops the drive (the path is blocked, ...).
using KeepDriving = std::function<bool(World&, const Pose2& T_world_base_estimated)>;

/// Drives from the estimated pose through `path` (world frame as the robot believes it; of the
/// headings only the last one counts) and comes to rest, whatever the outcome. Ticks the world and
/// the odometry, at most for a time that follows from the path's length.
/// @throws DivergedError from the world.
DriveResult drive(World& world, const Pr2& robot, Odometry& odometry, std::span<const Pose2> path,
                  const DriveOptions& options = {}, const KeepDriving& keep_driving = {});

/// Simulates `duration_s` with the base at rest, e.g. for the torso to move.
void hold_still(World& world, const Pr2& robot, Odometry& odometry, double duration_s);

}  // namespace vantage
