#include "vantage/tasks/mapping/drawing/map_voxels.hpp"

#include <gtest/gtest.h>

namespace vantage {
namespace {

TEST(MapVoxels, AreOfTheMapAsItIsInTheOrderOfTheirScans) {
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.5}, {4.0, 1.0, 1.0}, {4, 1, 1}));
  MapVoxels voxels;
  grid.log_odds = {1.0F, -1.0F, 1.0F, 0.0F};
  voxels.note(grid, 1);
  grid.log_odds = {-1.0F, 1.0F, 1.0F, 0.0F};  // a wall that loops have moved
  voxels.note(grid, 3);
  const auto shown = voxels.of(grid);
  ASSERT_EQ(shown.size(), 3U);
  EXPECT_FLOAT_EQ(shown[0].x, 0.5F);
  EXPECT_EQ(shown[0].step, 0);
  EXPECT_FLOAT_EQ(shown[1].x, -0.5F);
  EXPECT_EQ(shown[1].step, 2);
  EXPECT_EQ(shown[1].kind, kVoxelOccupied);
  EXPECT_FLOAT_EQ(shown[2].x, 1.5F);
  EXPECT_EQ(shown[2].kind, kVoxelUnobserved);
  grid.log_odds[0] = 1.0F;
  voxels.note(grid, 4);
  EXPECT_EQ(voxels.of(grid)[2].step, 3) << "occupied again";
}

}  // namespace
}  // namespace vantage
