#pragma once

#include <string_view>

#include "vantage/core/strategy.hpp"
#include "vantage/planners/visibility/attenuated_ray.hpp"

namespace vantage {

struct SimpleGain {
  static constexpr std::string_view name = "simple";
  static constexpr StrategyText text{
      .summary =
          "Counts the unobserved cells in view that no known occupied cell hides, one bit each: "
          "unobserved space is taken to be empty. The baseline; it promises too much in clutter.",
      .formula = "sum of 1 over unobserved cells in view"};
  static constexpr bool predicts_cells = true;
  void fields(auto&&) {}

  static constexpr bool unobserved_only = true;
  using Ray = AttenuatedRay;

  [[nodiscard]] Attenuation attenuation(const GainContext& context) const {
    return {.transmission = uniform_field(context.grid.frame.cells, 1.0), .by_entropy = false};
  }
  [[nodiscard]] CellTables prepare(const GainContext& context) const {
    return attenuation_tables(context.grid, attenuation(context));
  }
  [[nodiscard]] Ray ray(const CellTables& tables) const { return Ray(tables); }
};

}  // namespace vantage
