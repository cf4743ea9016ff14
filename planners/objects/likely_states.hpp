#pragma once

#include <Eigen/Core>

#include <vector>

namespace vantage {

/// The states that matter to a decision, and what is believed of them.
struct LikelyStates {
  std::vector<int> states;     ///< most probable first, of equal ones the lower number
  std::vector<double> belief;  ///< of each of them, sums to 1
  double mass = 1.0;           ///< what they hold of the whole belief
};

/// The `count` most probable states, fewer if fewer have any probability.
/// @param belief a probability per state, sums to 1
LikelyStates likely_states(const Eigen::VectorXd& belief, int count);

}  // namespace vantage
