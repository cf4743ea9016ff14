#include "vantage/planners/trajectory/optimisers/mppi.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/planners/trajectory/straight_flight.hpp"
#include "vantage/planners/trajectory/optimisers/smoothness.hpp"

namespace vantage {
namespace {

/// What is told of the paths it tries, and which they were.
struct TriedByMppi {
  std::vector<Horizon> paths;

  PathCost cost() {
    return [this](const Horizon& horizon, const Eigen::Ref<Eigen::VectorXd>& of_point) {
      paths.push_back(horizon);
      add(horizon, of_point);
    };
  }
  static void add(const Horizon& horizon, Eigen::Ref<Eigen::VectorXd> of_point) {
    for (Eigen::Index i = 0; i < horizon.count(); ++i) {
      of_point[i] += static_cast<double>(i) * std::abs(horizon.points(1, i) - 0.3);
    }
  }
  /// Control included.
  [[nodiscard]] double cost_of(std::size_t path) const {
    Eigen::VectorXd of_point = Eigen::VectorXd::Zero(paths[path].count());
    add(paths[path], of_point);
    add_control_cost(paths[path], of_point);
    return of_point.sum();
  }
};

/// The update of one round, written out: a path has one weight for all its points. The last path
/// that is tried is the mean.
TEST(Mppi, MovesAllPointsByTheNoiseOfPathsThatAreCheapAsWholes) {
  TriedByMppi tried;
  const Horizon horizon = test::straight_flight(7);
  const Mppi mppi{.rollouts = 6, .iterations = 1};
  Rng rng(3);
  mppi(horizon, tried.cost(), rng);
  ASSERT_EQ(tried.paths.size(), 7U);
  Eigen::VectorXd cost(6);
  for (std::size_t u = 0; u < 6; ++u) cost[static_cast<Eigen::Index>(u)] = tried.cost_of(u);
  const double span = cost.maxCoeff() - cost.minCoeff();
  Eigen::ArrayXd p = (-mppi.inverse_temperature * (cost.array() - cost.minCoeff()) / span).exp();
  p /= p.sum();
  Eigen::Matrix4Xd expected = horizon.points;
  for (std::size_t u = 0; u < 6; ++u) {
    expected += p[static_cast<Eigen::Index>(u)] * (tried.paths[u].points - horizon.points);
  }
  EXPECT_LT((tried.paths[6].points - expected).norm(), 1e-12);
  EXPECT_GT((expected - horizon.points).norm(), 0.01);
}

/// From the mean of the first round, with noise that has decayed once.
TEST(Mppi, SearchesLessFarAfieldInEachRound) {
  TriedByMppi tried;
  const Horizon horizon = test::straight_flight(7);
  const Mppi mppi{.rollouts = 4, .iterations = 2, .noise = {.decay = 0.25}};
  Rng rng(3);
  mppi(horizon, tried.cost(), rng);
  ASSERT_EQ(tried.paths.size(), 4U + 4U + 1U);
  Rng again(3);
  const Eigen::Index n = horizon.free_points();
  const Smoothness smoothness(n);
  Eigen::Matrix4Xd noise(4, n);
  for (int u = 1; u < 4; ++u) smoothness.draw(mppi.noise.sigma(), again, noise);
  const Eigen::Matrix4Xd mean = tried.paths[4].points.middleCols(1, n);
  for (const std::size_t path : {5U, 6U, 7U}) {
    smoothness.draw(mppi.noise.sigma(), again, noise);
    const Eigen::Matrix4Xd off = tried.paths[path].points.middleCols(1, n) - mean;
    EXPECT_LT((off - 0.25 * noise).norm(), 1e-12) << path;
  }
}

}  // namespace
}  // namespace vantage
