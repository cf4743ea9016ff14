#include "src/episode/tabletop_truth.hpp"

#include <algorithm>
#include <utility>

namespace vantage {

TabletopTruth::TabletopTruth(const World& world, const RayScene& geometry, const GridFrame& frame,
                             std::span<const Candidate> views, const FieldOfView& field_of_view,
                             int threads)
    : CellTruth(world, frame) {
  std::vector<std::uint8_t> observable(frame.size(), 0);
  for (const Candidate& view : views) {
    visible_from_.push_back(
        visible_cells(geometry, frame, view.T_world_sensor, field_of_view, -1, threads));
    std::ranges::transform(observable, visible_from_.back(), observable.begin(),
                           [](auto a, auto b) { return a | b; });
  }
  set_observable(std::move(observable));
}

std::size_t TabletopTruth::true_new_cells(const OccupancyGrid& grid, int view_id) const {
  return count_unobserved(grid, visible_from_[static_cast<std::size_t>(view_id)]);
}

}  // namespace vantage
