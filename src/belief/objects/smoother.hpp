/// The belief at every step of a sequence of views, in the light of all of them.
/// [Potthast2016, (4.3)-(4.8), their sums taken over states]; [Rabiner1989, III.A-B]
#pragma once

#include <Eigen/Core>

#include <span>
#include <string>
#include <vector>

#include "vantage/belief/objects/object_belief.hpp"

namespace vantage {

/// A motion, then what was seen.
struct ViewStep {
  double motion_rad = 0.0;         ///< as in transition.hpp; 0: no transition
  Eigen::VectorXd log_likelihood;  ///< of every state, -inf for zero; empty: nothing was seen
};

struct SmoothedSequence {
  std::vector<Eigen::VectorXd> log_filtered;  ///< of each step, ln p(state | views up to it)
  std::vector<Eigen::VectorXd> log_smoothed;  ///< of each step, ln p(state | all views)
  /// Of each step, ln p(its view and those after | state) up to a constant.
  std::vector<Eigen::VectorXd> log_ahead;
  double log_likelihood = 0.0;  ///< of all views
  std::string reason;           ///< why there is no smoothed belief; empty if there is
};

/// @param prior before the first step's motion
/// With a view that is impossible, or no likelihood, `reason` names its step; only the steps before
/// it have a filtered belief then, and none a smoothed one.
SmoothedSequence smooth(const ObjectStates& states, const ObjectBelief& prior,
                        const TransitionModel& transition, std::span<const ViewStep> steps);

}  // namespace vantage
