#include "vantage/belief/map/octomap_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/belief/map/voxel_scene.hpp"
#include "tests/support/octomap_bytes.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/belief/map/octomap_io.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class OctomapFiles : public ::testing::Test {
 protected:
  fs::path file(const std::string& name, const std::string& bytes) {
    std::ofstream(directory_ / name, std::ios::binary) << bytes;
    return directory_ / name;
  }
  OctomapFile map(const std::vector<support::MapCube>& cubes, double resolution_m) {
    return OctomapFile(file("map.bt", support::octomap_bytes(cubes, resolution_m)));
  }
  static std::string error_of(const fs::path& path) {
    try {
      const OctomapFile map(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }
  support::TemporaryDirectory directory_;
};

TEST_F(OctomapFiles, CellsKilometresApart) {
  const auto far = map({{{-32768, -32768, -32768}, 1, true},
                        {{0, 0, 0}, 4, false},
                        {{32767, 32767, 32767}, 1, true}},
                       0.5);
  EXPECT_EQ(far.occupied(), 2U);
  EXPECT_EQ(far.free(), 64U);
  EXPECT_TRUE(far.box_of(far.known())
                  .isApprox(Eigen::AlignedBox3d(Eigen::Vector3d::Constant(-16384.0),
                                                Eigen::Vector3d::Constant(16384.0))));
  const OccupancyGrid middle =
      far.grid_of(far.cells_in({Eigen::Vector3d::Constant(-1.0), Eigen::Vector3d::Constant(3.0)}));
  EXPECT_EQ(middle.size(), 512U);
  EXPECT_EQ(middle.count(CellState::free), 64U);
  EXPECT_EQ(middle.count(CellState::occupied), 0U);
  EXPECT_EQ(middle.state(middle.frame.index(middle.frame.cell_at({0.1, 0.1, 1.9}))),
            CellState::free);
}

TEST_F(OctomapFiles, WholeTreeOfHugeLeaves) {
  std::vector<support::MapCube> cubes;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Array3i corner(i & 1, i >> 1 & 1, i >> 2 & 1);
    cubes.push_back({(corner - 1) * 32768, 32768, i == 0});
  }
  const auto full = map(cubes, 0.01);
  EXPECT_EQ(full.occupied(), std::size_t{1} << 45);
  EXPECT_EQ(full.grid_of({{-2, -2, -2}, {2, 2, 2}}).count(CellState::occupied), 8U);
  EXPECT_THROW(read_octomap(directory_ / "map.bt"), InputError);
  EXPECT_THROW(read_octomap_grid(directory_ / "map.bt"), InputError);
}

TEST_F(OctomapFiles, RefusesMoreCellsThanItListsOrAGridHolds) {
  std::vector<support::MapCube> cubes;
  std::size_t left = 50'000'001;
  int x = 0;
  for (int level = 8; level >= 0; --level) {  // side by side, the larger ones first
    const std::size_t cells = std::size_t{1} << (3 * level);
    for (; left >= cells; left -= cells) {
      cubes.push_back({{x, 0, 0}, 1 << level, true});
      x += 1 << level;
    }
  }
  EXPECT_EQ(map(cubes, 0.1).occupied(), 50'000'001U);
  EXPECT_THAT([&] { read_octomap(directory_ / "map.bt"); },
              ThrowsMessage<InputError>(HasSubstr("more than 50000000 occupied cells")));
  map({{{0, 0, 0}, 1, true}, {{20000, 9999, 0}, 1, true}}, 0.1);
  EXPECT_THAT([&] { read_octomap_grid(directory_ / "map.bt"); },
              ThrowsMessage<InputError>(HasSubstr("20001 x 10000 x 1 cells, at most 200000000")));
}

TEST_F(OctomapFiles, CellsInABoxAreThoseItReachesInto) {
  const auto one = map({{{0, 0, 0}, 1, true}}, 0.1);
  const auto along = [&](double from, double to) {
    const CellBlock cells = one.cells_in({Eigen::Vector3d(from, 0, 0), Eigen::Vector3d(to, 1, 1)});
    return std::pair{cells.begin.x(), cells.end.x()};
  };
  EXPECT_EQ(along(0.05, 0.15), (std::pair{0, 2}));
  EXPECT_EQ(along(0.1, 0.3), (std::pair{1, 3}));  // rounding apart, two cells
  EXPECT_EQ(along(-0.05, 0.05), (std::pair{-1, 1}));
  EXPECT_EQ(along(-1e300, 1e300), (std::pair{-32768, 32768}));
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(along(-infinity, infinity), (std::pair{-32768, 32768}));
  EXPECT_TRUE(one.cells_in({}).empty());
  const CellBlock whole = one.cells_in(one.box_of(one.known()));
  EXPECT_TRUE((whole.begin == one.known().begin).all() && (whole.end == one.known().end).all());
}

TEST_F(OctomapFiles, GridsAreTheSameWhicheverWriterAndFormat) {
  Rng rng(8);
  const GridFrame frame = make_grid_frame({-0.4, 0.2, 0.4}, {1.6, 1.2, 0.8}, {16, 12, 8});
  const OccupancyGrid grid = test::random_grid(frame, 0.2, 0.4, rng);
  for (const char* name : {"map.ot", "map.bt"}) {
    write_octomap(grid, directory_ / name);
    const OctomapFile map(directory_ / name);
    const OccupancyGrid back = map.grid_of(map.cells_in(frame.box()));
    ASSERT_TRUE((back.frame.cells == frame.cells).all());
    for (std::size_t i = 0; i < grid.size(); ++i) {
      ASSERT_EQ(back.state(i), grid.state(i)) << name << ' ' << i;
    }
  }
}

/// A few hundred bytes may say as many cells as a grid may have, in leaves of a thousand a side.
TEST_F(OctomapFiles, GridsHoldWhatOfALeafLiesInThem) {
  const std::vector<support::MapCube> cubes{
      {{0, 0, 0}, 8, false}, {{8, 0, 0}, 8, true}, {{-4, -4, -4}, 4, true}, {{-1, 3, 5}, 1, false}};
  const auto leaves = map(cubes, 0.1);
  const CellBlock block{{-2, -3, -1}, {11, 6, 7}};
  const OccupancyGrid grid = leaves.grid_of(block);
  block.for_each_cell([&](const Eigen::Array3i& cell) {
    CellState wanted = CellState::unobserved;
    for (const auto& [corner, edge, occupied] : cubes) {
      if ((cell < corner).any() || (cell >= corner + edge).any()) continue;
      wanted = occupied ? CellState::occupied : CellState::free;
    }
    EXPECT_EQ(grid.state(grid.frame.index(cell - block.begin)), wanted) << cell.transpose();
  });
}

TEST_F(OctomapFiles, CoarseCells) {
  // Cubes of two: occupied if one cell is, free if half of them are known, else unobserved.
  std::vector<support::MapCube> cubes{{{-2, 0, 0}, 2, false}, {{2, 0, 0}, 1, true}};
  for (int i = 0; i < 4; ++i) cubes.push_back({{i & 1, i >> 1, 0}, 1, false});
  for (int i = 0; i < 3; ++i) cubes.push_back({{4 + (i & 1), i >> 1, 0}, 1, false});
  const auto fine = map(cubes, 0.1);
  const OccupancyGrid coarse = fine.grid_of(fine.known(), 2);
  EXPECT_TRUE(coarse.frame.min_corner_m.isApprox(Eigen::Vector3d(-0.2, 0.0, 0.0)));
  EXPECT_TRUE(coarse.frame.cell_size_m.isApprox(Eigen::Vector3d::Constant(0.2)));
  EXPECT_EQ(test::draw(coarse), (std::vector<std::string>{"..#?"}));
}

TEST_F(OctomapFiles, CoarseCellsAtTheRimAreJudgedByTheirPartInside) {
  std::vector<support::MapCube> cubes{{{0, 0, 0}, 8, false}, {{9, 0, 0}, 1, true}};
  const CellBlock block{{0, 0, 0}, {9, 9, 9}};
  block.for_each_cell([&](const Eigen::Array3i& cell) {
    if ((cell == 8).any()) cubes.push_back({cell, 1, false});
  });
  EXPECT_EQ(map(cubes, 0.1).grid_of(block, 4).count(CellState::free), 27U);
}

TEST_F(OctomapFiles, HalfOfACoarseCellIsHalfHoweverManyLeavesItTakes) {
  std::vector<support::MapCube> cubes;
  const CellBlock half{{0, 0, 0}, {10, 10, 5}};
  half.for_each_cell([&](const Eigen::Array3i& cell) { cubes.push_back({cell, 1, false}); });
  const CellBlock whole{{0, 0, 0}, {10, 10, 10}};
  EXPECT_EQ(map(cubes, 0.1).grid_of(whole, 10).count(CellState::free), 1U);
  cubes.pop_back();
  EXPECT_EQ(map(cubes, 0.1).grid_of(whole, 10).count(CellState::unobserved), 1U);
}

TEST_F(OctomapFiles, CoarseBlocksHoldTheFineOnes) {
  const CellBlock block{{-3, -1, 4}, {5, 1, 8}};
  const CellBlock coarse = block.coarsened(4);
  EXPECT_TRUE((coarse.begin == Eigen::Array3i(-1, -1, 1)).all());
  EXPECT_TRUE((coarse.end == Eigen::Array3i(2, 1, 2)).all());
}

TEST_F(OctomapFiles, RefusesWhatNeverEnds) {
  EXPECT_THAT(error_of("/dev/zero"), HasSubstr("/dev/zero: is not a regular file"));
  EXPECT_THAT(error_of(directory_.path()), HasSubstr("directory"));
  EXPECT_THAT(error_of(directory_ / "none.bt"), HasSubstr("none.bt"));
  const fs::path large = file("large.bt", "# Octomap OcTree file\n");
  fs::resize_file(large, (std::uintmax_t{1} << 31) + 1);  // sparse on disk
  EXPECT_THAT(error_of(large), HasSubstr("larger than 2 GiB"));
}

TEST_F(OctomapFiles, ResolutionsThatNoWorldHas) {
  for (const char* res : {"1e-300", "1e300", "1e-7", "2e6"}) {
    const std::string text = std::string("# Octomap OcTree file\nid OcTree\nsize 0\nres ") + res;
    EXPECT_THAT(error_of(file("map.ot", text + "\ndata\n")), HasSubstr("'res' is "));
  }
}

TEST_F(OctomapFiles, ACoarseCellIsAsTheMostOccupiedOfItsCells) {
  // Occupied and then free in the tree's order, and the other way round.
  const auto fine = map(
      {{{0, 0, 0}, 1, true}, {{1, 0, 0}, 1, false}, {{2, 0, 0}, 1, false}, {{3, 0, 0}, 1, true}},
      0.1);
  EXPECT_EQ(test::draw(fine.grid_of(fine.known(), 2)), (std::vector<std::string>{"##"}));
}

TEST_F(OctomapFiles, WhatIsKnownNeedNotHoldTheOrigin) {
  const auto away = map({{{10, -20, 30}, 1, true}, {{12, -24, 32}, 2, false}}, 0.5);
  EXPECT_TRUE((away.known().begin == Eigen::Array3i(10, -24, 30)).all());
  EXPECT_TRUE((away.known().end == Eigen::Array3i(14, -19, 34)).all());
  EXPECT_TRUE(away.box_of(away.known())
                  .isApprox(Eigen::AlignedBox3d(Eigen::Vector3d(5.0, -12.0, 15.0),
                                                Eigen::Vector3d(7.0, -9.5, 17.0))));
}

TEST_F(OctomapFiles, ABorderOfCellsIsOneToAMillionthOfACell) {
  const auto one = map({{{0, 0, 0}, 1, true}}, 0.1);
  const auto along = [&](double from_cells, double to_cells) {
    const CellBlock cells = one.cells_in(
        {Eigen::Vector3d(0.1 * from_cells, 0, 0), Eigen::Vector3d(0.1 * to_cells, 1, 1)});
    return std::pair{cells.begin.x(), cells.end.x()};
  };
  EXPECT_EQ(along(1.0 - 7e-7, 3.0 + 7e-7), (std::pair{1, 3}));
  EXPECT_EQ(along(1.0 - 1.5e-6, 3.0 + 1.5e-6), (std::pair{0, 4}));
}

TEST_F(OctomapFiles, ACoarseCellOfOneKnownOneIsUnobserved) {
  const auto fine = map({{{0, 0, 0}, 1, false}, {{2, 0, 0}, 2, false}}, 0.1);
  EXPECT_EQ(test::draw(fine.grid_of({{0, 0, 0}, {4, 2, 2}}, 2)), (std::vector<std::string>{"?."}));
}

TEST_F(OctomapFiles, WhatIsMissingIsSaidToBeSo) {
  EXPECT_THAT(error_of(directory_ / "none.bt"), HasSubstr("none.bt: cannot read"));
  EXPECT_THAT(error_of(directory_.path()), HasSubstr(": is a directory"));
}

}  // namespace
}  // namespace vantage
