// Leaps over free space end as the walk cell by cell does, ties and grazes included.
#include "vantage/belief/map/obstacle_distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

OccupancyGrid random_world(Rng& rng, double share_occupied) {
  OccupancyGrid grid(make_grid_frame({0.3, -0.2, 0.1}, {4.0, 3.0, 1.2}, {57, 41, 23}));
  for (float& log_odds : grid.log_odds) {
    const bool occupied = rng.uniform() < share_occupied;
    log_odds = occupied ? 1.0F : static_cast<float>(rng.uniform(-1.0, 0.4));
  }
  return grid;
}

/// By the walk cell by cell.
bool walked_clear(const OccupancyGrid& grid, const Eigen::Vector3d& from,
                  const Eigen::Vector3d& to) {
  return walk_ray(grid.frame, from, to,
                  [&](std::size_t cell) { return grid.state(cell) != CellState::occupied; });
}

/// A point about the grid; `grain` 0: anywhere, else on corners, edges and middles of cells.
Eigen::Vector3d random_point(const GridFrame& frame, Rng& rng, int grain) {
  Eigen::Vector3d p;
  for (int axis = 0; axis < 3; ++axis) {
    double cells = rng.uniform(-0.2, 1.2) * frame.cells[axis];
    if (grain > 0) cells = std::round(cells * grain) / grain;
    p[axis] = frame.min_corner_m[axis] + cells * frame.cell_size_m[axis];
  }
  return p;
}

TEST(ObstacleDistance, IsTheChessboardDistance) {
  Rng rng(1);
  const OccupancyGrid grid = random_world(rng, 3e-4);
  const ObstacleDistance distance(grid);
  for (std::size_t cell = 0; cell < grid.size(); cell += 97) {
    int nearest = ObstacleDistance::kMax_cells;
    for (std::size_t other = 0; other < grid.size(); ++other) {
      if (grid.state(other) != CellState::occupied) continue;
      const Eigen::Array3i apart = grid.frame.cell(cell) - grid.frame.cell(other);
      nearest = std::min(nearest, apart.abs().maxCoeff());
    }
    ASSERT_EQ(distance.cells(cell), nearest) << cell;
  }
}

TEST(ObstacleDistance, SaysOfEverySegmentWhatTheWalkSays) {
  Rng rng(2);
  int clear = 0;
  int blocked = 0;
  for (const double share : {0.0, 1e-4, 1e-3, 1e-2}) {
    const OccupancyGrid grid = random_world(rng, share);
    const ObstacleDistance distance(grid, 2);
    for (int i = 0; i < 20000; ++i) {
      const Eigen::Vector3d from = random_point(grid.frame, rng, i % 3);
      Eigen::Vector3d to = random_point(grid.frame, rng, i % 3);
      if (i % 7 == 0) to[i % 2] = from[i % 2];  // along a plane of cells
      const bool expected = walked_clear(grid, from, to);
      ASSERT_EQ(distance.is_clear(from, to), expected)
          << from.transpose() << " to " << to.transpose();
      (expected ? clear : blocked) += 1;
    }
  }
  EXPECT_GT(clear, 20000);
  EXPECT_GT(blocked, 5000);
}

TEST(ObstacleDistance, DoesNotDependOnThreads) {
  Rng rng(3);
  const OccupancyGrid grid = random_world(rng, 1e-3);
  const ObstacleDistance one(grid, 1);
  const ObstacleDistance three(grid, 3);
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    ASSERT_EQ(one.cells(cell), three.cells(cell));
  }
}

TEST(ObstacleDistance, IsThatToCellsThatAreOnlyJustOccupied) {
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.0}, {5.0, 1.0, 1.0}, {5, 1, 1}));
  grid.log_odds[1] = kOccupiedLogOdds;
  grid.log_odds[4] = std::nextafter(kOccupiedLogOdds, 0.0F);
  const ObstacleDistance distance(grid);
  const std::vector<int> expected{1, 0, 1, 2, 3};
  for (std::size_t cell = 0; cell < 5; ++cell) EXPECT_EQ(distance.cells(cell), expected[cell]);
}

}  // namespace
}  // namespace vantage
