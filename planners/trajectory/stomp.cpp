#include "planners/trajectory/stomp.hpp"

#include <cmath>

#include "planners/trajectory/smoothness.hpp"

namespace vantage {

void rollout_probabilities(const Eigen::Ref<const Eigen::MatrixXd>& cost, double sensitivity,
                           Eigen::Ref<Eigen::MatrixXd> probability) {
  for (Eigen::Index t = 0; t < cost.rows(); ++t) {
    const double least = cost.row(t).minCoeff();
    const double span = cost.row(t).maxCoeff() - least;
    const double factor = span > 0.0 ? -sensitivity / span : 0.0;
    double sum = 0.0;
    for (Eigen::Index u = 0; u < cost.cols(); ++u) {
      probability(t, u) = std::exp(factor * (cost(t, u) - least));
      sum += probability(t, u);
    }
    probability.row(t) /= sum;
  }
}

OptimisedHorizon Stomp::operator()(const Horizon& horizon, const PathCost& cost, Rng& rng) const {
  PathSearch search(horizon, cost);
  const Eigen::Index n = horizon.free_points();
  if (n == 0) return search.result();
  const Smoothness smoothness(n);
  std::vector<Eigen::Matrix4Xd> eps(static_cast<std::size_t>(rollouts),
                                    Eigen::Matrix4Xd::Zero(4, n));  // the first stays zero
  Eigen::MatrixXd cost_at(n, rollouts);
  Eigen::MatrixXd probability(n, rollouts);
  Eigen::Matrix4Xd mean = search.nominal();
  Eigen::Matrix4Xd trial(4, n);
  Eigen::Matrix4Xd step(4, n);
  Eigen::Vector4d sigma = noise.sigma();
  for (int i = 0; i < iterations; ++i, sigma *= noise.decay) {
    for (int u = 0; u < rollouts; ++u) {
      auto& noise_u = eps[static_cast<std::size_t>(u)];
      if (u > 0) smoothness.draw(sigma, rng, noise_u);
      trial = mean + noise_u;
      if (u > 0 || i > 0) search.evaluate(trial);  // the very first is known
      cost_at.col(u) = search.cost_of_point().segment(1, n);
    }
    rollout_probabilities(cost_at, sensitivity, probability);
    step.setZero();
    for (int u = 1; u < rollouts; ++u) {
      for (Eigen::Index t = 0; t < n; ++t) {
        step.col(t) += probability(t, u) * eps[static_cast<std::size_t>(u)].col(t);
      }
    }
    for (Eigen::Index t = 0; t < n; ++t) {
      for (Eigen::Index s = 0; s < n; ++s) mean.col(t) += smoothness.M()(t, s) * step.col(s);
    }
  }
  search.evaluate(mean);
  return search.result();
}

}  // namespace vantage
