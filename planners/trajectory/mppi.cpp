#include "planners/trajectory/mppi.hpp"

#include <vector>

#include "planners/trajectory/smoothness.hpp"
#include "planners/trajectory/stomp.hpp"

namespace vantage {

OptimisedHorizon Mppi::operator()(const Horizon& horizon, const PathCost& cost, Rng& rng) const {
  PathSearch search(horizon, cost);
  const Eigen::Index n = horizon.free_points();
  if (n == 0) return search.result();
  const Smoothness smoothness(n);
  std::vector<Eigen::Matrix4Xd> eps(static_cast<std::size_t>(rollouts),
                                    Eigen::Matrix4Xd::Zero(4, n));  // the first stays zero
  Eigen::RowVectorXd cost_of(rollouts);
  Eigen::RowVectorXd weight(rollouts);
  Eigen::Matrix4Xd mean = search.nominal();
  Eigen::Matrix4Xd trial(4, n);
  Eigen::Vector4d sigma = noise.sigma();
  for (int i = 0; i < iterations; ++i, sigma *= noise.decay) {
    for (int u = 0; u < rollouts; ++u) {
      auto& noise_u = eps[static_cast<std::size_t>(u)];
      if (u > 0) smoothness.draw(sigma, rng, noise_u);
      trial = mean + noise_u;
      if (u > 0 || i > 0) search.evaluate(trial);  // the very first is known
      cost_of[u] = search.cost_of_point().sum();
    }
    rollout_probabilities(cost_of, sensitivity, weight);
    for (int u = 1; u < rollouts; ++u) mean += weight[u] * eps[static_cast<std::size_t>(u)];
  }
  search.evaluate(mean);
  return search.result();
}

}  // namespace vantage
