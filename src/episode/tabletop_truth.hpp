/// What is really on the table, for metrics and for the `oracle` upper bound alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planners/candidate.hpp"
#include "src/episode/cell_truth.hpp"

namespace vantage {

class TabletopTruth : public CellTruth {
 public:
  /// Observable cells: those that a noise-free sensor sees from at least one of `views`.
  TabletopTruth(const World& world, const RayScene& geometry, const GridFrame& frame,
                std::span<const Candidate> views, const FieldOfView& field_of_view, int threads);

  /// Unobserved cells that view `view_id` would really show.
  [[nodiscard]] std::size_t true_new_cells(const OccupancyGrid& grid, int view_id) const;

 private:
  std::vector<std::vector<std::uint8_t>> visible_from_;  ///< per view
};

}  // namespace vantage
