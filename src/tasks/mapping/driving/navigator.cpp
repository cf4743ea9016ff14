#include "vantage/tasks/mapping/driving/navigator.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "vantage/perception/clouds/usable_readings.hpp"
#include "vantage/planners/navigation/centred_legs.hpp"
#include "vantage/planners/navigation/passage_watch.hpp"

namespace vantage {
namespace {

/// How often the planar scanner adds to the floor map while driving.
constexpr int kTicksPerFloorScan = 10;
/// Plans towards one view before it counts as out of reach: the floor map grows on the way.
constexpr int kMaxPlans = 12;
constexpr double kProgress_m = 0.05;
/// Wheels tell turns worst: scans are tied to each other as often.
constexpr double kTurnPerKeyframe_rad = 0.5;

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
      keyframe_m_(keyframe_m),
      empty_reference_map_(reference_map_) {}

void Navigator::close_loops(const LoopOptions& loops, const RegistrationOptions& registration,
                            const OdometryOptions& odometry) {
  loops_.emplace(loops, registration, odometry, robot_.estimated_base());
}

std::optional<PoseCorrection> Navigator::correct_over_loops() {
  if (!loops_ || !loops_->wants_correction()) return std::nullopt;
  PoseCorrection correction = loops_->correct();
  const std::size_t last = loops_->remembered().size() - 1;
  const Pose2 base = correction.moved(robot_.estimated_base(), last);
  loops_->moved_to(robot_.estimated_base(), base);
  robot_.correct_pose(base);
  for (std::size_t i = 0; i < path_m_.size(); ++i) {
    path_m_[i] = correction.moved(path_m_[i], keyframe_of_path_[i]);
  }
  for (Touched& touched : touched_) touched.at_m = correction.moved(touched.at_m, touched.keyframe);
  const bool by_posts = reference_map_.goes_by_posts();
  reference_map_ = empty_reference_map_;
  if (by_posts) reference_map_.go_by_posts();
  clear_floor(loops_->remembered().front().T_world_base);
  for (const auto& seen : loops_->remembered()) {
    reference_map_.remember(seen.scan, seen.scanner_height_m, seen.T_world_base);
    add_scan(seen.scan, seen.T_world_base);
  }
  last_keyframe_m_ = {base.x_m, base.y_m};
  uncertainty_.assume(base, loops_->graph().covariances(std::array{last}).front());
  return correction;
}

/// Nothing is known of it but that the robot stood at its start.
void Navigator::clear_floor(const Pose2& start) {
  floor_ = make_floor_map(floor_options_);
  clear_footprint(floor_, start, options_.inflation_m() + floor_.cell_m);
  if (!passages_) return;
  *detail() = make_floor_detail(floor_, passages_->detail_options);
  clear_footprint(*detail(), start, options_.inflation_m() + floor_.cell_m);
}

PlanarScan Navigator::read_scanner() {
  PlanarScan scan = robot_.read_base_scanner();
  discard_unusable(scan);
  return scan;
}

void Navigator::use_passages(const PassageOptions& options, const FloorDetailOptions& detail) {
  if (!options.use) return;
  passages_ = PassageMap{options, detail, robot_.outline(), make_floor_detail(floor_, detail)};
}

FloorMap* Navigator::detail() {
  space_.reset();
  return passages_ ? &passages_->detail : nullptr;
}

std::shared_ptr<const FootprintSpace> Navigator::space() const {
  if (passages_ && !space_) {
    space_ = std::make_shared<const FootprintSpace>(
        passages_->detail, passages_->detail_options.parts, passages_->robot, passages_->options);
  }
  return space_;
}

void Navigator::add_scan(const PlanarScan& scan, const Pose2& T_world_base) {
  add_planar_scan(floor_, scan, T_world_base, floor_options_, threads_);
  if (!passages_) return;
  add_beams(*detail(), scan, T_world_base, passages_->detail_options);
  clear_outline(*detail(), moved(passages_->robot.outline, T_world_base));
}

bool Navigator::turn_in_place() {
  const Pose2 start = robot_.estimated_base();
  clear_footprint(floor_, start, options_.inflation_m() + floor_.cell_m);
  if (passages_) clear_footprint(*detail(), start, options_.inflation_m() + floor_.cell_m);
  const PlanarScan scan = read_scanner();
  extend_reference_map(scan, start);
  if (!reference_map_.walls_fix_pose(scan, robot_.base_scan_height_m())) {
    if (!reference_map_.posts_fix_pose(scan)) {
      add_scan(scan, start);
      return false;
    }
    reference_map_.go_by_posts();
  }
  for (int third = 1; third <= 3; ++third) {
    const double yaw_rad = start.yaw_rad + 2.0 / 3.0 * std::numbers::pi * third;
    drive_open({{start.x_m, start.y_m, wrap_angle(yaw_rad)}});
    const bool located = localise();
    const PlanarScan seen = read_scanner();
    if (located) extend_reference_map(seen, robot_.estimated_base());
  }
  return true;
}

void Navigator::remember(const PlanarScan& scan, const Pose2& T_world_base) {
  extend_reference_map(scan, T_world_base);
  add_scan(scan, T_world_base);
}

void Navigator::extend_reference_map(const PlanarScan& scan, const Pose2& T_world_base) {
  reference_map_.remember(scan, robot_.base_scan_height_m(), T_world_base);
  uncertainty_.remember();
  if (loops_) {
    loops_->moved_to(robot_.estimated_base(), robot_.estimated_base());
    loops_->remember(scan, robot_.base_scan_height_m(), T_world_base);
  }
  last_keyframe_m_ = {T_world_base.x_m, T_world_base.y_m};
}

/// Corrects dead reckoning by the planar scanner and adds the scan to the floor map.
bool Navigator::localise() {
  const PlanarScan scan = read_scanner();
  const auto located = reference_map_.locate(scan, robot_.base_scan_height_m(),
                                             robot_.estimated_base(), plausible_correction());
  const Pose2& pose = located.T_world_base;
  correct_pose(pose, located.information);
  add_scan(scan, pose);
  const double gone_m = (Eigen::Vector2d(pose.x_m, pose.y_m) - last_keyframe_m_).norm();
  if (located.converged && gone_m >= keyframe_m_) {
    extend_reference_map(scan, pose);
  } else if (located.converged && loops_ && loops_->turned_rad() > kTurnPerKeyframe_rad) {
    loops_->remember(scan, robot_.base_scan_height_m(), pose);
  }
  return located.converged;
}

Correction Navigator::plausible_correction() {
  uncertainty_.move_to(robot_.estimated_base());
  return {uncertainty_.plausible_shift_m(), uncertainty_.plausible_turn_rad()};
}

void Navigator::correct_pose(const Pose2& T_world_base, const Eigen::Matrix3d& information) {
  uncertainty_.move_to(robot_.estimated_base());
  uncertainty_.correct(T_world_base, information);
  if (loops_) loops_->moved_to(robot_.estimated_base(), T_world_base);
  robot_.correct_pose(T_world_base);
}

std::shared_ptr<const PathField> Navigator::plan() {
  const Pose2 base = robot_.estimated_base();
  clear_footprint(floor_, base, robot_.inscribed_radius_m());
  block_touched();
  const bool known = planned_ && planned_->start.x_m == base.x_m &&
                     planned_->start.y_m == base.y_m && planned_->start.yaw_rad == base.yaw_rad &&
                     planned_->space == space() && planned_->map.log_odds == floor_.log_odds &&
                     planned_->map.blocked == floor_.blocked;
  if (!known) planned_ = std::make_shared<const PathField>(ways_from(base));
  return planned_;
}

void Navigator::note_path_point() {
  path_m_.emplace_back(robot_.estimated_base().x_m, robot_.estimated_base().y_m);
  keyframe_of_path_.push_back(last_keyframe());
}

std::size_t Navigator::last_keyframe() const {
  const std::size_t remembered = loops_ ? loops_->remembered().size() : 0;
  return remembered > 0 ? remembered - 1 : 0;
}

void Navigator::note_touched(const PathLeg& leg) {
  for (const Eigen::Vector2d& cell_m :
       cells_before(passages_->detail, leg, robot_.estimated_base(), passages_->robot)) {
    touched_.push_back({cell_m, last_keyframe()});
  }
}

void Navigator::block_touched() {
  for (const Touched& touched : touched_) {
    const Eigen::Array2i cell = passages_->detail.cell_at(touched.at_m);
    if (!passages_->detail.contains(cell)) continue;
    const std::size_t index = passages_->detail.index(cell);
    if (passages_->detail.blocked[index] == 0) detail()->blocked[index] = 1;
  }
}

PathField Navigator::ways_from(const Pose2& T_world_base) const {
  return make_path_field(floor_, T_world_base, options_, space());
}

DriveResult Navigator::drive_and_map(std::span<const Pose2> waypoints, double max_speed_m_s,
                                     const std::function<bool()>& is_blocked) {
  int tick = 0;
  turned_back_ = false;
  return robot_.drive_along(waypoints, max_speed_m_s, [&] {
    if (++tick % kTicksPerFloorScan != 0) return true;
    const bool located = localise();
    note_path_point();
    if (located && on_the_way) on_the_way();
    turned_back_ = may_go_on && !may_go_on();
    return !turned_back_ && !is_blocked();
  });
}

DriveResult Navigator::drive_open(const std::vector<Pose2>& waypoints) {
  return drive_and_map(waypoints, std::numeric_limits<double>::infinity(), [&] {
    return is_way_blocked(floor_, waypoints, robot_.estimated_base(), options_);
  });
}

DriveResult Navigator::drive_leg(const PathLeg& leg) {
  std::vector<Pose2> waypoints = leg.waypoints;
  waypoints.front() = robot_.estimated_base();
  if (!leg.narrow) return drive_open(waypoints);
  const DriveResult driven = drive_and_map(waypoints, passages_->options.speed_m_s, [&] {
    return is_passage_blocked(passages_->detail, leg, robot_.estimated_base(), passages_->robot);
  });
  if (driven.status != DriveStatus::stuck) return driven;
  note_touched(leg);
  return back_off(leg, driven);
}

/// The robot that got stuck goes back a little the way it came.
DriveResult Navigator::back_off(const PathLeg& leg, DriveResult driven) {
  const Pose2 base = robot_.estimated_base();
  const DriveResult back = drive_and_map(std::array{base, pose_behind(leg, base)},
                                         passages_->options.speed_m_s, [] { return false; });
  driven.path_length_m += back.path_length_m;
  driven.duration_s += back.duration_s;
  return driven;
}

/// One leg after the other, as far as it gets.
DriveResult Navigator::drive(const PlannedPath& path) {
  if (path.legs.empty()) return drive_open(path.waypoints);
  DriveResult result;
  for (const PathLeg& leg : path.legs) {
    const DriveResult driven = drive_leg(leg);
    result.status = driven.status;
    result.path_length_m += driven.path_length_m;
    result.duration_s += driven.duration_s;
    if (driven.status != DriveStatus::arrived) break;
  }
  return result;
}

Approach Navigator::approach(const Pose2& goal, const std::optional<Eigen::Vector2d>& look_at_m) {
  Approach result;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (int attempt = 0; attempt < kMaxPlans; ++attempt) {
    const auto field = plan();
    const PlannedPath path = centred(*field, plan_path(*field, goal, look_at_m));
    const double remaining_m = std::hypot(path.end.x_m - goal.x_m, path.end.y_m - goal.y_m);
    if (!path.reaches_goal && remaining_m > nearest_m - kProgress_m) return result;
    nearest_m = remaining_m;
    if (on_plan) on_plan(path);
    const std::size_t touched_before = touched_.size();
    const DriveResult driven = drive(path);
    result.path_length_m += driven.path_length_m;
    result.reached = driven.status == DriveStatus::arrived && path.reaches_goal;
    result.turned_back = turned_back_;
    const bool stuck = driven.status == DriveStatus::stuck && touched_.size() == touched_before;
    if (result.reached || turned_back_ || stuck) return result;
  }
  return result;
}

}  // namespace vantage
