#include "vantage/belief/objects/baum_welch.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace vantage {
namespace {

Eigen::Map<const Eigen::MatrixXd> slips_of(const LearnedTransition& transition, int bins) {
  return {transition.slip.data(), bins, bins};
}

/// Shares the moves by d bins among the one or two commands that the motion was a mixture of.
void add_slips(const Eigen::VectorXd& moves, const MotionBins& motion,
               const LearnedTransition& transition, Eigen::MatrixXd& counts) {
  const auto bins = static_cast<int>(moves.size());
  const auto slips = slips_of(transition, bins);
  for (int d = 0; d < bins; ++d) {
    const int lower_slip = (d - motion.lower + bins) % bins;
    const int upper_slip = (d - motion.upper + bins) % bins;
    const double lower = (1.0 - motion.upper_share) * slips(lower_slip, motion.lower);
    const double upper = motion.upper_share * slips(upper_slip, motion.upper);
    if (lower + upper == 0.0) continue;
    counts(lower_slip, motion.lower) += moves[d] * lower / (lower + upper);
    counts(upper_slip, motion.upper) += moves[d] * upper / (lower + upper);
  }
}

}  // namespace

LearnedTransition as_learned(const TransitionModel& transition, int bins) {
  LearnedTransition learned;
  Eigen::MatrixXd slips(bins, bins);
  for (int command = 0; command < bins; ++command) {
    const double motion_rad = command * 2.0 * std::numbers::pi / bins;
    const TransitionKernel kernel = kernel_of(transition, motion_rad, bins);
    for (int slip = 0; slip < bins; ++slip) {
      slips(slip, command) = kernel.bin_change[(command + slip) % bins];
    }
    learned.same_object = kernel.same_object;
    learned.other_instance = kernel.other_instance;
    learned.other_category = kernel.other_category;
  }
  learned.slip.assign(slips.data(), slips.data() + slips.size());
  return learned;
}

TransitionCounts prior_counts(const TransitionModel& transition, int bins, double moves) {
  const LearnedTransition learned = as_learned(transition, bins);
  return {.slip = moves * slips_of(learned, bins),
          .same_object = moves * learned.same_object,
          .other_instance = moves * learned.other_instance,
          .other_category = moves * learned.other_category};
}

LearnedTransition learned_from(const TransitionCounts& counts, const LearnedTransition& before) {
  LearnedTransition learned = before;
  const auto bins = static_cast<int>(counts.slip.cols());
  Eigen::Map<Eigen::MatrixXd> slips(learned.slip.data(), bins, bins);
  for (int command = 0; command < bins; ++command) {
    const double moves = counts.slip.col(command).sum();
    if (moves > 0.0) slips.col(command) = counts.slip.col(command) / moves;
  }
  const double outcomes = counts.same_object + counts.other_instance + counts.other_category;
  if (outcomes > 0.0) {
    learned.same_object = counts.same_object / outcomes;
    learned.other_instance = counts.other_instance / outcomes;
    learned.other_category = counts.other_category / outcomes;
  }
  return learned;
}

double add_expected_moves(const ObjectStates& states, const LearnedTransition& transition,
                          std::span<const ViewStep> sequence, TransitionCounts& counts) {
  const ObjectBelief prior = uniform_belief(states);
  const SmoothedSequence smoothed = smooth(states, prior, transition, sequence);
  if (!smoothed.reason.empty()) return -std::numeric_limits<double>::infinity();
  const LearnedTransition learned = as_learned(transition, states.bins);
  for (std::size_t t = 0; t < sequence.size(); ++t) {
    const double motion_rad = sequence[t].motion_rad;
    if (motion_rad == 0.0) continue;
    const Eigen::VectorXd& before = t > 0 ? smoothed.log_filtered[t - 1] : prior.log_p;
    const ExpectedMoves moves = expected_moves(states, learned.kernel(motion_rad, states.bins),
                                               before, smoothed.log_ahead[t]);
    add_slips(moves.bin_change, motion_bins(motion_rad, states.bins), learned, counts.slip);
    counts.same_object += moves.same_object;
    counts.other_instance += moves.other_instance;
    counts.other_category += moves.other_category;
  }
  return smoothed.log_likelihood;
}

LearnedTransition learn_sequence(const ObjectStates& states, std::span<const ViewStep> sequence,
                                 TransitionCounts& counts) {
  const LearnedTransition fallback = as_learned(RigidTransition{}, states.bins);
  add_expected_moves(states, learned_from(counts, fallback), sequence, counts);
  return learned_from(counts, fallback);
}

BaumWelchResult baum_welch(const ObjectStates& states, const TransitionModel& start,
                           std::span<const std::vector<ViewStep>> sequences,
                           const BaumWelchOptions& options) {
  check_options(options, "baum_welch");
  const TransitionCounts prior = prior_counts(start, states.bins, options.prior_moves);
  BaumWelchResult result;
  result.transition = as_learned(start, states.bins);
  for (int iteration = 0; iteration < options.max_iterations && !result.converged; ++iteration) {
    TransitionCounts counts = prior;
    double total = 0.0;
    result.unexplained = 0;
    for (const std::vector<ViewStep>& sequence : sequences) {
      const double log_p = add_expected_moves(states, result.transition, sequence, counts);
      std::isfinite(log_p) ? total += log_p : ++result.unexplained;
    }
    result.transition = learned_from(counts, result.transition);
    const double enough = options.tolerance * static_cast<double>(sequences.size());
    result.converged =
        !result.log_likelihood.empty() && total - result.log_likelihood.back() <= enough;
    result.log_likelihood.push_back(total);
  }
  return result;
}

}  // namespace vantage
