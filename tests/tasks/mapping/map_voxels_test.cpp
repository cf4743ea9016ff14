#include "vantage/tasks/mapping/drawing/map_voxels.hpp"

#include <gtest/gtest.h>

#include <cstddef>

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

TEST(MapVoxels, StandWhereTheirCellsAre) {
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 1.0}, {2.0, 4.0, 2.0}, {2, 2, 2}));
  MapVoxels voxels;
  EXPECT_EQ(voxels.of(grid).size(), 8U) << "all unobserved, nothing noted";
  grid.log_odds[1] = grid.log_odds[6] = 1.0F;
  voxels.note(grid, 2);
  grid.log_odds[0] = 1.0F;
  voxels.note(grid, 5);
  grid.log_odds[2] = -1.0F;
  const auto shown = voxels.of(grid);
  ASSERT_EQ(shown.size(), 7U) << "all but the free one";
  const auto expect_at = [&](std::size_t i, const Eigen::Vector3f& p_m, int step, int kind) {
    EXPECT_EQ(Eigen::Vector3f(shown[i].x, shown[i].y, shown[i].z), p_m) << i;
    EXPECT_EQ(shown[i].step, step) << i;
    EXPECT_EQ(shown[i].kind, kind) << i;
  };
  expect_at(0, {0.5F, -1.0F, 0.5F}, 1, kVoxelOccupied);
  expect_at(1, {-0.5F, 1.0F, 1.5F}, 1, kVoxelOccupied);
  expect_at(2, {-0.5F, -1.0F, 0.5F}, 4, kVoxelOccupied);
  expect_at(3, {0.5F, 1.0F, 0.5F}, 0, kVoxelUnobserved);
  expect_at(6, {0.5F, 1.0F, 1.5F}, 0, kVoxelUnobserved);
}

}  // namespace
}  // namespace vantage
