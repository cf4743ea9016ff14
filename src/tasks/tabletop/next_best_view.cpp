#include "vantage/tasks/tabletop/next_best_view.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "vantage/core/log.hpp"
#include "vantage/planners/choice/view_choice.hpp"
#include "vantage/planners/swept_gain.hpp"
#include "vantage/planners/views/view_candidates.hpp"
#include "vantage/tasks/mapping/scan_summary.hpp"

namespace vantage {
namespace {

Eigen::Vector3d region_centre(const Episode& episode) {
  return {episode.map.centre_m[0], episode.map.centre_m[1], episode.map.centre_m[2]};
}

}  // namespace

NextBestView::NextBestView(const ResolvedEpisode& resolved, TabletopRobotInterface& robot,
                           Recorder& recorder)
    : episode_(resolved.episode),
      robot_(robot),
      recorder_(recorder),
      views_(ring_of_views(episode_.candidates, region_centre(episode_))),
      belief_(episode_),
      truth_(robot.world(), robot.true_geometry(), belief_.grid().frame, robot.view_field(),
             episode_.threads),
      navigator_(episode_, robot, ReferenceMap(episode_.registration)),
      choice_rng_(Rng::stream(episode_.seed, "view choice")) {
  const Eigen::AlignedBox3d region = belief_.grid().frame.box();
  block_box(navigator_.floor(), {region.min().head<2>(), region.max().head<2>()});
  std::vector<Pose> T_world_views;
  for (const Candidate& view : views_) T_world_views.push_back(view.T_world_sensor);
  truth_.add_observable(T_world_views);
  recorder_.set_panel([this] { return panel(); });
  navigator_.on_plan = [this](const PlannedPath& path) { recorder_.route(path.waypoints); };
  if (truth_.observable_cells() == 0) log_warning("map: none of the views sees any of its cells");
}

TabletopObservation NextBestView::observe() {
  if (scans_.empty()) {
    navigator_.turn_in_place();
    predict(robot_.estimated_laser());
  }
  const double start_s = robot_.world().time_s();
  auto observation = robot_.observe();
  current_.scan_time_s = robot_.world().time_s() - start_s;
  return observation;
}

void NextBestView::update(const TabletopObservation& observation) {
  const double start_s = wall_s();
  const OccupancyGrid before = belief_.grid();
  const Pose2 dead_reckoned = robot_.dead_reckoned_base();
  const BeliefUpdate report = belief_.update(observation, navigator_.reference_map());
  robot_.correct_pose(report.T_world_base);
  robot_.restart_dead_reckoning();
  block_table();
  navigator_.remember(observation.base_scan, report.T_world_base);
  current_.map_time_s = wall_s() - start_s;
  current_.actual_new_cells = newly_observed(before, belief_.grid());
  current_.time_s = robot_.world().time_s();
  current_.registered = report.registered;
  measure_pose(robot_.truth(), dead_reckoned, report.T_world_base, current_);
  truth_.measure(belief_.grid(), episode_.metrics.tolerance_cells, current_);
  current_.T_world_sensor = to_se3(report.T_world_base) * observation.T_base_laser;
  if (!report.registered) {
    log_warning(fmt::format("scan {}: odometry kept, {}", scans_.size(), report.registration_note));
  }
}

void NextBestView::record() {
  scans_.push_back(std::exchange(current_, {}));
  const ScanRecord& scan = scans_.back();
  log_scan(scan, scans_.size() - 1);
  recorder_.scan(scan, scans_.size() - 1, belief_.grid());
}

bool NextBestView::finished() const { return static_cast<int>(scans_.size()) >= episode_.scans; }

std::vector<Candidate> NextBestView::propose() {
  decision_start_s_ = wall_s();
  std::vector<Candidate> candidates = views_;
  const PathField paths = navigator_.plan();
  for (Candidate& candidate : candidates) {
    candidate.path_length_m = path_length_m(paths, robot_.base_for_view(candidate.T_world_sensor));
    candidate.reachable = std::isfinite(candidate.path_length_m);
  }
  return candidates;
}

void NextBestView::score(std::vector<Candidate>& candidates) {
  if (weighs_gain(episode_.choice) || recorder_.logs_events()) {
    const BlockField transmission = belief_.hazard().transmission();
    const auto gains = view_gains_bits(episode_.gain, {belief_.filled_grid(), &transmission},
                                       candidates, robot_.view_field(), episode_.threads);
    for (std::size_t i = 0; i < candidates.size(); ++i) candidates[i].gain_bits = gains[i];
  }
  if (std::holds_alternative<OracleView>(episode_.choice)) {
    for (Candidate& candidate : candidates) {
      candidate.true_new_cells =
          static_cast<double>(truth_.true_new_cells(belief_.grid(), candidate.T_world_sensor));
    }
  }
}

std::size_t NextBestView::choose(const std::vector<Candidate>& candidates) {
  const std::size_t chosen = choose_view(episode_.choice, candidates, choice_rng_);
  current_.candidates = candidates.size();
  current_.plan_time_s = wall_s() - decision_start_s_;
  recorder_.decision(candidates, chosen);
  return chosen;
}

void NextBestView::act(const Candidate& candidate) {
  current_.chosen_view = candidate.id;
  predict(candidate.T_world_sensor);
  const Approach approach = navigator_.approach(robot_.base_for_view(candidate.T_world_sensor),
                                                region_centre(episode_).head<2>());
  current_.path_length_m = approach.path_length_m;
  current_.fallback = !approach.reached;
  if (!current_.fallback) return;
  log_warning(
      fmt::format("view {} is out of reach: scanning from as near as possible", candidate.id));
  views_[static_cast<std::size_t>(candidate.id)].exhausted = true;
  predict(robot_.estimated_laser());  // of the place the scan will be taken from
}

void NextBestView::predict(const Pose& T_world_sensor) {
  const BlockField transmission = belief_.hazard().transmission();
  current_.predicted_cells = predicted_cells(episode_, {belief_.filled_grid(), &transmission},
                                             T_world_sensor, robot_.view_field());
}

/// The table's edge, as far as it was seen, is above the planar scanner's sight.
void NextBestView::block_table() {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& corner : belief_.table().hull) box.extend(corner);
  block_box(navigator_.floor(), box);
}

MapPanelInput NextBestView::panel() const {
  MapPanelInput input = panel_of_scans(episode_, scans_);
  input.grid = &belief_.grid();
  for (const Candidate& view : views_) input.T_world_candidates.push_back(view.T_world_sensor);
  if (current_.chosen_view >= 0) {
    const auto goal = static_cast<std::size_t>(current_.chosen_view);
    input.T_world_chosen.push_back(views_[goal].T_world_sensor);
  }
  input.T_world_base = robot_.estimated_base();
  input.path_m = navigator_.path_m();
  return input;
}

}  // namespace vantage
