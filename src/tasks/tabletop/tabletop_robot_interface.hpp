/// Robot interface of the table-top task: a mobile robot with a tilting laser scanner.
#pragma once

#include "vantage/tasks/mapping/driving/mobile_robot_interface.hpp"

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
  /// Sweeps the tilting laser through its range while the base stands. @throws Interrupted
  virtual TabletopObservation observe() = 0;
};

}  // namespace vantage
