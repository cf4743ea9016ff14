#include "vantage/planners/choice/drawn_map.hpp"

#include <gtest/gtest.h>

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
  EXPECT_EQ(belief.grid().state(0), CellState::unobserved) << "18 of 27";
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
