#pragma once

#include <string_view>

#include "vantage/planners/visibility/beam_gain.hpp"
#include "vantage/planners/visibility/entropy_beam.hpp"

namespace vantage {

/// Per beam sum of V_i H(o_i) in bits over all its cells up to the first occupied one, V_i the
/// probability that everything in front is free.  [Isler2016]
struct OcclusionAwareGain {
  static constexpr std::string_view name = "occlusion_aware";
  static constexpr bool predicts_cells = false;
  BeamFan fan = {};
  double opacity_unobserved = kOpacityUnobserved;
  void fields(auto&& f) {
    fan.fields(f);
    f("opacity_unobserved", opacity_unobserved, "of a cell, [0, 0.5]; higher sees less deep",
      between(0.0, 0.5));
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
