#include "vantage/planners/views/space_beyond.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace vantage {
namespace {

/// Two rooms of 2 x 2 m side by side along x, in cells of 0.1 m; the one on the left is seen, the
/// other not, and a wall of two columns between them is seen on its left.
struct Rooms {
  OccupancyGrid grid{make_grid_frame({2.0, 1.0, 0.5}, {4.0, 2.0, 1.0}, {40, 20, 10})};

  Rooms() {
    fill({0, 0}, {20, 20}, -3.0F);
    fill({19, 0}, {20, 20}, 3.0F);
  }
  void fill(const Eigen::Array2i& low, const Eigen::Array2i& high, float log_odds) {
    for (int z = 0; z < 10; ++z) {
      for (int y = low.y(); y < high.y(); ++y) {
        for (int x = low.x(); x < high.x(); ++x)
          grid.log_odds[grid.frame.index({x, y, z})] = log_odds;
      }
    }
  }
  /// From y = 0.7 to 1.3 m.
  void open_door() { fill({19, 7}, {20, 13}, -3.0F); }
  [[nodiscard]] int columns_of(const SpaceBeyond& space, std::int32_t place) const {
    return static_cast<int>(std::ranges::count(space.place_of, place));
  }
};

TEST(ColumnStates, TellWallsFromWhatIsUnknown) {
  Rooms rooms;
  rooms.fill({5, 5}, {6, 6}, 0.0F);                               // one that nothing was seen of
  rooms.grid.log_odds[rooms.grid.frame.index({3, 3, 0})] = 3.0F;  // something low
  const auto states = column_states(rooms.grid);
  const auto at = [&](int x, int y) {
    return states[40 * static_cast<std::size_t>(y) + static_cast<std::size_t>(x)];
  };
  EXPECT_EQ(at(3, 3), ColumnState::open);
  EXPECT_EQ(at(5, 5), ColumnState::unknown);
  EXPECT_EQ(at(19, 3), ColumnState::wall);
  EXPECT_EQ(at(30, 3), ColumnState::unknown);
}

TEST(SpaceBeyond, NothingLeadsThroughAWall) {
  const Rooms rooms;
  const std::vector<Eigen::Vector2d> places{{1.0, 1.0}};
  EXPECT_EQ(rooms.columns_of(space_beyond(rooms.grid, places, 100.0), 0), 0);
}

TEST(SpaceBeyond, AllOfARoomIsBehindItsDoor) {
  Rooms rooms;
  rooms.open_door();
  const std::vector<Eigen::Vector2d> places{{1.0, 1.0}};
  // Of 20 x 20 columns those beside what was seen of the wall are closed: 7 + 7 of its 20 rows.
  EXPECT_EQ(rooms.columns_of(space_beyond(rooms.grid, places, 100.0), 0), 400 - 14);
}

TEST(SpaceBeyond, BelongsToTheNearerPlace) {
  Rooms rooms;
  rooms.open_door();
  // Both places see the door; the second stands in it.
  const std::vector<Eigen::Vector2d> places{{0.5, 1.0}, {1.95, 1.05}};
  const SpaceBeyond space = space_beyond(rooms.grid, places, 100.0);
  EXPECT_EQ(rooms.columns_of(space, 0), 0);
  EXPECT_EQ(rooms.columns_of(space, 1), 400 - 14);
}

TEST(SpaceBeyond, EndsWhereTheWayIsTooLong) {
  Rooms rooms;
  rooms.open_door();
  const std::vector<Eigen::Vector2d> places{{1.95, 1.05}};
  // Columns of the other room up to 0.3 m away along x and y: 6 rows of the door at most.
  const SpaceBeyond space = space_beyond(rooms.grid, places, 0.31);
  EXPECT_EQ(rooms.columns_of(space, 0), 5 + 3 + 1);
}

TEST(SpaceBeyond, ExpectsOfTheUnknownWhatWasSeenOfTheOpen) {
  Rooms rooms;
  // Three cells in ten of half of the open columns stay unseen, as below tables.
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 19; ++x) {
      for (int z = 0; z < 10; z += 4) rooms.grid.log_odds[rooms.grid.frame.index({x, y, z})] = 0.0F;
    }
  }
  const std::vector<Eigen::Vector2d> places{{1.0, 1.0}};
  EXPECT_NEAR(space_beyond(rooms.grid, places, 1.0).seen_share, 0.85, 1e-9);
}

TEST(SpaceBeyond, APlaceOutsideTheGridLeadsNowhere) {
  Rooms rooms;
  const std::vector<Eigen::Vector2d> places{{-1.0, 1.0}, {9.0, 1.0}};
  const SpaceBeyond space = space_beyond(rooms.grid, places, 100.0);
  EXPECT_EQ(rooms.columns_of(space, SpaceBeyond::kNone), 800);
}

/// Ten cells high: three occupied make a wall, whatever the rest is, and five unobserved the
/// unknown.
TEST(ColumnStates, GoByThreeInTenAndByHalf) {
  OccupancyGrid grid(make_grid_frame({0.5, 0.5, 0.5}, {1.0, 1.0, 1.0}, {3, 2, 10}));
  const auto set = [&](int x, int y, int occupied, int unobserved) {
    for (int z = 0; z < 10; ++z) {
      grid.log_odds[grid.frame.index({x, y, z})] =
          z < occupied ? 3.0F : (z < occupied + unobserved ? 0.0F : -3.0F);
    }
  };
  set(0, 0, 3, 0);
  set(1, 0, 2, 0);
  set(2, 0, 3, 7);
  set(0, 1, 0, 5);
  set(1, 1, 0, 4);
  set(2, 1, 2, 8);
  EXPECT_EQ(column_states(grid),
            (std::vector{ColumnState::wall, ColumnState::open, ColumnState::wall,
                         ColumnState::unknown, ColumnState::open, ColumnState::unknown}));
}

/// Nothing is known of columns of 0.125 x 0.25 m; the way is along x and y.
TEST(SpaceBeyond, MeasuresTheWayAlongEitherAxis) {
  const OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.5}, {0.875, 1.25, 1.0}, {7, 5, 2}));
  const std::vector<Eigen::Vector2d> places{{0.0, 0.0}};
  const SpaceBeyond space = space_beyond(grid, places, 0.25);
  EXPECT_EQ(std::ranges::count(space.place_of, 0), 1 + 4 + 2) << "just at the reach, too";
  EXPECT_EQ(space.place_of[7 * 2 + 1], 0);
  EXPECT_EQ(space.place_of[7 * 1 + 3], 0);
  EXPECT_EQ(space.place_of[7 * 1 + 2], SpaceBeyond::kNone);
  EXPECT_EQ(space.seen_share, 1.0) << "no column is open";
  EXPECT_EQ(std::ranges::count(space_beyond(grid, places, 100.0).place_of, 0), 35);
}

/// Columns of 1 x 0.25 m. The first place is beside a column that the second one is nearer to, and
/// is heard first.
TEST(SpaceBeyond, GoesOnBehindAColumnThatAShorterWayWasFoundTo) {
  const OccupancyGrid grid(make_grid_frame({2.0, 0.25, 0.5}, {4.0, 0.5, 1.0}, {4, 2, 2}));
  const std::vector<Eigen::Vector2d> places{{0.5, 0.375}, {1.5, 0.125}};
  EXPECT_EQ(space_beyond(grid, places, 100.0).place_of, (std::vector<std::int32_t>{0, 1, 1, 1,  //
                                                                                   0, 1, 1, 1}));
}

/// Walls stand in the first and in the last column, nothing is known of the others.
TEST(SpaceBeyond, NothingLeadsToColumnsBesideAWall) {
  OccupancyGrid grid(make_grid_frame({2.5, 2.0, 1.0}, {5.0, 4.0, 2.0}, {5, 4, 2}));
  for (const int z : {0, 1}) {
    grid.log_odds[grid.frame.index({0, 0, z})] = 3.0F;
    grid.log_odds[grid.frame.index({4, 3, z})] = 3.0F;
  }
  const std::vector<Eigen::Vector2d> places{{2.5, 1.5}};
  std::string drawn;
  for (const std::int32_t place : space_beyond(grid, places, 100.0).place_of) {
    drawn += place == SpaceBeyond::kNone ? '-' : '0';
  }
  EXPECT_EQ(drawn,
            "--000"
            "-0000"
            "0000-"
            "000--");
}

TEST(SpaceBeyond, OfEquallyNearPlacesBelongsToTheFirst) {
  const OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.5}, {5.0, 1.0, 1.0}, {5, 1, 2}));
  for (const double first_m : {-2.0, 2.0}) {
    const std::vector<Eigen::Vector2d> places{{first_m, 0.0}, {-first_m, 0.0}};
    const auto place_of = space_beyond(grid, places, 9.0).place_of;
    EXPECT_EQ(place_of[2], 0);
    EXPECT_EQ(place_of[first_m < 0.0 ? 1 : 3], 0);
    EXPECT_EQ(place_of[first_m < 0.0 ? 3 : 1], 1);
  }
}

}  // namespace
}  // namespace vantage
