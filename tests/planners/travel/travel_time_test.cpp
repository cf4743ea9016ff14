#include "vantage/planners/travel/travel_time.hpp"

#include <gtest/gtest.h>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

TEST(TravelTime, IsThatOfTheSpeedAtFirst) {
  const TravelTime travel(0.6);
  EXPECT_NEAR(travel.of_m(6.0) - travel.of_m(0.0), 1.1 * 10.0, 1e-9);
  EXPECT_GT(travel.of_m(0.0), 0.0);
}

TEST(TravelTime, LearnsWhatDrivesTake) {
  Rng rng(1);
  TravelTime travel(0.6);
  for (int k = 0; k < 400; ++k) {
    const double length_m = rng.uniform(0.5, 15.0);
    travel.observe(length_m, 4.0 + 2.5 * length_m + rng.normal(0.0, 1.0));
  }
  EXPECT_NEAR(travel.of_m(0.0), 4.0, 0.3);
  EXPECT_NEAR(travel.of_m(10.0), 29.0, 0.3);
}

TEST(TravelTime, NeverPromisesMoreThanTwiceTheSpeed) {
  TravelTime travel(0.5);
  for (int k = 0; k < 20; ++k) {
    travel.observe(1.0, 30.0);
    travel.observe(10.0, 2.0);
  }
  EXPECT_NEAR(travel.of_m(11.0) - travel.of_m(10.0), 1.0, 1e-9);
  EXPECT_GE(travel.of_m(0.0), 0.0);
}

/// A line through the prior's two drives, of 1 and 8 m, is the prior's; another drive tilts it.
TEST(TravelTime, IsTheLineThroughThePriorAndTheDrives) {
  TravelTime travel(0.5);
  EXPECT_NEAR(travel.of_m(0.0), 2.5, 1e-9) << "to start and to turn";
  EXPECT_NEAR(travel.of_m(10.0), 2.5 + 10.0 * 1.1 / 0.5, 1e-9);
  // At 3 m, 9.9 s above the prior's line. Mean length 4 m, squares about it 9 + 16 + 1.
  travel.observe(3.0, 2.5 + 3.0 * 2.2 + 9.9);
  const double s_per_m = 2.2 - 9.9 / 26.0;
  EXPECT_NEAR(travel.of_m(4.0), 2.5 + 4.0 * 2.2 + 9.9 / 3.0, 1e-9) << "through the means";
  EXPECT_NEAR(travel.of_m(5.0) - travel.of_m(4.0), s_per_m, 1e-9);
}

TEST(TravelTime, NoDriveTakesLessThanNothingToStart) {
  TravelTime travel(0.5);
  for (int k = 0; k < 50; ++k) {
    travel.observe(1.0, 0.5);
    travel.observe(10.0, 60.0);
  }
  EXPECT_EQ(travel.of_m(0.0), 0.0);
  EXPECT_GT(travel.of_m(1.0), 5.0);
}

}  // namespace
}  // namespace vantage
