/// The gain of views on an OctoMap of any extent: only what they can reach becomes a grid.
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "vantage/belief/map/octomap_file.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/planners/candidate.hpp"
#include "vantage/planners/gain.hpp"

namespace vantage {

/// What of a map counts: a box in the world. Outside it nothing is there to be seen, or in the way.
struct ScoredRegion {
  std::optional<std::array<double, 3>> min_m = {};
  std::optional<std::array<double, 3>> max_m = {};
  int coarsen = 1;
  void fields(auto&& f) {
    f("min_m", min_m, "none: the lowest corner of the known cells", between(-1e9, 1e9));
    f("max_m", max_m, "none: their highest corner", between(-1e9, 1e9));
    f("coarsen", coarsen,
      "cells of the map per cell of the grid, each way; higher is faster, coarser",
      between(1, 1024));
  }
  [[nodiscard]] CellBlock cells(const OctomapFile& map) const;  ///< empty: none is inside
  [[nodiscard]] double cell_m(const OctomapFile& map) const { return coarsen * map.resolution_m(); }
};

/// Cells that scoring holds at once, about 1 GB.
inline constexpr double kMaxScoredCells = 33554432.0;

/// Gain of each view, in bits or the unit the gain names; 0 if it reaches no cell of the region.
/// The gain is not `adaptive`: a map tells nothing of the beams that were stopped. The result does
/// not depend on `threads` (at least 1).
/// @throws ConfigError if the sensor or the region is out of range, InputError if a single view
/// reaches over more than kMaxScoredCells.
std::vector<double> score_views(const OctomapFile& map, const ScoredRegion& region,
                                const Gain& gain, std::span<const Candidate> views,
                                const FieldOfView& sensor, int threads);

}  // namespace vantage
