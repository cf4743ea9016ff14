/// The inner loops of the visibility sweep: rows of cells, in single precision. They are compiled
/// for AVX2 as well and dispatched at run time; both give the same bits.
#pragma once

#include "vantage/geometry/view_cone.hpp"
#include "vantage/planners/visibility/sweep_tables.hpp"

namespace vantage {

/// out[j] = (1 - fraction) a[j] + fraction b[j] for j in [begin, end).
void blend_rows(const float* a, const float* b, float fraction, int begin, int end, float* out);

/// A lower transmittance counts as 0: interpolation leaks a trace behind every edge.
inline constexpr float kDark = 0.002F;

/// A row of cells and what stands between it and the layer before; arrays are indexed by the place
/// i along the row.
struct SweepRow {
  const float* arriving;        ///< transmittance up to the layer before, blended to this row
  const float* cells;           ///< of this row, as SweepTables::layers has them
  const float* straight;        ///< of the layer before, right before this row
  const float* slanted;         ///< of the layer before, in the row the rays come through
  const float* straight_depth;  ///< optical depth of the cells there, were they unobserved
  const float* slanted_depth;   ///< likewise
  float source = 0.0F;          ///< place of the sensor along the row, cells
  float depth = 1.0F;           ///< layers from the sensor to this one, >= 1
  float across = 0.0F;          ///< cells that the rays move across the rows, per layer
};

/// For i in [begin, end), all with floor((source - i) / depth) == shift: the transmittance, taken
/// where the ray from the sensor crossed the layer before and attenuated by the cells it crossed
/// since, and the utility of what is seen. Up to kLanes - 1 places beyond `end` are written too.
void advance_row(const SweepRow& row, int shift, int begin, int end, float* visible,
                 float* seen_utility);

/// Sum of utility[i] over i in [begin, end); reads up to kLanes - 1 beyond.
double sum_run(const float* utility, int begin, int end);

/// kept[i] = utility[i] for the i in [begin, end) that the view holds, 0 for the others.
void keep_in_view(const ConeRow& view, const float* utility, int begin, int end, float* kept);

}  // namespace vantage
