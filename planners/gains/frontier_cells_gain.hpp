#pragma once

#include <cstddef>
#include <string_view>

#include "vantage/core/strategy.hpp"
#include "vantage/geometry/face_neighbours.hpp"
#include "vantage/planners/visibility/attenuated_ray.hpp"

namespace vantage {

/// Frontier cells are those of planners/views/frontiers.hpp, of all heights.
struct FrontierCellsGain {
  static constexpr std::string_view name = "frontier_cells";
  static constexpr StrategyText text{
      .summary =
          "Number of frontier cells in view, free ones beside an unobserved one, that neither an "
          "occupied nor an unobserved cell hides. For exploring by frontiers; blind to how much "
          "lies behind them.",
      .formula = "number of frontier cells in view whose ray crosses free cells alone",
      .source = "Zhou2021"};
  static constexpr std::string_view unit = "cells";
  static constexpr bool predicts_cells = false;
  void fields(auto&&) {}

  static constexpr bool unobserved_only = false;
  using Ray = AttenuatedRay;
  static constexpr int halo_cells() { return 1; }

  [[nodiscard]] CellTables prepare(const GainContext& context) const {
    const OccupancyGrid& grid = context.grid;
    const auto unobserved = [&](std::size_t cell) {
      return grid.state(cell) == CellState::unobserved;
    };
    CellTables tables;
    tables.transmission.assign(grid.size(), 0.0F);
    tables.utility.assign(grid.size(), 0.0F);
    for (std::size_t cell = 0; cell < grid.size(); ++cell) {
      if (grid.state(cell) != CellState::free) continue;
      tables.transmission[cell] = 1.0F;
      if (any_face_neighbour(grid.frame, grid.frame.cell(cell), unobserved)) {
        tables.utility[cell] = 1.0F;
      }
    }
    return tables;
  }
  [[nodiscard]] bool counts(const CellTables& tables, std::size_t cell) const {
    return tables.utility[cell] > 0.0F;
  }
  [[nodiscard]] Ray ray(const CellTables& tables) const { return Ray(tables); }
};

}  // namespace vantage
