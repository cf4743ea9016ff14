#include "vantage/belief/map/occupancy_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace vantage {
namespace {

TEST(OccupancyGrid, StartsUnobserved) {
  OccupancyGrid grid(make_grid_frame({0, 0, 0}, {1, 1, 1}, {2, 3, 4}));
  EXPECT_EQ(grid.size(), 24U);
  EXPECT_EQ(grid.count(CellState::unobserved), 24U);
  EXPECT_EQ(grid.p_occupied(7), 0.5);
}

TEST(OccupancyGrid, ThresholdsInLogOddsMatchTheProbabilities) {
  EXPECT_FLOAT_EQ(kFreeLogOdds, static_cast<float>(log_odds_of(kFreeBelow)));
  EXPECT_FLOAT_EQ(kOccupiedLogOdds, static_cast<float>(log_odds_of(kOccupiedAbove)));
}

TEST(OccupancyGrid, ClassifiesEitherSideOfEachThreshold) {
  const auto state = [](double p) { return classify(static_cast<float>(log_odds_of(p))); };
  EXPECT_EQ(state(0.399), CellState::free);
  EXPECT_EQ(state(0.401), CellState::unobserved);
  EXPECT_EQ(state(0.599), CellState::unobserved);
  EXPECT_EQ(state(0.601), CellState::occupied);
}

TEST(OccupancyGrid, CountsEachStateOnce) {
  OccupancyGrid grid(make_grid_frame({0, 0, 0}, {1, 1, 1}, {6, 1, 1}));
  grid.log_odds = {-2.0F, -1.0F, 0.0F, 3.0F, 4.0F, 5.0F};
  EXPECT_EQ(grid.count(CellState::free), 2U);
  EXPECT_EQ(grid.count(CellState::unobserved), 1U);
  EXPECT_EQ(grid.count(CellState::occupied), 3U);
}

TEST(LogOdds, InvertsProbability) {
  for (const double p : {0.001, 0.3, 0.5, 0.9, 0.999}) {
    EXPECT_NEAR(probability_of(log_odds_of(p)), p, 1e-12);
  }
}

TEST(OccupancyGrid, JustAtAThresholdACellIsKnown) {
  EXPECT_EQ(classify(kFreeLogOdds), CellState::free);
  EXPECT_EQ(classify(kOccupiedLogOdds), CellState::occupied);
  EXPECT_EQ(classify(std::nextafter(kFreeLogOdds, 0.0F)), CellState::unobserved);
  EXPECT_EQ(classify(std::nextafter(kOccupiedLogOdds, 0.0F)), CellState::unobserved);
}

}  // namespace
}  // namespace vantage
