#include "src/episode/tabletop_truth.hpp"

#include <algorithm>

namespace vantage {
namespace {

std::size_t count_unobserved(const OccupancyGrid& grid, const std::vector<std::uint8_t>& among) {
  std::size_t count = 0;
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    count += among[cell] != 0 && grid.state(cell) == CellState::unobserved ? 1 : 0;
  }
  return count;
}

}  // namespace

TabletopTruth::TabletopTruth(const World& world, const RayScene& geometry, const GridFrame& frame,
                             std::span<const Candidate> views, const FieldOfView& field_of_view,
                             int threads)
    : observable_(frame.size(), 0),
      surface_(surface_cells(world.model(), world.snapshot(), frame, kWithoutRobot)) {
  for (const Candidate& view : views) {
    visible_from_.push_back(
        visible_cells(geometry, frame, view.T_world_sensor, field_of_view, -1, threads));
    std::ranges::transform(observable_, visible_from_.back(), observable_.begin(),
                           [](auto a, auto b) { return a | b; });
  }
  observable_count_ = static_cast<std::size_t>(std::ranges::count(observable_, std::uint8_t{1}));
}

std::size_t TabletopTruth::observable_unobserved(const OccupancyGrid& grid) const {
  return count_unobserved(grid, observable_);
}

std::size_t TabletopTruth::true_new_cells(const OccupancyGrid& grid, int view_id) const {
  return count_unobserved(grid, visible_from_[static_cast<std::size_t>(view_id)]);
}

MapScore TabletopTruth::score(const OccupancyGrid& grid, int tolerance_cells) const {
  std::vector<std::uint8_t> occupied(grid.size());
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    occupied[cell] = grid.state(cell) == CellState::occupied ? 1 : 0;
  }
  return score_map(grid.frame, occupied, surface_, observable_, tolerance_cells);
}

}  // namespace vantage
