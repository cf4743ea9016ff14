/// Our choice: the first view of a tour through views, planned anew at each scan.
#pragma once

#include <string_view>

#include "vantage/core/fields.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/core/strategy.hpp"
#include "vantage/planners/tours/planning_problem.hpp"
#include "vantage/planners/tours/tour_search.hpp"

namespace vantage {

/// Options of every choice that searches tours.
struct TourOptions {
  double finish_weight = 0.5;
  double worth_s = 3000.0;
  double scan_weight = 1.5;
  int first_moves = 8;
  double keep_s = 10.0;
  void fields(auto&& f) {
    f("finish_weight", finish_weight,
      "weight of the time at which the tour ends against the mean time until what it shows is "
      "seen; higher ends earlier and sees less at first",
      between(0.0, 1.0));
    f("worth_s", worth_s,
      "time that it is worth to see all there is to be seen; a view is taken if what it adds is "
      "worth its detour and its scan; higher takes in views that show less",
      at_least(0.0));
    f("scan_weight", scan_weight,
      "times its own time that a scan counts for in a plan, since views that nobody can propose "
      "yet will show part of the same; higher plans with fewer views that show more each",
      between(1.0, 100.0));
    f("first_moves", first_moves,
      "number of views that are tried as the first one; higher plans better and takes time in "
      "proportion",
      between(1, 1000));
    f("keep_s", keep_s,
      "time by which another tour must be better than one that goes on as was planned at the scan "
      "before; higher changes its mind less",
      at_least(0.0));
  }
  [[nodiscard]] TourObjective objective() const { return {finish_weight, worth_s, scan_weight}; }
  [[nodiscard]] TourSearchOptions search() const {
    return {.first_moves = static_cast<std::size_t>(first_moves), .keep_s = keep_s};
  }
};

struct TourChoice : TourOptions {
  static constexpr std::string_view name = "tour";
  static constexpr StrategyText text{
      .summary =
          "Plans which views to take and in what order, with the time to drive and to scan, by "
          "what "
          "they are expected to show together; takes the first, and plans anew after its scan. "
          "Leaves a room when it is done with, not when another view promises more.",
      .formula =
          "argmin over tours of (1 - b) (sum_k dE_k t_k + U t_end) / E + b t_end + w U / (S + E), "
          "E "
          "= sum_c [1 - prod_i (1 - p_i(c))], U what of it the tour leaves out, S what is seen, w "
          "worth_s, b finish_weight; a scan counts as scan_weight scans in t"};
  static constexpr bool weighs_gain = true;
  PlannedViews operator()(const PlanningProblem& problem, Rng& rng) const;
};

/// The same search on what the views really show.
struct OracleTour : TourOptions {
  static constexpr std::string_view name = "oracle_tour";
  static constexpr StrategyText text{
      .summary =
          "As `tour`, but knows from ground truth what each view shows: what a planner that knew "
          "the building would do. It is no proven bound, see `vantage bound`."};
  static constexpr bool weighs_gain = false;
  /// It knows all views there will be.
  OracleTour() { scan_weight = 1.0; }
  PlannedViews operator()(const PlanningProblem& problem, Rng& rng) const;
};

}  // namespace vantage
