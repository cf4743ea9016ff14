#include "vantage/planners/navigation/path_planning.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vantage/planners/navigation/narrow_path.hpp"

namespace vantage {
namespace {

using Points = std::vector<Eigen::Vector2d>;

/// Cost of driving straight from `from` to `to`; infinity if that leaves the traversable cells.
double straight_cost(const PathField& field, const Eigen::Vector2d& from,
                     const Eigen::Vector2d& to) {
  constexpr double kLayer = 0.5;
  const GridFrame frame = field.map.frame();
  const bool clear = walk_ray(frame, {from.x(), from.y(), kLayer}, {to.x(), to.y(), kLayer},
                              [&](std::size_t cell) { return field.traversable(cell); });
  if (!clear) return std::numeric_limits<double>::infinity();
  const double length_m = (to - from).norm();
  const int samples = 1 + static_cast<int>(2.0 * length_m / field.map.cell_m);
  double mean = 0.0;
  for (int i = 0; i < samples; ++i) {
    const Eigen::Vector2d p = from + (i + 0.5) / samples * (to - from);
    const Eigen::Array2i cell = field.map.cell_at(p);
    mean += field.cost_per_metre(field.map.index(cell)) / samples;
  }
  return length_m * mean;
}

/// From the start pose through the search tree to `p_end` in `last_cell`.
std::vector<PathStep> trace_back(const PathField& field, std::size_t last_cell,
                                 const Eigen::Vector2d& p_end) {
  std::vector<PathStep> steps;
  std::size_t at = last_cell;
  if (const auto heading_rad = field.heading_rad(last_cell)) {
    at = field.parent[last_cell];  // the robot stands where it fits, not where it was asked to
  } else {
    steps.push_back({p_end, std::nullopt});
    at = last_cell == field.start_cell ? PathField::kNone : field.parent[last_cell];
  }
  while (at != PathField::kNone && at != field.start_cell) {
    if (at < field.map.size()) {
      steps.push_back({field.map.centre(field.map.cell(at)), std::nullopt});
      at = field.parent[at];
    } else {
      const NarrowPose& narrow = field.narrow[at - field.map.size()];
      steps.push_back({position(narrow.pose), narrow.pose.yaw_rad});
      at = narrow.parent;
    }
  }
  const bool from_passage = !steps.empty() && steps.back().yaw_rad && at == PathField::kNone;
  if (!from_passage) steps.push_back({position(field.start), std::nullopt});
  std::ranges::reverse(steps);
  return steps;
}

PlannedPath with_headings(const PathField& field, const Points& points, double final_yaw_rad) {
  PlannedPath path;
  path.waypoints.push_back(field.start);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Eigen::Vector2d leg = points[i] - points[i - 1];
    path.length_m += leg.norm();
    path.waypoints.push_back({points[i].x(), points[i].y(), std::atan2(leg.y(), leg.x())});
  }
  path.waypoints.back().yaw_rad = final_yaw_rad;
  path.end = path.waypoints.back();
  return path;
}

double heading_towards(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  return std::atan2(to.y() - from.y(), to.x() - from.x());
}

/// The path from its point nearest to `p_m` on, as points at most `step_m` apart, over `length_m`.
Points way_ahead(std::span<const Pose2> waypoints, const Eigen::Vector2d& p_m, double step_m,
                 double length_m) {
  Points way;
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    const Eigen::Vector2d from = position(waypoints[i - 1]);
    const Eigen::Vector2d leg = position(waypoints[i]) - from;
    const int steps = 1 + static_cast<int>(leg.norm() / step_m);
    for (int k = 0; k <= steps; ++k) {
      way.emplace_back(from + static_cast<double>(k) / steps * leg);
      if ((way.back() - p_m).norm() < (way[nearest] - p_m).norm()) nearest = way.size() - 1;
    }
  }
  way.erase(way.begin(), way.begin() + static_cast<std::ptrdiff_t>(nearest));
  double gone_m = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    gone_m += (way[i] - way[i - 1]).norm();
    if (gone_m > length_m) way.resize(i);
  }
  return way;
}

}  // namespace

Points pull_straight(const PathField& field, const Points& points) {
  Points pulled{points.front()};
  for (std::size_t anchor = 0; anchor + 1 < points.size();) {
    std::size_t next = anchor + 1;
    double replaced = straight_cost(field, points[anchor], points[next]);
    while (next + 1 < points.size()) {
      replaced += straight_cost(field, points[next], points[next + 1]);
      // The slack forgives the sampling of the two costs.
      if (!(straight_cost(field, points[anchor], points[next + 1]) <= 1.01 * replaced)) break;
      if (!std::isfinite(replaced)) break;
      ++next;
    }
    pulled.push_back(points[next]);
    anchor = next;
  }
  return pulled;
}

bool is_way_blocked(const FloorMap& map, std::span<const Pose2> waypoints,
                    const Pose2& T_world_base, const NavigationOptions& options) {
  const Eigen::Vector2d p_base = position(T_world_base);
  const Points way = way_ahead(waypoints, p_base, map.cell_m, options.watch_m);
  if (way.empty() || options.watch_m == 0.0) return false;
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& p : way) box.extend(p);
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(options.footprint_radius_m);
  const Eigen::Array2i low = map.cell_at(box.min() - reach).max(0);
  const Eigen::Array2i high =
      map.cell_at(box.max() + reach).min(Eigen::Array2i(map.nx - 1, map.ny - 1));
  for (int y = low.y(); y <= high.y(); ++y) {
    for (int x = low.x(); x <= high.x(); ++x) {
      if (map.state(map.index({x, y})) != CellState::occupied) continue;
      const Eigen::Vector2d obstacle = map.centre({x, y});
      const double now_m = (obstacle - p_base).norm() - 0.5 * map.cell_m;
      const double limit_m = std::min(options.footprint_radius_m, now_m);
      if (std::ranges::any_of(way, [&](const auto& p) { return (p - obstacle).norm() < limit_m; }))
        return true;
    }
  }
  return false;
}

PlannedPath plan_path(const PathField& field, const Pose2& goal,
                      const std::optional<Eigen::Vector2d>& look_at_m) {
  const Eigen::Array2i goal_cell = field.map.cell_at(position(goal));
  const bool reaches_goal = field.reachable(position(goal));
  const std::optional<std::size_t> last =
      reaches_goal ? field.map.index(goal_cell) : nearest_reachable(field, position(goal));
  if (!last) return {.waypoints = {field.start}, .legs = {}, .end = field.start};
  Eigen::Vector2d p_end = position(goal);
  double final_yaw_rad = goal.yaw_rad;
  if (!reaches_goal) {
    p_end = field.map.centre(field.map.cell(*last));
    if (look_at_m) final_yaw_rad = heading_towards(p_end, *look_at_m);
  }
  const std::vector<PathStep> steps = trace_back(field, *last, p_end);
  PlannedPath path;
  if (std::ranges::any_of(steps, [](const PathStep& step) { return step.yaw_rad.has_value(); })) {
    path = path_through_passages(field, steps, final_yaw_rad);
  } else {
    Points points;
    for (const PathStep& step : steps) points.push_back(step.p_m);
    path = with_headings(field, pull_straight(field, points), final_yaw_rad);
  }
  path.reaches_goal = reaches_goal;
  return path;
}

double path_length_m(const PathField& field, const Pose2& goal) {
  if (!field.reachable(position(goal))) return std::numeric_limits<double>::infinity();
  return plan_path(field, goal).length_m;
}

}  // namespace vantage
