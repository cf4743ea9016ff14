#include "vantage/planners/trajectory/optimisers/smoothness.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "tests/planners/trajectory/straight_flight.hpp"

namespace vantage {
namespace {

double condition_of_R(Eigen::Index n) {
  const Eigen::MatrixXd A = second_differences(n);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A.transpose() * A);
  return solver.eigenvalues()[n - 1] / solver.eigenvalues()[0];
}

TEST(Smoothness, SecondDifferencesOfThreeFreePoints) {
  Eigen::MatrixXd expected(5, 3);
  expected << 1, 0, 0, -2, 1, 0, 1, -2, 1, 0, 1, -2, 0, 0, 1;
  EXPECT_EQ(second_differences(3), expected);
}

TEST(Smoothness, KnownGreatestElementsOfInverse) {
  EXPECT_NEAR(Smoothness(8).R_inverse().maxCoeff(), 5.15, 0.005);
  EXPECT_NEAR(Smoothness(18).R_inverse().maxCoeff(), 41.6, 0.05);
  EXPECT_NEAR(Smoothness(98).R_inverse().maxCoeff(), 5208.0, 0.5);
}

TEST(Smoothness, KnownConditionNumbers) {
  EXPECT_NEAR(condition_of_R(8), 299.0, 0.5);
  EXPECT_NEAR(condition_of_R(18), 5.0e3, 0.05e3);
  EXPECT_NEAR(condition_of_R(98), 3.2e6, 0.05e6);
}

TEST(Smoothness, ColumnMaximaOfMAreOneOverN) {
  for (const Eigen::Index n : {1, 2, 8, 18, 98}) {
    const Smoothness smoothness(n);
    for (Eigen::Index column = 0; column < n; ++column) {
      EXPECT_NEAR(smoothness.M().col(column).maxCoeff(), 1.0 / static_cast<double>(n), 1e-12);
    }
  }
}

TEST(Smoothness, MKeepsTheShapeOfTheColumnsOfInverse) {
  const Smoothness smoothness(8);
  const Eigen::VectorXd ratio = smoothness.M().col(2).cwiseQuotient(smoothness.R_inverse().col(2));
  EXPECT_LT(ratio.maxCoeff() - ratio.minCoeff(), 1e-12);
}

TEST(Smoothness, NoiseHasTheCovarianceOfSmoothPaths) {
  const Smoothness smoothness(8);
  const Eigen::Vector4d sigma(0.5, 0.4, 0.2, 0.1);
  Rng rng(1);
  Eigen::Matrix4Xd noise(4, 8);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(8, 8);
  double across = 0.0;
  constexpr int kDraws = 40'000;
  for (int i = 0; i < kDraws; ++i) {
    smoothness.draw(sigma, rng, noise);
    covariance += noise.row(1).transpose() * noise.row(1) / (0.16 * kDraws);
    across += noise(0, 4) * noise(1, 4) / (0.2 * kDraws);
  }
  EXPECT_LT((covariance - smoothness.covariance()).cwiseAbs().maxCoeff(), 0.03);
  EXPECT_NEAR(across, 0.0, 0.03);
  EXPECT_DOUBLE_EQ(smoothness.covariance().maxCoeff(), 1.0);
}

/// Each column from what was drawn for it and for those before it.
TEST(Smoothness, NoiseIsDrawnIntoTheColumnsGivenAlone) {
  const Smoothness smoothness(5);
  const Eigen::Vector4d sigma(0.5, 0.4, 0.2, 0.1);
  Eigen::Matrix4Xd wider = Eigen::Matrix4Xd::Constant(4, 7, 9.0);
  Rng rng(2);
  smoothness.draw(sigma, rng, wider.middleCols(1, 5));
  Rng same(2);
  Eigen::Matrix4Xd drawn(4, 5);
  for (double& value : drawn.reshaped()) value = same.normal();
  const Eigen::MatrixXd L = smoothness.covariance().llt().matrixL();
  const Eigen::Matrix4Xd expected = sigma.asDiagonal() * drawn * L.transpose();
  EXPECT_LT((wider.middleCols(1, 5) - expected).cwiseAbs().maxCoeff(), 1e-12);
  for (const Eigen::Index beside : {0, 6}) {
    EXPECT_EQ(wider.col(beside), Eigen::Vector4d::Constant(9.0)) << beside;
  }
}

TEST(ControlCost, OfAStraightFlightOfConstantSpeedIsZero) {
  for (const Eigen::Index count : {10, 20, 100}) {
    Horizon horizon = test::straight_flight(count);
    horizon.points.row(3).setLinSpaced(1.0, 1.0 + 0.1 * static_cast<double>(count - 1));
    horizon.before[3] = 0.9;
    horizon.after[3] = 1.0 + 0.1 * static_cast<double>(count);
    Eigen::VectorXd cost = Eigen::VectorXd::Zero(count);
    add_control_cost(horizon, cost);
    EXPECT_NEAR(cost.sum(), 0.0, 1e-20);
  }
}

TEST(ControlCost, IsHalfTheSquareOfAQPlusB) {
  Horizon horizon = test::straight_flight(6);
  Rng rng(3);
  for (auto& value : horizon.points.reshaped()) value += rng.normal();
  const Eigen::MatrixXd A = second_differences(4);
  double expected = 0.0;
  for (Eigen::Index d = 0; d < 4; ++d) {
    Eigen::VectorXd b = Eigen::VectorXd::Zero(6);
    b[0] = horizon.before[d] - 2.0 * horizon.points(d, 0);
    b[1] = horizon.points(d, 0);
    b[4] = horizon.points(d, 5);
    b[5] = horizon.after[d] - 2.0 * horizon.points(d, 5);
    const Eigen::VectorXd Q = horizon.points.row(d).segment(1, 4).transpose();
    expected += 0.5 * (A * Q + b).squaredNorm();
  }
  Eigen::VectorXd cost = Eigen::VectorXd::Zero(6);
  add_control_cost(horizon, cost);
  EXPECT_NEAR(cost.sum(), expected, 1e-12);
}

TEST(ControlCost, OfAStepOfOnePoint) {
  Horizon horizon = test::straight_flight(5);
  horizon.points(1, 2) = 0.3;
  Eigen::VectorXd cost = Eigen::VectorXd::Zero(5);
  add_control_cost(horizon, cost);
  const Eigen::VectorXd expected = (Eigen::VectorXd(5) << 0.0, 0.045, 0.18, 0.045, 0.0).finished();
  EXPECT_LT((cost - expected).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(UnwrappedHorizon, GoesTheShortWayRound) {
  Horizon horizon = test::straight_flight(3);
  horizon.before[3] = 3.0;
  horizon.points.row(3) << -3.1, 3.1, -2.9;
  horizon.after[3] = 0.0;
  const Horizon smooth = unwrapped(horizon);
  EXPECT_NEAR(smooth.points(3, 0), 2.0 * M_PI - 3.1, 1e-12);
  EXPECT_NEAR(smooth.points(3, 1), 3.1, 1e-12);
  EXPECT_NEAR(smooth.points(3, 2), 2.0 * M_PI - 2.9, 1e-12);
  EXPECT_NEAR(smooth.after[3], 2.0 * M_PI, 1e-12);
}

/// Nearly half a turn either way: from another yaw than the last the short way would be the other.
TEST(UnwrappedHorizon, TheOneAfterFollowsTheLast) {
  for (const double yaw : {0.0, 1.5, 3.0}) {
    for (const double turn : {3.0, -3.0}) {
      Horizon horizon = test::straight_flight(3);
      horizon.before[3] = yaw;
      horizon.points.row(3).setConstant(yaw);
      horizon.after[3] = yaw + turn;
      EXPECT_NEAR(unwrapped(horizon).after[3], yaw + turn, 1e-12) << yaw << " " << turn;
    }
  }
}

}  // namespace
}  // namespace vantage
