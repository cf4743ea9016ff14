#pragma once

#include <string_view>

#include "planners/attenuated_ray.hpp"

namespace vantage {

/// As `beer_lambert`, with the transmission of an unobserved cell estimated on the run, one for
/// each height: GainContext::transmission_per_slice.
struct AdaptiveGain {
  static constexpr std::string_view name = "adaptive";
  static constexpr bool unobserved_only = true;
  static constexpr bool predicts_cells = true;
  void fields(auto&&) {}

  using Ray = AttenuatedRay;

  [[nodiscard]] CellTables prepare(const GainContext& context) const {
    CellTables tables;
    tables.state = cell_states(context.grid);
    tables.worth = unobserved_entropies_bits(context.grid);
    tables.transmission = cell_transmissions(context.grid, context.transmission_per_slice);
    return tables;
  }
  [[nodiscard]] Ray ray(const CellTables& tables) const { return Ray(tables); }
};

}  // namespace vantage
