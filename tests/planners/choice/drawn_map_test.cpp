#include "vantage/planners/choice/drawn_map.hpp"

#include <gtest/gtest.h>

namespace vantage {
namespace {

TEST(DrawnMap, HasACellOfWhatIsThinnerThanOne) {
  const OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.0}, {0.6, 0.6, 0.2}, {6, 6, 2}));
  const BlockField transmission = uniform_field(grid.frame.cells, 0.5);
  const DrawableMap belief({grid, &transmission}, 3);
  ASSERT_EQ(belief.grid().size(), 4U);
  EXPECT_EQ(belief.grid().state(0), CellState::unobserved) << "18 of 27";
}

}  // namespace
}  // namespace vantage
