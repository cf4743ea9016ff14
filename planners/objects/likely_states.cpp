#include "vantage/planners/objects/likely_states.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "vantage/core/error.hpp"

namespace vantage {

LikelyStates likely_states(const Eigen::VectorXd& belief, int count) {
  expects(count > 0, "likely_states needs room for a state");
  expects(belief.size() > 0 && belief.minCoeff() >= 0.0 && std::abs(belief.sum() - 1.0) < 1e-6,
          "a belief is probabilities that sum to 1");
  std::vector<int> order(static_cast<std::size_t>(belief.size()));
  std::iota(order.begin(), order.end(), 0);
  const auto kept = std::min(order.size(), static_cast<std::size_t>(count));
  const auto rank = [&](int state) { return std::pair(-belief[state], state); };
  std::ranges::partial_sort(order, order.begin() + static_cast<std::ptrdiff_t>(kept), {}, rank);
  LikelyStates likely{.states = {}, .belief = {}, .mass = 0.0};
  for (std::size_t i = 0; i < kept && belief[order[i]] > 0.0; ++i) {
    likely.states.push_back(order[i]);
    likely.belief.push_back(belief[order[i]]);
    likely.mass += belief[order[i]];
  }
  for (double& p : likely.belief) p /= likely.mass;
  return likely;
}

}  // namespace vantage
