#pragma once

#include <string_view>

#include "vantage/planners/visibility/beam_gain.hpp"
#include "vantage/planners/visibility/entropy_beam.hpp"

namespace vantage {

struct OcclusionAwareGain {
  static constexpr std::string_view name = "occlusion_aware";
  static constexpr StrategyText text{
      .summary =
          "Entropy that each beam of a fan meets up to its first occupied cell, weighted by the "
          "probability that everything in front is free. Ranks views, predicts no number of cells.",
      .formula = "sum over beams of sum_i V_i H(o_i), V_i = prod_{j<i} (1 - o_j)",
      .source = "Isler2016"};
  static constexpr bool predicts_cells = false;
  BeamFan fan = {};
  double opacity_unobserved = kOpacityUnobserved;
  void fields(auto&& f) {
    fan.fields(f);
    f("opacity_unobserved", opacity_unobserved,
      "share of a beam that an unobserved cell stops; higher sees less deep", between(0.0, 0.5));
  }
  [[nodiscard]] double transmission_unobserved() const { return 1.0 - opacity_unobserved; }

  using Beam = EntropyBeam;

  [[nodiscard]] CellTables prepare(const GainContext& context) const {
    CellTables tables;
    tables.entropy_bits = cell_entropies_bits(context.grid);
    tables.transmission = beam_transmissions(context.grid, opacity_unobserved);
    return tables;
  }
  [[nodiscard]] Beam beam(const CellTables& tables) const { return Beam(tables); }
};

}  // namespace vantage
