#include "vantage/planners/objects/likely_states.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "vantage/core/error.hpp"

namespace vantage {

namespace {

void require_belief(const Eigen::VectorXd& belief, int count) {
  expects(count > 0, "likely_states needs room for a state");
  expects(belief.size() > 0 && belief.minCoeff() >= 0.0 && std::abs(belief.sum() - 1.0) < 1e-6,
          "a belief is probabilities that sum to 1");
}

/// The last of the `kept` first of `order`, as far as others beyond are as probable, in place of
/// themselves taken evenly from all that are.
void spread_ties(const Eigen::VectorXd& belief, std::vector<int>& order, std::size_t kept) {
  constexpr double kEqual = 1e-9;  // relative: the sums of a motion round
  if (kept == 0 || kept == order.size()) return;
  const double last = belief[order[kept - 1]];
  const auto more = [&](int state) { return belief[state] > last * (1.0 + kEqual); };
  const auto tied_end = std::partition(order.begin(), order.end(), [&](int state) {
    return belief[state] >= last * (1.0 - kEqual);
  });
  const auto tied_begin = std::partition(order.begin(), tied_end, more);
  std::sort(tied_begin, tied_end);
  const std::vector<int> tied(tied_begin, tied_end);
  const auto first = static_cast<std::size_t>(tied_begin - order.begin());
  const std::size_t room = kept - first;
  for (std::size_t i = 0; i < room; ++i) order[first + i] = tied[i * tied.size() / room];
}

/// Of the states from `first` to `last`; their belief sums to 1 unless they have none.
LikelyStates most_probable(const Eigen::VectorXd& belief, int first, int last, int count) {
  std::vector<int> order(static_cast<std::size_t>(last - first));
  std::iota(order.begin(), order.end(), first);
  const auto kept = std::min(order.size(), static_cast<std::size_t>(count));
  const auto rank = [&](int state) { return std::pair(-belief[state], state); };
  const auto end = order.begin() + static_cast<std::ptrdiff_t>(kept);
  std::ranges::partial_sort(order, end, {}, rank);
  spread_ties(belief, order, kept);
  std::ranges::sort(order.begin(), end, {}, rank);
  LikelyStates likely{.states = {}, .belief = {}, .mass = 0.0};
  for (std::size_t i = 0; i < kept && belief[order[i]] > 0.0; ++i) {
    likely.states.push_back(order[i]);
    likely.belief.push_back(belief[order[i]]);
    likely.mass += belief[order[i]];
  }
  for (double& p : likely.belief) p /= likely.mass;
  return likely;
}

}  // namespace

LikelyStates likely_states(const Eigen::VectorXd& belief, int count) {
  require_belief(belief, count);
  return most_probable(belief, 0, static_cast<int>(belief.size()), count);
}

LikelyStates likely_states(const ObjectStates& database, const Eigen::VectorXd& belief, int count) {
  if (database.unknown_size() == 0) return likely_states(belief, count);
  require_belief(belief, count);
  expects(belief.size() == database.size(), "a probability per state");
  const int of_unknown = std::min(database.unknown_size(), std::max(1, count / 8));
  const int known = database.known_size();
  LikelyStates likely = most_probable(belief, 0, known, std::max(1, count - of_unknown));
  const LikelyStates unknown = most_probable(belief, known, database.size(), of_unknown);
  const double p_unknown = belief.tail(database.unknown_size()).sum();
  const double p_known = belief.head(known).sum();
  for (double& p : likely.belief) p *= p_known;
  for (std::size_t i = 0; i < unknown.states.size(); ++i) {
    likely.states.push_back(unknown.states[i]);
    likely.belief.push_back(unknown.belief[i] * p_unknown);
  }
  likely.mass += unknown.mass;
  return likely;
}

}  // namespace vantage
