#pragma once

#include <string_view>

#include "vantage/core/error.hpp"
#include "vantage/core/strategy.hpp"
#include "vantage/planners/visibility/attenuated_ray.hpp"

namespace vantage {

/// Its transmissions are GainContext::transmission.
struct AdaptiveGain {
  static constexpr std::string_view name = "adaptive";
  static constexpr StrategyText text{
      .summary =
          "As `beer_lambert`, with the transmission of an unobserved cell learnt on the run, by "
          "height and place, from the beams that were stopped. The one to use on a run.",
      .formula =
          "sum of H(o) prod (1 - h/n) over unobserved cells in view, h/n the hazard of each "
          "unobserved cell in front"};
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
