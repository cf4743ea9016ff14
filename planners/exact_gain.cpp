#include "vantage/planners/exact_gain.hpp"

#include "vantage/core/parallel_for.hpp"

namespace vantage {
double exact_gain_bits(const Gain& gain, const GainContext& context, const Pose& T_world_sensor,
                       const FieldOfView& field_of_view) {
  Candidate view;
  view.T_world_sensor = T_world_sensor;
  return exact_gains_bits(gain, context, {&view, 1}, field_of_view, 1).front();
}

std::vector<double> exact_gains_bits(const Gain& gain, const GainContext& context,
                                     std::span<const Candidate> candidates,
                                     const FieldOfView& field_of_view, int threads) {
  expects(threads >= 1, "exact_gains_bits needs a thread");
  std::vector<double> gains_bits(candidates.size());
  std::visit(
      [&](const auto& g) {
        const auto tables = g.prepare(context);
        parallel_for(candidates.size(), threads, [&](std::size_t i) {
          gains_bits[i] = sum_over_view(g, tables, context.grid.frame, candidates[i].T_world_sensor,
                                        field_of_view);
        });
      },
      gain);
  return gains_bits;
}

}  // namespace vantage
