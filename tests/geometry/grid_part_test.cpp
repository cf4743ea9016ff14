#include "vantage/geometry/grid_part.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

GridFrame frame() { return make_grid_frame({1.0, 0.0, 0.5}, {2.0, 3.0, 1.0}, {20, 30, 10}); }

TEST(GridPart, OfAllHasTheIndexOfTheGrid) {
  const GridFrame grid = frame();
  const GridPart all = whole(grid);
  EXPECT_EQ(all.size(), grid.size());
  for (std::size_t cell = 0; cell < grid.size(); cell += 7) {
    EXPECT_EQ(all.index(grid.cell(cell)), cell);
  }
}

TEST(GridPart, NumbersItsOwnCellsOneByOne) {
  const GridPart part{.begin = {3, 4, 5}, .count = {2, 3, 4}};
  std::size_t next = 0;
  Eigen::Array3i cell;
  for (cell.z() = 5; cell.z() < part.end().z(); ++cell.z()) {
    for (cell.y() = 4; cell.y() < part.end().y(); ++cell.y()) {
      for (cell.x() = 3; cell.x() < part.end().x(); ++cell.x()) EXPECT_EQ(part.index(cell), next++);
    }
  }
  EXPECT_EQ(next, part.size());
}

TEST(CellsAbout, AreTheCellsMetAndTwoAllRound) {
  const Eigen::AlignedBox3d met(Eigen::Vector3d(0.55, -0.45, 0.35),
                                Eigen::Vector3d(0.75, 0.05, 0.36));
  const GridPart part = cells_about(frame(), met);  // cells of 0.1 m: 5 to 7, 10 to 15, 3
  EXPECT_TRUE((part.begin == Eigen::Array3i(3, 8, 1)).all()) << part.begin.transpose();
  EXPECT_TRUE((part.end() == Eigen::Array3i(10, 18, 6)).all()) << part.end().transpose();
}

RC_GTEST_PROP(CellsAbout, HoldTheCellOfEveryPointOfBoxAndGrid, (std::uint64_t seed)) {
  Rng rng(seed);
  const GridFrame grid = frame();
  const auto point = [&] {
    return Eigen::Vector3d(rng.uniform(-1.0, 3.0), rng.uniform(-2.5, 2.5), rng.uniform(-0.5, 1.5));
  };
  Eigen::AlignedBox3d met(point());
  met.extend(point());
  const GridPart part = cells_about(grid, met);
  RC_ASSERT((part.begin >= 0).all() && (part.end() <= grid.cells).all());
  for (int i = 0; i < 50; ++i) {
    const Eigen::Array3d share(rng.uniform(0.0, 1.0), rng.uniform(0.0, 1.0), rng.uniform(0.0, 1.0));
    const Eigen::Array3i cell = grid.cell_at(met.min() + (share * met.sizes().array()).matrix());
    if (grid.contains(cell)) RC_ASSERT((cell >= part.begin).all() && (cell < part.end()).all());
  }
}

TEST(CellsAbout, AreNoneOfABoxOutsideTheGridOrOfNothing) {
  const Eigen::AlignedBox3d outside(Eigen::Vector3d(2.5, 0.0, 0.5), Eigen::Vector3d(3.0, 0.1, 0.6));
  EXPECT_EQ(cells_about(frame(), outside).size(), 0U);
  EXPECT_TRUE((cells_about(frame(), outside).count == 0).all());
  EXPECT_EQ(cells_about(frame(), Eigen::AlignedBox3d()).size(), 0U);
}

TEST(CellsAbout, OfAGridOfOneCellAreThatCell) {
  const GridFrame one = make_grid_frame({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {1, 1, 1});
  const GridPart part = cells_about(one, one.box());
  EXPECT_TRUE((part.begin == 0).all()) << part.begin.transpose();
  EXPECT_TRUE((part.count == 1).all()) << part.count.transpose();
}

}  // namespace
}  // namespace vantage
