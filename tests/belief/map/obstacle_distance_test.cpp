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
    ASSERT_EQ(distance.cells(grid.frame.cell(cell)), nearest) << cell;
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

Eigen::Vector3d random_point(const Eigen::AlignedBox3d& box_m, Rng& rng) {
  const Eigen::Array3d share(rng.uniform(0.0, 1.0), rng.uniform(0.0, 1.0), rng.uniform(0.0, 1.0));
  return box_m.min() + (share * box_m.sizes().array()).matrix();
}

TEST(ObstacleDistance, SaysTheSameOfSegmentsInReachWithoutALookElsewhere) {
  Rng rng(4);
  int blocked = 0;
  for (int world = 0; world < 20; ++world) {
    const OccupancyGrid grid = random_world(rng, 1e-2);
    Eigen::AlignedBox3d part_m(random_point(grid.frame, rng, 0));
    part_m.extend(random_point(grid.frame, rng, 0));
    const GridPart reach = cells_about(grid.frame, part_m);
    if (reach.size() == 0) continue;
    const ObstacleDistance distance(grid, reach, 2);
    for (int i = 0; i < 1000; ++i) {
      const Eigen::Vector3d from = random_point(part_m, rng);
      const Eigen::Vector3d to = random_point(part_m, rng);
      const bool expected = walked_clear(grid, from, to);
      ASSERT_EQ(distance.is_clear(from, to), expected)
          << from.transpose() << " to " << to.transpose();
      blocked += expected ? 0 : 1;
    }
  }
  EXPECT_GT(blocked, 500);
}

TEST(ObstacleDistance, DoesNotDependOnThreads) {
  Rng rng(3);
  const OccupancyGrid grid = random_world(rng, 1e-3);
  const ObstacleDistance one(grid, 1);
  const ObstacleDistance three(grid, 3);
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    const Eigen::Array3i at = grid.frame.cell(cell);
    ASSERT_EQ(one.cells(at), three.cells(at));
  }
}

TEST(ObstacleDistance, IsThatToCellsThatAreOnlyJustOccupied) {
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.0}, {5.0, 1.0, 1.0}, {5, 1, 1}));
  grid.log_odds[1] = kOccupiedLogOdds;
  grid.log_odds[4] = std::nextafter(kOccupiedLogOdds, 0.0F);
  const ObstacleDistance distance(grid);
  const std::vector<int> expected{1, 0, 1, 2, 3};
  for (int x = 0; x < 5; ++x) {
    EXPECT_EQ(distance.cells({x, 0, 0}), expected[static_cast<std::size_t>(x)]);
  }
}

TEST(ObstacleDistance, IsThatToTheOutermostCellsToo) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool last : {false, true}) {
      Eigen::Array3i cells = Eigen::Array3i::Ones();
      cells[axis] = 20;
      GridFrame frame;
      frame.cells = cells;
      OccupancyGrid grid(frame);
      grid.log_odds[last ? 19 : 0] = 1.0F;
      const ObstacleDistance distance(grid);
      for (int i = 0; i < 20; ++i) {
        Eigen::Array3i at = Eigen::Array3i::Zero();
        at[axis] = i;
        EXPECT_EQ(distance.cells(at), std::min(last ? 19 - i : i, 15)) << axis << " " << i;
      }
    }
  }
}

}  // namespace
}  // namespace vantage
