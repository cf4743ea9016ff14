#pragma once

#include <Eigen/Core>

#include <vector>

#include "vantage/belief/objects/object_states.hpp"

namespace vantage {

/// The states that matter to a decision, and what is believed of them.
struct LikelyStates {
  /// Most probable first, of equal ones the lower number; of equal ones that are not all kept,
  /// those that are lie evenly spread over them: the first objects of a database are alike.
  std::vector<int> states;
  std::vector<double> belief;  ///< of each of them, sums to 1
  double mass = 1.0;           ///< what they hold of the whole belief
};

/// The `count` most probable states, fewer if fewer have any probability.
/// @param belief a probability per state, sums to 1
LikelyStates likely_states(const Eigen::VectorXd& belief, int count);

/// The same where objects may be unknown: the most probable known states, then the most probable
/// unknown ones, an eighth of `count` at most but one, each kind scaled to what it holds of the
/// whole belief. Without that, a prior that is spread over thousands of known states would leave
/// only hypotheses of the unknown, which nothing tells apart, and no feature would be worth while.
LikelyStates likely_states(const ObjectStates& database, const Eigen::VectorXd& belief, int count);

}  // namespace vantage
