#include "vantage/planners/choice/drawn_map.hpp"

#include <cmath>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

/// Whole cells only: what is left over at the far ends belongs to no coarse cell.
GridFrame coarser(const GridFrame& frame, int edge) {
  GridFrame coarse = frame;
  coarse.cell_size_m *= edge;
  coarse.cells = (frame.cells / edge).max(1);
  return coarse;
}

struct Counts {
  int cells = 0;
  int occupied = 0;
  int unobserved = 0;
};

Counts count_states(const OccupancyGrid& grid, const Eigen::Array3i& first, int edge) {
  Counts counts;
  const Eigen::Array3i end = (first + edge).min(grid.frame.cells);
  counts.cells = (end - first).prod();
  for (int z = first.z(); z < end.z(); ++z) {
    for (int y = first.y(); y < end.y(); ++y) {
      for (int x = first.x(); x < end.x(); ++x) {
        const CellState state = grid.state(grid.frame.index({x, y, z}));
        counts.occupied += state == CellState::occupied ? 1 : 0;
        counts.unobserved += state == CellState::unobserved ? 1 : 0;
      }
    }
  }
  return counts;
}

}  // namespace

DrawableMap::DrawableMap(const GainContext& map, int edge)
    : grid_(coarser(map.grid.frame, edge)),
      p_opaque_(grid_.size(), 0.0F),
      cells_in_each_(map.grid.frame.cells.min(edge).prod()) {
  expects(map.transmission != nullptr, "what is known of transmission");
  constexpr float kKnown = 4.0F;
  for (std::size_t cell = 0; cell < grid_.size(); ++cell) {
    const Eigen::Array3i first = grid_.frame.cell(cell) * edge;
    const Counts counts = count_states(map.grid, first, edge);
    const bool unobserved = counts.occupied == 0 && 2 * counts.unobserved >= counts.cells;
    grid_.log_odds[cell] = counts.occupied > 0 ? kKnown : (unobserved ? 0.0F : -kKnown);
    if (!unobserved) continue;
    const double passes = std::pow(map.transmission->at_cell(first), edge);
    p_opaque_[cell] = static_cast<float>(1.0 - passes);
  }
}

Attenuation DrawableMap::draw(Rng& rng) const {
  Attenuation drawn{
      .transmission = {{grid_.frame.cells, grid_.frame.cells}, std::vector<double>(grid_.size())},
      .utility = cells_in_each_,
      .by_entropy = false};
  for (std::size_t cell = 0; cell < grid_.size(); ++cell) {
    const bool opaque =
        p_opaque_[cell] > 0.0F && rng.uniform() < static_cast<double>(p_opaque_[cell]);
    drawn.transmission.per_block[cell] = opaque ? 0.0 : 1.0;
  }
  return drawn;
}

}  // namespace vantage
