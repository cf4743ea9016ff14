#include "vantage/planners/visibility/cell_walk.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

std::vector<std::size_t> cells_to(const GridFrame& grid, const Eigen::Vector3d& p_from,
                                  const Eigen::Array3i& target) {
  std::vector<std::size_t> cells;
  EXPECT_TRUE(walk_to_cell(grid, p_from, target, [&](std::size_t cell) {
    cells.push_back(cell);
    return true;
  }));
  cells.push_back(grid.index(target));
  return cells;
}

std::vector<std::size_t> cells_of_walk_ray(const GridFrame& grid, const Eigen::Vector3d& p_from,
                                           const Eigen::Array3i& target) {
  std::vector<std::size_t> cells;
  walk_ray(grid, p_from, grid.centre(target), [&](std::size_t cell) {
    cells.push_back(cell);
    return true;
  });
  return cells;
}

TEST(WalkToCell, VisitsTheCellsOfWalkRay) {
  Rng rng(3);
  const GridFrame grid = make_grid_frame({0.3, -0.2, 0.5}, {1.3, 0.9, 0.7}, {13, 11, 17});
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector3d p_from(rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0),
                                 rng.uniform(-2.0, 2.0));
    const Eigen::Array3i target = grid.cell(rng.uniform_index(grid.size()));
    EXPECT_EQ(cells_to(grid, p_from, target), cells_of_walk_ray(grid, p_from, target))
        << "draw " << i;
  }
}

// Where a ray meets several faces at once, the step along y comes first, that along z last.
TEST(WalkToCell, VisitsTheCellsOfWalkRayThroughEdgesAndCornersToo) {
  GridFrame grid;
  grid.cells = {9, 9, 9};
  const Eigen::Vector3d p_from(4.5, 4.5, 4.5);
  constexpr std::array kSteps{-4, -2, -1, 0, 1, 2, 4};
  for (const int x : kSteps) {
    for (const int y : kSteps) {
      for (const int z : kSteps) {
        const Eigen::Array3i target(4 + x, 4 + y, 4 + z);
        EXPECT_EQ(cells_to(grid, p_from, target), cells_of_walk_ray(grid, p_from, target))
            << target.transpose();
      }
    }
  }
  grid.cells = {2, 2, 2};
  EXPECT_EQ(cells_to(grid, {0.5, 0.5, 0.5}, {1, 1, 1}), (std::vector<std::size_t>{0, 2, 3, 7}));
}

// Rays along faces and through edges, where the order of the steps is a matter of rounding.
TEST(WalkToCell, GoesFromNeighbourToNeighbourOnDegenerateRays) {
  GridFrame grid;
  grid.cells = {9, 9, 9};
  for (std::size_t from = 0; from < 1000; ++from) {
    const std::size_t layer = from / 100;
    const Eigen::Vector3d p_from(static_cast<double>(from % 10),
                                 static_cast<double>(from / 10 % 10), static_cast<double>(layer));
    for (const int corner : {0, 4, 8}) {
      const auto cells = cells_to(grid, p_from, {corner, 8 - corner, 4});
      for (std::size_t i = 1; i < cells.size(); ++i) {
        ASSERT_EQ((grid.cell(cells[i]) - grid.cell(cells[i - 1])).abs().sum(), 1);
      }
    }
  }
}

TEST(WalkToCell, StopsWhenToldTo) {
  GridFrame grid;
  grid.cells = {5, 1, 1};
  int passed = 0;
  EXPECT_FALSE(
      walk_to_cell(grid, {-1.0, 0.5, 0.5}, {4, 0, 0}, [&](std::size_t) { return ++passed < 2; }));
  EXPECT_EQ(passed, 2);
}

TEST(WalkToCell, PassesNothingOnTheWayToItsOwnCell) {
  GridFrame grid;
  grid.cells = {5, 1, 1};
  EXPECT_EQ(cells_to(grid, {2.2, 0.1, 0.9}, {2, 0, 0}), std::vector<std::size_t>{2});
}

}  // namespace
}  // namespace vantage
