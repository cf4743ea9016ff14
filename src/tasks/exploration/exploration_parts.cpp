#include "vantage/tasks/exploration/exploration_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "vantage/core/log.hpp"
#include "vantage/planners/swept_gain.hpp"

namespace vantage {
namespace {

/// A frontier so near to a candidate comes into sight from there.
constexpr double kNear_m = 1.5;

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

std::vector<Predictor> exploration_predictors(const Exploration& task) {
  std::vector<Gain> gains = cell_predictors();
  std::erase_if(gains, [](const Gain& gain) { return !can_sweep(gain); });
  return recorded_predictors(task, std::move(gains));
}

ExplorationParts::ExplorationParts(const MappingContext& context, const Exploration& task,
                                   ExplorationRobotInterface& robot, ExplorationBelief& belief)
    : MappingParts(context, task, belief, exploration_predictors(task),
                   Navigator(task.floor_map, task.navigation, task.odometry, robot,
                             ReferenceMap(task.registration, task.reference_novelty_m),
                             context.options.threads, task.keyframe_m)),
      task_(task),
      exploring_robot_(robot),
      belief_(belief),
      traversed_(navigator_.floor().size(), 0) {}

ExplorationObservation ExplorationParts::observe() {
  if (scans_.empty()) {
    const Pose2 start = robot_.estimated_base();
    mark_disc(navigator_.floor(), {start.x_m, start.y_m}, task_.start_room_m, traversed_);
    look_round_at_start();
  }
  return observed([this] { return exploring_robot_.observe(); });
}

void ExplorationParts::update(const ExplorationObservation& observation) {
  const Before before = before_update();
  const BeliefUpdate update =
      belief_.update(observation, navigator_.reference_map(), navigator_.plausible_correction());
  correct_pose(update);
  navigator_.remember(observation.base_scan, update.T_world_base);
  block_floor();
  measure(before, update, to_se3(update.T_world_base) * exploring_robot_.T_base_sweep());
}

/// What the camera saw of the room over the floor is in the robot's way too.
void ExplorationParts::block_floor() {
  const auto& path_m = navigator_.path_m();
  for (; path_traversed_ < path_m.size(); ++path_traversed_) {
    mark_disc(navigator_.floor(), path_m[path_traversed_], robot_.inscribed_radius_m(), traversed_);
  }
  block_columns(navigator_.floor(), belief_.grid(), traversed_, task_.headroom);
}

void ExplorationParts::record() {
  const ScanRecord& scan = record_scan();
  const bool poor = scan.actual_new_cells < task_.poor_cells;
  visited_.add(place_of(scan.T_world_sensor),
               poor ? std::max(task_.poor_m, task_.taken_m) : task_.taken_m);
  start_decision();
  views_ = find_views(plans_views(task_.choice));
  views_have_gains_ = false;
  if (task_.enough.scans > 0 && !views_.empty()) update_stopping_criterion();
  if (task_.stop.share > 0.0) judge_what_is_left();
}

/// By all candidates there are, whatever the choice looks at.
void ExplorationParts::judge_what_is_left() {
  const double start_s = wall_s();
  ScanRecord& scan = scans_.back();
  const auto known = static_cast<double>(belief_.grid().size() - scan.unobserved_cells);
  const auto views = find_views(true);
  LeftRecord left;
  if (!views.empty()) left.expected_cells = expected_left_cells(views);
  left.share = left_share(left.expected_cells, known);
  left.confidence = confidence_of_left(left.share, 1.0 - task_.stop.share);
  scan.left = left;
  decision_start_s_ += wall_s() - start_s;  // the method itself does not need it
}

/// Counts how often in a row the best view promised less than a share of what is known. Not asked
/// while scans show many times that: then there is more.
void ExplorationParts::update_stopping_criterion() {
  constexpr double kPlenty = 10.0;
  const double start_s = wall_s();
  const auto known = static_cast<double>(belief_.grid().size() - scans_.back().unobserved_cells);
  const double poor_cells = task_.enough.share * known;
  if (scans_.back().actual_new_cells > kPlenty * poor_cells) {
    poor_promises_ = 0;
    return;
  }
  const auto promises = gains_bits(AdaptiveGain{}, views_, episode_.threads);
  if (std::holds_alternative<AdaptiveGain>(task_.gain)) {
    for (std::size_t i = 0; i < views_.size(); ++i) views_[i].gain_bits = promises[i];
    views_have_gains_ = true;
  } else {
    decision_start_s_ += wall_s() - start_s;  // the method itself does not need it
  }
  poor_promises_ = std::ranges::max(promises) < poor_cells ? poor_promises_ + 1 : 0;
  if (is_enough()) log_info(fmt::format("explored: none of {} views is worth it", views_.size()));
}

bool ExplorationParts::is_enough() const {
  const int scans = task_.enough.scans;
  return scans > 0 && poor_promises_ >= scans;
}

std::string ExplorationParts::finished() const {
  if (views_.empty()) return "no frontier is left that can be looked at from a new place in reach";
  const auto& left = scans_.back().left;
  if (left && left->confidence >= task_.stop.confidence) {
    return fmt::format("explored: {:.0f} % of what can be seen has been seen, {:.1f} % sure (stop)",
                       100.0 * task_.stop.share, 100.0 * left->confidence);
  }
  if (!is_enough()) return limit_reached(views_);
  return fmt::format(
      "explored: {} in a row, no view promised more than {:g} % of what is known (enough.share)",
      task_.enough.scans, 100.0 * task_.enough.share);
}

/// The place nearest to each frontier where the robot can stand, the largest frontiers first. A
/// choice that plans ahead knows of all of them: those beyond max_candidates that are not near one
/// of these, where they come into sight, are candidates too.
std::vector<Candidate> ExplorationParts::find_views(bool all) {
  const PathField paths = navigator_.plan();
  VisitedPlaces proposed;
  VisitedPlaces near_proposed;
  std::vector<Candidate> views;
  for (const Frontier& frontier : find_frontiers(belief_.filled_grid(), task_.frontiers)) {
    const bool full = static_cast<int>(views.size()) >= task_.max_candidates;
    if (full && !all) break;
    const Eigen::Vector2d wanted = frontier.p_m.head<2>();
    const auto cell = nearest_reachable(paths, wanted);
    if (!cell) break;
    const Eigen::Vector2d place = paths.map.centre(paths.map.cell(*cell));
    const Pose2 from = robot_.estimated_base();
    const Pose2 base{place.x(), place.y(), std::atan2(place.y() - from.y_m, place.x() - from.x_m)};
    Candidate view;
    view.id = static_cast<int>(views.size());
    view.T_world_sensor = to_se3(base) * exploring_robot_.T_base_sweep();
    const Eigen::Vector2d p_sweep = place_of(view.T_world_sensor);
    if (visited_.covers(p_sweep) || proposed.covers(p_sweep)) continue;
    if (full && near_proposed.covers(p_sweep)) continue;
    view.reachable = (place - wanted).norm() <= task_.reach_m;
    view.path_length_m =
        view.reachable ? path_length_m(paths, base) : std::numeric_limits<double>::infinity();
    proposed.add(p_sweep, task_.taken_m);
    near_proposed.add(p_sweep, kNear_m);
    views.push_back(view);
  }
  return views;
}

void ExplorationParts::act(const Candidate& candidate) {
  current_.chosen_view = candidate.id;
  visited_.add(place_of(candidate.T_world_sensor), task_.taken_m);
  const bool reached = approach(candidate, std::nullopt).reached;
  current_.fallback = !candidate.reachable || !reached;
  if (reached) {
    predict(candidate.T_world_sensor);
    return;
  }
  warn_out_of_reach(candidate);
  predict(robot_.estimated_sensor());  // of the place the scan will be taken from
}

}  // namespace vantage
