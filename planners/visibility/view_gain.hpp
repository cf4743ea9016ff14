// clang-format off
/// The contract of a gain: what planners/gain.hpp closes in a variant for `gain:` of an episode,
/// and what a program of one's own may hand to view_gains_bits() and score_views() as it is.
///
///   struct MyGain {
///     static constexpr bool unobserved_only = true;          // known cells have no utility
///     using Ray = AttenuatedRay;                             // or one of your own, see RayGain
///     CellTables prepare(const GainContext& context) const;  // once a decision, of every cell:
///                                                            // what the ray reads, and `state`
///     Ray ray(const CellTables& tables) const;               // the state of one ray
///   };
///
/// A gain is one of these:
///  - RayGain: a sum over the cells in view, each by the ray that sees it;
///  - BeamGain: over a fan of beams: `fan` and `beam()` in place of `unobserved_only` and `ray()`;
///    a sum of them, unless it also has `view()`;
///  - either with `Attenuation attenuation(const GainContext&) const`: a sum of transmittance times
///    utility, which is swept, several ten times faster than ray by ray.
///
/// A gain whose prepare() looks round a cell says how far, over faces, by `int halo_cells() const`:
/// score_views() cuts so much more out of a map than the sensor reaches.
///
/// In the variant it also says `name`, `text`, `predicts_cells` (whether its value is a number of
/// cells, to be held against what a view showed) and `fields()`; and, if so, `unit` (else bits) and
/// `transmission_unobserved()`.
// clang-format on
#pragma once

#include <algorithm>

#include "vantage/planners/visibility/attenuated_ray.hpp"
#include "vantage/planners/visibility/beam_gain.hpp"
#include "vantage/planners/visibility/cell_tables.hpp"

namespace vantage {

template <class G>
concept ViewGain = RayGain<G> || BeamGain<G>;

/// How far round the cells that a view reaches its value depends on others. Where a sweep is in
/// doubt of a cell it says by the neighbours.
template <ViewGain G>
int halo_cells(const G& gain) {
  int cells = AttenuationGain<G> ? 1 : 0;
  if constexpr (requires { gain.halo_cells(); }) cells = std::max(cells, gain.halo_cells());
  return cells;
}

}  // namespace vantage
