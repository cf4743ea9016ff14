#include "vantage/tasks/mapping/driving/navigator.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace vantage {
namespace {

/// How often the planar scanner adds to the floor map while driving.
constexpr int kTicksPerFloorScan = 10;
/// Plans towards one view before it counts as out of reach: the floor map grows on the way.
constexpr int kMaxPlans = 12;
constexpr double kProgress_m = 0.05;

}  // namespace

Navigator::Navigator(const FloorMapOptions& floor, const NavigationOptions& navigation,
                     const OdometryOptions& odometry, MobileRobotInterface& robot,
                     ReferenceMap reference_map, int threads, double keyframe_m)
    : threads_(threads),
      floor_options_(floor),
      options_(navigation),
      robot_(robot),
      floor_(make_floor_map(floor)),
      reference_map_(std::move(reference_map)),
      uncertainty_(odometry, robot.estimated_base()),
      keyframe_m_(keyframe_m) {}

void Navigator::turn_in_place() {
  const Pose2 start = robot_.estimated_base();
  clear_footprint(floor_, start, options_.inflation_m() + floor_.cell_m);
  const PlanarScan scan = robot_.read_base_scanner();
  extend_reference_map(scan, start);
  if (!reference_map_.walls_fix_pose(scan, robot_.base_scan_height_m())) {
    if (!reference_map_.posts_fix_pose(scan)) {
      add_planar_scan(floor_, scan, start, floor_options_, threads_);
      return;
    }
    reference_map_.go_by_posts();
  }
  for (int third = 1; third <= 3; ++third) {
    const double yaw_rad = start.yaw_rad + 2.0 / 3.0 * std::numbers::pi * third;
    drive_and_map({{start.x_m, start.y_m, wrap_angle(yaw_rad)}});
    const bool located = localise();
    const PlanarScan seen = robot_.read_base_scanner();
    if (located) extend_reference_map(seen, robot_.estimated_base());
  }
}

void Navigator::remember(const PlanarScan& scan, const Pose2& T_world_base) {
  extend_reference_map(scan, T_world_base);
  add_planar_scan(floor_, scan, T_world_base, floor_options_, threads_);
}

void Navigator::extend_reference_map(const PlanarScan& scan, const Pose2& T_world_base) {
  reference_map_.remember(scan, robot_.base_scan_height_m(), T_world_base);
  uncertainty_.remember();
  last_keyframe_m_ = {T_world_base.x_m, T_world_base.y_m};
}

/// Corrects dead reckoning by the planar scanner and adds the scan to the floor map.
bool Navigator::localise() {
  const PlanarScan scan = robot_.read_base_scanner();
  const auto located = reference_map_.locate(scan, robot_.base_scan_height_m(),
                                             robot_.estimated_base(), plausible_correction());
  const Pose2& pose = located.T_world_base;
  correct_pose(pose, located.information);
  add_planar_scan(floor_, scan, pose, floor_options_, threads_);
  const double gone_m = (Eigen::Vector2d(pose.x_m, pose.y_m) - last_keyframe_m_).norm();
  if (located.converged && gone_m >= keyframe_m_) extend_reference_map(scan, pose);
  return located.converged;
}

Correction Navigator::plausible_correction() {
  uncertainty_.move_to(robot_.estimated_base());
  return {uncertainty_.plausible_shift_m(), uncertainty_.plausible_turn_rad()};
}

void Navigator::correct_pose(const Pose2& T_world_base, const Eigen::Matrix3d& information) {
  uncertainty_.move_to(robot_.estimated_base());
  uncertainty_.correct(T_world_base, information);
  robot_.correct_pose(T_world_base);
}

PathField Navigator::plan() {
  clear_footprint(floor_, robot_.estimated_base(), robot_.inscribed_radius_m());
  return make_path_field(floor_, robot_.estimated_base(), options_);
}

DriveResult Navigator::drive_and_map(const std::vector<Pose2>& waypoints) {
  int tick = 0;
  turned_back_ = false;
  return robot_.drive_along(waypoints, [&] {
    if (++tick % kTicksPerFloorScan != 0) return true;
    localise();
    path_m_.emplace_back(robot_.estimated_base().x_m, robot_.estimated_base().y_m);
    turned_back_ = may_go_on && !may_go_on();
    return !turned_back_ && !is_way_blocked(floor_, waypoints, robot_.estimated_base(), options_);
  });
}

Approach Navigator::approach(const Pose2& goal, const std::optional<Eigen::Vector2d>& look_at_m) {
  Approach result;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (int attempt = 0; attempt < kMaxPlans; ++attempt) {
    const PlannedPath path = plan_path(plan(), goal, look_at_m);
    const double remaining_m = std::hypot(path.end.x_m - goal.x_m, path.end.y_m - goal.y_m);
    if (!path.reaches_goal && remaining_m > nearest_m - kProgress_m) return result;
    nearest_m = remaining_m;
    if (on_plan) on_plan(path);
    const DriveResult drive = drive_and_map(path.waypoints);
    result.path_length_m += drive.path_length_m;
    result.reached = drive.status == DriveStatus::arrived && path.reaches_goal;
    if (result.reached || turned_back_ || drive.status == DriveStatus::stuck) return result;
  }
  return result;
}

}  // namespace vantage
