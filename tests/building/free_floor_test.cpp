// Where a robot can begin in rooms of squares that can be counted.
#include "vantage/building/free_floor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace vantage {
namespace {

/// A floor, walls of half a metre all round, and air; layers of z end at 0, 1, 1.7 and 2.5 m.
struct WalledRoom {
  FittedGrid grid;
  std::vector<std::uint8_t> solid;

  WalledRoom(const std::vector<double>& x_m, const std::vector<double>& y_m) {
    grid.lines_m = {x_m, y_m, std::vector<double>{-0.1, 0.0, 1.0, 1.7, 2.5}};
    solid.assign(grid.size(), 0);
    for (int y = 0; y < grid.cells(1); ++y) {
      for (int x = 0; x < grid.cells(0); ++x) {
        solid[grid.index(x, y, 0)] = 1;
        const bool wall = x == 0 || y == 0 || x == grid.cells(0) - 1 || y == grid.cells(1) - 1;
        if (wall) fill(x, y, 1);
      }
    }
  }
  void fill(int x, int y, int z, bool full = true) { solid[grid.index(x, y, z)] = full ? 1 : 0; }
};

const FreeFloorOptions kNarrow{.clearance_m = 0.58};

/// 81 squares of 5 cm by 41: 57 by 17 of them are 12 squares off the walls.
TEST(FreeFloor, BeginsInTheMiddleAlongTheRoom) {
  const WalledRoom room({0.0, 0.5, 4.55, 5.05}, {0.0, 0.5, 2.55, 3.05});
  const auto floor = find_free_floor(room.grid, room.solid, kNarrow);
  ASSERT_TRUE(floor);
  EXPECT_NEAR(floor->area_m2, 57 * 17 * 0.0025, 1e-9);
  EXPECT_NEAR(floor->clearance_m, 1.0, 1e-9);
  EXPECT_NEAR(floor->start.x_m, 2.525, 1e-9);
  EXPECT_NEAR(floor->start.y_m, 1.525, 1e-9);
  EXPECT_EQ(floor->start.yaw_rad, 0.0);
  const WalledRoom across({0.0, 0.5, 2.55, 3.05}, {0.0, 0.5, 4.55, 5.05});
  const auto turned = find_free_floor(across.grid, across.solid, kNarrow);
  ASSERT_TRUE(turned);
  EXPECT_NEAR(turned->start.x_m, 1.525, 1e-9);
  EXPECT_NEAR(turned->start.y_m, 2.525, 1e-9);
  EXPECT_NEAR(turned->start.yaw_rad, 0.5 * std::numbers::pi, 1e-12);
}

TEST(FreeFloor, IsTheLargestOfSeveralAreas) {
  // A wall from 1.95 to 2.45 m; the room beyond it is larger.
  WalledRoom room({0.0, 0.5, 1.95, 2.45, 4.5, 5.0}, {0.0, 0.5, 2.5, 3.0});
  room.fill(2, 1, 1);
  const auto floor = find_free_floor(room.grid, room.solid, kNarrow);
  ASSERT_TRUE(floor);
  EXPECT_GT(floor->start.x_m, 2.45 + 0.58);
  EXPECT_LT(floor->start.x_m, 4.5 - 0.58);
  // Squares 49 to 89 and 10 to 49, of which those 13 and more from the walls count: 17 by 16.
  EXPECT_NEAR(floor->area_m2, 17 * 16 * 0.0025, 1e-9);
}

TEST(FreeFloor, IsUnderWhatHangsHighButNotUnderWhatHangsLow) {
  const std::vector<double> x_m{0.0, 0.5, 2.5, 4.55, 5.05};
  const std::vector<double> y_m{0.0, 0.5, 2.55, 3.05};
  WalledRoom high(x_m, y_m);
  high.fill(1, 1, 3);
  EXPECT_NEAR(find_free_floor(high.grid, high.solid, kNarrow)->area_m2, 57 * 17 * 0.0025, 1e-9);
  WalledRoom low(x_m, y_m);
  low.fill(1, 1, 2);
  const auto floor = find_free_floor(low.grid, low.solid, kNarrow);
  EXPECT_LT(floor->area_m2, 0.5 * 57 * 17 * 0.0025);
  EXPECT_GT(floor->start.x_m, 2.5 + 0.58);
  EXPECT_LT(
      find_free_floor(high.grid, high.solid, {.clearance_m = 0.58, .headroom_m = 1.75})->area_m2,
      0.5 * 57 * 17 * 0.0025);
}

TEST(FreeFloor, IsNoneOverAHoleUnlessItIsLaid) {
  WalledRoom room({0.0, 0.5, 2.5, 4.55, 5.05}, {0.0, 0.5, 2.55, 3.05});
  room.fill(1, 1, 0, false);
  const auto floor = find_free_floor(room.grid, room.solid, kNarrow);
  ASSERT_TRUE(floor);
  EXPECT_GT(floor->start.x_m, 2.5 + 0.58);
  const auto laid =
      find_free_floor(room.grid, room.solid, {.clearance_m = 0.58, .floor_everywhere = true});
  EXPECT_NEAR(laid->area_m2, 57 * 17 * 0.0025, 1e-9);
  room.fill(2, 1, 0, false);
  EXPECT_FALSE(find_free_floor(room.grid, room.solid, kNarrow)) << "no floor at all";
}

TEST(FreeFloor, MayHaveNoRoomForARobot) {
  const WalledRoom room({0.0, 0.5, 4.55, 5.05}, {0.0, 0.5, 2.55, 3.05});
  const auto floor = find_free_floor(room.grid, room.solid, {.clearance_m = 1.02});
  ASSERT_TRUE(floor);
  EXPECT_EQ(floor->area_m2, 0.0);
  EXPECT_EQ(FreeFloorOptions{}.clearance_m, 0.6);
  EXPECT_EQ(FreeFloorOptions{}.headroom_m, 1.6);
}

/// 161 squares by 61 without a corner, whose middle is beside the line that is farthest from the
/// walls: 1.5 m are no better than 1.45 m.
TEST(FreeFloor, MoreRoomThanPlentyIsNotSought) {
  WalledRoom room({0.0, 0.5, 7.5, 8.55, 9.05}, {0.0, 0.5, 1.5, 3.55, 4.05});
  room.fill(2, 1, 1);
  const auto floor = find_free_floor(room.grid, room.solid, kNarrow);
  ASSERT_TRUE(floor);
  EXPECT_NEAR(floor->area_m2, 4681 * 0.0025, 1e-9);
  EXPECT_NEAR(floor->start.x_m, 4.275, 1e-9);
  EXPECT_NEAR(floor->start.y_m, 2.075, 1e-9);
  EXPECT_NEAR(floor->clearance_m, 1.45, 1e-9);
  EXPECT_EQ(floor->start.yaw_rad, 0.0);
}

/// Three corridors one behind the other, 47, 51 and 55 squares wide, the first of which is long and
/// has the middle: what is 1.2 m clear begins in the second.
TEST(FreeFloor, SeeksPlentyOfRoomNearTheMiddle) {
  WalledRoom room({0.0, 0.5, 10.5, 13.5, 16.5, 17.0}, {0.0, 0.5, 0.6, 0.7, 3.05, 3.15, 3.25, 3.75});
  for (const int y : {1, 5}) {
    room.fill(1, y, 1);
    room.fill(2, y, 1);
  }
  for (const int y : {2, 4}) room.fill(1, y, 1);
  const auto floor = find_free_floor(room.grid, room.solid, kNarrow);
  ASSERT_TRUE(floor);
  EXPECT_GT(floor->start.x_m, 10.5);
  EXPECT_LT(floor->start.x_m, 13.5);
  EXPECT_GE(floor->clearance_m, 1.2 - 1e-9);
  EXPECT_LE(floor->clearance_m, 1.25 + 1e-9);
}

/// A room of 2 m, and ground of 3 m round its walls.
TEST(FreeFloor, IsNotOutdoorsWhereThereIsARoom) {
  WalledRoom house({0.0, 3.0, 3.5, 5.5, 6.0, 9.0}, {0.0, 3.0, 3.5, 5.5, 6.0, 9.0});
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 5; ++x) {
      const bool of_house = x > 0 && y > 0 && x < 4 && y < 4;
      house.fill(x, y, 1, of_house && (x != 2 || y != 2));
    }
  }
  FreeFloorOptions options = kNarrow;
  const auto anywhere = find_free_floor(house.grid, house.solid, options);
  ASSERT_TRUE(anywhere);
  EXPECT_GT(std::abs(anywhere->start.x_m - 4.5) + std::abs(anywhere->start.y_m - 4.5), 2.0);
  options.standing_m = {Eigen::Vector2d(3.0, 3.0), Eigen::Vector2d(6.0, 6.0)};
  const auto indoors = find_free_floor(house.grid, house.solid, options);
  ASSERT_TRUE(indoors);
  EXPECT_NEAR(indoors->start.x_m, 4.5, 0.05);
  EXPECT_NEAR(indoors->start.y_m, 4.5, 0.05);
  house.fill(2, 1, 1, false);  // a door of 2 m
  const auto open = find_free_floor(house.grid, house.solid, options);
  ASSERT_TRUE(open);
  EXPECT_NEAR(open->start.x_m, 4.5, 0.05);
  EXPECT_GT(open->start.y_m, 3.0);
  EXPECT_LT(open->area_m2, 3.0) << "not the ground beyond the door";
  house.fill(2, 1, 1);
  house.fill(2, 2, 1);
  const auto outdoors = find_free_floor(house.grid, house.solid, options);
  ASSERT_TRUE(outdoors);
  EXPECT_EQ(outdoors->area_m2, anywhere->area_m2) << "there is nothing else";
}

/// A gate of 4 m: 2.8 m of its threshold have clearance. A side of 6 m that is open is outdoors.
TEST(FreeFloor, AHallWithAGateIsIndoors) {
  for (const double open_m : {4.0, 6.0}) {
    // Left of it a closed room of 2 x 2 m.
    const double low_m = 3.5 - 0.5 * open_m;
    WalledRoom hall({0.0, 0.5, 2.5, 3.0, 9.0}, {0.0, low_m, 2.5, 4.5, 7.0 - low_m, 7.0});
    for (int y = 0; y < 5; ++y) {
      for (int x = 1; x < 4; ++x)
        hall.fill(x, y, 1, y == 0 || y == 4 || x == 2 || (x == 1 && y != 2));
    }
    FreeFloorOptions options = kNarrow;
    options.standing_m = {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(9.0, 7.0)};
    const auto floor = find_free_floor(hall.grid, hall.solid, options);
    ASSERT_TRUE(floor);
    EXPECT_EQ(floor->start.x_m > 3.0, open_m < 5.0) << open_m;
  }
}

/// A hall of 6 x 6 m without one of its walls, and behind the one across from that a room of
/// 2 x 2 m.
TEST(FreeFloor, AHallWithoutAWallIsOutdoorsWhicheverItIs) {
  const std::vector<double> across_m{0.0, 0.5, 2.5, 4.5, 6.5, 7.0};
  for (const bool along_y : {false, true}) {
    for (const bool at_the_end : {false, true}) {
      const std::vector<double> along_m = at_the_end ? std::vector<double>{0.0, 0.5, 2.5, 3.0, 9.0}
                                                     : std::vector<double>{0.0, 6.0, 6.5, 8.5, 9.0};
      WalledRoom hall(along_y ? across_m : along_m, along_y ? along_m : across_m);
      for (int b = 0; b < 5; ++b) {
        for (int a = 0; a < 4; ++a) {
          const int from_room = at_the_end ? a : 3 - a;  // its wall, itself, a wall, the hall
          const bool wall = b == 0 || b == 4 || from_room == 0 || from_room == 2;
          hall.fill(along_y ? b : a, along_y ? a : b, 1, wall || (from_room == 1 && b != 2));
        }
      }
      FreeFloorOptions options = kNarrow;
      options.standing_m = {Eigen::Vector2d(0.0, 0.0),
                            along_y ? Eigen::Vector2d(7.0, 9.0) : Eigen::Vector2d(9.0, 7.0)};
      const auto floor = find_free_floor(hall.grid, hall.solid, options);
      ASSERT_TRUE(floor);
      EXPECT_NEAR(along_y ? floor->start.y_m : floor->start.x_m, at_the_end ? 1.5 : 7.5, 0.5)
          << along_y;
    }
  }
}

TEST(FreeFloor, OfTwoAreasAlikeIsTheFirst) {
  WalledRoom room({0.0, 0.5, 2.5, 3.0, 5.0, 5.5}, {0.0, 0.5, 2.5, 3.0});
  room.fill(2, 1, 1);
  const auto floor = find_free_floor(room.grid, room.solid, kNarrow);
  ASSERT_TRUE(floor);
  EXPECT_NEAR(floor->start.x_m, 1.5, 0.05);
}

TEST(FreeFloor, IsNoneWhereTheGridEndsAtIt) {
  FittedGrid grid;
  grid.lines_m = {std::vector<double>{0.0, 5.0}, {0.0, 5.0}, {0.0, 1.0, 1.7, 2.5}};
  const std::vector<std::uint8_t> air(grid.size(), 0);
  EXPECT_FALSE(find_free_floor(grid, air, kNarrow));
}

/// So many squares of 5 cm by so many, of which those that are drawn as blanks have a floor and are
/// free.
WalledRoom drawn_squares(const std::vector<std::string>& rows) {
  const auto lines = [](std::size_t count) {
    std::vector<double> lines_m;
    for (std::size_t i = 0; i <= count; ++i) lines_m.push_back(0.05 * static_cast<double>(i));
    return lines_m;
  };
  WalledRoom room(lines(rows[0].size()), lines(rows.size()));
  for (std::size_t y = 0; y < rows.size(); ++y) {
    for (std::size_t x = 0; x < rows[0].size(); ++x) {
      room.fill(static_cast<int>(x), static_cast<int>(y), 1, rows[y][x] != ' ');
    }
  }
  return room;
}

/// Each step of a way between squares, to every side, is one square long.
TEST(FreeFloor, GoesFromSquareToSquare) {
  const WalledRoom room = drawn_squares({"#########",  //
                                         "#### #  #",  //
                                         "####  # #",  //
                                         "#####   #",  //
                                         "##### ###",  //
                                         "#########"});
  const auto floor = find_free_floor(room.grid, room.solid, {.clearance_m = 0.0});
  ASSERT_TRUE(floor);
  EXPECT_NEAR(floor->area_m2, 10 * 0.0025, 1e-9);
}

/// All 4 by 3 squares are free, up to the edges of the grid.
TEST(FreeFloor, ReachesToTheEdgesOfTheGrid) {
  const WalledRoom room = drawn_squares({"    ", "    ", "    "});
  const auto floor = find_free_floor(room.grid, room.solid, kNarrow);
  ASSERT_TRUE(floor);
  EXPECT_NEAR(floor->area_m2, 12 * 0.0025, 1e-9);
}

/// Squares count by their middles: 81 by 41 of them, as where the walls end half a square on.
TEST(FreeFloor, IsOfSquaresWhoseMiddlesAreFree) {
  const WalledRoom room({-1.0, -0.48, 3.53, 4.05}, {2.0, 2.52, 4.53, 5.05});
  const auto floor = find_free_floor(room.grid, room.solid, kNarrow);
  ASSERT_TRUE(floor);
  EXPECT_NEAR(floor->area_m2, 57 * 17 * 0.0025, 1e-9);
  EXPECT_NEAR(floor->start.x_m, 1.525, 1e-9);
  EXPECT_NEAR(floor->start.y_m, 3.525, 1e-9);
}

/// A room of 41 by 41 squares with a niche of 10 in the middle of one of its walls.
TEST(FreeFloor, LooksWhereTheWayIsFreeForLongest) {
  const std::vector<double> niche_first_m{0.0, 0.5, 1.0, 3.05, 3.55};
  const std::vector<double> niche_last_m{0.0, 0.5, 2.55, 3.05, 3.55};
  const std::vector<double> across_m{0.0, 0.5, 1.5, 1.55, 2.55, 3.05};
  for (const bool along_y : {false, true}) {
    for (const bool first : {true, false}) {
      const auto& along_m = first ? niche_first_m : niche_last_m;
      WalledRoom room(along_y ? across_m : along_m, along_y ? along_m : across_m);
      const int niche = first ? 1 : 2;
      for (const int across : {1, 3}) {
        room.fill(along_y ? across : niche, along_y ? niche : across, 1);
      }
      const auto floor = find_free_floor(room.grid, room.solid, kNarrow);
      ASSERT_TRUE(floor);
      const double heading_rad =
          (along_y ? 0.5 : 0.0) * std::numbers::pi + (first ? std::numbers::pi : 0.0);
      EXPECT_NEAR(std::cos(floor->start.yaw_rad - heading_rad), 1.0, 1e-9) << along_y << first;
      EXPECT_LE(std::abs(floor->start.yaw_rad), std::numbers::pi + 1e-9);
    }
  }
}

/// Ground of 10 x 10 m, of which 4 x 4 m count as what stands there, outdoors for want of walls.
TEST(FreeFloor, OutdoorsBeginsWithinWhatStands) {
  const WalledRoom ground({0.0, 0.5, 9.5, 10.0}, {0.0, 0.5, 9.5, 10.0});
  FreeFloorOptions options = kNarrow;
  options.standing_m = {Eigen::Vector2d(1.5, 1.5), Eigen::Vector2d(5.5, 5.5)};
  const auto floor = find_free_floor(ground.grid, ground.solid, options);
  ASSERT_TRUE(floor);
  EXPECT_NEAR(floor->area_m2, 16.0, 0.5);
  EXPECT_LT(floor->start.x_m, 5.5);
  EXPECT_LT(floor->start.y_m, 5.5);
}

TEST(FreeFloor, WithoutAStartHasNoClearance) {
  const WalledRoom room({0.0, 0.5, 4.55, 5.05}, {0.0, 0.5, 2.55, 3.05});
  EXPECT_EQ(find_free_floor(room.grid, room.solid, {.clearance_m = 1.02})->clearance_m, 0.0);
}

/// 50 squares, and 100 beside them.
TEST(FreeFloor, IsTheLargerOfSmallAreasToo) {
  const WalledRoom room = drawn_squares(std::vector<std::string>(10, "     #          "));
  const auto floor = find_free_floor(room.grid, room.solid, {.clearance_m = 0.0});
  ASSERT_TRUE(floor);
  EXPECT_NEAR(floor->area_m2, 100 * 0.0025, 1e-9);
}

}  // namespace
}  // namespace vantage
