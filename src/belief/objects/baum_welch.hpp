/// Learns a transition from sequences of views whose objects and poses nobody has to know.
/// [Baum1970]; [Rabiner1989, III.C]
///
/// Learnt are the masses to the same object, other instances and other categories, and for each
/// command in whole bins a distribution of slips (LearnedTransition). What starts at zero stays
/// zero: from `rigid`, objects never change and slips are at most a bin.
#pragma once

#include <Eigen/Core>

#include <span>
#include <string>
#include <vector>

#include "vantage/belief/objects/smoother.hpp"

namespace vantage {

/// Expected numbers of moves: all that learning keeps of the sequences.
struct TransitionCounts {
  Eigen::MatrixXd slip;  ///< slips (rows) x commands (columns), bins x bins
  double same_object = 0.0;
  double other_instance = 0.0;
  double other_category = 0.0;
};

/// `transition` in the form that is learnt; equal to it for motions by whole bins.
LearnedTransition as_learned(const TransitionModel& transition, int bins);

/// Counts that say `transition`, each command as often as `moves`, and the outcomes as often.
TransitionCounts prior_counts(const TransitionModel& transition, int bins, double moves);

/// The transition most likely for the counts; a command without counts as in `before`.
LearnedTransition learned_from(const TransitionCounts& counts, const LearnedTransition& before);

/// Adds the expected moves of one sequence under `transition` to `counts`.
/// @return ln p(views); -inf, with `counts` as they were, if no states explain them
double add_expected_moves(const ObjectStates& states, const LearnedTransition& transition,
                          std::span<const ViewStep> sequence, TransitionCounts& counts);

/// Sequential learning: one sequence, seen once, and the transition it leads to. Start from
/// prior_counts(): the larger, the slower it learns and the less the order of sequences matters.
/// A sequence that no states explain adds nothing.
/// @return the transition for the counts, the sequence's included
LearnedTransition learn_sequence(const ObjectStates& states, std::span<const ViewStep> sequence,
                                 TransitionCounts& counts);

struct BaumWelchOptions {
  double prior_moves = 0.0;
  int max_iterations = 100;
  double tolerance = 1e-6;
  void fields(auto&& f) {
    f("prior_moves", prior_moves,
      "number of moves that the initial transition is worth; higher stays nearer to it; 0: maximum "
      "likelihood",
      at_least(0.0));
    f("max_iterations", max_iterations,
      "greatest number of passes over all sequences; higher converges further", between(1, 10000));
    f("tolerance", tolerance,
      "growth of the log likelihood per sequence, in nats, below which learning ends; higher ends "
      "earlier",
      above(0.0));
  }
};

struct BaumWelchResult {
  LearnedTransition transition;
  std::vector<double> log_likelihood;  ///< of all sequences, before each iteration's step
  int unexplained = 0;  ///< sequences that the start holds for impossible; they were left out
  bool converged = false;
};

/// Expectation maximisation over all sequences at once. Without prior moves the likelihood never
/// falls. Each sequence starts from the uniform belief.
/// @throws ConfigError if `options` are out of range.
BaumWelchResult baum_welch(const ObjectStates& states, const TransitionModel& start,
                           std::span<const std::vector<ViewStep>> sequences,
                           const BaumWelchOptions& options);

}  // namespace vantage
