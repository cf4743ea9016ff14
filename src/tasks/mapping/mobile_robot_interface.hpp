/// Interface of a mobile robot: drive commands in, readings of the planar scanner and odometry out.
/// Ground truth stays behind `truth()`, which metrics alone may call.
#pragma once

#include <functional>

#include "vantage/core/rng.hpp"
#include "vantage/sim/robots/drive.hpp"
#include "vantage/sim/robots/odometry.hpp"
#include "vantage/sim/robots/pr2.hpp"
#include "vantage/sim/sensors/laser.hpp"
#include "vantage/sim/sensors/ray_scene.hpp"
#include "vantage/sim/world/world.hpp"
#include "vantage/tasks/scenario.hpp"

namespace vantage {

struct MobileRobotTruth {
  Pose2 T_world_base;
  int collisions = 0;
};

class MobileRobotInterface {
 public:
  MobileRobotInterface(const MobileRobotInterface&) = delete;
  MobileRobotInterface& operator=(const MobileRobotInterface&) = delete;

  /// One scan of the planar scanner, from the present pose.
  PlanarScan read_base_scanner();
  /// `go_on` is asked every tick; truth is not passed on. @throws Interrupted
  DriveResult drive_along(std::span<const Pose2> path, const std::function<bool()>& go_on);
  void correct_pose(const Pose2& T_world_base);
  /// What the wheels alone say, without the corrections since restart_dead_reckoning().
  [[nodiscard]] Pose2 dead_reckoned_base() const;
  void restart_dead_reckoning();
  [[nodiscard]] double base_scan_height_m() const { return robot_.base_scan_height_m(); }
  [[nodiscard]] Pose2 estimated_base() const { return odometry_.estimate(); }

  [[nodiscard]] MobileRobotTruth truth() const;
  [[nodiscard]] const RayScene& true_geometry() const { return geometry_without_robot_; }
  World& world() { return world_; }
  [[nodiscard]] const World& world() const { return world_; }

 protected:
  /// `place` puts the robot where the episode begins.
  MobileRobotInterface(const ResolvedEpisode& resolved, const std::function<Pr2(World&)>& place);
  ~MobileRobotInterface() = default;

  void tick();  ///< @throws Interrupted

  Episode episode_;
  World world_;
  Pr2 robot_;
  RayScene geometry_;
  RayScene geometry_without_robot_;
  Odometry odometry_;

 private:
  void report_touch() const;

  Pose2 T_world_dead_reckoned_;  ///< at the last correction
  Pose2 T_world_corrected_;      ///< the pose that correction set
  CollisionCounter collisions_;
  Rng scanner_noise_;
};

}  // namespace vantage
