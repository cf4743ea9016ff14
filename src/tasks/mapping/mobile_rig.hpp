/// The robot in its world, as far as driving goes: what it can command and what its planar scanner
/// and odometry return. Truth stays behind `truth()`, which metrics alone may call.
#pragma once

#include <functional>

#include "vantage/sim/robots/drive.hpp"
#include "vantage/sim/sensors/laser.hpp"
#include "vantage/sim/robots/odometry.hpp"
#include "vantage/sim/robots/pr2.hpp"
#include "vantage/sim/sensors/ray_scene.hpp"
#include "vantage/sim/world/world.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/tasks/scenario.hpp"

namespace vantage {

struct RigTruth {
  Pose2 T_world_base;
  int collisions = 0;
};

class MobileRig {
 public:
  MobileRig(const MobileRig&) = delete;
  MobileRig& operator=(const MobileRig&) = delete;

  /// A single reading of the planar scanner, at the present place.
  PlanarScan look_around();
  /// `go_on` is asked every tick; truth is not passed on. @throws Interrupted
  DriveResult drive_along(std::span<const Pose2> path, const std::function<bool()>& go_on);
  void correct_pose(const Pose2& T_world_base);
  /// What the wheels alone say, without the corrections since restart_dead_reckoning().
  [[nodiscard]] Pose2 dead_reckoned_base() const;
  void restart_dead_reckoning();
  [[nodiscard]] double base_scan_height_m() const { return robot_.base_scan_height_m(); }
  [[nodiscard]] Pose2 estimated_base() const { return odometry_.estimate(); }

  [[nodiscard]] RigTruth truth() const;
  [[nodiscard]] const RayScene& true_geometry() const { return geometry_without_robot_; }
  World& world() { return world_; }
  [[nodiscard]] const World& world() const { return world_; }

 protected:
  /// `place` puts the robot where the episode begins.
  MobileRig(const ResolvedEpisode& resolved, const std::function<Pr2(World&)>& place);
  ~MobileRig() = default;

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
