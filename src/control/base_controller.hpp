/// Following a path of waypoints with an omnidirectional base.
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/geometry/twist.hpp"

namespace vantage {

struct BaseControllerOptions {
  double speed_m_s = 0.6;
  double acceleration_m_s2 = 0.5;
  double turn_rate_rad_s = 0.8;
  double turn_acceleration_rad_s2 = 1.2;
  double lookahead_m = 0.10;
  double gain_per_s = 2.0;
  void fields(auto&& f) {
    f("speed_m_s", speed_m_s, "cruising speed; higher is faster and cuts corners wider",
      Range{0.0, 1.0, true});
    f("acceleration_m_s2", acceleration_m_s2,
      "greatest acceleration, also when braking and across the path in corners; higher is brisker",
      Range{0.0, 1.5, true});
    f("turn_rate_rad_s", turn_rate_rad_s, "cruising turn rate; higher turns faster",
      Range{0.0, 1.5, true});
    f("turn_acceleration_rad_s2", turn_acceleration_rad_s2,
      "greatest angular acceleration; higher starts and ends turns more sharply",
      Range{0.0, 5.0, true});
    f("lookahead_m", lookahead_m,
      "distance along the path to the point that is steered for; higher is smoother and cuts "
      "corners wider",
      Range{0.0, 1.0, true});
    f("gain_per_s", gain_per_s,
      "speed per distance left at the end of the path; higher arrives faster, and overshoots above "
      "2.5",
      Range{0.0, 3.0, true});
  }
};

/// A polyline to drive along; the heading turns evenly from `start_yaw_rad` to `final_yaw_rad`.
class DrivePath {
 public:
  /// From `T_world_base` through the waypoints. Of their headings only the last one counts.
  DrivePath(const Pose2& T_world_base, std::span<const Pose2> waypoints);

  [[nodiscard]] double length_m() const { return arc_m_.back(); }
  [[nodiscard]] double turn_rad() const { return turn_rad_; }  ///< signed, the short way
  [[nodiscard]] const Pose2& goal() const { return goal_; }
  [[nodiscard]] Eigen::Vector2d point(double arc_m) const;
  [[nodiscard]] double yaw(double arc_m) const;
  /// Arc length of the path's point nearest `p_m`, searched between two arc lengths.
  [[nodiscard]] double project(const Eigen::Vector2d& p_m, double from_m, double to_m) const;
  /// Arc length of the first corner at or after `arc_m` that turns by more than `turn_rad`; the
  /// path's length if there is none.
  [[nodiscard]] double next_corner(double arc_m, double turn_rad) const;
  /// The highest speed at `arc_m` from which corners ahead, and the end, can still be met.
  [[nodiscard]] double speed_limit(double arc_m, const BaseControllerOptions& options) const;

 private:
  std::vector<Eigen::Vector2d> points_m_;
  std::vector<double> arc_m_;            ///< of each point
  std::vector<double> half_corner_tan_;  ///< of each point; 0 goes straight on
  double start_yaw_rad_ = 0.0;
  double turn_rad_ = 0.0;
  Pose2 goal_;
};

/// Fastest approach to a stop `left` away (m or rad): braking evenly, then proportionally, without
/// a kink. A part of the acceleration is kept back for the lag of the drive.
double approach_speed(double left, double acceleration, double gain_per_s);

/// What the controller remembers between ticks.
struct PathFollowing {
  double arc_m = 0.0;                                     ///< how far along the path
  Eigen::Vector2d v_world_m_s = Eigen::Vector2d::Zero();  ///< last command
  double wz_rad_s = 0.0;
};

/// One tick: moves `following` on and returns the command in the base's frame. Pure: no clock, no
/// world.
Twist2 follow_path(const DrivePath& path, const Pose2& T_world_base, double period_s,
                   const BaseControllerOptions& options, PathFollowing& following);

}  // namespace vantage
