#include "vantage/belief/objects/smoother.hpp"

#include <fmt/format.h>

#include "vantage/core/error.hpp"
#include "vantage/information/log_space.hpp"

namespace vantage {
namespace {

Eigen::VectorXd likelihood_of(const ObjectStates& states, const ViewStep& step) {
  if (step.log_likelihood.size() == 0) return Eigen::VectorXd::Zero(states.size());
  return step.log_likelihood;
}

/// What is ahead of a step, seen from the step before.
Eigen::VectorXd behind(const ObjectStates& states, const TransitionModel& transition,
                       double motion_rad, const Eigen::VectorXd& log_ahead) {
  if (motion_rad == 0.0) return log_ahead;
  return transition_backward(states, kernel_of(transition, motion_rad, states.bins), log_ahead);
}

void filter_forward(const ObjectStates& states, ObjectBelief belief,
                    const TransitionModel& transition, std::span<const ViewStep> steps,
                    SmoothedSequence& sequence) {
  for (std::size_t t = 0; t < steps.size(); ++t) {
    predict(belief, states, transition, steps[t].motion_rad);
    const EvidenceResult result = update(belief, likelihood_of(states, steps[t]));
    sequence.log_likelihood += result.log_evidence;
    if (!result.used()) {
      sequence.reason = fmt::format("step {}: {}", t, result.reason);
      return;
    }
    sequence.log_filtered.push_back(belief.log_p);
  }
}

}  // namespace

SmoothedSequence smooth(const ObjectStates& states, const ObjectBelief& prior,
                        const TransitionModel& transition, std::span<const ViewStep> steps) {
  expects(prior.log_p.size() == states.size(), "a prior for every state");
  SmoothedSequence sequence;
  filter_forward(states, prior, transition, steps, sequence);
  if (!sequence.reason.empty()) return sequence;
  sequence.log_smoothed.resize(steps.size());
  sequence.log_ahead.resize(steps.size());
  Eigen::VectorXd after = Eigen::VectorXd::Zero(states.size());
  for (std::size_t t = steps.size(); t-- > 0;) {
    Eigen::VectorXd smoothed = sequence.log_filtered[t] + after;
    normalise_log({smoothed.data(), static_cast<std::size_t>(smoothed.size())});
    sequence.log_smoothed[t] = std::move(smoothed);
    Eigen::VectorXd ahead = likelihood_of(states, steps[t]) + after;
    ahead.array() -= ahead.maxCoeff();
    after = behind(states, transition, steps[t].motion_rad, ahead);
    sequence.log_ahead[t] = std::move(ahead);
  }
  return sequence;
}

}  // namespace vantage
