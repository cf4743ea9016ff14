/// Which of the proposed views to take.
///
/// A choice knows nothing of the map: gains, path lengths and reachability are values of the
/// candidates, and the episode decides which candidates it passes. Unreachable ones may be chosen
/// (navigation then goes as near as it can), by those that weigh paths only where no other is left;
/// so an episode that wants none of them leaves them out.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/core/strategy.hpp"
#include "vantage/planners/candidate.hpp"
#include "vantage/planners/choice/external_choice.hpp"
#include "vantage/planners/choice/oracle_lookahead.hpp"
#include "vantage/planners/tours/frontier_tour.hpp"
#include "vantage/planners/tours/information_rate.hpp"
#include "vantage/planners/tours/receding_horizon.hpp"
#include "vantage/planners/tours/rollout.hpp"
#include "vantage/planners/tours/tour.hpp"
#include "vantage/planners/tours/two_level_tour.hpp"

namespace vantage {

struct RandomView {
  static constexpr std::string_view name = "random";
  static constexpr StrategyText text{
      .summary =
          "Takes any view, each as likely as the other. The baseline that a gain has to beat."};
  static constexpr bool weighs_gain = false;
  int draw = 0;
  void fields(auto&& f) {
    f("draw", draw,
      "which of the sequences of views that one seed has; another for each of several episodes "
      "that "
      "differ by nothing else",
      at_least(0));
  }
  std::size_t operator()(std::span<const Candidate> candidates, Rng& rng) const;
};

/// Of equal gains the shorter path, then the lower id.
struct GreedyGain {
  static constexpr std::string_view name = "greedy";
  static constexpr StrategyText text{
      .summary = "Takes the view with the largest gain; of equal ones the nearest.",
      .formula = "argmax of the gain",
      .source = "Potthast2016, (3.1)"};
  static constexpr bool weighs_gain = true;
  void fields(auto&&) {}
  std::size_t operator()(std::span<const Candidate> candidates, Rng& rng) const;
};

/// Every candidate must carry `true_new_cells`. Ties as in GreedyGain.
struct OracleView {
  static constexpr std::string_view name = "oracle";
  static constexpr StrategyText text{
      .summary =
          "Takes the view that will really show most new cells, which it knows from ground truth: "
          "the best that is to be had from the next scan alone. No upper bound of an episode: "
          "another choice may do better over several scans, see `oracle_lookahead`.",
      .formula = "argmax of the true number of new cells"};
  static constexpr bool weighs_gain = false;
  void fields(auto&&) {}
  std::size_t operator()(std::span<const Candidate> candidates, Rng& rng) const;
};

/// Of equal paths the lower id; unreachable views come last.  [Yamauchi1997]
struct NearestFrontier {
  static constexpr std::string_view name = "nearest_frontier";
  static constexpr StrategyText text{
      .summary =
          "Takes the view with the shortest path, whatever there is to be seen; round a "
          "table, of the views that it has not taken yet.",
      .formula = "argmin of the path length",
      .source = "Yamauchi1997"};
  static constexpr bool weighs_gain = false;
  void fields(auto&&) {}
  std::size_t operator()(std::span<const Candidate> candidates, Rng& rng) const;
};

/// Ties as in GreedyGain; unreachable views come last.  [GonzalezBanosLatombe2002]
struct GainOverDistance {
  static constexpr std::string_view name = "gain_over_distance";
  static constexpr StrategyText text{
      .summary =
          "Takes the view with the largest gain after a discount for the way there: trades gain "
          "for shorter ways.",
      .formula = "argmax of A exp(-lambda L), A the gain, L the path length",
      .source = "GonzalezBanosLatombe2002"};
  static constexpr bool weighs_gain = true;
  double lambda_per_m = 0.2;
  void fields(auto&& f) {
    f("lambda_per_m", lambda_per_m,
      "decay of the gain per metre of path; higher prefers near views; 0: as `greedy`",
      at_least(0.0));
  }
  std::size_t operator()(std::span<const Candidate> candidates, Rng& rng) const;
};

using ViewChoice =
    std::variant<RandomView, GreedyGain, OracleView, OracleLookahead, NearestFrontier,
                 GainOverDistance, InformationRate, RecedingHorizon, FrontierTour, TwoLevelTour,
                 TourChoice, Rollout, OracleTour, ExternalChoice>;
template <>
inline constexpr std::string_view strategy_family<ViewChoice> = "view choice";

/// Whether it looks at Candidate::gain_bits.
inline bool weighs_gain(const ViewChoice& choice) {
  return std::visit([](const auto& c) { return c.weighs_gain; }, choice);
}

/// Whether it asks for ground truth: Candidate::true_new_cells or true_new_cell_set.
inline bool knows_truth(const ViewChoice& choice) {
  return std::holds_alternative<OracleView>(choice) ||
         std::holds_alternative<OracleLookahead>(choice) ||
         std::holds_alternative<OracleTour>(choice);
}

/// Whether it goes from frontier to frontier by the ways alone. A view that it has taken is no
/// frontier any more, which a fixed set of views does not tell by itself.
inline bool goes_by_ways(const ViewChoice& choice) {
  return std::holds_alternative<NearestFrontier>(choice) ||
         std::holds_alternative<FrontierTour>(choice);
}

/// Whether a program of the user's makes it: neither choose_view() nor plan_views() can.
inline bool asks_outside(const ViewChoice& choice) {
  return std::holds_alternative<ExternalChoice>(choice);
}

/// What plans several views ahead, with the times of everything.
template <class C>
concept PlansViews = requires(const C& choice, const PlanningProblem& problem, Rng& rng) {
  { choice(problem, rng) } -> std::same_as<PlannedViews>;
};

/// Whether it asks for a planning problem; it chooses by plan_views(), the others by choose_view().
bool plans_views(const ViewChoice& choice);

/// @param choice of plans_views()
PlannedViews plan_views(const ViewChoice& choice, const PlanningProblem& problem, Rng& rng);

/// The random numbers that a choice draws in an episode of that seed.
Rng choice_stream(const ViewChoice& choice, std::uint64_t seed);

/// The same choice, which plans no further ahead than the scans that are left (at least 1).
ViewChoice within_scans_left(ViewChoice choice, int scans_left);

/// What chooses: one of the variant, or a function of your own.
template <class C>
concept ChoosesView = requires(const C& choice, std::span<const Candidate> candidates, Rng& rng) {
  { choice(candidates, rng) } -> std::convertible_to<std::size_t>;
};

/// Indices of the candidates that are not exhausted; all of them if there is none.
std::vector<std::size_t> open_candidates(std::span<const Candidate> candidates);

/// Index of the view to take; exhausted candidates are left out unless all are. `candidates` must
/// not be empty.
template <ChoosesView C>
std::size_t choose_view(const C& choice, std::span<const Candidate> candidates, Rng& rng) {
  const std::vector<std::size_t> open = open_candidates(candidates);
  std::vector<Candidate> views;
  for (const std::size_t i : open) views.push_back(candidates[i]);
  return open[choice(std::span<const Candidate>(views), rng)];
}

/// The same by whichever was chosen, which must not be one that plans_views() or asks_outside().
std::size_t choose_view(const ViewChoice& choice, std::span<const Candidate> candidates, Rng& rng);

}  // namespace vantage
