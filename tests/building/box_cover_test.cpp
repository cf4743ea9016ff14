// Boxes of cells hold what is solid and nothing else; lines of a grid lie in the faces of a mesh.
#include "vantage/building/box_cover.hpp"

#include <gtest/gtest.h>

#include <random>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

FittedGrid even_grid(int nx, int ny, int nz) {
  FittedGrid grid;
  for (int axis = 0; axis < 3; ++axis) {
    const int n = axis == 0 ? nx : axis == 1 ? ny : nz;
    for (int i = 0; i <= n; ++i) grid.lines_m[static_cast<std::size_t>(axis)].push_back(0.1 * i);
  }
  return grid;
}

/// How many boxes hold each cell.
std::vector<int> times_held(const FittedGrid& grid, const std::vector<CellBox>& boxes) {
  std::vector<int> held(grid.size(), 0);
  for (const CellBox& box : boxes) {
    for (int z = box.first[2]; z < box.end[2]; ++z) {
      for (int y = box.first[1]; y < box.end[1]; ++y) {
        for (int x = box.first[0]; x < box.end[0]; ++x) ++held[grid.index(x, y, z)];
      }
    }
  }
  return held;
}

TEST(BoxCover, HoldsEverySolidCellAndNoOther) {
  std::mt19937 random(7);
  for (int round = 0; round < 50; ++round) {
    const FittedGrid grid = even_grid(9, 7, 5);
    std::vector<std::uint8_t> solid(grid.size());
    std::bernoulli_distribution full(0.02 * (round % 50));
    for (auto& cell : solid) cell = full(random) ? 1 : 0;
    const std::vector<int> held = times_held(grid, cover_with_boxes(grid, solid));
    for (std::size_t i = 0; i < solid.size(); ++i) ASSERT_EQ(held[i] > 0, solid[i] != 0);
  }
}

/// The cell behind the end of a row is the first of the next one in memory.
TEST(BoxCover, BoxesBeginWithinTheGrid) {
  const FittedGrid grid = even_grid(3, 2, 2);
  std::vector<std::uint8_t> solid(grid.size(), 0);
  solid[grid.index(0, 1, 0)] = 1;
  const auto boxes = cover_with_boxes(grid, solid);
  ASSERT_EQ(boxes.size(), 1U);
  EXPECT_EQ(boxes[0].first, (std::array{0, 1, 0}));
  EXPECT_EQ(boxes[0].end, (std::array{1, 2, 1}));
}

TEST(BoxCover, ARoomIsFourWallsAndAFloor) {
  const FittedGrid grid = even_grid(20, 30, 12);
  std::vector<std::uint8_t> solid(grid.size(), 0);
  for (int z = 0; z < 12; ++z) {
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 20; ++x) {
        const bool wall = x == 0 || y == 0 || x == 19 || y == 29;
        if (wall || z == 0) solid[grid.index(x, y, z)] = 1;
      }
    }
  }
  EXPECT_EQ(cover_with_boxes(grid, solid).size(), 5U);
}

TEST(BoxCover, GrowsInTheOrderThatTakesInMost) {
  // A bar along y crosses one along x; the first cell belongs to the shorter one.
  const FittedGrid grid = even_grid(4, 9, 2);
  std::vector<std::uint8_t> solid(grid.size(), 0);
  for (int x = 0; x < 4; ++x) solid[grid.index(x, 0, 0)] = 1;
  for (int y = 0; y < 9; ++y) solid[grid.index(0, y, 0)] = 1;
  const auto boxes = cover_with_boxes(grid, solid);
  ASSERT_EQ(boxes.size(), 2U);
  EXPECT_EQ(boxes[0].first, (std::array{0, 0, 0}));
  EXPECT_EQ(boxes[0].end, (std::array{1, 9, 1}));
  EXPECT_EQ(boxes[1].first, (std::array{0, 0, 0})) << "they may overlap";
  EXPECT_EQ(boxes[1].end, (std::array{4, 1, 1}));
}

TEST(BoxCover, BoxesHaveTheirExtentByTheLinesOfTheGrid) {
  FittedGrid grid = even_grid(4, 5, 6);
  grid.lines_m[1][3] = 0.33;
  const Eigen::AlignedBox3d extent_m = box_m(grid, {{1, 0, 2}, {4, 3, 5}});
  EXPECT_LT((extent_m.min() - Eigen::Vector3d(0.1, 0.0, 0.2)).norm(), 1e-12);
  EXPECT_LT((extent_m.max() - Eigen::Vector3d(0.4, 0.33, 0.5)).norm(), 1e-12);
}

BuildingMesh square(double x_m, double size_m) {
  BuildingMesh mesh;
  mesh.vertices_m = {{x_m, 0, 0}, {x_m, size_m, 0}, {x_m, size_m, size_m}, {x_m, 0, size_m}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.colours.resize(2);
  mesh.objects.resize(2);
  return mesh;
}

TEST(FittedGrid, HasALineInEveryLargeFace) {
  const BuildingMesh mesh = square(0.4321, 1.0);
  const FittedGrid grid =
      fit_grid(mesh, {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 1, 1)}, 0.05);
  const auto& x = grid.lines_m[0];
  EXPECT_NE(std::ranges::find(x, 0.4321), x.end());
  for (std::size_t i = 1; i < x.size(); ++i) {
    EXPECT_LE(x[i] - x[i - 1], 0.05 + 1e-9);
    EXPECT_GT(x[i], x[i - 1]);
  }
  EXPECT_LE(x.front(), -0.05);
  EXPECT_GE(x.back(), 1.05);
  EXPECT_NE(std::ranges::find(grid.lines_m[2], 0.0), grid.lines_m[2].end());
  EXPECT_EQ(grid.cell_at(0, 0.4321), std::ranges::find(x, 0.4321) - x.begin());
}

TEST(FittedGrid, TooManyCellsAreRefused) {
  const Eigen::AlignedBox3d box_m(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(300, 300, 3));
  EXPECT_THROW(fit_grid(square(1.0, 1.0), box_m, 0.01), ConfigError);
}

TEST(FittedGrid, HoldsAHundredMillionCells) {
  const BuildingMesh mesh = square(1.0, 1.0);
  const Eigen::Vector3d low_m(0, 0, 0);
  EXPECT_EQ(fit_grid(mesh, {low_m, Eigen::Vector3d(998, 998, 98)}, 1.0).cells(1), 1000);
  EXPECT_THROW(fit_grid(mesh, {low_m, Eigen::Vector3d(999, 998, 98)}, 1.0), ConfigError);
}

/// Twelve planes in every cell of an even grid that would do.
TEST(FittedGrid, PlanesOfTheMeshCountToo) {
  BuildingMesh mesh;
  for (int i = 0; i < 1200; ++i) {
    const double at_m = 0.1 * i / 12.0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto first = static_cast<int>(mesh.vertices_m.size());
      for (const auto& [u, v] : {std::pair(0.0, 0.0), {10.0, 0.0}, {10.0, 10.0}, {0.0, 10.0}}) {
        Eigen::Vector3d p;
        p[axis] = at_m;
        p[(axis + 1) % 3] = u;
        p[(axis + 2) % 3] = v;
        mesh.vertices_m.emplace_back(p);
      }
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
  }
  mesh.colours.resize(mesh.triangles.size());
  mesh.objects.resize(mesh.triangles.size());
  const Eigen::AlignedBox3d box_m(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(10, 10, 10));
  EXPECT_THROW(fit_grid(mesh, box_m, 0.1), ConfigError);
}

TEST(FittedGrid, SaysWhichCellsWouldDo) {
  const Eigen::AlignedBox3d box_m(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(300, 200, 3));
  try {
    fit_grid(square(1.0, 1.0), box_m, 0.01);
    ADD_FAILURE() << "it has too many";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "--cell 0.01: too many cells, 1.81e+11 of 300 x 200 x 3 m; 0.13 m would do, or is "
                 "--scale wrong?");
  }
}

TEST(BoxCover, OfBoxesAlikeTheOneAlongXIsTaken) {
  const FittedGrid grid = even_grid(3, 3, 2);
  std::vector<std::uint8_t> solid(grid.size(), 0);
  for (int i = 0; i < 3; ++i) solid[grid.index(i, 0, 0)] = solid[grid.index(0, i, 0)] = 1;
  const auto boxes = cover_with_boxes(grid, solid);
  ASSERT_EQ(boxes.size(), 2U);
  EXPECT_EQ(boxes[0].end, (std::array{3, 1, 1}));
  EXPECT_EQ(boxes[1].first, (std::array{0, 0, 0}));
  EXPECT_EQ(boxes[1].end, (std::array{1, 3, 1}));
}

TEST(BoxCover, WhatIsHeldAlreadyIsTakenInForASingleNewCell) {
  const FittedGrid grid = even_grid(2, 3, 2);
  std::vector<std::uint8_t> solid(grid.size(), 0);
  solid[grid.index(1, 0, 0)] = 1;
  for (int y = 0; y < 3; ++y) solid[grid.index(0, y, 0)] = 1;
  const auto boxes = cover_with_boxes(grid, solid);
  ASSERT_EQ(boxes.size(), 2U);
  EXPECT_EQ(boxes[0].end, (std::array{1, 3, 1}));
  EXPECT_EQ(boxes[1].first, (std::array{0, 0, 0}));
  EXPECT_EQ(boxes[1].end, (std::array{2, 1, 1}));
}

/// Upwards from the second layer's first cell there is more below a row than there is new in it.
TEST(BoxCover, WhatIsNewCountsNotHowLargeABoxIs) {
  const FittedGrid grid = even_grid(3, 5, 2);
  std::vector<std::uint8_t> solid(grid.size(), 0);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 3; ++x) solid[grid.index(x, y, 0)] = 1;
  }
  for (int x = 0; x < 3; ++x) solid[grid.index(x, 0, 1)] = 1;
  for (int y = 0; y < 5; ++y) solid[grid.index(0, y, 1)] = 1;
  const auto boxes = cover_with_boxes(grid, solid);
  ASSERT_EQ(boxes.size(), 3U);
  EXPECT_EQ(boxes[0].end, (std::array{3, 3, 1}));
  EXPECT_EQ(boxes[1].first, (std::array{0, 0, 1})) << "five new cells, not three of six";
  EXPECT_EQ(boxes[1].end, (std::array{1, 5, 2}));
}

}  // namespace
}  // namespace vantage
