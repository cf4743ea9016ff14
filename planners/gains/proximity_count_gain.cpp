#include "vantage/planners/gains/proximity_count_gain.hpp"

#include <utility>

#include "vantage/geometry/face_neighbours.hpp"

namespace vantage {

std::vector<int> steps_from_surface(const OccupancyGrid& grid, int max_steps) {
  std::vector<int> steps(grid.size(), 0);
  std::vector<std::size_t> reached;
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    if (grid.state(cell) == CellState::occupied) reached.push_back(cell);
  }
  for (int step = 1; step <= max_steps && !reached.empty(); ++step) {
    std::vector<std::size_t> next;
    const auto reach = [&](std::size_t cell) {
      if (steps[cell] == 0 && grid.state(cell) == CellState::unobserved) {
        steps[cell] = step;
        next.push_back(cell);
      }
      return false;
    };
    for (const std::size_t cell : reached) {
      any_face_neighbour(grid.frame, grid.frame.cell(cell), reach);
    }
    reached = std::move(next);
  }
  return steps;
}

CellTables ProximityCountGain::prepare(const GainContext& context) const {
  CellTables tables;
  tables.state = cell_states(context.grid);
  tables.utility.reserve(context.grid.size());
  for (const int d : steps_from_surface(context.grid, d_max_cells)) {
    tables.utility.push_back(d > 0 ? static_cast<float>(d_max_cells - d) : 0.0F);
  }
  return tables;
}

}  // namespace vantage
