/// Orienteering over what views show together: which views to take, and in what order, so that much
/// is seen early and the tour ends soon. [Vansteenwegen2011]
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "vantage/planners/tours/planning_problem.hpp"

namespace vantage {

/// What a tour costs, in seconds: the mean time until what the views show is seen, and its end.
struct TourObjective {
  double finish_weight = 0.5;  ///< of the tour's end against that mean, [0, 1]
  double worth_s = 1800.0;     ///< added to the tour's end for what it leaves unseen
};

/// (1 - b) [sum_k dE_k t_k + (E - E_k) (t_end + worth)] / E + b t_end, with b the finish weight,
/// dE_k the cells that the k-th view adds, t_k when its scan ends, and E what all views show
/// together.
double tour_cost_s(const PlanningProblem& problem, const TourObjective& objective,
                   std::span<const std::size_t> order);

struct TourSearchOptions {
  std::size_t first_moves = 8;  ///< so many views are tried as the first one
  std::size_t rounds = 6;       ///< of local search at most, each with the gains worked out anew
};

struct Tour {
  std::vector<std::size_t> order;
  double cost_s = 0.0;
};

/// The cheapest affordable tour found: insertion, then Or-opt, 2-opt, leaving out and taking in.
/// Never empty where a view is affordable.
/// @param first the tour begins there, if given
Tour search_tour(const PlanningProblem& problem, const TourObjective& objective,
                 const TourSearchOptions& options, std::optional<std::size_t> first = std::nullopt);

/// That for each of the most promising first views, cheapest first.
std::vector<Tour> search_tours(const PlanningProblem& problem, const TourObjective& objective,
                               const TourSearchOptions& options);

}  // namespace vantage
