#include "vantage/planners/views/space_beyond.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

namespace vantage {
namespace {

constexpr double kWall = 0.3;
constexpr double kUnknown = 0.5;

struct ColumnCounts {
  std::vector<int> occupied;
  std::vector<int> unobserved;
};

ColumnCounts count_columns(const OccupancyGrid& grid) {
  const auto columns = static_cast<std::size_t>(grid.frame.cells.x()) *
                       static_cast<std::size_t>(grid.frame.cells.y());
  ColumnCounts counts{std::vector<int>(columns, 0), std::vector<int>(columns, 0)};
  std::size_t cell = 0;
  for (int z = 0; z < grid.frame.cells.z(); ++z) {
    for (std::size_t column = 0; column < columns; ++column, ++cell) {
      const CellState state = grid.state(cell);
      counts.occupied[column] += state == CellState::occupied ? 1 : 0;
      counts.unobserved[column] += state == CellState::unobserved ? 1 : 0;
    }
  }
  return counts;
}

std::vector<ColumnState> states_of(const ColumnCounts& counts, int height) {
  std::vector<ColumnState> states(counts.occupied.size(), ColumnState::open);
  for (std::size_t column = 0; column < states.size(); ++column) {
    if (counts.occupied[column] >= kWall * height) {
      states[column] = ColumnState::wall;
    } else if (counts.unobserved[column] >= kUnknown * height) {
      states[column] = ColumnState::unknown;
    }
  }
  return states;
}

/// The floor plan of columns: neighbours along x and y.
struct Plan {
  const GridFrame& frame;

  template <class Visit>
  void for_each_neighbour(std::size_t column, Visit&& visit) const {
    const auto width = static_cast<std::size_t>(frame.cells.x());
    const auto depth = static_cast<std::size_t>(frame.cells.y());
    const std::size_t x = column % width;
    const std::size_t y = column / width;
    if (x > 0) visit(column - 1, frame.cell_size_m.x());
    if (x + 1 < width) visit(column + 1, frame.cell_size_m.x());
    if (y > 0) visit(column - width, frame.cell_size_m.y());
    if (y + 1 < depth) visit(column + width, frame.cell_size_m.y());
  }
};

/// A wall measured with noise has holes: its neighbours are closed too.
std::vector<std::uint8_t> closed_columns(const Plan& plan, const std::vector<ColumnState>& states) {
  std::vector<std::uint8_t> closed(states.size(), 0);
  for (std::size_t column = 0; column < states.size(); ++column) {
    if (states[column] != ColumnState::wall) continue;
    closed[column] = 1;
    plan.for_each_neighbour(column, [&](std::size_t beside, double) { closed[beside] = 1; });
  }
  return closed;
}

double seen_share(const ColumnCounts& counts, const std::vector<ColumnState>& states, int height) {
  double cells = 0.0;
  double unobserved = 0.0;
  for (std::size_t column = 0; column < states.size(); ++column) {
    if (states[column] != ColumnState::open) continue;
    cells += height;
    unobserved += counts.unobserved[column];
  }
  return cells > 0.0 ? 1.0 - unobserved / cells : 1.0;
}

}  // namespace

std::vector<ColumnState> column_states(const OccupancyGrid& grid) {
  return states_of(count_columns(grid), grid.frame.cells.z());
}

SpaceBeyond space_beyond(const OccupancyGrid& grid, std::span<const Eigen::Vector2d> places_m,
                         double reach_m) {
  const int height = grid.frame.cells.z();
  const ColumnCounts counts = count_columns(grid);
  const std::vector<ColumnState> states = states_of(counts, height);
  const Plan plan{grid.frame};
  const std::vector<std::uint8_t> closed = closed_columns(plan, states);

  std::vector<double> way_m(states.size(), std::numeric_limits<double>::infinity());
  std::vector<std::int32_t> nearest(states.size(), SpaceBeyond::kNone);
  using Entry = std::tuple<double, std::int32_t, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto offer = [&](std::size_t column, std::int32_t place, double from_m) {
    if (from_m >= way_m[column] || from_m > reach_m) return;
    way_m[column] = from_m;
    nearest[column] = place;
    queue.emplace(from_m, place, column);
  };
  for (std::size_t i = 0; i < places_m.size(); ++i) {
    const Eigen::Array3i cell =
        grid.frame.cell_at({places_m[i].x(), places_m[i].y(), grid.frame.box().center().z()});
    if (!grid.frame.contains(cell)) continue;
    offer(grid.frame.index({cell.x(), cell.y(), 0}), static_cast<std::int32_t>(i), 0.0);
  }
  while (!queue.empty()) {
    const auto [so_far_m, place, column] = queue.top();
    queue.pop();
    if (so_far_m > way_m[column]) continue;
    plan.for_each_neighbour(column,
                            [&, from_m = so_far_m, to = place](std::size_t beside, double step_m) {
                              if (closed[beside] == 0) offer(beside, to, from_m + step_m);
                            });
  }
  for (std::size_t column = 0; column < states.size(); ++column) {
    if (states[column] != ColumnState::unknown) nearest[column] = SpaceBeyond::kNone;
  }
  return {std::move(nearest), seen_share(counts, states, height)};
}

}  // namespace vantage
