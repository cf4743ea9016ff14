#include "vantage/tasks/exploration/exploration_parts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "vantage/core/log.hpp"
#include "vantage/planners/swept_gain.hpp"
#include "vantage/tasks/exploration/frontier_views.hpp"

namespace vantage {
namespace {

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
  return recorded_predictors(task, gains);
}

ExplorationParts::ExplorationParts(const MappingContext& context, const Exploration& task,
                                   ExplorationRobotInterface& robot, ExplorationBelief& belief)
    : MappingParts(context, task, belief, exploration_predictors(task),
                   Navigator(task.floor_map, task.navigation, task.odometry, robot,
                             ReferenceMap(task.registration, task.reference_novelty_m),
                             context.options.threads, task.keyframe_m),
                   kForecastsInRooms),
      task_(task),
      exploring_robot_(robot),
      belief_(belief),
      traversed_(navigator_.floor().size(), 0) {
  navigator_.use_passages(task_.passages, task_.floor_detail);
  if (const FloorMap* detail = navigator_.detail()) traversed_detail_.assign(detail->size(), 0);
  if (task.gaze.chooses()) partial_scans_ = PartialScans{robot.sweep_images(), task.gaze};
  if (task.localisation.loops.close) {
    navigator_.close_loops(task.localisation.loops, task.registration, task.odometry);
  }
  if (task.gaze.on_the_way_m > 0.0) navigator_.on_the_way = [this] { look_on_the_way(); };
}

/// The way home closes the last loop, of what was driven out.
void ExplorationParts::end() {
  navigator_.on_the_way = nullptr;  // nothing more is looked at
  MappingParts::end(explored().empty() ? views_ : std::vector<Candidate>{});
  if (const auto correction = navigator_.correct_over_loops()) correct_map(*correction, false);
  note_agreeing_loops();
}

/// The robot has been there, and in passages beside what it keeps a margin from: or what it sees of
/// the room beside a passage later would close the way back.
void ExplorationParts::traverse(const Eigen::Vector2d& p_m, double radius_m) {
  mark_disc(navigator_.floor(), p_m, radius_m, traversed_);
  if (const FloorMap* detail = navigator_.detail()) {
    const double beside_m = task_.passages.margin_m + detail->cell_m;
    mark_disc(*detail, p_m, radius_m + beside_m, traversed_detail_);
  }
}

void ExplorationParts::update(const ExplorationObservation& observation) {
  const Before before = before_update();
  const BeliefUpdate update =
      belief_.update(observation, navigator_.reference_map(), navigator_.plausible_correction());
  correct_pose(update);
  navigator_.remember(observation.base_scan, update.T_world_base);
  block_floor();
  measure(before, update, to_se3(update.T_world_base) * exploring_robot_.T_base_sweep());
  if (navigator_.loops() == nullptr) return;
  belief_.keep(observation, current_.keyframe);
  if (const auto correction = navigator_.correct_over_loops()) correct_map(*correction, true);
}

void ExplorationParts::correct_map(const PoseCorrection& correction, bool scanning) {
  belief_.reintegrate(correction.T_world_after);
  for (std::size_t i = 0; i < visited_.size(); ++i) {
    visited_.move(i, correction.moved(visited_.place(i), visited_at_[i]));
  }
  std::ranges::fill(traversed_, std::uint8_t{0});
  std::ranges::fill(traversed_detail_, std::uint8_t{0});
  traverse(p_start_m_, task_.start_room_m);
  path_traversed_ = 0;
  block_floor();
  correct_records(correction, exploring_robot_.T_base_sweep(), scanning);
}

void ExplorationParts::visit(const Eigen::Vector2d& p_m, double radius_m, bool missed) {
  visited_.add(p_m, radius_m, missed);
  const LoopClosing* loops = navigator_.loops();
  visited_at_.push_back(loops == nullptr ? 0 : loops->remembered().size() - 1);
}

/// What the camera saw of the room over the floor is in the robot's way too.
void ExplorationParts::block_floor() {
  const auto& path_m = navigator_.path_m();
  for (; path_traversed_ < path_m.size(); ++path_traversed_) {
    traverse(path_m[path_traversed_], robot_.inscribed_radius_m());
  }
  if (FloorMap* detail = navigator_.detail()) {
    block_columns({navigator_.floor(), traversed_}, {*detail, traversed_detail_}, belief_.grid(),
                  task_.headroom, robot_.base_scan_height_m());
  } else {
    block_columns(navigator_.floor(), belief_.grid(), traversed_, task_.headroom);
  }
}

void ExplorationParts::record() {
  const ScanRecord& scan = record_scan();
  const bool poor = !missed_images_ && scan.actual_new_cells < task_.poor_cells;
  visit(place_of(scan.T_world_sensor), poor ? std::max(task_.poor_m, task_.taken_m) : task_.taken_m,
        missed_images_);
  start_decision();
  views_ = find_views(plans_views(task_.choice));
  if (views_.empty() && visited_.reopen()) views_ = find_views(plans_views(task_.choice));
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
  const std::string reason = explored();
  return reason.empty() ? limit_reached(views_) : reason;
}

std::string ExplorationParts::explored() const {
  if (views_.empty()) return "no frontier is left that can be looked at from a new place in reach";
  const auto& left = scans_.back().left;
  if (left && left->confidence >= task_.stop.confidence) {
    return fmt::format("explored: {:.0f} % of what can be seen has been seen, {:.1f} % sure (stop)",
                       100.0 * task_.stop.share, 100.0 * left->confidence);
  }
  if (!is_enough()) return {};
  return fmt::format(
      "explored: {} in a row, no view promised more than {:g} % of what is known (enough.share)",
      task_.enough.scans, 100.0 * task_.enough.share);
}

/// A choice that knows all places there are looks from the frontiers all the same: its own map may
/// show no way to the next of those places before it does.
std::vector<Candidate> ExplorationParts::find_views(bool all) {
  const auto planned = navigator_.plan();
  const PathField& paths = *planned;
  std::vector<Candidate> views = views_of_truth(paths, true);
  std::erase_if(
      views, [&](const Candidate& view) { return visited_.covers(place_of(view.T_world_sensor)); });
  const std::vector<Candidate> of_frontiers =
      frontier_views(task_,
                     {.grid = belief_.filled_grid(),
                      .paths = paths,
                      .T_base_sweep = exploring_robot_.T_base_sweep(),
                      .visited = visited_},
                     all);
  views.insert(views.end(), of_frontiers.begin(), of_frontiers.end());
  for (std::size_t i = 0; i < views.size(); ++i) views[i].id = static_cast<int>(i);
  return views;
}

void ExplorationParts::act(const Candidate& candidate) {
  current_.chosen_view = candidate.id;
  visit(place_of(candidate.T_world_sensor), task_.taken_m);
  last_look_.reset();
  const Approach approached = approach(candidate, std::nullopt);
  if (last_look_) belief_.refill();
  current_.fallback = !candidate.reachable || !approached.reached;
  if (!approached.reached) warn_not_reached(candidate, approached);
  if (partial_scans_) return choose_images();
  // Of the place the scan will be taken from.
  predict(approached.reached ? candidate.T_world_sensor : robot_.estimated_sensor());
}

}  // namespace vantage
