/// The gain of views on an OctoMap of any extent: only what they can reach becomes a grid.
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "vantage/belief/map/octomap_file.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/planners/candidate.hpp"
#include "vantage/planners/gain.hpp"
#include "vantage/planners/swept_gain.hpp"

namespace vantage {

/// What of a map counts: a box in the world. Outside it nothing is there to be seen, or in the way.
struct ScoredRegion {
  std::optional<std::array<double, 3>> min_m = {};
  std::optional<std::array<double, 3>> max_m = {};
  int coarsen = 1;
  void fields(auto&& f) {
    f("min_m", min_m,
      "lowest corner of the region in the map's frame; null: that of the known cells",
      between(-1e9, 1e9));
    f("max_m", max_m,
      "highest corner of the region in the map's frame; null: that of the known cells",
      between(-1e9, 1e9));
    f("coarsen", coarsen,
      "cells of the map per cell of the grid, along each axis; higher is faster and coarser",
      between(1, 1024));
  }
  [[nodiscard]] CellBlock cells(const OctomapFile& map) const;  ///< empty: none is inside
  [[nodiscard]] double cell_m(const OctomapFile& map) const { return coarsen * map.resolution_m(); }
};

/// Cells that scoring holds at once, about 1 GB.
inline constexpr double kMaxScoredCells = 33554432.0;

/// What scores views on a grid.
using GridGains =
    std::function<std::vector<double>(const OccupancyGrid& grid, std::span<const Candidate> views)>;

/// What `gains_on` finds of each view; 0 if it reaches no cell of the region. Its grids reach
/// `halo_cells` of their cells beyond the sensor's range.
/// @throws ConfigError if the sensor or the region is out of range, InputError if a single view
/// reaches over more than kMaxScoredCells.
std::vector<double> score_views(const OctomapFile& map, const ScoredRegion& region,
                                const GridGains& gains_on, std::span<const Candidate> views,
                                const FieldOfView& sensor, int halo_cells = 0);

/// Gain of each view, in bits or the unit the gain names; `gain` is one of planners/gain.hpp or of
/// your own. It is that on a grid of the whole region, whichever views are listed beside it. The
/// result does not depend on `threads` (at least 1).
template <ViewGain G>
std::vector<double> score_views(const OctomapFile& map, const ScoredRegion& region, const G& gain,
                                std::span<const Candidate> views, const FieldOfView& sensor,
                                int threads) {
  const auto gains_on = [&](const OccupancyGrid& grid, std::span<const Candidate> on_grid) {
    return view_gains_bits(gain, {grid}, on_grid, sensor, threads);
  };
  return score_views(map, region, gains_on, views, sensor, halo_cells(gain));
}

/// Of whichever gain was chosen, but for `adaptive`: a map tells nothing of the beams that were
/// stopped.
std::vector<double> score_views(const OctomapFile& map, const ScoredRegion& region,
                                const Gain& gain, std::span<const Candidate> views,
                                const FieldOfView& sensor, int threads);

}  // namespace vantage
