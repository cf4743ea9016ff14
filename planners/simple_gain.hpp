#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include "planners/attenuated_ray.hpp"

namespace vantage {

/// Every unobserved cell that no known occupied cell hides counts one bit: unobserved space is
/// taken to be empty.
struct SimpleGain {
  static constexpr std::string_view name = "simple";
  static constexpr bool unobserved_only = true;
  static constexpr bool predicts_cells = true;
  void fields(auto&&) {}

  using Ray = AttenuatedRay;

  [[nodiscard]] CellTables prepare(const GainContext& context) const {
    const auto slices = static_cast<std::size_t>(context.grid.frame.cells.z());
    CellTables tables;
    tables.state = cell_states(context.grid);
    tables.worth.resize(tables.state.size());
    std::ranges::transform(tables.state, tables.worth.begin(), [](CellState state) {
      return state == CellState::unobserved ? 1.0F : 0.0F;
    });
    tables.transmission = cell_transmissions(context.grid, std::vector<double>(slices, 1.0));
    return tables;
  }
  [[nodiscard]] Ray ray(const CellTables& tables) const { return Ray(tables); }
};

}  // namespace vantage
