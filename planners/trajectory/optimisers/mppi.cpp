#include "vantage/planners/trajectory/optimisers/mppi.hpp"

#include "vantage/planners/trajectory/optimisers/noisy_rollouts.hpp"
#include "vantage/planners/trajectory/optimisers/stomp.hpp"

namespace vantage {

OptimisedHorizon Mppi::operator()(const Horizon& horizon, const PathCost& cost, Rng& rng) const {
  Eigen::RowVectorXd cost_of(rollouts);
  Eigen::RowVectorXd weight(rollouts);
  const auto move = [&](const NoisyRollouts& tried, const Smoothness&, Eigen::Matrix4Xd& mean) {
    cost_of = tried.cost.colwise().sum();
    rollout_probabilities(cost_of, inverse_temperature, weight);
    for (int u = 1; u < rollouts; ++u) mean += weight[u] * tried.eps[static_cast<std::size_t>(u)];
  };
  return search_by_rollouts(horizon, cost, rng, {rollouts, iterations, noise}, move);
}

}  // namespace vantage
