#include "vantage/planners/trajectory/optimisers/cem.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "vantage/planners/trajectory/optimisers/smoothness.hpp"

namespace vantage {
namespace {

/// Mean and deviation of each point of the elite.
struct Elite {
  Eigen::Matrix4Xd mean;
  Eigen::Matrix4Xd deviation;

  explicit Elite(Eigen::Index n) : mean(4, n), deviation(4, n) {}

  void fit(const std::vector<Eigen::Matrix4Xd>& paths, const std::vector<std::size_t>& order,
           std::size_t count) {
    mean.setZero();
    deviation.setZero();
    for (std::size_t e = 0; e < count; ++e) mean += paths[order[e]];
    mean /= static_cast<double>(count);
    for (std::size_t e = 0; e < count; ++e) {
      deviation.array() += (paths[order[e]] - mean).array().square();
    }
    deviation = (deviation / static_cast<double>(count)).cwiseSqrt();
  }
};

}  // namespace

void Cem::check() const {
  if (elites > rollouts) throw ConfigError("elites: more than rollouts");
}

OptimisedHorizon Cem::operator()(const Horizon& horizon, const PathCost& cost, Rng& rng) const {
  PathSearch search(horizon, cost);
  const Eigen::Index n = horizon.free_points();
  if (n == 0) return search.result();
  const Smoothness smoothness(n);
  const auto tries = static_cast<std::size_t>(rollouts);
  std::vector<Eigen::Matrix4Xd> paths(tries, search.nominal());
  std::vector<double> cost_of(tries, search.best_cost());
  std::vector<std::size_t> order(tries);
  std::iota(order.begin(), order.end(), std::size_t{0});
  Elite elite(n);
  Eigen::Matrix4Xd mean = search.nominal();
  // Of a point, as share of what the covariance of the first iteration gives it.
  const Eigen::Matrix4Xd deviation =
      noise.sigma() * smoothness.covariance().diagonal().cwiseSqrt().transpose();
  Eigen::Matrix4Xd scale = Eigen::Matrix4Xd::Ones(4, n);
  for (int i = 0; i < iterations; ++i) {
    for (std::size_t u = 0; u < tries; ++u) {
      paths[u].setZero();
      if (u > 0) smoothness.draw(noise.sigma(), rng, paths[u]);
      paths[u] = mean + paths[u].cwiseProduct(scale);
      if (u > 0 || i > 0) cost_of[u] = search.evaluate(paths[u]);  // the very first is known
    }
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
      return cost_of[a] != cost_of[b] ? cost_of[a] < cost_of[b] : a < b;
    });
    elite.fit(paths, order, static_cast<std::size_t>(elites));
    mean += learning * (elite.mean - mean);
    for (Eigen::Index k = 0; k < scale.size(); ++k) {
      const double fitted = deviation(k) > 0.0 ? elite.deviation(k) / deviation(k) : min_sigma;
      scale(k) = std::max(min_sigma, scale(k) + learning * (fitted - scale(k)));
    }
  }
  search.evaluate(mean);
  return search.result();
}

}  // namespace vantage
