/// Robot interface of the table-top task: a mobile robot with a tilting laser scanner.
#pragma once

#include "vantage/tasks/mapping/mobile_robot_interface.hpp"

namespace vantage {

/// What the robot observes with one scan, standing still.
struct TabletopObservation {
  RangeScan scan;                   ///< tilting laser
  Pose T_base_laser;                ///< laser frame at tilt 0
  PlanarScan base_scan;             ///< planar scanner near the floor
  double base_scan_height_m = 0.0;  ///< of that scanner above the floor
  Pose2 T_world_base_odometry;      ///< dead reckoning since the last correction
};

class TabletopRobotInterface : public MobileRobotInterface {
 public:
  /// @throws ConfigError, InputError if the episode cannot begin, see start_check.hpp
  explicit TabletopRobotInterface(const ResolvedEpisode& resolved);

  /// Sweeps the tilting laser through its range while the base stands. @throws Interrupted
  TabletopObservation observe();
  /// Where the laser (at tilt 0) is, as the robot believes.
  [[nodiscard]] Pose estimated_laser() const;
  [[nodiscard]] Pose2 base_for_view(const Pose& T_world_laser) const;
  [[nodiscard]] FieldOfView view_field() const { return field_of_view(episode_.laser); }

 private:
  void move_laser_to(double tilt_rad);

  Rng laser_noise_;
};

}  // namespace vantage
