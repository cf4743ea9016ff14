#pragma once

#include <string_view>

#include "vantage/core/error.hpp"
#include "vantage/planners/visibility/attenuated_ray.hpp"

namespace vantage {

/// As `beer_lambert`, with the transmission of an unobserved cell estimated on the run, by height
/// and place: GainContext::transmission.
struct AdaptiveGain {
  static constexpr std::string_view name = "adaptive";
  static constexpr bool predicts_cells = true;
  void fields(auto&&) {}

  static constexpr bool unobserved_only = true;
  using Ray = AttenuatedRay;

  [[nodiscard]] Attenuation attenuation(const GainContext& context) const {
    expects(context.transmission != nullptr, "adaptive needs what was learnt of transmission");
    return {.transmission = *context.transmission};
  }
  [[nodiscard]] CellTables prepare(const GainContext& context) const {
    return attenuation_tables(context.grid, attenuation(context));
  }
  [[nodiscard]] Ray ray(const CellTables& tables) const { return Ray(tables); }
};

}  // namespace vantage
