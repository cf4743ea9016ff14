#include "vantage/belief/map/headroom.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace vantage {
namespace {

constexpr float kFree = -1.0F;
constexpr float kOccupied = 1.0F;

/// Ten columns of 0.2 m along x, ten cells of 0.2 m high, free but for what a test puts there.
OccupancyGrid free_row() {
  OccupancyGrid grid(make_grid_frame({0.0, 0.1, 1.0}, {2.0, 0.2, 2.0}, {10, 1, 10}));
  std::ranges::fill(grid.log_odds, kFree);
  return grid;
}

FloorMap free_floor() {
  FloorMap floor = make_floor_map({.cell_m = 0.1, .half_size_m = 1.5});
  std::ranges::fill(floor.log_odds, kFree);
  return floor;
}

void set(OccupancyGrid& grid, int x, int z, float log_odds) {
  grid.log_odds[grid.frame.index({x, 0, z})] = log_odds;
}

/// Cells of the floor within the grid that are blocked.
std::ptrdiff_t blocked_within(const OccupancyGrid& grid, const FloorMap& floor) {
  const Eigen::AlignedBox3d box = grid.frame.box();
  std::ptrdiff_t blocked = 0;
  for (std::size_t cell = 0; cell < floor.size(); ++cell) {
    const Eigen::Vector2d p_m = floor.centre(floor.cell(cell));
    blocked += box.contains(Eigen::Vector3d(p_m.x(), p_m.y(), 1.0)) ? floor.blocked[cell] : 0;
  }
  return blocked;
}

/// The floor from x = -1 to 1 along y = 0.05: 'x' blocked, '.' not.
std::string row(const FloorMap& floor) {
  std::string drawn;
  for (double x_m = -0.95; x_m < 1.0; x_m += 0.1) {
    drawn += floor.blocked[floor.index(floor.cell_at({x_m, 0.05}))] != 0 ? 'x' : '.';
  }
  return drawn;
}

std::vector<std::uint8_t> nowhere(const FloorMap& floor) {
  return std::vector<std::uint8_t>(floor.size(), 0);
}

constexpr HeadroomOptions kOptions{
    .low_m = 0.15, .high_m = 1.5, .seen_low_m = 0.15, .max_unseen = 0.3};

TEST(Headroom, ATableTopBlocksTheFloorBelowIt) {
  OccupancyGrid grid = free_row();
  for (const int x : {3, 4, 5}) set(grid, x, 3, kOccupied);
  FloorMap floor = free_floor();
  block_columns(floor, grid, nowhere(floor), kOptions);
  EXPECT_EQ(row(floor), "......xxxxxx........");
  EXPECT_EQ(floor.state_at({-0.35, 0.05}), CellState::occupied);
}

TEST(Headroom, AColumnBlocksAllFloorBelowIt) {
  OccupancyGrid grid = free_row();
  set(grid, 5, 3, kOccupied);  // 0.2 x 0.2 m
  FloorMap floor = make_floor_map({.cell_m = 0.05, .half_size_m = 1.5});
  std::ranges::fill(floor.log_odds, kFree);
  block_columns(floor, grid, nowhere(floor), kOptions);
  EXPECT_EQ(blocked_within(grid, floor), 16);
}

/// The scanner has measured the face of a wall; it has not seen what hangs above it.
TEST(Headroom, WallsDoNotBlockTheFinerMap) {
  OccupancyGrid grid = free_row();
  for (int z = 0; z < 10; ++z) set(grid, 2, z, kOccupied);  // a wall
  set(grid, 4, 3, kOccupied);                               // a table top
  for (int z = 3; z < 10; ++z) set(grid, 6, z, kOccupied);  // a cupboard that hangs
  set(grid, 8, 1, kOccupied);                               // a low box
  FloorMap floor = free_floor();
  FloorMap detail = free_floor();
  block_columns({floor, nowhere(floor)}, {detail, nowhere(detail)}, grid, kOptions, 0.25);
  EXPECT_EQ(row(floor), "....xx..xx..xx..xx..");
  EXPECT_EQ(row(detail), "........xx..xx..xx..");
}

/// What stands in a shelf looks like a wall to the scanner, but boards stand out from it.
TEST(Headroom, WallsAreOccupiedAtNineTenthsOfTheRobotsHeight) {
  OccupancyGrid grid = free_row();
  for (int z = 0; z < 10; ++z) {
    if (z != 6) set(grid, 2, z, kOccupied);            // nine of ten
    if (z != 4 && z != 6) set(grid, 6, z, kOccupied);  // eight of ten
  }
  HeadroomOptions options = kOptions;
  options.low_m = 0.0;
  options.high_m = 2.0;
  FloorMap floor = free_floor();
  FloorMap detail = free_floor();
  block_columns({floor, nowhere(floor)}, {detail, nowhere(detail)}, grid, options, 0.25);
  EXPECT_EQ(row(floor), "....xx......xx......");
  EXPECT_EQ(row(detail), "............xx......");
}

/// A shelf is as full as a wall, but the robot's camera looks over it.
TEST(Headroom, WallsGoOnAboveTheRobot) {
  OccupancyGrid grid(make_grid_frame({0.0, 0.1, 1.2}, {2.0, 0.2, 2.4}, {10, 1, 48}));
  std::ranges::fill(grid.log_odds, kFree);
  for (int z = 0; z < 35; ++z) set(grid, 2, z, kOccupied);  // five of seven slices above 1.5 m
  for (int z = 0; z < 34; ++z) set(grid, 6, z, kOccupied);  // four
  HeadroomOptions options = kOptions;
  options.high_m = 1.47;
  FloorMap floor = free_floor();
  FloorMap detail = free_floor();
  block_columns({floor, nowhere(floor)}, {detail, nowhere(detail)}, grid, options, 0.25);
  EXPECT_EQ(row(floor), "....xx......xx......");
  EXPECT_EQ(row(detail), "............xx......");
}

/// A face near the boundary of two columns is now and then in the farther one.
TEST(Headroom, WhatIsBesideAWallDoesNotBlockTheFinerMap) {
  OccupancyGrid grid = free_row();
  for (int z = 0; z < 10; ++z) set(grid, 2, z, kOccupied);      // a wall
  for (const int z : {3, 6}) set(grid, 3, z, kOccupied);        // its face, here and there
  for (int z = 0; z < 10; ++z) set(grid, 7, z, kOccupied);      // another
  for (const int x : {5, 6, 8, 9}) set(grid, x, 3, kOccupied);  // a board, on either side
  FloorMap floor = free_floor();
  FloorMap detail = free_floor();
  block_columns({floor, nowhere(floor)}, {detail, nowhere(detail)}, grid, kOptions, 0.25);
  EXPECT_EQ(row(floor), "....xxxx..xxxxxxxxxx");
  EXPECT_EQ(row(detail), "..........xx......xx");
}

TEST(Headroom, WhatIsBesideAWallDoesNotBlockTheFinerMapAtTheRimOfTheGridEither) {
  OccupancyGrid grid = free_row();
  for (int z = 0; z < 10; ++z) {
    for (const int x : {1, 8}) set(grid, x, z, kOccupied);
  }
  for (const int x : {0, 9}) set(grid, x, 3, kOccupied);
  FloorMap floor = free_floor();
  FloorMap detail = free_floor();
  block_columns({floor, nowhere(floor)}, {detail, nowhere(detail)}, grid, kOptions, 0.25);
  EXPECT_EQ(row(floor), "xxxx............xxxx");
  EXPECT_EQ(row(detail), "....................");
}

TEST(Headroom, NothingBlocksTheFinerMapWhereTheRobotHasBeen) {
  OccupancyGrid grid = free_row();
  set(grid, 4, 3, kOccupied);
  for (int z = 1; z <= 3; ++z) set(grid, 7, z, 0.0F);
  FloorMap floor = free_floor();
  FloorMap detail = free_floor();
  std::vector<std::uint8_t> traversed = nowhere(detail);
  for (const double x_m : {-0.15, 0.45}) traversed[detail.index(detail.cell_at({x_m, 0.05}))] = 1;
  block_columns({floor, traversed}, {detail, traversed}, grid, kOptions, 0.25);
  EXPECT_EQ(row(floor), "........xx.....x....");
  EXPECT_EQ(row(detail), ".........x.....x....");
}

TEST(Headroom, TheFloorItselfAndWhatIsAboveTheRobotDoNot) {
  OccupancyGrid grid = free_row();
  set(grid, 2, 0, kOccupied);
  set(grid, 6, 8, kOccupied);
  FloorMap floor = free_floor();
  block_columns(floor, grid, nowhere(floor), kOptions);
  EXPECT_EQ(row(floor), "....................");
}

TEST(Headroom, AColumnHardlySeenBlocksUnlessTheRobotHasBeenThere) {
  OccupancyGrid grid = free_row();
  for (int z = 1; z <= 2; ++z) set(grid, 1, z, 0.0F);  // two of seven
  for (int z = 1; z <= 3; ++z) set(grid, 7, z, 0.0F);
  FloorMap floor = free_floor();
  std::vector<std::uint8_t> traversed = nowhere(floor);
  block_columns(floor, grid, traversed, kOptions);
  EXPECT_EQ(row(floor), "..............xx....");
  traversed[floor.index(floor.cell_at({0.45, 0.05}))] = 1;
  block_columns(floor, grid, traversed, kOptions);
  EXPECT_EQ(row(floor), "...............x....");
  set(grid, 7, 3, kOccupied);
  block_columns(floor, grid, traversed, kOptions);
  EXPECT_EQ(row(floor), "..............xx....") << "what was seen there counts all the same";
}

/// Free but for columns of which nothing was seen, 0.2 m wide, at their indices.
OccupancyGrid unseen_columns(std::initializer_list<Eigen::Array2i> columns) {
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 1.0}, {2.0, 2.0, 2.0}, {10, 10, 10}));
  std::ranges::fill(grid.log_odds, kFree);
  for (const Eigen::Array2i& column : columns) {
    for (int z = 0; z < 10; ++z) {
      grid.log_odds[grid.frame.index({column.x(), column.y(), z})] = 0.0F;
    }
  }
  return grid;
}

std::ptrdiff_t blocked_by(const OccupancyGrid& grid) {
  FloorMap floor = free_floor();
  block_columns(floor, grid, nowhere(floor), kOptions);
  return blocked_within(grid, floor);
}

TEST(Headroom, FewUnseenColumnsAmidOpenOnesDoNotBlock) {
  EXPECT_EQ(blocked_by(unseen_columns({{4, 5}})), 0);
  EXPECT_EQ(blocked_by(unseen_columns({{4, 5}, {5, 6}, {5, 7}, {4, 8}, {1, 1}})), 0);
}

TEST(Headroom, UnseenColumnsThatAreManyOrTouchAnObstacleOrTheEdgeBlock) {
  constexpr int kFloorCells = 4;  // below a column
  EXPECT_EQ(blocked_by(unseen_columns({{4, 5}, {5, 6}, {5, 7}, {4, 8}, {5, 5}})), 5 * kFloorCells);
  EXPECT_EQ(blocked_by(unseen_columns({{0, 5}, {1, 6}})), 2 * kFloorCells);
  EXPECT_EQ(blocked_by(unseen_columns({{4, 9}})), kFloorCells);
  OccupancyGrid beside_a_post = unseen_columns({{4, 5}, {5, 5}});
  beside_a_post.log_odds[beside_a_post.frame.index({3, 4, 5})] = kOccupied;
  EXPECT_EQ(blocked_by(beside_a_post), 3 * kFloorCells);
}

TEST(Headroom, AnUnseenColumnBesideAWallBlocks) {
  constexpr int kFloorCells = 4;  // below a column
  OccupancyGrid grid = unseen_columns({{4, 5}});
  for (int z = 0; z < 10; ++z) grid.log_odds[grid.frame.index({3, 4, z})] = kOccupied;
  FloorMap floor = free_floor();
  FloorMap detail = free_floor();
  block_columns({floor, nowhere(floor)}, {detail, nowhere(detail)}, grid, kOptions, 0.25);
  EXPECT_EQ(blocked_within(grid, floor), 2 * kFloorCells);
  EXPECT_EQ(blocked_within(grid, detail), kFloorCells);
}

/// Columns that a post hides from 0.4 m up; the scanner is at 0.25 m.
OccupancyGrid behind_a_post(std::initializer_list<Eigen::Array2i> hidden) {
  OccupancyGrid grid = unseen_columns(hidden);
  for (const Eigen::Array2i& column : hidden) {
    for (int z = 0; z < 2; ++z) {
      grid.log_odds[grid.frame.index({column.x(), column.y(), z})] = kFree;
    }
  }
  for (int z = 0; z < 10; ++z) grid.log_odds[grid.frame.index({3, 4, z})] = kOccupied;
  return grid;
}

std::ptrdiff_t blocked_in_detail(const OccupancyGrid& grid) {
  FloorMap floor = free_floor();
  FloorMap detail = free_floor();
  block_columns({floor, nowhere(floor)}, {detail, nowhere(detail)}, grid, kOptions, 0.25);
  return blocked_within(grid, detail);
}

TEST(Headroom, WhatAPostHidesJustBehindItDoesNotBlockTheFinerMap) {
  constexpr int kFloorCells = 4;  // below a column
  OccupancyGrid grid = behind_a_post({{4, 5}});
  EXPECT_EQ(blocked_in_detail(grid), 0);
  EXPECT_EQ(blocked_by(grid), 2 * kFloorCells) << "the post and what it hides";
  grid.log_odds[grid.frame.index({4, 5, 1})] = 0.0F;
  EXPECT_EQ(blocked_in_detail(grid), kFloorCells) << "not seen at the scanner's height";
}

TEST(Headroom, WhatAPostHidesFartherOffBlocksTheFinerMap) {
  constexpr int kFloorCells = 4;  // below a column
  EXPECT_EQ(blocked_in_detail(behind_a_post({{4, 5}, {5, 5}, {6, 5}})), 2 * kFloorCells);
  const OccupancyGrid shade = behind_a_post(
      {{3, 5}, {4, 5}, {5, 5}, {4, 4}, {5, 4}, {3, 6}, {4, 6}, {5, 6}, {5, 3}, {4, 3}});
  EXPECT_EQ(blocked_in_detail(shade), 7 * kFloorCells)
      << "three are between the post and open ones";
}

TEST(Headroom, ForgetsWhatIsNoLongerThere) {
  OccupancyGrid grid = free_row();
  set(grid, 4, 4, kOccupied);
  FloorMap floor = free_floor();
  block_columns(floor, grid, nowhere(floor), kOptions);
  block_columns(floor, free_row(), nowhere(floor), kOptions);
  EXPECT_EQ(row(floor), "....................");
}

TEST(Headroom, RejectsOptionsOutOfRange) {
  FloorMap floor = free_floor();
  EXPECT_THROW(block_columns(floor, free_row(), nowhere(floor), {.low_m = 2.0}), ConfigError);
  EXPECT_THROW(block_columns(floor, free_row(), nowhere(floor), {.max_unseen = 1.5}), ConfigError);
}

TEST(Headroom, WhatIsBelowAColumnIsBlockedWhateverTheShapeOfTheFloor) {
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 1.0}, {2.0, 1.2, 2.0}, {10, 6, 10}));
  std::ranges::fill(grid.log_odds, kFree);
  grid.log_odds[grid.frame.index({7, 4, 5})] = kOccupied;
  for (int z = 0; z < 10; ++z) grid.log_odds[grid.frame.index({2, 1, z})] = 0.0F;  // amid open ones
  FloorMap floor = free_floor();
  block_columns(floor, grid, nowhere(floor), kOptions);
  EXPECT_EQ(blocked_within(grid, floor), 4);
  for (const double x_m : {0.45, 0.55}) {
    for (const double y_m : {0.25, 0.35}) {
      EXPECT_EQ(floor.blocked[floor.index(floor.cell_at({x_m, y_m}))], 1) << x_m << " " << y_m;
    }
  }
}

TEST(Headroom, NoUnseenCellIsAllowedWhereTheShareIsZero) {
  HeadroomOptions options = kOptions;
  options.max_unseen = 0.0;
  OccupancyGrid grid = free_row();
  FloorMap floor = free_floor();
  block_columns(floor, grid, nowhere(floor), options);
  EXPECT_EQ(row(floor), "....................");
  set(grid, 7, 3, 0.0F);
  block_columns(floor, grid, nowhere(floor), options);
  EXPECT_EQ(row(floor), "..............xx....");
}

TEST(Headroom, AFloorBelowThingsIsBlockedUpToItsRim) {
  OccupancyGrid grid = unseen_columns({});
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 10; ++x) grid.log_odds[grid.frame.index({x, y, 3})] = kOccupied;
  }
  FloorMap floor(Eigen::Vector2d(-0.4, -0.3), 0.1, 8, 6);  // smaller than the grid, not square
  block_columns(floor, grid, nowhere(floor), kOptions);
  EXPECT_EQ(std::ranges::count(floor.blocked, std::uint8_t{1}), 48);
}

TEST(Headroom, AnUnseenColumnNextToTheOutermostOnesIsAmidOpenOnesToo) {
  for (const Eigen::Array2i& column :
       {Eigen::Array2i(8, 5), Eigen::Array2i(1, 5), Eigen::Array2i(5, 8), Eigen::Array2i(5, 1)}) {
    EXPECT_EQ(blocked_by(unseen_columns({column})), 0) << column.transpose();
  }
  EXPECT_EQ(blocked_by(unseen_columns({{9, 5}})), 4);
}

TEST(Headroom, RejectsHeightsThatAreNotBelowTheRobotsTop) {
  FloorMap floor = free_floor();
  EXPECT_THROW(block_columns(floor, free_row(), nowhere(floor), {.low_m = 1.65}), ConfigError);
  EXPECT_THROW(block_columns(floor, free_row(), nowhere(floor), {.seen_low_m = 1.65}), ConfigError);
}

/// An outer door that stands open: the planar scanner sees floor behind it, of which nothing is
/// known.
TEST(Headroom, FloorBeyondTheGridIsBlockedButWhereTheRobotHasBeen) {
  const OccupancyGrid grid = unseen_columns({});
  FloorMap floor = free_floor();
  FloorMap detail = free_floor();
  std::vector<std::uint8_t> traversed = nowhere(floor);
  traversed[floor.index(floor.cell_at({1.25, 0.05}))] = 1;
  block_columns({floor, traversed}, {detail, nowhere(detail)}, grid, kOptions, 0.25);
  EXPECT_EQ(std::ranges::count(floor.blocked, std::uint8_t{1}), 30 * 30 - 20 * 20 - 1);
  EXPECT_EQ(floor.state_at({0.95, 0.05}), CellState::free);
  EXPECT_EQ(floor.state_at({1.05, 0.05}), CellState::occupied);
  EXPECT_EQ(floor.state_at({1.25, 0.05}), CellState::free);
  EXPECT_EQ(std::ranges::count(detail.blocked, std::uint8_t{1}), 30 * 30 - 20 * 20);
}

TEST(Headroom, WhatBeginsJustAtTheLowerOrTheUpperHeightCounts) {
  OccupancyGrid grid(make_grid_frame({0.0, 0.1, 1.0}, {2.0, 0.2, 2.0}, {10, 1, 8}));
  std::ranges::fill(grid.log_odds, kFree);
  set(grid, 2, 1, kOccupied);  // from 0.25 m on
  set(grid, 6, 1, 0.0F);
  set(grid, 8, 6, kOccupied);  // from 1.5 m on
  HeadroomOptions options = kOptions;
  options.low_m = 0.25;
  options.seen_low_m = 0.25;
  options.max_unseen = 0.0;
  FloorMap floor = free_floor();
  block_columns(floor, grid, nowhere(floor), options);
  EXPECT_EQ(row(floor), "....xx......xx..xx..");
}

/// Of which all is occupied, from 2 m up or from 1 m below the floor down.
TEST(Headroom, AGridAboveTheRobotOrBelowItBlocksNothing) {
  for (const double middle_m : {-2.0, 3.0}) {
    OccupancyGrid grid(make_grid_frame({0.0, 0.1, middle_m}, {2.0, 0.2, 2.0}, {10, 1, 10}));
    std::ranges::fill(grid.log_odds, kOccupied);
    FloorMap floor = free_floor();
    block_columns(floor, grid, nowhere(floor), kOptions);
    EXPECT_EQ(row(floor), "....................") << middle_m;
  }
}

/// Faces of columns and of cells of the floor differ by rounding.
TEST(Headroom, AColumnTouchesACellThatItReachesIntoByLessThanANanometre) {
  for (const auto& [shift_m, blocked] :
       {std::pair(0.8e-9, "....xx.............."), std::pair(1.5e-9, "....xxx.............")}) {
    OccupancyGrid grid(make_grid_frame({shift_m, 0.1, 1.0}, {2.0, 0.2, 2.0}, {10, 1, 10}));
    std::ranges::fill(grid.log_odds, kFree);
    set(grid, 2, 3, kOccupied);
    FloorMap floor = free_floor();
    block_columns(floor, grid, nowhere(floor), kOptions);
    EXPECT_EQ(row(floor), blocked) << shift_m;
  }
}

TEST(Headroom, RejectsOptionsOutOfRangeOfTheFinerMapToo) {
  FloorMap floor = free_floor();
  FloorMap detail = free_floor();
  const std::vector<std::uint8_t> none = nowhere(floor);
  for (const HeadroomOptions& bad :
       {HeadroomOptions{.low_m = 2.0}, HeadroomOptions{.max_unseen = 1.5}}) {
    EXPECT_THROW(block_columns({floor, none}, {detail, none}, free_row(), bad, 0.2), ConfigError);
  }
  EXPECT_NO_THROW(block_columns({floor, none}, {detail, none}, free_row(), kOptions, 0.2));
}

}  // namespace
}  // namespace vantage
