#pragma once

#include <string_view>

#include "vantage/core/fields.hpp"
#include "vantage/planners/visibility/attenuated_ray.hpp"

namespace vantage {

struct BeerLambertGain {
  static constexpr std::string_view name = "beer_lambert";
  static constexpr StrategyText text{
      .summary =
          "Entropy of the unobserved cells in view, fading with every unobserved cell in front and "
          "nothing behind a known occupied one. For maps from elsewhere, with an `a` that suits "
          "clutter and cell size.",
      .formula = "sum of a^n H(o) over unobserved cells in view, n the unobserved cells in front"};
  static constexpr bool predicts_cells = true;
  double a = 0.995;
  void fields(auto&& f) {
    f("a", a, "probability that a beam passes an unobserved cell; higher sees deeper",
      between(0.0, 1.0));
  }
  [[nodiscard]] double transmission_unobserved() const { return a; }

  static constexpr bool unobserved_only = true;
  using Ray = AttenuatedRay;

  [[nodiscard]] Attenuation attenuation(const GainContext& context) const {
    return {.transmission = uniform_field(context.grid.frame.cells, a)};
  }
  [[nodiscard]] CellTables prepare(const GainContext& context) const {
    return attenuation_tables(context.grid, attenuation(context));
  }
  [[nodiscard]] Ray ray(const CellTables& tables) const { return Ray(tables); }
};

}  // namespace vantage
