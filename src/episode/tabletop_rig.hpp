/// The robot in its world: what it can command and what its sensors return. Truth stays behind
/// `truth()`, which metrics alone may call.
#pragma once

#include <functional>

#include "planners/path_planning.hpp"
#include "sim/drive.hpp"
#include "sim/laser.hpp"
#include "sim/odometry.hpp"
#include "sim/pr2.hpp"
#include "sim/ray_scene.hpp"
#include "sim/world.hpp"
#include "src/core/rng.hpp"
#include "src/episode/scenario.hpp"

namespace vantage {

/// What the robot knows after standing still for a scan.
struct TabletopObservation {
  RangeScan scan;                   ///< tilting laser
  Pose T_base_laser;                ///< laser frame at tilt 0
  PlanarScan base_scan;             ///< planar scanner near the floor
  double base_scan_height_m = 0.0;  ///< of that scanner above the floor
  Pose2 T_world_base_odometry;      ///< dead reckoning since the last correction
};

struct RigTruth {
  Pose2 T_world_base;
  int collisions = 0;
};

class TabletopRig {
 public:
  /// @throws ConfigError, InputError if the episode cannot begin, see start_check.hpp
  explicit TabletopRig(const ResolvedEpisode& resolved);

  /// Sweeps the tilting laser through its range while the base stands. @throws Interrupted
  TabletopObservation observe();
  /// A single reading of the planar scanner, at the present place.
  PlanarScan look_around();
  /// `on_tick` is called while driving; truth is not passed on. @throws Interrupted
  DriveResult drive_along(std::span<const Pose2> path, const std::function<void()>& on_tick);
  void correct_pose(const Pose2& T_world_base);
  /// What the wheels alone say, without the corrections since restart_dead_reckoning().
  [[nodiscard]] Pose2 dead_reckoned_base() const;
  void restart_dead_reckoning();
  [[nodiscard]] double base_scan_height_m() const { return robot_.base_scan_height_m(); }
  [[nodiscard]] Pose2 estimated_base() const { return odometry_.estimate(); }
  /// Where the laser (at tilt 0) is, as the robot believes.
  [[nodiscard]] Pose estimated_laser() const;
  [[nodiscard]] Pose2 base_for_view(const Pose& T_world_laser) const;
  [[nodiscard]] FieldOfView view_field() const { return field_of_view(episode_.laser); }

  [[nodiscard]] RigTruth truth() const;
  [[nodiscard]] const RayScene& true_geometry() const { return geometry_without_robot_; }
  World& world() { return world_; }
  [[nodiscard]] const World& world() const { return world_; }

 private:
  void tick();
  void move_laser_to(double tilt_rad);

  Episode episode_;
  World world_;
  Pr2 robot_;
  RayScene geometry_;
  RayScene geometry_without_robot_;
  Odometry odometry_;
  Pose2 T_world_dead_reckoned_;  ///< at the last correction
  Pose2 T_world_corrected_;      ///< the pose that correction set
  CollisionCounter collisions_;
  Rng laser_noise_;
  Rng scanner_noise_;
};

}  // namespace vantage
