#include "vantage/planners/choice/drawn_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

TEST(DrawnMap, HasACellOfWhatIsThinnerThanOne) {
  const OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.0}, {0.6, 0.6, 0.2}, {6, 6, 2}));
  const BlockField transmission = uniform_field(grid.frame.cells, 0.5);
  const DrawableMap belief({grid, &transmission}, 3);
  ASSERT_EQ(belief.grid().size(), 4U);
  EXPECT_EQ(belief.grid().state(0), CellState::unobserved) << "18 of 18";
  const DrawableMap one({grid, &transmission}, 5);
  ASSERT_EQ(one.grid().size(), 1U);
  EXPECT_EQ(one.grid().state(0), CellState::unobserved) << "all 50 that there are";
  Rng rng(1);
  EXPECT_EQ(belief.draw(rng).utility, 18.0);
  EXPECT_EQ(one.draw(rng).utility, 50.0);
}

/// Four cells of 2 x 2 x 2: with three unobserved ones, with four, with four and an occupied one,
/// and with eight. What is left over belongs to none.
TEST(DrawnMap, ACellIsOccupiedByOneAndUnobservedByHalfOfItsCells) {
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.0}, {0.9, 0.3, 0.2}, {9, 3, 2}));
  std::ranges::fill(grid.log_odds, -3.0F);
  const auto leave_unobserved = [&](int x, int count) {
    for (int k = 0; k < count; ++k) {
      grid.log_odds[grid.frame.index({x + k % 2, k / 2 % 2, k / 4})] = 0.0F;
    }
  };
  leave_unobserved(0, 3);
  leave_unobserved(2, 4);
  leave_unobserved(4, 4);
  leave_unobserved(6, 8);
  grid.log_odds[grid.frame.index({5, 1, 1})] = 3.0F;
  const BlockField transmission{.layout = {.cells = grid.frame.cells, .blocks = {9, 1, 1}},
                                .per_block = {0.5, 0.5, 0.0, 0.5, 0.5, 0.5, 1.0, 0.5, 0.5}};
  const DrawableMap belief({grid, &transmission}, 2);
  ASSERT_EQ(belief.grid().size(), 4U);
  EXPECT_NEAR(belief.grid().frame.cell_size_m.x(), 0.2, 1e-12);
  EXPECT_EQ(belief.grid().state(0), CellState::free);
  EXPECT_EQ(belief.grid().state(1), CellState::unobserved);
  EXPECT_EQ(belief.grid().state(2), CellState::occupied);
  EXPECT_EQ(belief.grid().state(3), CellState::unobserved);
  Rng rng(1);
  for (int k = 0; k < 20; ++k) {
    const Attenuation drawn = belief.draw(rng);
    EXPECT_EQ(drawn.transmission.per_block, (std::vector{1.0, 0.0, 1.0, 1.0}))
        << "what lets nothing pass is opaque, what lets all pass is not";
    EXPECT_EQ(drawn.utility, 8.0);
    EXPECT_FALSE(drawn.by_entropy);
  }
}

/// The first random number is that of the first cell that is not known.
TEST(DrawnMap, DrawsWhatIsNotKnownAlone) {
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.0}, {0.3, 0.1, 0.1}, {3, 1, 1}));
  grid.log_odds = {-3.0F, 3.0F, 0.0F};
  const BlockField transmission = uniform_field(grid.frame.cells, 0.5);
  const DrawableMap belief({grid, &transmission}, 1);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Rng rng(seed);
    Rng again(seed);
    const double passes = again.uniform() < 0.5 ? 0.0 : 1.0;
    EXPECT_EQ(belief.draw(rng).transmission.per_block, (std::vector{1.0, 1.0, passes})) << seed;
  }
}

}  // namespace
}  // namespace vantage
