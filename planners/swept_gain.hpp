/// The gain of views by one outward sweep a position instead of one ray a cell.
#pragma once

#include <span>
#include <vector>

#include "vantage/planners/candidate.hpp"
#include "vantage/planners/gain.hpp"
#include "vantage/planners/visibility/visibility_sweep.hpp"

namespace vantage {

/// Whether a gain is a sum over cells of transmittance times utility, attenuated cell by cell along
/// the ray: what the sweep can compute.
bool can_sweep(const Gain& gain);

/// Gain in bits of each candidate; what exact_gains_bits gives up to interpolation, several ten
/// times faster, and like it never below zero. Candidates at one position share a sweep. The result
/// does not depend on `threads` (at least 1). The gain must satisfy can_sweep().
std::vector<double> swept_gains_bits(const Gain& gain, const GainContext& context,
                                     std::span<const Candidate> candidates,
                                     const FieldOfView& field_of_view, int threads,
                                     const SweepOptions& options = {});

/// Gain of each candidate, in bits or the unit the gain names: swept if it can be, else exact.
std::vector<double> view_gains_bits(const Gain& gain, const GainContext& context,
                                    std::span<const Candidate> candidates,
                                    const FieldOfView& field_of_view, int threads);

}  // namespace vantage
