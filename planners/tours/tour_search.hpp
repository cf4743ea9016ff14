/// Orienteering over what views show together: which views to take, and in what order, so that much
/// is seen early and the tour ends soon. [Vansteenwegen2011]
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "vantage/planners/tours/planning_problem.hpp"

namespace vantage {

/// What a tour costs, in seconds: the mean time until what is to be seen is seen, its end, and what
/// it leaves unseen.
struct TourObjective {
  double finish_weight = 0.5;  ///< of the tour's end against that mean, [0, 1]
  double worth_s = 3000.0;     ///< of time that all there is to be seen is worth
  double scan_weight = 1.0;    ///< times its own time that a scan counts for, at least 1
};

/// (1 - b) [sum_k dE_k t_k + B_k (t_k + d_k / 2) + U t_end] / (E + B) + b t_end + w U / (S + E +
/// B), with b the finish weight, w the worth, dE_k the cells that the k-th view adds, t_k when its
/// scan ends where each scan takes scan_weight times its time, B_k what lies beyond it and d_k =
/// B_k / pace the time that takes, during which the robot stays there; E is what all views show
/// together, B what lies beyond them, U what of both the tour leaves out, and S what is seen
/// already.
double tour_cost_s(const PlanningProblem& problem, const TourObjective& objective,
                   std::span<const std::size_t> order);

struct TourSearchOptions {
  std::size_t first_moves = 8;  ///< so many views are tried as the first one
  std::size_t rounds = 6;       ///< of local search at most, each with the gains worked out anew
  double keep_s = 0.0;          ///< so much cheaper another tour must be than the one intended
};

struct Tour {
  std::vector<std::size_t> order;
  double cost_s = 0.0;
};

/// The cheapest affordable tour found: insertion, then Or-opt, 2-opt, leaving out and taking in.
/// Never empty where a view is affordable: where none is worth its time the one that comes nearest.
/// @param first the tour begins there, if given
Tour search_tour(const PlanningProblem& problem, const TourObjective& objective,
                 const TourSearchOptions& options, std::optional<std::size_t> first = std::nullopt);

/// Of a worth at which at least one view is worth its time: where none was, what is left has become
/// dearer than was thought.
TourObjective with_raised_worth(const PlanningProblem& problem, TourObjective objective,
                                const TourSearchOptions& options);

/// That for each of the most promising first views and for the one intended, by
/// with_raised_worth(), cheapest first; the tour that begins where it was intended counts as
/// `keep_s` cheaper.
std::vector<Tour> search_tours(const PlanningProblem& problem, const TourObjective& objective,
                               const TourSearchOptions& options);

/// Index of the tour that begins where it was intended, if one does.
std::optional<std::size_t> intended_tour(const PlanningProblem& problem,
                                         std::span<const Tour> tours);

}  // namespace vantage
