/// Following a path of waypoints with a base that cannot go sideways: pure pursuit of a point ahead
/// on the path, turning in place where the path turns sharply, and at its end.
#pragma once

#include "vantage/control/base_controller.hpp"

namespace vantage {

/// What the controller remembers between ticks.
struct DifferentialFollowing {
  double arc_m = 0.0;  ///< how far along the path
  double v_m_s = 0.0;  ///< last command, negative backwards
  double wz_rad_s = 0.0;
  bool turning = false;   ///< in place, towards the path
  bool aligning = false;  ///< in place, to the goal's heading
  /// From the goal's position at which it turns to the goal's heading; higher arrives sooner, less
  /// exactly.
  double arrival_m = 0.003;
};

/// Curvature (1/m, left positive) of the arc that leaves the origin along x and passes through
/// `p_base_m`; 0 for a point at the origin.  [Coulter1992, section 2]
double pursuit_curvature(const Eigen::Vector2d& p_base_m);

/// One tick: moves `following` on and returns the command, its vy 0. Speed falls so that no arc
/// asks for a faster turn than one that can still end at the bearing of the point ahead: it does
/// not weave. Pure: no clock, no world.
Twist2 follow_path(const DrivePath& path, const Pose2& T_world_base, double period_s,
                   const BaseControllerOptions& options, DifferentialFollowing& following);

}  // namespace vantage
