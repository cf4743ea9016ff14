#pragma once

#include <cstddef>
#include <string_view>

#include "planners/simple_gain.hpp"

namespace vantage {

/// Volume of the unobserved cells in view that no known occupied cell hides: `simple`, counted in
/// cubic metres instead of cells.  [Bircher2016]
struct UnmappedVolumeGain {
  static constexpr std::string_view name = "unmapped_volume";
  static constexpr bool unobserved_only = true;
  static constexpr bool predicts_cells = false;
  void fields(auto&&) {}

  class Ray : public SimpleGain::Ray {
   public:
    explicit Ray(const CellTables& tables)
        : SimpleGain::Ray(tables), cell_volume_m3_(tables.cell_volume_m3) {}
    [[nodiscard]] double worth(std::size_t /*cell*/) const { return cell_volume_m3_; }

   private:
    double cell_volume_m3_;
  };

  [[nodiscard]] CellTables prepare(const GainContext& context) const {
    CellTables tables;
    tables.state = cell_states(context.grid);
    tables.cell_volume_m3 = context.grid.frame.cell_size_m.prod();
    return tables;
  }
  [[nodiscard]] Ray ray(const CellTables& tables) const { return Ray(tables); }
};

}  // namespace vantage
