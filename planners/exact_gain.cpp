#include "vantage/planners/exact_gain.hpp"

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
  return std::visit(
      [&](const auto& g) {
        return exact_gains_bits(g, context, candidates, field_of_view, threads);
      },
      gain);
}

}  // namespace vantage
