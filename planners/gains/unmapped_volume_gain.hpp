#pragma once

#include <string_view>

#include "vantage/core/strategy.hpp"
#include "vantage/planners/visibility/attenuated_ray.hpp"

namespace vantage {

struct UnmappedVolumeGain {
  static constexpr std::string_view name = "unmapped_volume";
  static constexpr StrategyText text{
      .summary =
          "Volume of the unobserved cells in view that no known occupied cell hides: `simple`, in "
          "cubic metres. The gain of receding-horizon exploration.",
      .formula = "cell volume times the number of unobserved cells in view",
      .source = "Bircher2016"};
  static constexpr std::string_view unit = "m3";
  static constexpr bool predicts_cells = false;
  void fields(auto&&) {}

  static constexpr bool unobserved_only = true;
  using Ray = AttenuatedRay;

  [[nodiscard]] Attenuation attenuation(const GainContext& context) const {
    return {.transmission = uniform_field(context.grid.frame.cells, 1.0),
            .utility = context.grid.frame.cell_size_m.prod(),
            .by_entropy = false};
  }
  [[nodiscard]] CellTables prepare(const GainContext& context) const {
    return attenuation_tables(context.grid, attenuation(context));
  }
  [[nodiscard]] Ray ray(const CellTables& tables) const { return Ray(tables); }
};

}  // namespace vantage
