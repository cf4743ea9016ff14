#include "vantage/tasks/exploration/frontier_views.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vantage/planners/navigation/path_planning.hpp"
#include "vantage/tasks/exploration/outlooks.hpp"

namespace vantage {
namespace {

/// A frontier so near to a candidate comes into sight from there.
constexpr double kNear_m = 1.5;

/// Nothing that the robot has met stands between the two.
bool sees_across(const FloorMap& floor, const Eigen::Vector2d& a_m, const Eigen::Vector2d& b_m) {
  const double length_m = (b_m - a_m).norm();
  const int steps = 1 + static_cast<int>(2.0 * length_m / floor.cell_m);
  for (int i = 0; i <= steps; ++i) {
    if (floor.state_at(a_m + (b_m - a_m) * i / steps) == CellState::occupied) return false;
  }
  return true;
}

/// At a cell that is reachable.
Pose2 base_at(const PathField& paths, std::size_t cell) {
  const Eigen::Vector2d place = paths.map.centre(paths.map.cell(cell));
  const Pose2& from = paths.start;
  const double yaw_rad =
      paths.heading_rad(cell).value_or(std::atan2(place.y() - from.y_m, place.x() - from.x_m));
  return {place.x(), place.y(), yaw_rad};
}

/// On the way there, or where that was looked from already, the nearest, if through a wall.
std::optional<Pose2> base_towards(const FrontierViewInput& input, const Outlooks& outlooks,
                                  const Eigen::Vector2d& p_m) {
  const auto on_the_way = outlooks.towards(p_m);
  if (!on_the_way) return std::nullopt;
  const Pose2 base = base_at(input.paths, *on_the_way);
  const Pose T_world_sweep = to_se3(base) * input.T_base_sweep;
  if (!input.visited.covers(T_world_sweep.translation().head<2>())) return base;
  return base_at(input.paths, *nearest_reachable(input.paths, p_m));
}

}  // namespace

std::vector<Candidate> frontier_views(const Exploration& task, const FrontierViewInput& input,
                                      bool all) {
  const Outlooks outlooks(input.paths);
  VisitedPlaces proposed;
  std::vector<Candidate> views;
  for (const Frontier& frontier : find_frontiers(input.grid, task.frontiers)) {
    const bool full = static_cast<int>(views.size()) >= task.max_candidates;
    if (full && !all) break;
    const Eigen::Vector2d wanted = frontier.p_m.head<2>();
    const auto base = base_towards(input, outlooks, wanted);
    if (!base) break;
    Candidate view;
    view.id = static_cast<int>(views.size());
    view.T_world_sensor = to_se3(*base) * input.T_base_sweep;
    const Eigen::Vector2d p_sweep = view.T_world_sensor.translation().head<2>();
    if (input.visited.covers(p_sweep) || proposed.covers(p_sweep)) continue;
    const auto shows_it = [&](const Candidate& other) {
      const Eigen::Vector2d p_other = other.T_world_sensor.translation().head<2>();
      return (p_other - p_sweep).norm() < kNear_m && sees_across(input.paths.map, p_other, p_sweep);
    };
    if (full && std::ranges::any_of(views, shows_it)) continue;
    view.reachable = all || (position(*base) - wanted).norm() <= task.reach_m;
    view.path_length_m = view.reachable ? path_length_m(input.paths, *base)
                                        : std::numeric_limits<double>::infinity();
    proposed.add(p_sweep, task.taken_m);
    views.push_back(view);
  }
  return views;
}

}  // namespace vantage
