/// The best first view in expectation over maps that the belief allows.
#pragma once

#include <string_view>

#include "vantage/planners/tours/tour.hpp"

namespace vantage {

struct Rollout : TourOptions {
  static constexpr std::string_view name = "rollout";
  static constexpr StrategyText text{
      .summary =
          "Draws maps that what is known of clutter allows, plans the rest of the tour in each for "
          "each promising first view, and takes the first view whose tours are best on average. "
          "Slower than `tour`; hedges against what may be hidden.",
      .formula = "argmin over first views of the mean over drawn maps of the best tour's cost"};
  static constexpr bool weighs_gain = true;
  int draws = 8;
  void fields(auto&& f) {
    TourOptions::fields(f);
    f("draws", draws,
      "number of maps drawn at each decision; higher is less a matter of chance and takes time in "
      "proportion",
      between(1, 10000));
  }
  PlannedViews operator()(const PlanningProblem& problem, Rng& rng) const;
};

}  // namespace vantage
