#include "vantage/planners/navigation/travel_time.hpp"

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

}  // namespace
}  // namespace vantage
