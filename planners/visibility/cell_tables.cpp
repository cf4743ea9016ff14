#include "vantage/planners/visibility/cell_tables.hpp"

#include "vantage/core/error.hpp"
#include "vantage/information/discrete.hpp"

namespace vantage {
namespace {

/// `of(cell)` for every cell; most have never been measured, for them `unmeasured` is taken.
template <class Of>
std::vector<float> measured_cells(const OccupancyGrid& grid, float unmeasured, Of&& of) {
  std::vector<float> table(grid.size(), unmeasured);
  for (std::size_t cell = 0; cell < table.size(); ++cell) {
    if (grid.log_odds[cell] != 0.0F) table[cell] = static_cast<float>(of(cell));
  }
  return table;
}

}  // namespace

std::vector<CellState> cell_states(const OccupancyGrid& grid) {
  std::vector<CellState> states(grid.size());
  for (std::size_t cell = 0; cell < states.size(); ++cell) states[cell] = grid.state(cell);
  return states;
}

std::vector<float> cell_probabilities(const OccupancyGrid& grid) {
  return measured_cells(grid, 0.5F, [&](std::size_t cell) { return grid.p_occupied(cell); });
}

std::vector<float> cell_entropies_bits(const OccupancyGrid& grid) {
  return measured_cells(
      grid, 1.0F, [&](std::size_t cell) { return binary_entropy_bits(grid.p_occupied(cell)); });
}

std::vector<float> unobserved_entropies_bits(const OccupancyGrid& grid) {
  return measured_cells(grid, 1.0F, [&](std::size_t cell) {
    return grid.state(cell) == CellState::unobserved ? binary_entropy_bits(grid.p_occupied(cell))
                                                     : 0.0;
  });
}

std::vector<float> cell_transmissions(const OccupancyGrid& grid, const BlockField& unobserved) {
  expects((unobserved.layout.cells == grid.frame.cells).all(),
          "transmissions for a grid of this size");
  std::vector<float> table(grid.size());
  for (std::size_t cell = 0; cell < table.size(); ++cell) {
    switch (grid.state(cell)) {
      case CellState::free: table[cell] = 1.0F; break;
      case CellState::occupied: table[cell] = 0.0F; break;
      case CellState::unobserved:
        table[cell] = static_cast<float>(unobserved.at_cell(grid.frame.cell(cell)));
        break;
    }
  }
  return table;
}

std::vector<float> cell_opacities(const OccupancyGrid& grid, double opacity_unobserved) {
  const double prior_log_odds = log_odds_of(opacity_unobserved);
  return measured_cells(grid, static_cast<float>(opacity_unobserved), [&](std::size_t cell) {
    const auto evidence = static_cast<double>(grid.log_odds[cell]);
    const bool occupied = grid.state(cell) == CellState::occupied;
    return probability_of(occupied ? evidence : evidence + prior_log_odds);
  });
}

std::vector<float> beam_transmissions(const OccupancyGrid& grid, double opacity_unobserved) {
  std::vector<float> table = cell_opacities(grid, opacity_unobserved);
  for (std::size_t cell = 0; cell < table.size(); ++cell) {
    table[cell] = grid.state(cell) == CellState::occupied ? 0.0F : 1.0F - table[cell];
  }
  return table;
}

}  // namespace vantage
