#pragma once

#include <string_view>

#include "planners/simple_gain.hpp"

namespace vantage {

/// Volume of the unobserved cells in view that no known occupied cell hides: `simple`, counted in
/// cubic metres instead of cells.  [Bircher2016]
struct UnmappedVolumeGain {
  static constexpr std::string_view name = "unmapped_volume";
  static constexpr std::string_view unit = "m3";
  static constexpr bool unobserved_only = true;
  static constexpr bool predicts_cells = false;
  void fields(auto&&) {}

  using Ray = AttenuatedRay;

  [[nodiscard]] CellTables prepare(const GainContext& context) const {
    CellTables tables = SimpleGain{}.prepare(context);
    const auto volume_m3 = static_cast<float>(context.grid.frame.cell_size_m.prod());
    for (float& worth : tables.worth) worth *= volume_m3;
    return tables;
  }
  [[nodiscard]] Ray ray(const CellTables& tables) const { return Ray(tables); }
};

}  // namespace vantage
