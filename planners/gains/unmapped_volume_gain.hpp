#pragma once

#include <string_view>

#include "vantage/planners/visibility/attenuated_ray.hpp"

namespace vantage {

/// Volume of the unobserved cells in view that no known occupied cell hides: `simple`, counted in
/// cubic metres instead of cells.  [Bircher2016]
struct UnmappedVolumeGain {
  static constexpr std::string_view name = "unmapped_volume";
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
