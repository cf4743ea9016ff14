#include "vantage/information/quantile.hpp"

#include <gtest/gtest.h>

namespace vantage {
namespace {

TEST(Quantile, IsTheValueOfTheNearestRank) {
  const std::vector<double> values{5.0, 1.0, 4.0, 2.0, 3.0};
  EXPECT_EQ(quantile(values, 0.0), 1.0);
  EXPECT_EQ(quantile(values, 0.5), 3.0);
  EXPECT_EQ(quantile(values, 0.6), 3.0);
  EXPECT_EQ(quantile(values, 0.7), 4.0);
  EXPECT_EQ(quantile(values, 1.0), 5.0);
}

TEST(Quantile, OfTwoTheMedianIsTheGreater) {
  EXPECT_EQ(quantile({1.0, 2.0}, 0.5), 2.0);
  EXPECT_EQ(quantile({7.0}, 0.5), 7.0);
}

TEST(Quantile, RanksAreRoundedToTheNearest) {
  const std::vector<double> values{40.0, 10.0, 30.0, 20.0};
  EXPECT_EQ(quantile(values, 0.16), 10.0);
  EXPECT_EQ(quantile(values, 0.17), 20.0);
  EXPECT_EQ(quantile(values, 0.49), 20.0);
  EXPECT_EQ(quantile(values, 0.84), 40.0);
}

}  // namespace
}  // namespace vantage
