#include "vantage/belief/map/octomap_io.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "tests/belief/map/voxel_scene.hpp"
#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

class OctomapIo : public ::testing::Test {
 protected:
  OctomapIo() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    directory_ = fs::temp_directory_path() /
                 ("vantage_octomap_" + std::string(test->name()) + std::to_string(::getpid()));
    fs::create_directories(directory_);
  }
  ~OctomapIo() override { fs::remove_all(directory_); }

  fs::path directory_;
};

/// The table top's cells, moved where they do not line up with the world's origin.
GridFrame table_frame() {
  return make_grid_frame({0.413, -0.207, 0.951}, {40.0 / 129, 30.0 / 129, 20.0 / 129},
                         {40, 30, 20});
}

void expect_same_cells(const OccupancyGrid& grid, const OctomapContent& content) {
  EXPECT_EQ(content.occupied, grid.count(CellState::occupied));
  EXPECT_EQ(content.free, grid.count(CellState::free));
  ASSERT_EQ(content.occupied_centres.size(), content.occupied);
  const Eigen::Array3d half_cell = 0.5 * grid.frame.cell_size_m.array() + 1e-6;
  std::vector<bool> seen(grid.size(), false);
  for (const Eigen::Vector3f& centre : content.occupied_centres) {
    bool found = false;
    for (std::size_t i = 0; i < grid.size() && !found; ++i) {
      if (seen[i] || grid.state(i) != CellState::occupied) continue;
      const Eigen::Vector3d d = centre.cast<double>() - grid.frame.centre(grid.frame.cell(i));
      if ((d.array().abs() <= half_cell).all()) found = seen[i] = true;
    }
    EXPECT_TRUE(found) << centre.transpose();
  }
}

TEST_F(OctomapIo, KeepsEveryCell) {
  Rng rng(3);
  for (const char* extension : {".bt", ".ot"}) {
    const OccupancyGrid grid = test::random_grid(table_frame(), 0.05, 0.5, rng);
    const fs::path path = directory_ / ("map" + std::string(extension));
    write_octomap(grid, path);
    const OctomapContent content = read_octomap(path);
    EXPECT_NEAR(content.resolution_m, 1.0 / 129, 1e-12);
    expect_same_cells(grid, content);
  }
}

TEST_F(OctomapIo, KeepsEveryCellOfAGridThatIsNotCubic) {
  Rng rng(4);
  const GridFrame frame = make_grid_frame({-3.3, 12.1, 0.4}, {3.0, 1.7, 1.1}, {20, 17, 8});
  const OccupancyGrid grid = test::random_grid(frame, 0.1, 0.4, rng);
  write_octomap(grid, directory_ / "map.bt");
  expect_same_cells(grid, read_octomap(directory_ / "map.bt"));
}

// With centres on key borders, rounding puts neighbours into one key at 1.5 m, 0.95 m, -7.06 m.
TEST_F(OctomapIo, NoTwoCellsShareALeafWhereverTheGridLies) {
  for (const double shift_m : {0.0, 0.5 / 129, 1e-12, 1.5, 122.5 / 129, -910.5 / 129, 123.456}) {
    GridFrame frame;
    frame.min_corner_m.setConstant(shift_m);
    frame.cell_size_m.setConstant(1.0 / 129);
    frame.cells = {129, 3, 2};
    OccupancyGrid grid(frame);
    std::ranges::fill(grid.log_odds, 2.0F);
    write_octomap(grid, directory_ / "map.bt");
    EXPECT_EQ(read_octomap(directory_ / "map.bt").occupied, grid.size()) << shift_m;
  }
}

TEST_F(OctomapIo, CountsCellsOfPrunedLeaves) {
  GridFrame frame;
  frame.cells = {16, 16, 16};
  OccupancyGrid grid(frame);
  std::ranges::fill(grid.log_odds, 2.0F);
  write_octomap(grid, directory_ / "map.ot");
  EXPECT_LT(fs::file_size(directory_ / "map.ot"), 1000U);
  const OctomapContent content = read_octomap(directory_ / "map.ot");
  EXPECT_EQ(content.occupied, 4096U);
  EXPECT_TRUE(content.box.isApprox(frame.box()));
}

TEST_F(OctomapIo, ListsEveryCellOfAPrunedLeaf) {
  GridFrame frame;
  frame.min_corner_m = {-4.0, 0.0, 8.0};
  frame.cells = {4, 4, 4};  // one leaf
  OccupancyGrid grid(frame);
  std::ranges::fill(grid.log_odds, 2.0F);
  write_octomap(grid, directory_ / "map.bt");
  expect_same_cells(grid, read_octomap(directory_ / "map.bt"));
}

TEST_F(OctomapIo, StatesAloneArePrunedWhateverTheLogOdds) {
  GridFrame frame;
  frame.cells = {16, 16, 16};
  OccupancyGrid alike(frame);
  std::ranges::fill(alike.log_odds, 2.0F);
  OccupancyGrid varied = alike;
  for (std::size_t i = 0; i < varied.size(); ++i) {
    varied.log_odds[i] = 1.0F + 0.25F * static_cast<float>(i % 7);
  }
  write_octomap(alike, directory_ / "alike.bt");
  write_octomap(varied, directory_ / "varied.bt");
  EXPECT_LT(fs::file_size(directory_ / "alike.bt"), 200U);
  EXPECT_EQ(read_file(directory_ / "varied.bt"), read_file(directory_ / "alike.bt"));
}

TEST_F(OctomapIo, BothOfAFolderAreThoseWrittenOneByOne) {
  Rng rng(8);
  const GridFrame not_cubic = make_grid_frame({-3.3, 12.1, 0.4}, {3.0, 1.7, 1.1}, {20, 17, 8});
  for (const GridFrame& frame : {table_frame(), not_cubic}) {
    OccupancyGrid grid = test::random_grid(frame, 0.05, 0.5, rng);
    std::fill_n(grid.log_odds.begin(), grid.size() / 2, -2.0F);  // there is to prune
    write_octomaps(grid, directory_);
    for (const char* extension : {".bt", ".ot"}) {
      const fs::path alone = directory_ / (std::string("alone") + extension);
      write_octomap(grid, alone);
      EXPECT_EQ(read_file(directory_ / (std::string("map") + extension)), read_file(alone));
    }
  }
}

TEST_F(OctomapIo, InnerNodesHoldTheGreatestLogOddsBelowThem) {
  write_octomap(test::parse({".#"}), directory_ / "map.ot");
  const std::string bytes = read_file(directory_ / "map.ot");
  float root = 0.0F;
  std::memcpy(&root, bytes.data() + bytes.find("data\n") + 5, sizeof root);
  EXPECT_EQ(root, 2.0F);
}

TEST_F(OctomapIo, UnobservedCellsAreNotStored) {
  write_octomap(OccupancyGrid(table_frame()), directory_ / "empty.bt");
  const OctomapContent content = read_octomap(directory_ / "empty.bt");
  EXPECT_EQ(content.occupied + content.free, 0U);
  EXPECT_TRUE(content.box.isEmpty());
  EXPECT_THROW(read_octomap_grid(directory_ / "empty.bt"), InputError);
}

TEST_F(OctomapIo, GridComesBackWithItsLogOdds) {
  const OccupancyGrid grid = test::parse({".#?.", "???#", "#..?"});
  write_octomap(grid, directory_ / "map.ot");
  const OccupancyGrid back = read_octomap_grid(directory_ / "map.ot");
  EXPECT_EQ(test::draw(back), test::draw(grid));
  EXPECT_EQ(back.log_odds, grid.log_odds);
  write_octomap(grid, directory_ / "map.bt");
  EXPECT_EQ(test::draw(read_octomap_grid(directory_ / "map.bt")), test::draw(grid));
}

/// Beyond OctoMap's own limits, -2 and 3.5.
TEST_F(OctomapIo, LogOddsAreKeptUpToThoseOfOneInAMillion) {
  OccupancyGrid grid = test::parse({"..##"});
  grid.log_odds = {-20.0F, -13.5F, 13.5F, 20.0F};
  write_octomap(grid, directory_ / "map.ot");
  const OccupancyGrid back = read_octomap_grid(directory_ / "map.ot");
  ASSERT_EQ(back.size(), 4U);
  EXPECT_NEAR(back.log_odds[0], -13.8155, 1e-3);
  EXPECT_EQ(back.log_odds[1], -13.5F);
  EXPECT_EQ(back.log_odds[2], 13.5F);
  EXPECT_NEAR(back.log_odds[3], 13.8155, 1e-3);
}

TEST_F(OctomapIo, RefusesWhatItCannotWrite) {
  const OccupancyGrid grid = test::parse({".#"});
  EXPECT_THROW(write_octomap(grid, directory_ / "map.pcd"), OutputError);
  EXPECT_THROW(write_octomap(grid, directory_ / "missing" / "map.bt"), OutputError);
  OccupancyGrid far_away = grid;
  far_away.frame.min_corner_m.x() = 40'000.0;
  EXPECT_THROW(write_octomap(far_away, directory_ / "far.bt"), OutputError);
  EXPECT_TRUE(fs::is_empty(directory_));
}

TEST_F(OctomapIo, RefusesWhatIsNotThere) {
  EXPECT_THROW(read_octomap(directory_ / "missing.bt"), InputError);
  EXPECT_THROW(read_octomap(directory_), InputError);
}

TEST_F(OctomapIo, ReachesFromTheLowestKeyToTheHighestAndNoFarther) {
  OccupancyGrid grid = test::parse({".#"});  // two cells of 1 m
  for (const double from_m : {-32768.0, 32766.0}) {
    grid.frame.min_corner_m.x() = from_m;
    write_octomap(grid, directory_ / "rim.bt");
    const OctomapContent content = read_octomap(directory_ / "rim.bt");
    EXPECT_EQ(content.box.min().x(), from_m);
    EXPECT_EQ(content.box.max().x(), from_m + 2.0);
  }
  for (const double from_m : {-32769.0, 32767.0}) {
    grid.frame.min_corner_m.x() = from_m;
    EXPECT_THROW(write_octomap(grid, directory_ / "rim.bt"), OutputError) << from_m;
  }
}

}  // namespace
}  // namespace vantage
