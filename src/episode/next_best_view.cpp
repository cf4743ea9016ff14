#include "src/episode/next_best_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "planners/exact_gain.hpp"
#include "planners/swept_gain.hpp"
#include "planners/view_candidates.hpp"
#include "planners/view_choice.hpp"
#include "src/core/log.hpp"

namespace vantage {
namespace {

/// How often the planar scanner adds to the floor map while driving.
constexpr int kTicksPerFloorScan = 10;
/// Plans towards one view before it counts as out of reach: the floor map grows on the way.
constexpr int kMostPlans = 12;
constexpr double kProgress_m = 0.05;
/// Of the base, 0.668 m square: what it stands on is free.
constexpr double kInscribedRadius_m = 0.33;

Eigen::Vector3d region_centre(const Episode& episode) {
  return {episode.map.centre_m[0], episode.map.centre_m[1], episode.map.centre_m[2]};
}

double newly_observed(const OccupancyGrid& before, const OccupancyGrid& after) {
  std::size_t count = 0;
  for (std::size_t cell = 0; cell < before.size(); ++cell) {
    count +=
        before.state(cell) == CellState::unobserved && after.state(cell) != CellState::unobserved
            ? 1
            : 0;
  }
  return static_cast<double>(count);
}

double predicted_by(const ScanRecord& scan, std::string_view gain) {
  const auto found =
      std::ranges::find(scan.predicted_cells, gain, &std::pair<std::string, double>::first);
  return found == scan.predicted_cells.end() ? std::numeric_limits<double>::quiet_NaN()
                                             : found->second;
}

}  // namespace

NextBestView::NextBestView(const ResolvedEpisode& resolved, TabletopRig& rig, Recorder& recorder)
    : episode_(resolved.episode),
      rig_(rig),
      recorder_(recorder),
      views_(ring_of_views(episode_.candidates, region_centre(episode_))),
      belief_(episode_),
      truth_(rig.world(), rig.true_geometry(), belief_.grid().frame, views_, rig.view_field(),
             episode_.threads),
      floor_(make_floor_map(episode_.floor_map)),
      choice_rng_(Rng::stream(episode_.seed, "view choice")) {
  const Eigen::AlignedBox3d region = belief_.grid().frame.box();
  block_box(floor_, {region.min().head<2>(), region.max().head<2>()});
  recorder_.set_panel([this] { return panel(); });
  if (truth_.observable_cells() == 0) log_warning("map: none of the views sees any of its cells");
}

TabletopObservation NextBestView::observe() {
  if (scans_.empty()) {
    look_round();
    predict(rig_.estimated_laser());
  }
  const double start_s = rig_.world().time_s();
  auto observation = rig_.observe();
  current_.scan_time_s = rig_.world().time_s() - start_s;
  return observation;
}

void NextBestView::update(const TabletopObservation& observation) {
  const double start_s = wall_s();
  const OccupancyGrid before = belief_.grid();
  const Pose2 dead_reckoned = rig_.dead_reckoned_base();
  const BeliefUpdate report = belief_.update(observation);
  rig_.correct_pose(report.T_world_base);
  rig_.restart_dead_reckoning();
  block_table();
  add_planar_scan(floor_, observation.base_scan, report.T_world_base, episode_.floor_map);
  current_.map_time_s = wall_s() - start_s;
  current_.actual_new_cells = newly_observed(before, belief_.grid());
  measure(dead_reckoned, report);
  current_.T_world_sensor = lift(report.T_world_base) * observation.T_base_laser;
  if (!report.registered) {
    log_warning(fmt::format("scan {}: odometry kept, {}", scans_.size(), report.registration_note));
  }
}

/// Holds the belief against the truth, for the record alone.
void NextBestView::measure(const Pose2& dead_reckoned, const BeliefUpdate& report) {
  const OccupancyGrid& grid = belief_.grid();
  const RigTruth truth = rig_.truth();
  const auto error_m = [&](const Pose2& pose) {
    return std::hypot(pose.x_m - truth.T_world_base.x_m, pose.y_m - truth.T_world_base.y_m);
  };
  const MapScore score = truth_.score(grid, episode_.metrics.tolerance_cells);
  current_.time_s = rig_.world().time_s();
  current_.unobserved_cells = grid.count(CellState::unobserved);
  current_.observable_unobserved_cells = truth_.observable_unobserved(grid);
  current_.pose_error_before_registration_m = error_m(dead_reckoned);
  current_.pose_error_m = error_m(report.T_world_base);
  current_.yaw_error_rad = wrap_angle(report.T_world_base.yaw_rad - truth.T_world_base.yaw_rad);
  current_.registered = report.registered;
  current_.collisions = truth.collisions;
  current_.precision = score.precision;
  current_.recall = score.recall;
}

void NextBestView::record() {
  scans_.push_back(std::exchange(current_, {}));
  const ScanRecord& scan = scans_.back();
  log_debug(fmt::format(
      "scan {}: view {}{}, {} new cells, {} observable left, pose error {:.1f} mm",
      scans_.size() - 1, scan.chosen_view, scan.fallback ? " (fallback)" : "",
      scan.actual_new_cells, scan.observable_unobserved_cells, 1e3 * scan.pose_error_m));
  recorder_.scan(scans_.back(), scans_.size() - 1, belief_.grid());
}

bool NextBestView::finished() const { return static_cast<int>(scans_.size()) >= episode_.scans; }

std::vector<Candidate> NextBestView::propose() {
  decision_start_s_ = wall_s();
  std::vector<Candidate> candidates = views_;
  const PathField paths = plan_from_here();
  for (Candidate& candidate : candidates) {
    candidate.path_length_m = path_length_m(paths, rig_.base_for_view(candidate.T_world_sensor));
    candidate.reachable = std::isfinite(candidate.path_length_m);
  }
  return candidates;
}

void NextBestView::score(std::vector<Candidate>& candidates) {
  const auto transmission = belief_.hazard().transmission_per_slice();
  const auto gains = view_gains_bits(episode_.gain, {belief_.filled_grid(), transmission},
                                     candidates, rig_.view_field(), episode_.threads);
  for (std::size_t i = 0; i < candidates.size(); ++i) candidates[i].gain_bits = gains[i];
  if (std::holds_alternative<OracleView>(episode_.choice)) {
    for (Candidate& candidate : candidates) {
      candidate.true_new_cells =
          static_cast<double>(truth_.true_new_cells(belief_.grid(), candidate.id));
    }
  }
}

std::size_t NextBestView::choose(const std::vector<Candidate>& candidates) {
  const std::size_t chosen = choose_view(episode_.choice, candidates, choice_rng_);
  current_.candidates = candidates.size();
  current_.plan_time_s = wall_s() - decision_start_s_;
  return chosen;
}

void NextBestView::act(const Candidate& candidate) {
  current_.chosen_view = candidate.id;
  predict(candidate.T_world_sensor);
  current_.fallback = !drive_closer(candidate);
  if (!current_.fallback) return;
  log_warning(
      fmt::format("view {} is out of reach: scanning from as near as possible", candidate.id));
  views_[static_cast<std::size_t>(candidate.id)].exhausted = true;
  predict(rig_.estimated_laser());  // of the place the scan will be taken from
}

/// How many new cells every gain that counts them expects of the view, for the record.
void NextBestView::predict(const Pose& T_world_sensor) {
  current_.predicted_cells.clear();
  const auto transmission = belief_.hazard().transmission_per_slice();
  for (const std::string_view name : cell_predictors()) {
    const auto gain =
        name == strategy_name_of(episode_.gain) ? episode_.gain : make_strategy<Gain>(name);
    current_.predicted_cells.emplace_back(
        name, exact_gain_bits(gain, {belief_.filled_grid(), transmission}, T_world_sensor,
                              rig_.view_field()));
  }
}

/// Turns once in place, to know the floor on all sides: the scanner does not see behind the robot.
/// Whoever starts the robot gives it room for that.
void NextBestView::look_round() {
  const NavigationOptions& navigation = episode_.navigation;
  const Pose2 start = rig_.estimated_base();
  clear_footprint(floor_, start, navigation.inflation_m() + floor_.cell_m);
  belief_.remember_walls(rig_.look_around(), rig_.base_scan_height_m(), start);
  for (int third = 1; third <= 3; ++third) {
    const double yaw_rad = start.yaw_rad + 2.0 / 3.0 * std::numbers::pi * third;
    drive_and_map({{start.x_m, start.y_m, wrap_angle(yaw_rad)}});
    localise();
    belief_.remember_walls(rig_.look_around(), rig_.base_scan_height_m(), rig_.estimated_base());
  }
}

/// Corrects dead reckoning by the planar scanner and adds the scan to the floor map.
void NextBestView::localise() {
  const PlanarScan scan = rig_.look_around();
  rig_.correct_pose(belief_.localise(scan, rig_.base_scan_height_m(), rig_.estimated_base()));
  add_planar_scan(floor_, scan, rig_.estimated_base(), episode_.floor_map);
}

/// The table's edge, as far as it was seen, is above the planar scanner's sight.
void NextBestView::block_table() {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& corner : belief_.table().hull) box.extend(corner);
  block_box(floor_, box);
}

PathField NextBestView::plan_from_here() {
  clear_footprint(floor_, rig_.estimated_base(), kInscribedRadius_m);
  return make_path_field(floor_, rig_.estimated_base(), episode_.navigation);
}

DriveResult NextBestView::drive_and_map(const std::vector<Pose2>& waypoints) {
  int tick = 0;
  return rig_.drive_along(waypoints, [&] {
    if (++tick % kTicksPerFloorScan != 0) return;
    localise();
    path_m_.emplace_back(rig_.estimated_base().x_m, rig_.estimated_base().y_m);
  });
}

/// Drives to the view, or as near as the known free floor allows; plans again as the floor map
/// grows.
/// @return whether the view was reached.
bool NextBestView::drive_closer(const Candidate& candidate) {
  const Pose2 goal = rig_.base_for_view(candidate.T_world_sensor);
  double nearest_m = std::numeric_limits<double>::infinity();
  for (int attempt = 0; attempt < kMostPlans; ++attempt) {
    const PlannedPath path = plan_path(plan_from_here(), goal, region_centre(episode_).head<2>());
    const double remaining_m = std::hypot(path.end.x_m - goal.x_m, path.end.y_m - goal.y_m);
    if (!path.reaches_goal && remaining_m > nearest_m - kProgress_m) return false;
    nearest_m = remaining_m;
    const DriveResult drive = drive_and_map(path.waypoints);
    current_.path_length_m += drive.path_length_m;
    if (drive.status == DriveStatus::arrived && path.reaches_goal) return true;
    if (drive.status == DriveStatus::stuck) return false;
  }
  return false;
}

MapPanelInput NextBestView::panel() const {
  MapPanelInput input;
  input.grid = &belief_.grid();
  for (const Candidate& view : views_) input.T_world_candidates.push_back(view.T_world_sensor);
  for (const ScanRecord& scan : scans_) {
    input.T_world_chosen.push_back(scan.T_world_sensor);
    input.observable_unobserved_cells.push_back(
        static_cast<double>(scan.observable_unobserved_cells));
  }
  if (current_.chosen_view >= 0) {
    const auto goal = static_cast<std::size_t>(current_.chosen_view);
    input.T_world_chosen.push_back(views_[goal].T_world_sensor);
  }
  input.T_world_base = rig_.estimated_base();
  input.path_m = path_m_;
  input.scans_planned = episode_.scans;
  input.method = method_name(episode_);
  if (!scans_.empty()) {
    input.predicted_new_cells = predicted_by(scans_.back(), strategy_name_of(episode_.gain));
    input.actual_new_cells = scans_.back().actual_new_cells;
  }
  return input;
}

}  // namespace vantage
