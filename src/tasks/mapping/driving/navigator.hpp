/// Drives the robot over the floor it knows, and gets to know more of it on the way.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "vantage/belief/map/floor_map.hpp"
#include "vantage/perception/clouds/reference_map.hpp"
#include "vantage/planners/navigation/path_planning.hpp"
#include "vantage/sim/robots/pose_uncertainty.hpp"
#include "vantage/tasks/mapping/driving/mobile_robot_interface.hpp"

namespace vantage {

/// How far the robot got towards a goal.
struct Approach {
  bool reached = false;
  double path_length_m = 0.0;
};

class Navigator {
 public:
  /// @param walls to drive by
  /// @param keyframe_m remembers the walls that often while driving; infinity: only when told to
  Navigator(const FloorMapOptions& floor, const NavigationOptions& navigation,
            const OdometryOptions& odometry, MobileRobotInterface& robot,
            ReferenceMap reference_map, int threads,
            double keyframe_m = std::numeric_limits<double>::infinity());

  /// Turns once in place, to know the floor on all sides: the scanner does not see behind the
  /// robot. Whoever starts the robot gives it room for that. Where the scanner sees nothing that
  /// fixes the pose it stays as it stands: a turn would lose the heading.
  void turn_in_place();
  /// Adds a scan that was taken at a known place to what it drives by and over.
  void remember(const PlanarScan& scan, const Pose2& T_world_base);
  /// A registration has put the base there. @param information of it, zero if it has failed
  void correct_pose(const Pose2& T_world_base, const Eigen::Matrix3d& information);
  /// The most that odometry may have drifted since the last correction.
  Correction plausible_correction();
  /// The ways from where the robot is.
  PathField plan();
  /// Drives to the goal, or as near as the known free floor allows; plans again as the floor map
  /// grows, and where something new stands in the way. Short of the goal it ends facing
  /// `look_at_m`, see plan_path().
  Approach approach(const Pose2& goal, const std::optional<Eigen::Vector2d>& look_at_m);

  /// Asked now and then on every way; where it says no, approach() ends there. May be empty.
  std::function<bool()> may_go_on;
  /// Told every path before it is driven; may be empty.
  std::function<void(const PlannedPath&)> on_plan;

  [[nodiscard]] FloorMap& floor() { return floor_; }
  [[nodiscard]] const ReferenceMap& reference_map() const { return reference_map_; }
  /// How far off the robot may believe itself to be.
  [[nodiscard]] const PoseUncertainty& uncertainty() const { return uncertainty_; }
  /// Driven, as the robot believes.
  [[nodiscard]] const std::vector<Eigen::Vector2d>& path_m() const { return path_m_; }

 private:
  bool localise();
  void extend_reference_map(const PlanarScan& scan, const Pose2& T_world_base);
  DriveResult drive_and_map(const std::vector<Pose2>& waypoints);

  int threads_;
  FloorMapOptions floor_options_;
  NavigationOptions options_;
  MobileRobotInterface& robot_;
  FloorMap floor_;
  ReferenceMap reference_map_;
  PoseUncertainty uncertainty_;
  double keyframe_m_;
  bool turned_back_ = false;  ///< on the last drive, since it might not go on
  Eigen::Vector2d last_keyframe_m_ = Eigen::Vector2d::Zero();
  std::vector<Eigen::Vector2d> path_m_;
};

}  // namespace vantage
