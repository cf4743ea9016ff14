#include "vantage/planners/trajectory/optimisers/noisy_rollouts.hpp"

namespace vantage {

OptimisedHorizon search_by_rollouts(const Horizon& horizon, const PathCost& cost, Rng& rng,
                                    const RolloutRounds& rounds, const MoveMean& move) {
  PathSearch search(horizon, cost);
  const Eigen::Index n = horizon.free_points();
  if (n == 0) return search.result();
  const Smoothness smoothness(n);
  NoisyRollouts tried{
      .eps = {static_cast<std::size_t>(rounds.rollouts), Eigen::Matrix4Xd::Zero(4, n)},
      .cost = Eigen::MatrixXd(horizon.count(), rounds.rollouts)};
  Eigen::Matrix4Xd mean = search.nominal();
  Eigen::Matrix4Xd trial(4, n);
  Eigen::Vector4d sigma = rounds.noise.sigma();
  for (int i = 0; i < rounds.rounds; ++i, sigma *= rounds.noise.decay) {
    for (int u = 0; u < rounds.rollouts; ++u) {
      auto& eps = tried.eps[static_cast<std::size_t>(u)];
      if (u > 0) smoothness.draw(sigma, rng, eps);
      trial = mean + eps;
      if (u > 0 || i > 0) search.evaluate(trial);  // the very first is known
      tried.cost.col(u) = search.cost_of_point();
    }
    move(tried, smoothness, mean);
  }
  search.evaluate(mean);
  return search.result();
}

}  // namespace vantage
