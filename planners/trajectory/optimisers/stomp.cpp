#include "vantage/planners/trajectory/optimisers/stomp.hpp"

#include <cmath>

#include "vantage/planners/trajectory/optimisers/noisy_rollouts.hpp"

namespace vantage {

void rollout_probabilities(const Eigen::Ref<const Eigen::MatrixXd>& cost,
                           double inverse_temperature, Eigen::Ref<Eigen::MatrixXd> probability) {
  for (Eigen::Index t = 0; t < cost.rows(); ++t) {
    const double least = cost.row(t).minCoeff();
    const double span = cost.row(t).maxCoeff() - least;
    const double factor = span > 0.0 ? -inverse_temperature / span : 0.0;
    double sum = 0.0;
    for (Eigen::Index u = 0; u < cost.cols(); ++u) {
      probability(t, u) = std::exp(factor * (cost(t, u) - least));
      sum += probability(t, u);
    }
    probability.row(t) /= sum;
  }
}

OptimisedHorizon Stomp::operator()(const Horizon& horizon, const PathCost& cost, Rng& rng) const {
  const Eigen::Index n = horizon.free_points();
  Eigen::MatrixXd probability(n, rollouts);
  Eigen::Matrix4Xd step(4, n);
  const auto move = [&](const NoisyRollouts& tried, const Smoothness& smoothness,
                        Eigen::Matrix4Xd& mean) {
    rollout_probabilities(tried.cost.middleRows(1, n), inverse_temperature, probability);
    step.setZero();
    for (int u = 1; u < rollouts; ++u) {
      for (Eigen::Index t = 0; t < n; ++t) {
        step.col(t) += probability(t, u) * tried.eps[static_cast<std::size_t>(u)].col(t);
      }
    }
    for (Eigen::Index t = 0; t < n; ++t) {
      for (Eigen::Index s = 0; s < n; ++s) mean.col(t) += smoothness.M()(t, s) * step.col(s);
    }
  };
  return search_by_rollouts(horizon, cost, rng, {rollouts, iterations, noise}, move);
}

}  // namespace vantage
