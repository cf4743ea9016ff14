#include "vantage/planners/trajectory/optimisers/stomp.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/planners/trajectory/straight_flight.hpp"
#include "vantage/planners/trajectory/optimisers/smoothness.hpp"

namespace vantage {
namespace {

TEST(RolloutProbabilities, SumToOneAtEveryPoint) {
  Rng rng(1);
  Eigen::MatrixXd cost(8, 20);
  for (double& c : cost.reshaped()) c = 1e3 * rng.uniform();
  Eigen::MatrixXd probability(8, 20);
  rollout_probabilities(cost, 10.0, probability);
  for (Eigen::Index t = 0; t < 8; ++t) EXPECT_NEAR(probability.row(t).sum(), 1.0, 1e-14);
  EXPECT_GT(probability.minCoeff(), 0.0);
}

TEST(RolloutProbabilities, FallByExpOfHOverTheSpan) {
  Eigen::MatrixXd cost(1, 3);
  cost << 2.0, 4.0, 3.0;
  Eigen::MatrixXd probability(1, 3);
  rollout_probabilities(cost, 10.0, probability);
  EXPECT_NEAR(probability(0, 1) / probability(0, 0), std::exp(-10.0), 1e-15);
  EXPECT_NEAR(probability(0, 2) / probability(0, 0), std::exp(-5.0), 1e-15);
}

TEST(RolloutProbabilities, AreEqualWhereCostsAre) {
  const Eigen::MatrixXd cost = Eigen::MatrixXd::Constant(2, 5, 7.0);
  Eigen::MatrixXd probability(2, 5);
  rollout_probabilities(cost, 10.0, probability);
  EXPECT_LT((probability.array() - 0.2).abs().maxCoeff(), 1e-15);
}

TEST(Stomp, StaysWhereAllPathsCostTheSame) {
  // Only control counts, and a straight flight of constant speed has none.
  const auto nothing = [](const Horizon&, const Eigen::Ref<Eigen::VectorXd>&) {};
  const Horizon horizon = test::straight_flight();
  Rng rng(1);
  const auto result = Stomp{}(horizon, nothing, rng);
  EXPECT_EQ(result.points, horizon.points);
  EXPECT_EQ(result.cost, result.initial_cost);
}

/// The update of one round, written out: each point moves by the probable part of the noise at that
/// very point, smoothed by M. The last path that is tried is the mean.
TEST(Stomp, MovesEachPointByTheNoiseThatIsCheapThere) {
  std::vector<Horizon> tried;
  const auto cost = [&](const Horizon& horizon, Eigen::Ref<Eigen::VectorXd> of_point) {
    tried.push_back(horizon);
    for (Eigen::Index i = 0; i < horizon.count(); ++i) {
      of_point[i] += static_cast<double>(i) * std::abs(horizon.points(1, i) - 0.3);
    }
  };
  const Horizon horizon = test::straight_flight(7);
  const Stomp stomp{.rollouts = 6, .iterations = 1};
  Rng rng(3);
  stomp(horizon, cost, rng);
  ASSERT_EQ(tried.size(), 7U);

  const Eigen::Index n = horizon.free_points();
  Eigen::MatrixXd cost_of(7, 6);
  const std::vector<Horizon> paths(tried.begin(), tried.end() - 1);
  for (Eigen::Index u = 0; u < 6; ++u) {
    Eigen::VectorXd of_point = Eigen::VectorXd::Zero(7);
    cost(paths[static_cast<std::size_t>(u)], of_point);
    add_control_cost(paths[static_cast<std::size_t>(u)], of_point);
    cost_of.col(u) = of_point;
  }
  Eigen::Matrix4Xd step = Eigen::Matrix4Xd::Zero(4, n);
  for (Eigen::Index t = 0; t < n; ++t) {
    const auto at = cost_of.row(t + 1);
    const double span = at.maxCoeff() - at.minCoeff();
    Eigen::VectorXd p(6);
    for (Eigen::Index u = 0; u < 6; ++u) {
      p[u] = std::exp(-stomp.inverse_temperature * (at[u] - at.minCoeff()) / span);
    }
    p /= p.sum();
    for (Eigen::Index u = 0; u < 6; ++u) {
      step.col(t) += p[u] * (paths[static_cast<std::size_t>(u)].points - horizon.points).col(t + 1);
    }
  }
  const Eigen::Matrix4Xd expected =
      horizon.points.middleCols(1, n) + step * Smoothness(n).M().transpose();
  EXPECT_LT((tried[6].points.middleCols(1, n) - expected).norm(), 1e-12);
  EXPECT_GT((expected - horizon.points.middleCols(1, n)).norm(), 0.01);
}

TEST(Stomp, StraightensABentFlight) {
  const auto nothing = [](const Horizon&, const Eigen::Ref<Eigen::VectorXd>&) {};
  Horizon horizon = test::straight_flight();
  for (Eigen::Index i = 1; i < 9; ++i)
    horizon.points(1, i) = std::sin(M_PI * static_cast<double>(i) / 9.0);
  Rng rng(1);
  const auto result = Stomp{}(horizon, nothing, rng);
  EXPECT_LT(result.cost, 0.2 * result.initial_cost);
}

TEST(StompOptions, AreChecked) {
  EXPECT_THROW(check_options(Stomp{.rollouts = 1}), ConfigError);
  EXPECT_THROW(check_options(Stomp{.inverse_temperature = 0.0}), ConfigError);
  EXPECT_THROW(check_options(Stomp{.noise = {.decay = 1.5}}), ConfigError);
}

}  // namespace
}  // namespace vantage
