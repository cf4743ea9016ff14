#pragma once

#include <string_view>

#include "vantage/core/fields.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/core/strategy.hpp"
#include "vantage/planners/tours/planning_problem.hpp"

namespace vantage {

/// [Cao2021]
struct TwoLevelTour {
  static constexpr std::string_view name = "two_level_tour";
  static constexpr StrategyText text{
      .summary =
          "Near the robot, the fewest views that cover what is unknown there, on the shortest "
          "route; farther away, the shortest route through whole regions; the near route ends "
          "where the far one begins.",
      .formula =
          "first view of the local route; greedy cover of sum_c [1 - prod_i (1 - p_i(c))], open "
          "travelling salesman routes",
      .source = "Cao2021"};
  static constexpr bool weighs_gain = true;
  double horizon_s = 12.0;
  double cover = 0.9;
  double region_m = 4.0;
  void fields(auto&& f) {
    f("horizon_s", horizon_s,
      "travel time up to which a view is near; higher plans more views one by one", above(0.0));
    f("cover", cover,
      "share of what all near views show together that the chosen ones must show; higher takes "
      "more views",
      Range{0.0, 1.0, true});
    f("region_m", region_m,
      "edge of the squares that far views are gathered in; higher plans the far route more "
      "coarsely",
      at_least(0.01));
  }
  PlannedViews operator()(const PlanningProblem& problem, Rng& rng) const;
};

}  // namespace vantage
