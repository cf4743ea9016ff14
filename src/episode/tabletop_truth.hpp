/// What is really there, for metrics and for the `oracle` upper bound alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planners/candidate.hpp"
#include "sim/ground_truth.hpp"
#include "sim/ray_scene.hpp"
#include "sim/world.hpp"
#include "src/belief/occupancy_grid.hpp"

namespace vantage {

class TabletopTruth {
 public:
  /// Observable cells: those that a noise-free sensor sees from at least one of `views`.
  TabletopTruth(const World& world, const RayScene& geometry, const GridFrame& frame,
                std::span<const Candidate> views, const FieldOfView& field_of_view, int threads);

  [[nodiscard]] std::size_t observable_cells() const { return observable_count_; }
  [[nodiscard]] std::size_t observable_unobserved(const OccupancyGrid& grid) const;
  /// Unobserved cells that view `view_id` would really show.
  [[nodiscard]] std::size_t true_new_cells(const OccupancyGrid& grid, int view_id) const;
  [[nodiscard]] MapScore score(const OccupancyGrid& grid, int tolerance_cells) const;

 private:
  std::vector<std::vector<std::uint8_t>> visible_from_;  ///< per view
  std::vector<std::uint8_t> observable_;
  std::vector<std::uint8_t> surface_;
  std::size_t observable_count_ = 0;
};

}  // namespace vantage
