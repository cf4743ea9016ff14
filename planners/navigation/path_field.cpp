#include "vantage/planners/navigation/path_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <queue>
#include <utility>

#include "vantage/core/cancellation/stop_poll.hpp"
#include "vantage/planners/navigation/distance_field.hpp"
#include "vantage/planners/navigation/narrow_search.hpp"

namespace vantage {
namespace {

constexpr std::array<std::pair<int, int>, 8> kSteps{
    {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};

/// Calls visit(neighbour, length in cells) for the steps from `cell` that stay on `open` cells; a
/// diagonal one needs both cells beside it.
template <class Open, class Visit>
void for_each_step(const FloorMap& map, std::size_t cell, Open&& open, Visit&& visit) {
  const Eigen::Array2i at = map.cell(cell);
  const auto passable = [&](int dx, int dy) {
    const Eigen::Array2i to = at + Eigen::Array2i(dx, dy);
    return map.contains(to) && open(map.index(to));
  };
  for (const auto& [dx, dy] : kSteps) {
    if (!passable(dx, dy)) continue;
    const bool diagonal = dx != 0 && dy != 0;
    if (diagonal && !(passable(dx, 0) && passable(0, dy))) continue;
    visit(map.index(at + Eigen::Array2i(dx, dy)), diagonal ? std::numbers::sqrt2 : 1.0);
  }
}

struct SearchTree {
  std::vector<double> cost;
  std::vector<std::size_t> parent;
};

/// Dijkstra from `source` (entered at `source_cost`) over `open` cells; step_cost(from, to) is per
/// metre. Stops at the first settled cell with done(cell, cost) and returns it, else kNone.
template <class Open, class StepCost, class Done>
std::size_t search(const FloorMap& map, std::size_t source, double source_cost, Open&& open,
                   StepCost&& step_cost, Done&& done, SearchTree& tree) {
  using Entry = std::pair<double, std::size_t>;  // ties by index: the same tree every time
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  tree.cost[source] = source_cost;
  queue.emplace(source_cost, source);
  for (std::size_t settled = 1; !queue.empty();) {
    const auto [cost, cell] = queue.top();
    queue.pop();
    if (cost > tree.cost[cell]) continue;
    if (settled++ % kNodesBetweenPolls == 0) poll_stop();
    if (done(cell, cost)) return cell;
    for_each_step(map, cell, open, [&, from = cell, base = cost](std::size_t to, double cells) {
      const double through = base + cells * map.cell_m * step_cost(from, to);
      if (through >= tree.cost[to]) return;
      tree.cost[to] = through;
      tree.parent[to] = from;
      queue.emplace(through, to);
    });
  }
  return PathField::kNone;
}

SearchTree empty_tree(std::size_t size) {
  return {std::vector<double>(size, kInfinity), std::vector<std::size_t>(size, PathField::kNone)};
}

/// The end of the shortest way out over cells with at least `clearance_m`, whose cells get their
/// parents in `field`.
std::size_t find_way_out(const FloorMap& map, float clearance_m, PathField& field) {
  SearchTree tree = empty_tree(map.size());
  double length_m = 0.0;
  const std::size_t entry = search(
      map, field.start_cell, 0.0,
      [&](std::size_t cell) {
        return map.state(cell) == CellState::free && field.clearance_m[cell] >= clearance_m;
      },
      [](std::size_t, std::size_t) { return 1.0; },
      [&](std::size_t cell, double cost) {
        length_m = cost;
        return field.traversable(cell) || cost > field.options.escape_radius_m;
      },
      tree);
  if (entry == PathField::kNone || length_m > field.options.escape_radius_m)
    return PathField::kNone;
  for (std::size_t cell = entry; cell != PathField::kNone; cell = tree.parent[cell]) {
    field.parent[cell] = tree.parent[cell];
  }
  field.cost[entry] = length_m * (1.0 + field.options.clearance_weight);
  return entry;
}

/// Where the search may begin: the robot's own cell, or a way out to a traversable one.
std::size_t find_entry(const FloorMap& map, PathField& field) {
  if (field.traversable(field.start_cell)) return field.start_cell;
  const std::size_t entry = find_way_out(map, field.clearance_m[field.start_cell], field);
  return entry != PathField::kNone ? entry : find_way_out(map, 0.0F, field);
}

void search_open_places(PathField& field) {
  const FloorMap& map = field.map;
  const std::size_t entry = find_entry(map, field);
  if (entry == PathField::kNone) return;
  SearchTree tree = empty_tree(map.size());
  tree.parent = field.parent;
  search(
      map, entry, entry == field.start_cell ? 0.0 : field.cost[entry],
      [&](std::size_t cell) { return field.traversable(cell); },
      [&](std::size_t from, std::size_t to) {
        return 0.5 * (field.cost_per_metre(from) + field.cost_per_metre(to));
      },
      [](std::size_t, double) { return false; }, tree);
  field.cost = std::move(tree.cost);
  field.parent = std::move(tree.parent);
}

/// Traversable cells that make an open place worth it.
std::size_t least_open_cells(const PathField& field) {
  if (field.space == nullptr) return 1;
  const double cells = field.space->options().least_area_m2 / (field.map.cell_m * field.map.cell_m);
  return static_cast<std::size_t>(std::max(1.0, std::ceil(cells)));
}

/// Whether the traversable cells about the robot are an open place that is worth it.
bool stands_in_the_open(const PathField& field) {
  const std::size_t least = least_open_cells(field);
  std::vector<std::uint8_t> met(field.map.size(), 0);
  std::vector<std::size_t> cells{field.start_cell};
  met[field.start_cell] = 1;
  for (std::size_t i = 0; i < cells.size() && cells.size() < least; ++i) {
    for_each_step(
        field.map, cells[i], [&](std::size_t to) { return field.traversable(to); },
        [&](std::size_t to, double) {
          if (std::exchange(met[to], std::uint8_t{1}) == 0) cells.push_back(to);
        });
  }
  return cells.size() >= least;
}

/// So near to something that it may not turn, as far as cells of the map tell, or in a place in
/// which it may, but that leads nowhere: a way out of there keeps its heading in mind.
bool stands_narrow(const PathField& field) {
  if (field.traversable(field.start_cell)) return !stands_in_the_open(field);
  const double off_m = 0.5 * std::numbers::sqrt2 * field.map.cell_m;
  return static_cast<double>(field.clearance_m[field.start_cell]) <
         field.space->circumscribed_m() + off_m;
}

void forget_ways(PathField& field) {
  SearchTree tree = empty_tree(field.map.size());
  field.cost = std::move(tree.cost);
  field.parent = std::move(tree.parent);
  field.narrow.clear();
  field.narrow_edges.clear();
}

void find_ways(PathField& field) {
  forget_ways(field);
  const Eigen::Vector2d start_m = position(field.start);
  const Eigen::Array2i start = field.map.cell_at(start_m);
  if (!field.map.contains(start)) return;
  field.start_cell = field.map.index(start);
  const bool narrow = field.space != nullptr && stands_narrow(field);
  if (narrow) search_passages(field);
  if (!narrow || !field.reaches_open_place()) {
    forget_ways(field);
    search_open_places(field);
    if (field.space != nullptr) search_passages(field);
  }
}

}  // namespace

bool PathField::traversable(std::size_t cell) const {
  return static_cast<double>(clearance_m[cell]) >= std::max(options.inflation_m(), 1e-9);
}

bool PathField::reachable(std::size_t cell) const { return cost[cell] < kInfinity; }

bool PathField::reachable(const Eigen::Vector2d& p_world) const {
  const Eigen::Array2i cell = map.cell_at(p_world);
  return map.contains(cell) && reachable(map.index(cell));
}

bool PathField::reaches_open_place() const {
  std::size_t left = least_open_cells(*this);
  for (std::size_t cell = 0; cell < cost.size() && left > 0; ++cell) {
    if (reachable(cell) && traversable(cell)) --left;
  }
  return left == 0;
}

double PathField::cost_per_metre(std::size_t cell) const {
  const double spare_m = static_cast<double>(clearance_m[cell]) - options.inflation_m();
  return 1.0 + options.clearance_weight * std::clamp(1.0 - spare_m / options.comfort_m, 0.0, 1.0);
}

std::optional<double> PathField::heading_rad(std::size_t cell) const {
  if (!reachable(cell) || parent[cell] == kNone || parent[cell] < map.size()) return std::nullopt;
  const NarrowPose& pose = narrow[parent[cell] - map.size()];
  return pose.cell == cell ? std::optional(pose.pose.yaw_rad) : std::nullopt;
}

PathField make_path_field(const FloorMap& map, const Pose2& T_world_base,
                          const NavigationOptions& options) {
  return make_path_field(map, T_world_base, options, nullptr);
}

PathField make_path_field(const FloorMap& map, const Pose2& T_world_base,
                          const NavigationOptions& options,
                          std::shared_ptr<const FootprintSpace> space) {
  check_options(options, "navigation");
  PathField field;
  field.map = map;
  field.options = options;
  field.start = T_world_base;
  field.clearance_m = clearances_m(map);
  field.space = std::move(space);
  find_ways(field);
  return field;
}

std::optional<std::size_t> nearest_reachable(const PathField& field,
                                             const Eigen::Vector2d& p_world) {
  std::optional<std::size_t> nearest;
  std::pair<double, double> best(kInfinity, kInfinity);
  for (std::size_t cell = 0; cell < field.cost.size(); ++cell) {
    if (!field.reachable(cell)) continue;
    const double distance2 = (field.map.centre(field.map.cell(cell)) - p_world).squaredNorm();
    const std::pair<double, double> rank(distance2, field.cost[cell]);
    if (rank >= best) continue;
    best = rank;
    nearest = cell;
  }
  return nearest;
}

}  // namespace vantage
