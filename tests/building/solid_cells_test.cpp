// Where lines meet surfaces, the grid that is fitted to them, and the cells that they fill.
#include "vantage/building/solid_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/building/made_mesh.hpp"
#include "vantage/building/line_crossings.hpp"

namespace vantage {
namespace {

using test::MadeMesh;

/// z = 1 + x / 2 + y / 4 over the corners (0, 0), (4, 0) and (0, 4), facing up.
BuildingMesh slope() {
  MadeMesh made;
  made.triangle({0, 0, 1}, {4, 0, 3}, {0, 4, 2});
  return made.mesh;
}

TEST(LineCrossings, AreWhereALineMeetsATriangle) {
  const BuildingMesh mesh = slope();
  const auto up = line_crossings(mesh, mesh.triangles, 2, {-1.0, 1.0, 2.5, 5.0}, {0.5, 2.0, 6.0});
  ASSERT_EQ(up.size(), 3U);
  EXPECT_EQ(up[0].line, 1U);
  EXPECT_NEAR(up[0].at_m, 1.625, 1e-12);
  EXPECT_EQ(up[1].line, 2U);
  EXPECT_NEAR(up[1].at_m, 2.375, 1e-12);
  EXPECT_EQ(up[2].line, 5U);
  EXPECT_NEAR(up[2].at_m, 2.0, 1e-12);
  for (const Crossing& crossing : up) EXPECT_EQ(crossing.side, 1);
}

TEST(LineCrossings, AlongXAndYGoByTheNextTwoAxes) {
  const BuildingMesh mesh = slope();
  const auto along_x = line_crossings(mesh, mesh.triangles, 0, {1.0}, {1.5, 2.0, 2.9});
  ASSERT_EQ(along_x.size(), 2U);
  EXPECT_EQ(along_x[0].line, 0U);
  EXPECT_NEAR(along_x[0].at_m, 0.5, 1e-12);
  EXPECT_EQ(along_x[1].line, 1U);
  EXPECT_NEAR(along_x[1].at_m, 1.5, 1e-12);
  EXPECT_EQ(along_x[0].side, -1);
  const auto along_y = line_crossings(mesh, mesh.triangles, 1, {2.0}, {0.5, 1.0, 3.0});
  ASSERT_EQ(along_y.size(), 2U);
  EXPECT_NEAR(along_y[0].at_m, 3.0, 1e-12);
  EXPECT_NEAR(along_y[1].at_m, 2.0, 1e-12);
  EXPECT_EQ(along_y[1].side, -1);
}

TEST(LineCrossings, OfASharedEdgeAreOne) {
  MadeMesh made;
  made.quad({0, 0, 3}, {4, 0, 3}, {4, 4, 3}, {0, 4, 3});
  made.quad({0, 4, 1}, {4, 4, 1}, {4, 0, 1}, {0, 0, 1});  // facing down
  const std::vector<double> places_m{0.0, 1.0, 2.0, 3.0, 4.0};
  const auto crossings = line_crossings(made.mesh, made.mesh.triangles, 2, places_m, places_m);
  ASSERT_EQ(crossings.size(), 2U * 16U);
  for (std::size_t i = 0; i < crossings.size(); i += 2) {
    EXPECT_EQ(crossings[i].line, crossings[i + 1].line);
    EXPECT_EQ(crossings[i].at_m, 1.0);
    EXPECT_EQ(crossings[i].side, -1);
    EXPECT_EQ(crossings[i + 1].at_m, 3.0);
    EXPECT_EQ(crossings[i + 1].side, 1);
  }
}

FittedGrid tenths(double from_m) {
  FittedGrid grid;
  grid.cell_m = 0.1;
  for (auto& lines : grid.lines_m) {
    for (int i = 0; i <= 10; ++i) lines.push_back(from_m + 0.1 * i);
  }
  return grid;
}

/// The cells of a box of cells, and no other.
void expect_solid(const FittedGrid& grid, const std::vector<std::uint8_t>& solid,
                  const std::array<int, 3>& first, const std::array<int, 3>& end) {
  for (int z = 0; z < grid.cells(2); ++z) {
    for (int y = 0; y < grid.cells(1); ++y) {
      for (int x = 0; x < grid.cells(0); ++x) {
        const bool inside = x >= first[0] && x < end[0] && y >= first[1] && y < end[1] &&
                            z >= first[2] && z < end[2];
        ASSERT_EQ(solid[grid.index(x, y, z)] != 0, inside) << x << " " << y << " " << z;
      }
    }
  }
}

TEST(SolidCells, OfABoxAreThoseInsideIt) {
  MadeMesh made;
  made.box({0.2, 0.2, 0.1}, {0.8, 0.6, 0.5});
  const FittedGrid grid = tenths(0.0);
  const auto all = solid_cells(made.mesh, made.mesh.triangles, grid);
  expect_solid(grid, all, {2, 2, 1}, {8, 6, 5});
  MadeMesh open;
  open.box({0.2, 0.2, 0.1}, {0.8, 0.6, 0.5}, false);
  expect_solid(grid, solid_cells(open.mesh, open.mesh.triangles, grid), {2, 2, 1}, {8, 6, 5});
}

TEST(SolidCells, OfASheetAreThoseThatItPassesOrThoseBehindIt) {
  const FittedGrid grid = tenths(0.0);
  const auto filled = [&](double z_m, bool up) {
    MadeMesh made;
    made.level(0.2, 0.2, 0.8, 0.6, z_m, up);
    return solid_cells(made.mesh, made.mesh.triangles, grid);
  };
  expect_solid(grid, filled(0.35, true), {2, 2, 3}, {8, 6, 4});
  expect_solid(grid, filled(0.35, false), {2, 2, 3}, {8, 6, 4});
  expect_solid(grid, filled(0.4, true), {2, 2, 3}, {8, 6, 4});
  expect_solid(grid, filled(0.4, false), {2, 2, 4}, {8, 6, 5});
  expect_solid(grid, filled(0.408, false), {2, 2, 4}, {8, 6, 5});
  expect_solid(grid, filled(0.408, true), {2, 2, 3}, {8, 6, 4});
  expect_solid(grid, filled(0.412, true), {2, 2, 4}, {8, 6, 5});
  expect_solid(grid, filled(1.2, true), {0, 0, 0}, {0, 0, 0});
}

TEST(SolidCells, OfARoughFloorAreThoseBelowIt) {
  const FittedGrid grid = tenths(-0.3);
  FittedGrid with_zero = grid;
  with_zero.lines_m[2][3] = 0.0;
  const auto filled = [&](double z_m, bool up) {
    MadeMesh made;
    made.level(-0.1, -0.1, 0.5, 0.3, z_m, up);
    return solid_cells(made.mesh, made.mesh.triangles, with_zero);
  };
  for (const double z_m : {-0.048, -0.02, 0.0, 0.03, 0.048}) {
    for (const bool up : {true, false}) {
      expect_solid(with_zero, filled(z_m, up), {2, 2, 2}, {8, 6, 3});
    }
  }
  expect_solid(with_zero, filled(0.055, true), {2, 2, 3}, {8, 6, 4});
  expect_solid(with_zero, filled(-0.055, false), {2, 2, 2}, {8, 6, 3});
}

TEST(FittedGrid, CountsItsCells) {
  FittedGrid grid;
  EXPECT_EQ(grid.cell_m, 0.0);
  grid.lines_m = {std::vector<double>{0.0, 1.0, 2.0}, {0.0, 0.5, 1.5, 2.0}, {0, 1, 2, 3, 4}};
  EXPECT_EQ(grid.cells(0), 2);
  EXPECT_EQ(grid.cells(1), 3);
  EXPECT_EQ(grid.size(), 24U);
  EXPECT_EQ(grid.index(0, 0, 0), 0U);
  EXPECT_EQ(grid.index(1, 0, 0), 1U);
  EXPECT_EQ(grid.index(0, 1, 0), 2U);
  EXPECT_EQ(grid.index(0, 0, 1), 6U);
  EXPECT_EQ(grid.index(1, 2, 3), 23U);
  EXPECT_EQ(grid.centres_m(1), (std::vector<double>{0.25, 1.0, 1.75}));
  EXPECT_EQ(grid.line_m(1, 2), 1.5);
  const std::array<std::pair<double, int>, 8> held{
      {{-1.0, 0}, {0.0, 0}, {0.49, 0}, {0.5, 1}, {1.49, 1}, {1.5, 2}, {2.0, 2}, {5.0, 2}}};
  for (const auto& [at_m, cell] : held) EXPECT_EQ(grid.cell_at(1, at_m), cell) << at_m;
}

const Eigen::AlignedBox3d kUnitBox(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 1, 1));

bool has_line(const std::vector<double>& lines_m, double at_m) {
  return std::ranges::any_of(lines_m, [&](double line) { return std::abs(line - at_m) < 1e-9; });
}

TEST(FittedGrid, IsEvenBetweenItsFaces) {
  MadeMesh made;
  made.level(0.0, 0.0, 1.0, 1.0, 0.5, true);
  const auto z_m = fit_grid(made.mesh, kUnitBox, 0.05).lines_m[2];
  ASSERT_EQ(z_m.size(), 23U) << "one cell round 10 below and 10 above the face";
  for (std::size_t i = 0; i < z_m.size(); ++i) {
    EXPECT_NEAR(z_m[i], 0.05 * static_cast<double>(i) - 0.05, 1e-9);
  }
  const auto coarse_m = fit_grid(made.mesh, kUnitBox, 0.3).lines_m[2];
  EXPECT_TRUE(has_line(coarse_m, 0.25)) << "two parts of 0.25 to the face";
  EXPECT_TRUE(has_line(coarse_m, 0.5 + 0.8 / 3.0)) << "three parts to one cell beyond";
}

TEST(FittedGrid, HasOneLineWhereFacesAreTooNearEachOther) {
  for (const bool near : {true, false}) {
    MadeMesh made;
    const double other_m = near ? 0.434 : 0.436;
    made.wall_x(other_m, 0.0, 0.5, 0.5);
    made.wall_x(0.43, 0.0, 1.0, 1.0);
    const auto x_m = fit_grid(made.mesh, kUnitBox, 0.05).lines_m[0];
    EXPECT_TRUE(has_line(x_m, 0.43)) << "of the larger one";
    EXPECT_EQ(has_line(x_m, other_m), !near);
  }
}

TEST(FittedGrid, HasNoLinesOfSmallOrObliqueFaces) {
  MadeMesh made;
  made.wall_x(0.33, 0.0, 0.04, 0.04);  // 0.0016 m^2
  made.wall_x(0.61, 0.0, 0.05, 0.05);  // 0.0025 m^2
  made.wall_x(0.87, 0.0, 0.04, 0.03);  // two halves of it
  made.wall_x(0.87, 0.5, 0.54, 0.03);
  made.quad({0.73, 0, 0}, {0.74, 1, 0}, {0.74, 1, 1}, {0.73, 0, 1});
  const auto x_m = fit_grid(made.mesh, kUnitBox, 0.05).lines_m[0];
  EXPECT_FALSE(has_line(x_m, 0.33));
  EXPECT_TRUE(has_line(x_m, 0.61));
  EXPECT_TRUE(has_line(x_m, 0.87));
  EXPECT_FALSE(has_line(x_m, 0.735));
}

TEST(FittedGrid, HasTheFloorAsALineAndNoneBesideIt) {
  for (const double z_m : {0.02, -0.02, 0.03}) {
    MadeMesh made;
    made.level(0.0, 0.0, 1.0, 1.0, z_m, true);
    const Eigen::AlignedBox3d box_m(Eigen::Vector3d(0, 0, -0.1), Eigen::Vector3d(1, 1, 1));
    const auto lines_m = fit_grid(made.mesh, box_m, 0.05).lines_m[2];
    EXPECT_TRUE(has_line(lines_m, 0.0));
    EXPECT_EQ(has_line(lines_m, z_m), z_m == 0.03) << z_m;
  }
}

/// Walls a centimetre apart, one of which is half as large as the others.
TEST(FittedGrid, HasLinesOfTheLargestFifteenHundredFaces) {
  const Eigen::AlignedBox3d box_m(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(15.1, 1, 1));
  for (const int walls : {1500, 1501}) {
    MadeMesh made;
    for (int i = 0; i < walls; ++i) {
      made.wall_x(0.005 + 0.01 * i, 0.0, i == 700 ? 0.5 : 1.0, 1.0);
    }
    const auto x_m = fit_grid(made.mesh, box_m, 0.05).lines_m[0];
    EXPECT_EQ(has_line(x_m, 7.005), walls == 1500) << walls;
    EXPECT_TRUE(has_line(x_m, 6.995) && has_line(x_m, 7.015));
  }
}

TEST(FittedGrid, EndsACellBeyondItsBoxWhateverIsFartherOff) {
  MadeMesh made;
  made.wall_x(2.0, 0.0, 1.0, 1.0);
  made.wall_x(-1.0, 0.0, 1.0, 1.0);
  const auto x_m = fit_grid(made.mesh, kUnitBox, 0.05).lines_m[0];
  EXPECT_NEAR(x_m.front(), -0.05, 1e-9);
  EXPECT_NEAR(x_m.back(), 1.05, 1e-9);
  const Eigen::AlignedBox3d upstairs(Eigen::Vector3d(0, 0, 2), Eigen::Vector3d(1, 1, 3));
  const auto z_m = fit_grid(made.mesh, upstairs, 0.05).lines_m[2];
  EXPECT_NEAR(z_m.front(), 1.95, 1e-9) << "the floor at 0 is none of its lines";
}

TEST(SolidCells, OfASheetInTheFirstLayerAreThatLayerAndNoneOfOneBelowIt) {
  const FittedGrid grid = tenths(0.0);
  const auto filled = [&](double z_m) {
    MadeMesh made;
    made.level(0.2, 0.2, 0.8, 0.6, z_m, true);
    return solid_cells(made.mesh, made.mesh.triangles, grid);
  };
  expect_solid(grid, filled(0.07), {2, 2, 0}, {8, 6, 1});
  expect_solid(grid, filled(-0.2), {0, 0, 0}, {0, 0, 0});
}

/// Whose middle corner lies at the height of a line.
TEST(LineCrossings, AreOneBesideACornerToo) {
  MadeMesh made;
  made.triangle({0, 0, 1}, {4, 2, 1}, {0, 4, 1});
  const auto found =
      line_crossings(made.mesh, made.mesh.triangles, 2, {0.0, 1.5, 2.5}, {1.0, 2.0, 3.0});
  std::vector<std::uint32_t> lines;
  for (const Crossing& crossing : found) lines.push_back(crossing.line);
  EXPECT_EQ(lines, (std::vector<std::uint32_t>{0, 1, 3, 4, 5, 6, 7}));
}

TEST(LineCrossings, OfATriangleOfHalfASquareMetreAreThereToo) {
  MadeMesh made;
  made.triangle({0, 0, 1}, {1, 0, 1}, {0, 1, 1});
  EXPECT_EQ(line_crossings(made.mesh, made.mesh.triangles, 2, {0.25}, {0.25}).size(), 1U);
}

TEST(SolidCells, OfASheetAtTheEdgeOfTheGridAreThoseInIt) {
  const FittedGrid grid = tenths(0.0);
  const auto filled = [&](double z_m, bool up) {
    MadeMesh made;
    made.level(0.2, 0.2, 0.8, 0.6, z_m, up);
    return solid_cells(made.mesh, made.mesh.triangles, grid);
  };
  for (const bool up : {true, false}) {
    expect_solid(grid, filled(grid.line_m(2, 10), up), {2, 2, 9}, {8, 6, 10});
    expect_solid(grid, filled(0.0, up), {2, 2, 0}, {8, 6, 1});
  }
  expect_solid(grid, filled(0.392, false), {2, 2, 4}, {8, 6, 5});
  expect_solid(grid, filled(0.392, true), {2, 2, 3}, {8, 6, 4});
}

/// Slabs that end in a cell, of which less than half is theirs.
TEST(SolidCells, OfWhatHasSolidCellsBehindItsSurfaceAreNoMore) {
  const FittedGrid grid = tenths(0.0);
  MadeMesh low;
  low.box({0.2, 0.2, 0.0}, {0.8, 0.6, 0.12});
  expect_solid(grid, solid_cells(low.mesh, low.mesh.triangles, grid), {2, 2, 0}, {8, 6, 1});
  MadeMesh high;
  high.box({0.2, 0.2, 0.88}, {0.8, 0.6, grid.line_m(2, 10)});
  expect_solid(grid, solid_cells(high.mesh, high.mesh.triangles, grid), {2, 2, 9}, {8, 6, 10});
  MadeMesh covered;  // by a sheet that faces down
  covered.box({0.2, 0.2, 0.1}, {0.8, 0.6, 0.5});
  covered.level(0.2, 0.2, 0.8, 0.6, 0.5, false);
  expect_solid(grid, solid_cells(covered.mesh, covered.mesh.triangles, grid), {2, 2, 1}, {8, 6, 5});
}

TEST(SolidCells, OfAFloorOnASlabAreThoseOfTheSlab) {
  FittedGrid grid = tenths(-0.3);
  grid.lines_m[2][3] = 0.0;
  MadeMesh made;
  made.box({-0.1, -0.1, grid.line_m(2, 1)}, {0.5, 0.3, 0.0});
  made.level(-0.1, -0.1, 0.5, 0.3, 0.02, true);
  expect_solid(grid, solid_cells(made.mesh, made.mesh.triangles, grid), {2, 2, 1}, {8, 6, 3});
  FittedGrid shallow = tenths(-0.1);
  shallow.lines_m[2][1] = 0.0;
  MadeMesh sheet;
  sheet.level(0.1, 0.1, 0.7, 0.5, 0.03, true);
  const auto filled = solid_cells(sheet.mesh, sheet.mesh.triangles, shallow);
  expect_solid(shallow, filled, {2, 2, 0}, {8, 6, 1});
}

/// Faces in the middles of cells: of the first cell the middle is inside, of the last it is not.
TEST(SolidCells, HoldTheMiddlesFromAFaceUpToTheOther) {
  FittedGrid grid;
  grid.cell_m = 0.125;
  for (auto& lines : grid.lines_m) {
    for (int i = 0; i <= 8; ++i) lines.push_back(0.125 * i);
  }
  MadeMesh made;
  made.box({0.1875, 0.1875, 0.1875}, {0.8125, 0.6875, 0.5625});
  expect_solid(grid, solid_cells(made.mesh, made.mesh.triangles, grid), {1, 1, 1}, {6, 5, 4});
}

/// Lines that enter twice and never leave tell nothing of what is between.
TEST(SolidCells, AreNoneBetweenSheetsThatFaceOneWay) {
  const FittedGrid grid = tenths(0.0);
  MadeMesh made;
  for (const double at_m : {0.1, 0.8}) {
    made.quad({at_m, 0.1, 0.1}, {at_m, 0.1, 0.9}, {at_m, 0.9, 0.9}, {at_m, 0.9, 0.1});
    made.quad({0.1, at_m, 0.1}, {0.9, at_m, 0.1}, {0.9, at_m, 0.9}, {0.1, at_m, 0.9});
  }
  const auto solid = solid_cells(made.mesh, made.mesh.triangles, grid);
  EXPECT_EQ(solid[grid.index(1, 4, 4)], 1) << "behind a sheet";
  EXPECT_EQ(solid[grid.index(4, 1, 4)], 1);
  EXPECT_EQ(solid[grid.index(4, 4, 4)], 0);
}

/// Two troughs without tops, one behind the other.
TEST(SolidCells, AreInTheSecondOfTwoToo) {
  const FittedGrid grid = tenths(0.0);
  MadeMesh made;
  made.box({0.1, 0.2, 0.1}, {0.3, 0.7, 0.5}, false);
  made.box({0.4, 0.2, 0.1}, {0.9, 0.7, 0.5}, false);
  const auto solid = solid_cells(made.mesh, made.mesh.triangles, grid);
  EXPECT_EQ(solid[grid.index(6, 4, 3)], 1);
  EXPECT_EQ(solid[grid.index(3, 4, 3)], 0);
}

TEST(FittedGrid, HasOneLineWhicheverOfTwoNearFacesIsTheLarger) {
  for (const bool near : {true, false}) {
    MadeMesh made;
    const double other_m = near ? 0.426 : 0.424;
    made.wall_x(other_m, 0.0, 0.5, 0.5);
    made.wall_x(0.43, 0.0, 1.0, 1.0);
    const auto x_m = fit_grid(made.mesh, kUnitBox, 0.05).lines_m[0];
    EXPECT_TRUE(has_line(x_m, 0.43)) << "of the larger one";
    EXPECT_EQ(has_line(x_m, other_m), !near);
    EXPECT_FALSE(has_line(x_m, 0.427)) << "what is less than a cell is not parted";
  }
}

/// Halves of 0.0016 m^2, too small each.
TEST(FittedGrid, FacesInOnePlaneCountTogether) {
  for (const double apart_m : {0.00007, 0.00015}) {
    MadeMesh made;
    made.wall_x(0.33, 0.0, 0.04, 0.04);
    made.wall_x(0.33 + apart_m, 0.5, 0.54, 0.04);
    const auto x_m = fit_grid(made.mesh, kUnitBox, 0.05).lines_m[0];
    EXPECT_EQ(has_line(x_m, 0.33), apart_m < 0.0001) << apart_m;
  }
}

TEST(FittedGrid, FacesAreSquareWithinAThousandthOrSo) {
  for (const double tilt : {0.0012, 0.0018}) {
    MadeMesh made;
    made.triangle({0.33, 0, 0}, {0.33, 1, 0}, {0.33 + tilt, 0, 1});
    const auto x_m = fit_grid(made.mesh, kUnitBox, 0.05).lines_m[0];
    EXPECT_EQ(has_line(x_m, 0.33 + tilt / 3.0), tilt < 0.0014) << tilt;
  }
}

TEST(FittedGrid, HasLinesOfFacesAtTheSidesOfItsBoxAndWithinIt) {
  MadeMesh made;
  made.wall_x(1.5, 0.0, 1.0, 1.0);  // the largest is beyond
  made.wall_x(0.03125, 0.0, 0.9, 0.9);
  made.wall_x(0.96875, 0.0, 0.8, 0.8);
  const Eigen::AlignedBox3d box_m(Eigen::Vector3d(0.03125, 0, 0), Eigen::Vector3d(0.96875, 1, 1));
  const auto x_m = fit_grid(made.mesh, box_m, 0.05).lines_m[0];
  EXPECT_TRUE(has_line(x_m, 0.03125));
  EXPECT_TRUE(has_line(x_m, 0.96875));
  EXPECT_NEAR(x_m.front(), 0.03125 - 0.05, 1e-9);
}

/// Of boxes that hold it, or within a cell of which it lies.
TEST(FittedGrid, HasTheFloorAsALineWhereItReachesBothSidesOfIt) {
  const auto upright_m = [](double low_m, double high_m) {
    const Eigen::AlignedBox3d box_m(Eigen::Vector3d(0, 0, low_m), Eigen::Vector3d(1, 1, high_m));
    return fit_grid(BuildingMesh{}, box_m, 0.05).lines_m[2];
  };
  EXPECT_TRUE(has_line(upright_m(0.0, 0.98), 0.0));
  EXPECT_TRUE(has_line(upright_m(-0.12, 0.3), 0.0));
  EXPECT_NEAR(upright_m(0.02, 0.98).front(), -0.05, 1e-9);
  EXPECT_EQ(upright_m(0.05, 0.98).front(), 0.0) << "it is where the grid begins";
  EXPECT_NEAR(upright_m(0.5, 0.98).front(), 0.45, 1e-9);
  EXPECT_EQ(upright_m(-0.98, -0.05).back(), 0.0);
}

}  // namespace
}  // namespace vantage
