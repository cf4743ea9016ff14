/// The gain of views by one ray to every cell in sight, or by one along every beam of a fan: the
/// reference for faster ways.
#pragma once

#include <span>
#include <vector>

#include "vantage/core/cancellation/stop_poll.hpp"
#include "vantage/core/parallel_for.hpp"
#include "vantage/geometry/view_cone.hpp"
#include "vantage/planners/candidate.hpp"
#include "vantage/planners/gain.hpp"
#include "vantage/planners/visibility/cell_walk.hpp"
#include "vantage/planners/visibility/view_gain.hpp"

namespace vantage {

/// Sum over the cells of `grid` inside the field of view of their utility, in the gain's unit;
/// a ray is walked from the sensor to the centre of each.  [AmanatidesWoo1987]
template <RayGain G>
double sum_over_view(const G& gain, const CellTables& tables, const GridFrame& grid,
                     const Pose& T_world_sensor, const FieldOfView& field_of_view) {
  const ViewCone cone(T_world_sensor, field_of_view);
  expects(!G::unobserved_only || tables.state.size() == grid.size(),
          "a gain of unobserved cells alone tells their state");
  typename G::Ray ray = gain.ray(tables);
  double sum_bits = 0.0;
  constexpr std::size_t kRaysBetweenPolls = 1 << 14;
  std::size_t rays = 0;
  const auto wanted = [&](std::size_t cell) {
    if constexpr (requires { gain.counts(tables, cell); }) {
      if (!gain.counts(tables, cell)) return false;
    }
    return !G::unobserved_only || tables.state[cell] == CellState::unobserved;
  };
  for_each_cell_in_view(grid, cone, wanted, [&](const Eigen::Array3i& target, std::size_t index) {
    if (++rays % kRaysBetweenPolls == 0) poll_stop();
    ray.start();
    const auto pass = [&](std::size_t cell) { return ray.pass(cell); };
    if (walk_to_cell(grid, cone.apex_m(), target, pass)) sum_bits += ray.utility(index);
  });
  return sum_bits;
}

/// Gain of each candidate, in bits or the unit the gain names; T_world_sensor has x forward, z up.
/// Every sum is one thread's, in index order: the result does not depend on `threads` (at least 1).
template <ViewGain G>
std::vector<double> exact_gains_bits(const G& gain, const GainContext& context,
                                     std::span<const Candidate> candidates,
                                     const FieldOfView& field_of_view, int threads) {
  expects(threads >= 1, "exact_gains_bits needs a thread");
  std::vector<double> gains_bits(candidates.size());
  const auto tables = gain.prepare(context);
  parallel_for(candidates.size(), threads, [&](std::size_t i) {
    gains_bits[i] = sum_over_view(gain, tables, context.grid.frame, candidates[i].T_world_sensor,
                                  field_of_view);
    poll_stop();
  });
  return gains_bits;
}

/// The same of whichever gain was chosen.
std::vector<double> exact_gains_bits(const Gain& gain, const GainContext& context,
                                     std::span<const Candidate> candidates,
                                     const FieldOfView& field_of_view, int threads);

/// Gain of one view.
double exact_gain_bits(const Gain& gain, const GainContext& context, const Pose& T_world_sensor,
                       const FieldOfView& field_of_view);

}  // namespace vantage
