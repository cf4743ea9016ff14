#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <string_view>

#include "vantage/core/fields.hpp"
#include "vantage/geometry/face_neighbours.hpp"
#include "vantage/planners/visibility/attenuated_ray.hpp"

namespace vantage {

struct RimGain {
  static constexpr std::string_view name = "rim";
  static constexpr StrategyText text{
      .summary =
          "Counts the unobserved cells that touch a known surface, each weighted by the "
          "transmittance up to it: what is begun is completed.",
      .formula =
          "sum of a^n over unobserved cells in view beside an occupied one, n the unobserved cells "
          "in front"};
  static constexpr std::string_view unit = "cells";
  static constexpr bool predicts_cells = false;
  double a = 0.995;
  void fields(auto&& f) {
    f("a", a, "probability that a beam passes an unobserved cell; higher sees deeper",
      between(0.0, 1.0));
  }

  static constexpr bool unobserved_only = true;
  using Ray = AttenuatedRay;
  static constexpr int halo_cells() { return 1; }

  [[nodiscard]] CellTables prepare(const GainContext& context) const {
    const GridFrame& frame = context.grid.frame;
    CellTables tables = attenuation_tables(
        context.grid, {.transmission = uniform_field(frame.cells, a), .by_entropy = false});
    const auto occupied = [&](std::size_t cell) {
      return tables.state[cell] == CellState::occupied;
    };
    for (std::size_t cell = 0; cell < context.grid.size(); ++cell) {
      if (!any_face_neighbour(frame, frame.cell(cell), occupied)) tables.utility[cell] = 0.0F;
    }
    return tables;
  }
  [[nodiscard]] Ray ray(const CellTables& tables) const { return Ray(tables); }
};

}  // namespace vantage
