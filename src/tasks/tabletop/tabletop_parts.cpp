#include "vantage/tasks/tabletop/tabletop_parts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "vantage/perception/clouds/usable_readings.hpp"

namespace vantage {
namespace {

/// Discards what says nothing. @return whether enough is left
/// @param last_line that came, of the scan before, then of this one
bool keep_usable(TabletopObservation& observation, std::vector<float>& last_line) {
  constexpr double kLeastLines = 0.1;  // of a scan
  RangeScan& scan = observation.scan;
  discard_unusable(observation.base_scan);
  discard_unusable(scan);
  discard_repeated_lines(scan, last_line);
  return share_of_valid_lines(scan) >= kLeastLines;
}

}  // namespace

std::vector<Candidate> tabletop_views(const Tabletop& task) {
  return ring_of_views(task.candidates, task.map.centre());
}

TabletopParts::TabletopParts(const MappingContext& context, const Tabletop& task,
                             TabletopRobotInterface& robot, TabletopBelief& belief)
    : MappingParts(context, task, belief, recorded_predictors(task, cell_predictors()),
                   Navigator(task.floor_map, task.navigation, task.odometry, robot,
                             ReferenceMap(task.registration), context.options.threads),
                   kForecastsAtTables),
      task_(task),
      tabletop_robot_(robot),
      belief_(belief) {
  views_ = tabletop_views(task_);
  const Eigen::AlignedBox3d region = belief_.grid().frame.box();
  block_box(navigator_.floor(), {region.min().head<2>(), region.max().head<2>()});
}

TabletopObservation TabletopParts::observe() {
  if (scans_.empty()) look_round_at_start();
  return observed([this] {
    return first_usable<TabletopObservation>([this](TabletopObservation& observation) {
      observation = tabletop_robot_.observe();
      return keep_usable(observation, last_line_);
    });
  });
}

void TabletopParts::update(const TabletopObservation& observation) {
  const Before before = before_update();
  const BeliefUpdate update =
      belief_.update(observation, navigator_.reference_map(), navigator_.plausible_correction());
  correct_pose(update);
  block_table();
  navigator_.remember(observation.base_scan, update.T_world_base);
  measure(before, update, to_se3(update.T_world_base) * observation.T_base_laser);
  if (goes_by_ways(task_.choice)) leave_view(update.T_world_base);
}

/// The one that was taken from there is no frontier any more.
void TabletopParts::leave_view(const Pose2& T_world_base) {
  constexpr double kSame_m = 0.1;
  constexpr double kSame_rad = 0.1;
  for (Candidate& view : views_) {
    const Pose2 base = robot_.base_for_sensor(view.T_world_sensor);
    const double off_m = std::hypot(base.x_m - T_world_base.x_m, base.y_m - T_world_base.y_m);
    const double turned_rad = std::abs(wrap_angle(base.yaw_rad - T_world_base.yaw_rad));
    const bool taken = off_m < kSame_m && turned_rad < kSame_rad;
    view.exhausted = view.exhausted || taken;
  }
}

std::string TabletopParts::finished() {
  return limit_reached(task_.budget.is_limited() ? reachable_views() : views_);
}

std::vector<Candidate> TabletopParts::propose() {
  start_decision();
  return reachable_views();
}

std::vector<Candidate> TabletopParts::reachable_views() {
  std::vector<Candidate> candidates = views_;
  const auto planned = navigator_.plan();
  const PathField& paths = *planned;
  for (Candidate& candidate : candidates) {
    candidate.path_length_m =
        path_length_m(paths, robot_.base_for_sensor(candidate.T_world_sensor));
    candidate.reachable = std::isfinite(candidate.path_length_m);
  }
  return candidates;
}

void TabletopParts::act(const Candidate& candidate) {
  current_.chosen_view = candidate.id;
  predict(candidate.T_world_sensor);
  const Approach approached = approach(candidate, Eigen::Vector2d(task_.map.centre().head<2>()));
  current_.fallback = !approached.reached;
  if (!current_.fallback) return;
  warn_not_reached(candidate, approached);
  if (!approached.turned_back) views_[static_cast<std::size_t>(candidate.id)].exhausted = true;
  predict(robot_.estimated_sensor());  // of the place the scan will be taken from
}

/// The table's edge, as far as it was seen, is above the planar scanner's sight.
void TabletopParts::block_table() {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& corner : belief_.table().hull) box.extend(corner);
  block_box(navigator_.floor(), box);
}

}  // namespace vantage
