#pragma once

#include <string_view>

#include "vantage/core/fields.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/core/strategy.hpp"
#include "vantage/planners/tours/planning_problem.hpp"

namespace vantage {

/// [Bircher2016]
struct RecedingHorizon {
  static constexpr std::string_view name = "receding_horizon";
  static constexpr StrategyText text{
      .summary =
          "Grows a random tree of views from the robot, each joined to the nearest one in the "
          "tree; of the branch with the largest discounted gain it takes the first view. The tree "
          "is over the candidates that every choice has.",
      .formula =
          "argmax over branches of sum_k A(v_k) exp(-lambda c(v_k)), c the travel time there",
      .source = "Bircher2016"};
  static constexpr bool weighs_gain = true;
  double lambda_per_s = 0.05;
  int nodes = 1000;
  void fields(auto&& f) {
    f("lambda_per_s", lambda_per_s,
      "decay of a gain per second of the way to it; higher prefers near views", at_least(0.0));
    f("nodes", nodes, "greatest number of views in the tree, drawn at random; higher is slower",
      between(1, 1000));
  }
  PlannedViews operator()(const PlanningProblem& problem, Rng& rng) const;
};

}  // namespace vantage
