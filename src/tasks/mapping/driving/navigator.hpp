/// Drives the robot over the floor it knows, and gets to know more of it on the way.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "vantage/belief/map/floor_detail.hpp"
#include "vantage/belief/map/floor_map.hpp"
#include "vantage/perception/clouds/reference_map.hpp"
#include "vantage/planners/navigation/path_planning.hpp"
#include "vantage/sim/robots/pose_uncertainty.hpp"
#include "vantage/tasks/mapping/driving/loop_closing.hpp"
#include "vantage/tasks/mapping/driving/mobile_robot_interface.hpp"

namespace vantage {

/// How far the robot got towards a goal.
struct Approach {
  bool reached = false;
  bool turned_back = false;  ///< Navigator::may_go_on said no
  double path_length_m = 0.0;
};

/// What narrow passages are found and driven by.
struct PassageMap {
  PassageOptions options;
  FloorDetailOptions detail_options;
  RobotOutline robot;
  FloorMap detail;
};

class Navigator {
 public:
  /// @param walls to drive by
  /// @param keyframe_m remembers the walls that often while driving; infinity: only when told to
  Navigator(const FloorMapOptions& floor, const NavigationOptions& navigation,
            const OdometryOptions& odometry, MobileRobotInterface& robot,
            ReferenceMap reference_map, int threads,
            double keyframe_m = std::numeric_limits<double>::infinity());

  /// From now on it goes through passages that only the robot's outline fits through.
  void use_passages(const PassageOptions& options, const FloorDetailOptions& detail);

  /// Turns once in place, to know the floor on all sides: the scanner does not see behind the
  /// robot. Whoever starts the robot gives it room for that. Where the scanner sees nothing that
  /// fixes the pose it stays as it stands: a turn would lose the heading.
  /// @return whether it sees anything that does
  bool turn_in_place();
  /// Adds a scan that was taken at a known place to what it drives by and over.
  void remember(const PlanarScan& scan, const Pose2& T_world_base);
  /// A registration has put the base there. @param information of it, zero if it has failed
  void correct_pose(const Pose2& T_world_base, const Eigen::Matrix3d& information);
  /// From now on looks for places that it is back at. Before the first scan.
  void close_loops(const LoopOptions& loops, const RegistrationOptions& registration,
                   const OdometryOptions& odometry);
  /// Where loops were found that move what is remembered: the walls, the floor, the way so far and
  /// the robot are where they belong then. What blocks the floor besides is for the caller to say
  /// again.
  std::optional<PoseCorrection> correct_over_loops();
  /// Null: it was not told to look for loops.
  [[nodiscard]] const LoopClosing* loops() const { return loops_ ? &*loops_ : nullptr; }
  /// The most that odometry may have drifted since the last correction.
  Correction plausible_correction();
  /// The ways from where the robot is; worked out once as long as nothing changes.
  std::shared_ptr<const PathField> plan();
  /// The ways from some other place.
  [[nodiscard]] PathField ways_from(const Pose2& T_world_base) const;
  /// Drives to the goal, or as near as the known free floor allows; plans again as the floor map
  /// grows, where something new stands in the way, and where it does not get on in a passage: from
  /// then on that is closed where it was to go. Short of the goal it ends facing
  /// `look_at_m`, see plan_path().
  Approach approach(const Pose2& goal, const std::optional<Eigen::Vector2d>& look_at_m);

  /// Asked now and then on every way; where it says no, approach() ends there. May be empty.
  std::function<bool()> may_go_on;
  /// Told now and then on every way, when the pose has just been registered; may be empty.
  std::function<void()> on_the_way;
  /// Told every path before it is driven; may be empty.
  std::function<void(const PlannedPath&)> on_plan;

  [[nodiscard]] FloorMap& floor() { return floor_; }
  /// The finer map of the floor, to be changed; null without passages.
  [[nodiscard]] FloorMap* detail();
  [[nodiscard]] const ReferenceMap& reference_map() const { return reference_map_; }
  /// How far off the robot may believe itself to be.
  [[nodiscard]] const PoseUncertainty& uncertainty() const { return uncertainty_; }
  /// Driven, as the robot believes.
  [[nodiscard]] const std::vector<Eigen::Vector2d>& path_m() const { return path_m_; }

 private:
  /// What the planar scanner says, as far as that says anything.
  PlanarScan read_scanner();
  bool localise();
  void add_scan(const PlanarScan& scan, const Pose2& T_world_base);
  void extend_reference_map(const PlanarScan& scan, const Pose2& T_world_base);
  void clear_floor(const Pose2& start);
  void note_path_point();
  [[nodiscard]] std::size_t last_keyframe() const;
  DriveResult drive_and_map(std::span<const Pose2> waypoints, double max_speed_m_s,
                            const std::function<bool()>& is_blocked);
  DriveResult drive_open(const std::vector<Pose2>& waypoints);
  DriveResult drive_leg(const PathLeg& leg);
  DriveResult drive(const PlannedPath& path);
  void note_touched(const PathLeg& leg);
  DriveResult back_off(const PathLeg& leg, DriveResult driven);
  /// Says it again, since the map is made anew at times.
  void block_touched();
  [[nodiscard]] std::shared_ptr<const FootprintSpace> space() const;

  int threads_;
  FloorMapOptions floor_options_;
  NavigationOptions options_;
  MobileRobotInterface& robot_;
  FloorMap floor_;
  std::optional<PassageMap> passages_;
  mutable std::shared_ptr<const FootprintSpace> space_;  ///< of them as they are; null: to be made
  /// A cell that the robot did not get to, with something in it that no sensor has seen.
  struct Touched {
    Eigen::Vector2d at_m;
    std::size_t keyframe;  ///< the last one then
  };
  std::vector<Touched> touched_;
  ReferenceMap reference_map_;
  PoseUncertainty uncertainty_;
  std::shared_ptr<const PathField> planned_;  ///< by the last plan()
  double keyframe_m_;
  bool turned_back_ = false;  ///< on the last drive, since it might not go on
  Eigen::Vector2d last_keyframe_m_ = Eigen::Vector2d::Zero();
  std::vector<Eigen::Vector2d> path_m_;
  std::vector<std::size_t> keyframe_of_path_;  ///< the last one, at each point
  std::optional<LoopClosing> loops_;
  ReferenceMap empty_reference_map_;  ///< to begin again with
};

}  // namespace vantage
