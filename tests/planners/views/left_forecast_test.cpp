#include "vantage/planners/views/left_forecast.hpp"

#include <gtest/gtest.h>

namespace vantage {
namespace {

TEST(LeftShare, IsOfAllThatCanBeSeen) {
  EXPECT_DOUBLE_EQ(left_share(5.0, 95.0), 0.05);
  EXPECT_DOUBLE_EQ(left_share(0.0, 10.0), 0.0);
  EXPECT_DOUBLE_EQ(left_share(0.0, 0.0), 1.0) << "nothing is known yet";
}

TEST(ConfidenceOfLeft, GrowsWithWhatMayBeLeftAndFallsWithWhatIsExpected) {
  double last = -1.0;
  for (double left = 0.0; left < 0.2; left += 0.001) {
    const double confidence = confidence_of_left(0.03, left);
    EXPECT_GE(confidence, last);
    EXPECT_LE(confidence, 1.0);
    last = confidence;
  }
  EXPECT_GT(last, 0.9);
  EXPECT_GT(confidence_of_left(0.01, 0.05), confidence_of_left(0.04, 0.05));
  EXPECT_DOUBLE_EQ(confidence_of_left(0.04, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(confidence_of_left(0.0, 0.05), 1.0);
}

/// It is a matter of their ratio alone, without a jump.
TEST(ConfidenceOfLeft, IsContinuousInTheRatio) {
  for (double times = 0.05; times < 5.0; times *= 1.001) {
    EXPECT_NEAR(confidence_of_left(0.02, 0.02 * times), confidence_of_left(0.05, 0.05 * times),
                1e-12);
    EXPECT_NEAR(confidence_of_left(0.02, 0.02 * times), confidence_of_left(0.02, 0.02002 * times),
                0.02);
  }
}

/// At 5, 15, ... 95 % of the decisions in training the true share was so many times the expected.
TEST(ConfidenceOfLeft, IsTheShareOfDecisionsInTraining) {
  constexpr double kExpected = 0.02;
  double share = 0.05;
  for (const double times : {0.94, 1.08, 1.18, 1.27, 1.41, 1.62, 1.78, 2.04, 2.62, 3.33}) {
    EXPECT_NEAR(confidence_of_left(kExpected, times * kExpected), share, 1e-9) << times;
    share += 0.1;
  }
  EXPECT_NEAR(confidence_of_left(kExpected, 1.01 * kExpected), 0.1, 1e-9) << "half way between";
  EXPECT_NEAR(confidence_of_left(kExpected, 0.47 * kExpected), 0.025, 1e-9) << "half of the least";
  EXPECT_NEAR(confidence_of_left(kExpected, 6.66 * kExpected), 0.975, 1e-9) << "twice the most";
}

TEST(ConfidenceOfLeft, IsSureWhereNothingIsExpectedAndNothingMayBeLeft) {
  EXPECT_EQ(confidence_of_left(0.0, 0.0), 1.0);
}

}  // namespace
}  // namespace vantage
