#include "vantage/planners/views/left_forecast.hpp"

#include <gtest/gtest.h>

#include <numbers>

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
}

/// It is a matter of their difference alone, without a jump.
TEST(ConfidenceOfLeft, IsContinuousInTheDifference) {
  for (double more = -0.03; more < 0.06; more += 1e-5) {
    EXPECT_NEAR(confidence_of_left(0.03, 0.03 + more), confidence_of_left(0.05, 0.05 + more),
                1e-11);
    EXPECT_NEAR(confidence_of_left(0.03, 0.03 + more), confidence_of_left(0.03, 0.03 + more + 1e-5),
                0.002);
  }
}

/// At 5, 15, ... 95 % of the decisions in training so much more was left than was expected.
TEST(ConfidenceOfLeft, IsTheShareOfDecisionsInTraining) {
  constexpr double kExpected = 0.02;
  double share = 0.05;
  for (const double more :
       {-0.0036, 0.0051, 0.0126, 0.0161, 0.0186, 0.0197, 0.0205, 0.0217, 0.0245, 0.0278}) {
    EXPECT_NEAR(confidence_of_left(kExpected, kExpected + more), share, 1e-9) << more;
    share += 0.1;
  }
  const auto at = [&](double more) { return confidence_of_left(kExpected, kExpected + more); };
  EXPECT_NEAR(at(0.00075), 0.1, 1e-9) << "half way between";
  EXPECT_NEAR(at(-0.0086), 0.05 / std::numbers::e, 1e-9) << "below the least";
  EXPECT_NEAR(at(0.0328), 1.0 - 0.05 / std::numbers::e, 1e-9) << "above the most";
}

}  // namespace
}  // namespace vantage
