#include "vantage/belief/objects/view_weight.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace vantage {
namespace {

TEST(ViewWeight, OfTheFirstViewIsOneAndSoAreAllWithoutCorrelation) {
  for (const double correlation : {0.0, 0.3, 1.0}) EXPECT_EQ(view_weight(0, correlation), 1.0);
  for (int before = 0; before < 8; ++before) EXPECT_EQ(view_weight(before, 0.0), 1.0);
}

TEST(ViewWeight, OfRepetitionsIsNothing) {
  for (int before = 1; before < 8; ++before) EXPECT_NEAR(view_weight(before, 1.0), 0.0, 1e-12);
}

// The precision of the mean of n values of variance 1 and correlation r in pairs.
TEST(ViewWeight, TogetherAreWorthThePrecisionOfAMean) {
  constexpr double kCorrelation = 0.35;
  double sum = 0.0;
  for (int n = 1; n <= 8; ++n) {
    sum += view_weight(n - 1, kCorrelation);
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Constant(n, n, kCorrelation);
    covariance.diagonal().setOnes();
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(n);
    EXPECT_NEAR(sum, ones.dot(covariance.inverse() * ones), 1e-12);
  }
}

TEST(ViewWeight, Falls) {
  for (int before = 1; before < 20; ++before) {
    EXPECT_LT(view_weight(before, 0.1), view_weight(before - 1, 0.1));
    EXPECT_GT(view_weight(before, 0.1), 0.0);
  }
}

}  // namespace
}  // namespace vantage
