/// The gain of views by one outward sweep a position instead of one ray a cell.
#pragma once

#include <span>
#include <vector>

#include "vantage/planners/candidate.hpp"
#include "vantage/planners/exact_gain.hpp"
#include "vantage/planners/gain.hpp"
#include "vantage/planners/visibility/visibility_sweep.hpp"

namespace vantage {

/// Gain in bits of each candidate: the sum over the cells in view of transmittance times utility,
/// which is what exact_gains_bits gives up to interpolation, several ten times faster, and like it
/// never below zero. Candidates at one position share a sweep. The result does not depend on
/// `threads` (at least 1).
std::vector<double> swept_gains_bits(const Attenuation& attenuation, const OccupancyGrid& grid,
                                     std::span<const Candidate> candidates,
                                     const FieldOfView& field_of_view, int threads,
                                     const SweepOptions& options = {});

/// Gain of each candidate, in bits or the unit the gain names: swept if it can be, else exact.
template <ViewGain G>
std::vector<double> view_gains_bits(const G& gain, const GainContext& context,
                                    std::span<const Candidate> candidates,
                                    const FieldOfView& field_of_view, int threads) {
  if constexpr (AttenuationGain<G>) {
    return swept_gains_bits(gain.attenuation(context), context.grid, candidates, field_of_view,
                            threads);
  } else {
    return exact_gains_bits(gain, context, candidates, field_of_view, threads);
  }
}

/// Whether a gain can be swept.
bool can_sweep(const Gain& gain);
/// Of a gain that can be swept.
Attenuation attenuation_of(const Gain& gain, const GainContext& context);

/// Of whichever gain was chosen. The gain must satisfy can_sweep().
std::vector<double> swept_gains_bits(const Gain& gain, const GainContext& context,
                                     std::span<const Candidate> candidates,
                                     const FieldOfView& field_of_view, int threads,
                                     const SweepOptions& options = {});
std::vector<double> view_gains_bits(const Gain& gain, const GainContext& context,
                                    std::span<const Candidate> candidates,
                                    const FieldOfView& field_of_view, int threads);

}  // namespace vantage
