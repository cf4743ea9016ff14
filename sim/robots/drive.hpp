/// Driving a path in the world until the robot has arrived, or something is in the way.
#pragma once

#include <functional>
#include <span>

#include "vantage/control/drive_options.hpp"
#include "vantage/sim/robots/mobile_base.hpp"
#include "vantage/sim/robots/odometry.hpp"

namespace vantage {

/// Asked every tick, with the estimated pose; false stops the drive (the path is blocked, ...).
using KeepDriving = std::function<bool(World&, const Pose2& T_world_base_estimated)>;

/// Drives from the estimated pose through `path` (world frame as the robot believes it; of the
/// headings only the last one counts) and comes to rest, whatever the outcome. Ticks the world and
/// the odometry, at most for a time that follows from the path's length.
/// @throws DivergedError from the world.
DriveResult drive(World& world, const MobileBase& robot, Odometry& odometry,
                  std::span<const Pose2> path, const DriveOptions& options = {},
                  const KeepDriving& keep_driving = {});

/// Simulates `duration_s` with the base at rest, e.g. for the lift to move.
void hold_still(World& world, const MobileBase& robot, Odometry& odometry, double duration_s);

}  // namespace vantage
