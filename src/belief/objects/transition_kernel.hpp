/// How probability moves between states at one motion: p(o_t = j | o_{t-1} = i, a).
#pragma once

#include <Eigen/Core>

#include "vantage/belief/objects/object_states.hpp"

namespace vantage {

/// Where the mass of a state goes: the same object, another instance of its category, or another
/// category; evenly over the states of the last two. A group that is empty (an only instance, an
/// only category) leaves its mass with the object. All transitions of ours have this form; it is
/// applied with sums over groups, in O(states * bins), and never written out as a matrix. Unknown
/// objects have no yaw and are apart: no mass goes to them or comes from them.
struct TransitionKernel {
  /// p(bin after - bin before = d, modulo bins | same object), for d = 0 .. bins - 1; sums to one.
  Eigen::VectorXd bin_change;
  double same_object = 1.0;     ///< these three sum to one
  double other_instance = 0.0;  ///< of the same category
  double other_category = 0.0;
};

/// ln sum_i p_i A_ij for every j: the belief after the motion.
/// @param log_p of every state; -inf for probability zero
Eigen::VectorXd transition_forward(const ObjectStates& states, const TransitionKernel& kernel,
                                   const Eigen::Ref<const Eigen::VectorXd>& log_p);

/// ln sum_j A_ij x_j for every i: what is ahead, seen from before the motion.
/// @param log_x of every state; -inf for zero
Eigen::VectorXd transition_backward(const ObjectStates& states, const TransitionKernel& kernel,
                                    const Eigen::Ref<const Eigen::VectorXd>& log_x);

/// How often, in expectation, one motion did what a kernel distinguishes.
struct ExpectedMoves {
  Eigen::VectorXd bin_change;  ///< of moves that stay with the object; sums to their probability
  double same_object = 0.0;    ///< draws of the three outcomes; they sum to one
  double other_instance = 0.0;
  double other_category = 0.0;
};

/// Expectation of one motion given all evidence: of the moves i -> j, each with probability
/// proportional to p_i A_ij x_j.  [Rabiner1989, (37)]
/// @param states without hypotheses of unknown objects
/// @param log_p belief before the motion, from the evidence up to there
/// @param log_x likelihood of the evidence from the motion on; some p_i A_ij x_j > 0
ExpectedMoves expected_moves(const ObjectStates& states, const TransitionKernel& kernel,
                             const Eigen::Ref<const Eigen::VectorXd>& log_p,
                             const Eigen::Ref<const Eigen::VectorXd>& log_x);

}  // namespace vantage
