#pragma once

#include <string_view>

#include "vantage/planners/visibility/attenuated_ray.hpp"

namespace vantage {

/// Every unobserved cell that no known occupied cell hides counts one bit: unobserved space is
/// taken to be empty.
struct SimpleGain {
  static constexpr std::string_view name = "simple";
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
