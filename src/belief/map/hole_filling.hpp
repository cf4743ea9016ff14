/// Closes pinholes in surfaces: cells no beam hit, between cells that are occupied.
#pragma once

#include <cstddef>
#include <vector>

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/core/fields.hpp"

namespace vantage {

/// Markov random field over the cells that are not free, hidden s and observed o in {-1 unobserved,
/// +1 occupied}, N(s) the 6-neighbourhood:  [Potthast2016, 3.2.4]
///
///   E(S, O) = -smoothness_weight sum_s sum_{z in N(s)} s z - data_weight sum_s s o
///
/// The double sum counts each pair of neighbours twice, as printed.
struct HoleFilling {
  double data_weight = 1.0;
  double smoothness_weight = 1.0;
  int max_passes = 100;
  double p_occupied_filled = 0.7;
  void fields(auto&& f) {
    f("data_weight", data_weight,
      "weight of agreement with what was observed (alpha); higher keeps more cells as observed",
      at_least(0.0));
    f("smoothness_weight", smoothness_weight,
      "weight of agreement with neighbouring cells (beta); higher fills more", at_least(0.0));
    f("max_passes", max_passes,
      "greatest number of passes over the grid, which only pathological grids reach", at_least(1));
    f("p_occupied_filled", p_occupied_filled,
      "p(occupied) of a filled cell; higher makes it harder to carve away", between(0.61, 0.999));
  }
};

struct FilledGrid {
  OccupancyGrid grid;            ///< copy of the input with the holes filled
  std::size_t filled_cells = 0;  ///< hidden nodes that ended at +1 though observed -1
  int passes = 0;                ///< the last one, which changed nothing, included
  bool converged = false;        ///< false if max_passes stopped it
  std::vector<double> energy;    ///< E before the first pass and after each pass; never rises
};

/// Iterated conditional modes [Besag1986] in index order; only nodes observed -1 may flip; stops
/// when a whole pass changes nothing. Free cells take no part.
/// @throws ConfigError if `options` are out of range.
FilledGrid fill_holes(const OccupancyGrid& grid, const HoleFilling& options);

}  // namespace vantage
