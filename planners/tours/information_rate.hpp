#pragma once

#include <string_view>

#include "vantage/core/rng.hpp"
#include "vantage/core/strategy.hpp"
#include "vantage/planners/tours/planning_problem.hpp"

namespace vantage {

struct InformationRate {
  static constexpr std::string_view name = "information_rate";
  static constexpr StrategyText text{
      .summary =
          "Takes the view with the largest gain per second of driving and scanning: myopic, the "
          "reference for choices that plan ahead.",
      .formula = "argmax of A / (travel time + scan time), A the gain"};
  static constexpr bool weighs_gain = true;
  void fields(auto&&) {}
  PlannedViews operator()(const PlanningProblem& problem, Rng& rng) const;
};

}  // namespace vantage
