#pragma once

#include <string_view>

#include "vantage/core/rng.hpp"
#include "vantage/core/strategy.hpp"
#include "vantage/planners/tours/planning_problem.hpp"

namespace vantage {

/// [Zhou2021]
struct FrontierTour {
  static constexpr std::string_view name = "frontier_tour";
  static constexpr StrategyText text{
      .summary =
          "Plans the shortest route through the views of all frontiers and takes its first view: "
          "asks how long the way is, not how much a view shows. Round a table, the views are "
          "those that it has not taken yet.",
      .formula = "first place of the shortest open route through all views",
      .source = "Zhou2021"};
  static constexpr bool weighs_gain = false;
  void fields(auto&&) {}
  PlannedViews operator()(const PlanningProblem& problem, Rng& rng) const;
};

}  // namespace vantage
