#include "vantage/tasks/exploration/office_exploration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "vantage/core/log.hpp"
#include "vantage/planners/choice/view_choice.hpp"
#include "vantage/planners/swept_gain.hpp"
#include "vantage/tasks/mapping/scan_summary.hpp"

namespace vantage {
namespace {

/// Of the base: where its middle was, this much round it was free.
constexpr double kInscribedRadius_m = 0.33;

Eigen::Vector2d place_of(const Pose& T_world_sweep) {
  return T_world_sweep.translation().head<2>();
}

void mark_disc(const FloorMap& floor, const Eigen::Vector2d& p_m, double radius_m,
               std::vector<std::uint8_t>& flags) {
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(radius_m);
  const Eigen::Array2i low = floor.cell_at(p_m - reach).max(0);
  const Eigen::Array2i high =
      floor.cell_at(p_m + reach).min(Eigen::Array2i(floor.nx - 1, floor.ny - 1));
  for (int y = low.y(); y <= high.y(); ++y) {
    for (int x = low.x(); x <= high.x(); ++x) {
      if ((floor.centre({x, y}) - p_m).norm() <= radius_m) flags[floor.index({x, y})] = 1;
    }
  }
}

}  // namespace

OfficeExploration::OfficeExploration(const ResolvedEpisode& resolved,
                                     ExplorationRobotInterface& robot, Recorder& recorder)
    : episode_(resolved.episode),
      robot_(robot),
      recorder_(recorder),
      belief_(episode_),
      truth_(episode_, robot, belief_.grid().frame),
      navigator_(episode_, robot,
                 ReferenceMap(episode_.registration, episode_.exploration.reference_novelty_m),
                 episode_.exploration.keyframe_m),
      traversed_(navigator_.floor().size(), 0),
      choice_rng_(Rng::stream(episode_.seed, "view choice")) {
  recorder_.set_panel([this] { return panel(); });
  navigator_.on_plan = [this](const PlannedPath& path) { recorder_.route(path.waypoints); };
  log_debug(fmt::format("{} cells are observable, from {} places", truth_.observable_cells(),
                        truth_.poses()));
}

OfficeObservation OfficeExploration::observe() {
  if (scans_.empty()) {
    const Pose2 start = robot_.estimated_base();
    mark_disc(navigator_.floor(), {start.x_m, start.y_m}, episode_.exploration.start_room_m,
              traversed_);
    navigator_.turn_in_place();
    predict(robot_.estimated_sweep());
  }
  const double start_s = robot_.world().time_s();
  auto observation = robot_.observe();
  current_.scan_time_s = robot_.world().time_s() - start_s;
  return observation;
}

void OfficeExploration::update(const OfficeObservation& observation) {
  const double start_s = wall_s();
  const OccupancyGrid before = belief_.grid();
  const Pose2 dead_reckoned = robot_.dead_reckoned_base();
  const BeliefUpdate report = belief_.update(observation, navigator_.reference_map());
  robot_.correct_pose(report.T_world_base);
  robot_.restart_dead_reckoning();
  navigator_.remember(observation.base_scan, report.T_world_base);
  block_floor();
  current_.map_time_s = wall_s() - start_s;
  current_.actual_new_cells = newly_observed(before, belief_.grid());
  current_.time_s = robot_.world().time_s();
  current_.registered = report.registered;
  measure_pose(robot_.truth(), dead_reckoned, report.T_world_base, current_);
  truth_.measure(belief_.grid(), episode_.metrics.tolerance_cells, current_);
  current_.T_world_sensor = to_se3(report.T_world_base) * robot_.T_base_sweep();
  if (!report.registered) {
    log_warning(fmt::format("scan {}: odometry kept, {}", scans_.size(), report.registration_note));
  }
}

/// What the camera saw of the room over the floor is in the robot's way too.
void OfficeExploration::block_floor() {
  const auto& path_m = navigator_.path_m();
  for (; path_traversed_ < path_m.size(); ++path_traversed_) {
    mark_disc(navigator_.floor(), path_m[path_traversed_], kInscribedRadius_m, traversed_);
  }
  block_columns(navigator_.floor(), belief_.grid(), traversed_, episode_.exploration.headroom);
}

void OfficeExploration::record() {
  const ExplorationOptions& options = episode_.exploration;
  scans_.push_back(std::exchange(current_, {}));
  const ScanRecord& scan = scans_.back();
  const bool poor = scan.actual_new_cells < options.poor_cells;
  visited_.add(place_of(scan.T_world_sensor),
               poor ? std::max(options.poor_m, options.taken_m) : options.taken_m);
  log_scan(scan, scans_.size() - 1);
  recorder_.scan(scan, scans_.size() - 1, belief_.grid());
  decision_start_s_ = wall_s();
  views_ = find_views();
  are_views_weighed_ = false;
  if (options.enough.scans > 0 && !views_.empty()) update_stopping_criterion();
}

/// Counts how often in a row the best view promised less than a share of what is known. Not asked
/// while scans show many times that: then there is more.
void OfficeExploration::update_stopping_criterion() {
  constexpr double kPlenty = 10.0;
  const double start_s = wall_s();
  const auto known = static_cast<double>(belief_.grid().size() - scans_.back().unobserved_cells);
  const double poor_cells = episode_.exploration.enough.share * known;
  if (scans_.back().actual_new_cells > kPlenty * poor_cells) {
    poor_promises_ = 0;
    return;
  }
  const auto promises = learnt_gains_bits(AdaptiveGain{});
  if (std::holds_alternative<AdaptiveGain>(episode_.gain)) {
    for (std::size_t i = 0; i < views_.size(); ++i) views_[i].gain_bits = promises[i];
    are_views_weighed_ = true;
  } else {
    decision_start_s_ += wall_s() - start_s;  // the method itself does not need it
  }
  poor_promises_ = std::ranges::max(promises) < poor_cells ? poor_promises_ + 1 : 0;
  if (is_enough()) log_info(fmt::format("explored: none of {} views is worth it", views_.size()));
}

bool OfficeExploration::is_enough() const {
  const int scans = episode_.exploration.enough.scans;
  return scans > 0 && poor_promises_ >= scans;
}

bool OfficeExploration::finished() const {
  return views_.empty() || static_cast<int>(scans_.size()) >= episode_.scans || is_enough();
}

/// The place nearest to each frontier where the robot can stand, the largest frontiers first.
std::vector<Candidate> OfficeExploration::find_views() {
  const ExplorationOptions& options = episode_.exploration;
  const PathField paths = navigator_.plan();
  VisitedPlaces proposed;
  std::vector<Candidate> views;
  for (const Frontier& frontier : find_frontiers(belief_.filled_grid(), options.frontiers)) {
    if (static_cast<int>(views.size()) == options.max_candidates) break;
    const Eigen::Vector2d wanted = frontier.p_m.head<2>();
    const auto cell = nearest_reachable(paths, wanted);
    if (!cell) break;
    const Eigen::Vector2d place = paths.map.centre(paths.map.cell(*cell));
    const Pose2 from = robot_.estimated_base();
    const Pose2 base{place.x(), place.y(), std::atan2(place.y() - from.y_m, place.x() - from.x_m)};
    Candidate view;
    view.id = static_cast<int>(views.size());
    view.T_world_sensor = to_se3(base) * robot_.T_base_sweep();
    const Eigen::Vector2d p_sweep = place_of(view.T_world_sensor);
    if (visited_.covers(p_sweep) || proposed.covers(p_sweep)) continue;
    view.reachable = (place - wanted).norm() <= options.reach_m;
    view.path_length_m =
        view.reachable ? path_length_m(paths, base) : std::numeric_limits<double>::infinity();
    proposed.add(p_sweep, options.taken_m);
    views.push_back(view);
  }
  return views;
}

std::vector<double> OfficeExploration::learnt_gains_bits(const Gain& gain) const {
  const BlockField transmission = belief_.hazard().transmission();
  return view_gains_bits(gain, {belief_.filled_grid(), &transmission}, views_, robot_.view_field(),
                         episode_.threads);
}

std::vector<Candidate> OfficeExploration::propose() { return views_; }

void OfficeExploration::score(std::vector<Candidate>& candidates) {
  if (!are_views_weighed_ && (weighs_gain(episode_.choice) || recorder_.logs_events())) {
    const auto gains = learnt_gains_bits(episode_.gain);
    for (std::size_t i = 0; i < candidates.size(); ++i) candidates[i].gain_bits = gains[i];
  }
  if (std::holds_alternative<OracleView>(episode_.choice)) {
    for (Candidate& candidate : candidates) {
      candidate.true_new_cells =
          static_cast<double>(truth_.true_new_cells(belief_.grid(), candidate.T_world_sensor));
    }
  }
}

std::size_t OfficeExploration::choose(const std::vector<Candidate>& candidates) {
  const std::size_t chosen = choose_view(episode_.choice, candidates, choice_rng_);
  current_.candidates = candidates.size();
  current_.plan_time_s = wall_s() - decision_start_s_;
  recorder_.decision(candidates, chosen);
  return chosen;
}

void OfficeExploration::act(const Candidate& candidate) {
  current_.chosen_view = candidate.id;
  visited_.add(place_of(candidate.T_world_sensor), episode_.exploration.taken_m);
  const Approach approach =
      navigator_.approach(robot_.base_for_sweep(candidate.T_world_sensor), std::nullopt);
  current_.path_length_m = approach.path_length_m;
  current_.fallback = !candidate.reachable || !approach.reached;
  if (approach.reached) {
    predict(candidate.T_world_sensor);
    return;
  }
  log_warning(
      fmt::format("view {} is out of reach: scanning from as near as possible", candidate.id));
  predict(robot_.estimated_sweep());  // of the place the scan will be taken from
}

void OfficeExploration::predict(const Pose& T_world_sweep) {
  const BlockField transmission = belief_.hazard().transmission();
  current_.predicted_cells = predicted_cells(episode_, {belief_.filled_grid(), &transmission},
                                             T_world_sweep, robot_.view_field());
}

MapPanelInput OfficeExploration::panel() const {
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
