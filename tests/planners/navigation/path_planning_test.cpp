#include "vantage/planners/navigation/path_planning.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/planners/navigation/ascii_floor.hpp"
#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

/// Every cell the path passes is traversable.
void expect_clear(const PathField& field, const PlannedPath& path) {
  const auto& points = path.waypoints;
  for (std::size_t i = 1; i < points.size(); ++i) {
    walk_ray(field.map.frame(), {points[i - 1].x_m, points[i - 1].y_m, 0.5},
             {points[i].x_m, points[i].y_m, 0.5}, [&](std::size_t cell) {
               EXPECT_TRUE(field.traversable(cell)) << field.map.cell(cell).transpose();
               return true;
             });
  }
}

TEST(PlanPath, GoesStraightWhereNothingIsInTheWay) {
  const Drawing rows{
      "......G",  //
      ".......",  //
      ".......",  //
      "S......",  //
  };
  const PathField field = make_path_field(floor_of(rows), place_of(rows, 'S', 1.0), point_robot());
  const Pose2 goal = place_of(rows, 'G', 0.7);
  const PlannedPath path = plan_path(field, goal);
  EXPECT_TRUE(path.reaches_goal);
  ASSERT_EQ(path.waypoints.size(), 2U);
  EXPECT_NEAR(path.length_m, std::hypot(6.0, 3.0), 1e-12);
  EXPECT_DOUBLE_EQ(path_length_m(field, goal), path.length_m);
  EXPECT_DOUBLE_EQ(path.waypoints.front().yaw_rad, 1.0);
  EXPECT_DOUBLE_EQ(path.end.yaw_rad, 0.7);
  EXPECT_DOUBLE_EQ(path.end.x_m, goal.x_m);
}

TEST(PlanPath, EndsInTheGoalItselfNotInItsCell) {
  const FloorMap map = floor_of({"......", "......", "......"});
  const PathField field = make_path_field(map, {0.6, 1.4, 0.0}, point_robot());
  const PlannedPath path = plan_path(field, {5.3, 1.8, 0.0});
  EXPECT_NEAR(path.length_m, std::hypot(4.7, 0.4), 1e-12);
}

TEST(PlanPath, GoesThroughTheDoor) {
  const Drawing rows{
      "....#....",  //
      "....#....",  //
      "S...#...G",  //
      "....#....",  //
      ".........",  //
      "....#....",  //
  };
  const PathField field = make_path_field(floor_of(rows), place_of(rows, 'S'), point_robot());
  const PlannedPath path = plan_path(field, place_of(rows, 'G'));
  EXPECT_TRUE(path.reaches_goal);
  expect_clear(field, path);
  // Through the door's cell, entered and left by way of its neighbours: corners are not cut.
  EXPECT_GE(path.length_m, 2.0 * std::hypot(4.0, 2.0));
  EXPECT_LE(path.length_m, 2.0 * std::hypot(3.0, 2.0) + 2.0 + 1e-9);
  for (std::size_t i = 1; i + 1 < path.waypoints.size(); ++i) {
    const Pose2& from = path.waypoints[i - 1];
    const Pose2& to = path.waypoints[i];
    EXPECT_NEAR(to.yaw_rad, std::atan2(to.y_m - from.y_m, to.x_m - from.x_m), 1e-12);
  }
}

TEST(PlanPath, LeadsToTheNearestPlaceOfAnUnreachableRoom) {
  const Drawing rows{
      "....#....",  //
      "....#....",  //
      "S...#..G.",  //
      "....#....",  //
  };
  const PathField field = make_path_field(floor_of(rows), place_of(rows, 'S'), point_robot());
  const Pose2 goal = place_of(rows, 'G', 0.4);
  const PlannedPath path = plan_path(field, goal, Eigen::Vector2d(3.5, 9.5));
  EXPECT_FALSE(path.reaches_goal);
  EXPECT_DOUBLE_EQ(path.end.x_m, 3.5);
  EXPECT_DOUBLE_EQ(path.end.y_m, 1.5);
  EXPECT_NEAR(path.end.yaw_rad, std::numbers::pi / 2.0, 1e-12);
  EXPECT_NEAR(path.length_m, 3.0, 1e-12);
  EXPECT_EQ(path_length_m(field, goal), std::numeric_limits<double>::infinity());
  EXPECT_DOUBLE_EQ(plan_path(field, goal).end.yaw_rad, 0.4);
}

TEST(PlanPath, GetsOutOfCollisionFirst) {
  const Drawing rows{
      "#########",  //
      "#S......#",  //
      "#.......#",  //
      "#......G#",  //
      "#.......#",  //
      "#.......#",  //
      "#########",  //
  };
  NavigationOptions options = point_robot();
  options.footprint_radius_m = 2.0;
  options.escape_radius_m = 2.0;
  const PathField field = make_path_field(floor_of(rows), place_of(rows, 'S'), options);
  const PlannedPath path = plan_path(field, {6.5, 3.5, 0.0});
  EXPECT_TRUE(path.reaches_goal);
  ASSERT_GE(path.waypoints.size(), 3U);
  EXPECT_DOUBLE_EQ(path.waypoints[0].x_m, 1.5);
  EXPECT_DOUBLE_EQ(path.waypoints[1].x_m, 2.5);
  EXPECT_DOUBLE_EQ(path.waypoints[1].y_m, 4.5);
}

TEST(WayBlocked, ByWhatWasNotThereWhenItWasPlanned) {
  const Drawing rows{
      ".........",  //
      ".........",  //
      "S.......G",  //
      ".........",  //
      ".........",  //
  };
  NavigationOptions options = point_robot();
  options.footprint_radius_m = 1.2;
  options.watch_m = 4.0;
  FloorMap map = floor_of(rows);
  const std::vector<Pose2> way{place_of(rows, 'S'), place_of(rows, 'G')};
  const auto blocked_by = [&](int x, int y, const Pose2& base) {
    FloorMap changed = map;
    changed.log_odds[map.index({x, y})] = 3.0F;
    return is_way_blocked(changed, way, base, options);
  };
  EXPECT_FALSE(is_way_blocked(map, way, way.front(), options));
  EXPECT_TRUE(blocked_by(4, 2, way.front()));
  EXPECT_TRUE(blocked_by(4, 1, way.front())) << "the footprint would touch it";
  EXPECT_FALSE(blocked_by(4, 0, way.front())) << "beside the way";
  EXPECT_FALSE(blocked_by(7, 2, way.front())) << "too far ahead to matter yet";
  EXPECT_TRUE(blocked_by(7, 2, {4.5, 2.5, 0.0})) << "until the robot has come nearer";
  EXPECT_FALSE(blocked_by(3, 2, {4.5, 2.5, 0.0})) << "the robot is leaving it behind";
  options.watch_m = 0.0;
  EXPECT_FALSE(blocked_by(4, 2, way.front()));
  EXPECT_FALSE(blocked_by(4, 1, {4.5, 4.0, 0.0})) << "never, though it is beside the way";
}

/// It must be able to go out of a tight place: what it is no nearer to on the way does not stop it,
/// give or take half a cell.
TEST(WayBlocked, OnlyByWhatComesNearerThanItIsNow) {
  const FloorMap map = floor_of(Drawing(5, "........."));
  NavigationOptions options = point_robot();
  options.footprint_radius_m = 3.0;
  options.watch_m = 4.0;
  const Pose2 base{0.5, 2.5, 0.0};
  const std::vector<Pose2> way{base, {8.5, 2.5, 0.0}};
  const auto blocked_by = [&](int x, int y) {
    FloorMap changed = map;
    changed.log_odds[map.index({x, y})] = 3.0F;
    return is_way_blocked(changed, way, base, options);
  };
  EXPECT_FALSE(blocked_by(1, 3)) << "0.4 m nearer than now";
  EXPECT_TRUE(blocked_by(2, 4)) << "0.8 m nearer";
  EXPECT_FALSE(blocked_by(0, 2)) << "beneath it";
}

class WatchedWay : public testing::Test {
 protected:
  WatchedWay() { options_.footprint_radius_m = 1.6; }
  /// By something new in that cell; the robot is where the way begins.
  [[nodiscard]] bool blocked_by(int x, int y, const std::vector<Pose2>& way) const {
    FloorMap changed = map_;
    changed.log_odds[map_.index({x, y})] = 3.0F;
    return is_way_blocked(changed, way, way.front(), options_);
  }

  FloorMap map_ = floor_of(Drawing(5, "........."));
  NavigationOptions options_ = point_robot();
};

/// Over points 0.75 m apart, of which the last one is watched if it is just so far.
TEST_F(WatchedWay, IsAsLongAsItIsSaidToBe) {
  const std::vector<Pose2> way{{0.5, 2.5, 0.0}, {3.5, 2.5, 0.0}};
  options_.watch_m = 1.5;
  EXPECT_TRUE(blocked_by(3, 2, way)) << "1.5 m from its third point";
  options_.watch_m = 1.4;
  EXPECT_FALSE(blocked_by(3, 2, way));
}

TEST_F(WatchedWay, HasItsEndHoweverShortItIs) {
  EXPECT_TRUE(blocked_by(5, 2, {{4.1, 2.5, 0.0}, {4.9, 2.5, 0.0}}));
  EXPECT_FALSE(blocked_by(5, 2, {{4.1, 2.5, 0.0}, {4.1, 2.5, 1.0}})) << "it turns in place";
}

TEST_F(WatchedWay, EndsWithTheMapOnEverySide) {
  options_.watch_m = 4.0;
  const Pose2 middle{4.5, 2.5, 0.0};
  EXPECT_TRUE(blocked_by(0, 2, {middle, {0.5, 2.5, 0.0}}));
  EXPECT_TRUE(blocked_by(8, 2, {middle, {8.5, 2.5, 0.0}}));
  EXPECT_TRUE(blocked_by(4, 0, {middle, {4.5, 0.5, 0.0}}));
  EXPECT_TRUE(blocked_by(4, 4, {middle, {4.5, 4.5, 0.0}}));
  const std::vector<Pose2> way_out{middle, {8.5, 4.5, 0.0}};
  EXPECT_FALSE(is_way_blocked(map_, way_out, middle, options_)) << "nothing is beyond it";
}

TEST(PlanPath, StaysWhereItIsIfThereIsNoWay) {
  const FloorMap map = floor_of({"?????", "??.??", "?????"});
  NavigationOptions options = point_robot();
  options.footprint_radius_m = 3.0;
  const PathField field = make_path_field(map, {2.5, 1.5, 0.3}, options);
  const PlannedPath path = plan_path(field, {4.5, 1.5, 0.0});
  EXPECT_FALSE(path.reaches_goal);
  EXPECT_EQ(path.waypoints.size(), 1U);
  EXPECT_EQ(path.length_m, 0.0);
  EXPECT_EQ(path.end.yaw_rad, 0.3);
}

TEST(PlanPath, TakesADetourForClearance) {
  const Drawing rows{
      "...............",  //
      "...............",  //
      "...............",  //
      "...............",  //
      "...............",  //
      "S.............G",  //
      "####.#####.####",  //
  };
  const FloorMap map = floor_of(rows);
  NavigationOptions options = point_robot();
  options.comfort_m = 2.0;
  const auto highest_m = [&](double clearance_weight) {
    options.clearance_weight = clearance_weight;
    const PathField field = make_path_field(map, place_of(rows, 'S'), options);
    const PlannedPath path = plan_path(field, place_of(rows, 'G'));
    expect_clear(field, path);
    return std::ranges::max(path.waypoints, {}, &Pose2::y_m).y_m;
  };
  EXPECT_DOUBLE_EQ(highest_m(0.0), 1.5);
  EXPECT_GE(highest_m(2.0), 2.5);
}

/// A metre costs 2.5 in the second column and 1 from the third on: two of them straight on cost 5.
/// Either half of the detour is sampled at four places, one of them in the second column.
TEST(PullStraight, LeavesADetourThatCostsLess) {
  NavigationOptions options;
  options.footprint_radius_m = 0.5;
  options.margin_m = 0.5;
  options.clearance_weight = 3.0;
  options.comfort_m = 2.0;
  const FloorMap map = floor_of(Drawing(13, "........."));
  const PathField field = make_path_field(map, {1.5, 5.5, 0.0}, options);
  const auto points_left = [&](double aside_m) {
    const std::vector<Eigen::Vector2d> points{{1.5, 5.5}, {1.5 + aside_m, 6.5}, {1.5, 7.5}};
    return pull_straight(field, points).size();
  };
  EXPECT_EQ(points_left(1.4), 3U) << "4.731";
  EXPECT_EQ(points_left(1.5), 2U) << "4.958: hardly less, of costs that are sampled";
}

TEST(PlanPath, IsClearOnRandomMaps) {
  Rng rng(9);
  NavigationOptions options = point_robot();
  options.clearance_weight = 1.0;
  int reached = 0;
  for (int draw = 0; draw < 60; ++draw) {
    FloorMap map(Eigen::Vector2d::Zero(), 1.0, 25, 20);
    for (float& cell : map.log_odds) cell = rng.uniform() < 0.15 ? 3.0F : -3.0F;
    map.log_odds[map.index({0, 0})] = -3.0F;
    const PathField field = make_path_field(map, {0.4, 0.6, 0.0}, options);
    const Pose2 goal{rng.uniform(0.0, 25.0), rng.uniform(0.0, 20.0), 0.0};
    const PlannedPath path = plan_path(field, goal);
    expect_clear(field, path);
    EXPECT_GE(path.length_m + 1e-9, std::hypot(path.end.x_m - 0.4, path.end.y_m - 0.6));
    reached += path.reaches_goal ? 1 : 0;
  }
  EXPECT_GT(reached, 20);
}

TEST_F(WatchedWay, IsFreeWhereTheFootprintJustTouchesSomething) {
  const std::vector<Pose2> way{{0.5, 2.5, 0.0}, {3.5, 2.5, 0.0}};
  options_.watch_m = 4.0;
  options_.footprint_radius_m = 1.0;
  EXPECT_FALSE(blocked_by(3, 1, way)) << "a metre beside its end";
  options_.footprint_radius_m = 1.001;
  EXPECT_TRUE(blocked_by(3, 1, way));
}

/// A metre costs 2.5 in the second column and 1 from the third on. Twice in a cell and once more:
/// of four places of either half of the detour one is in the second column.
TEST(PullStraight, LooksAtTheCostTwiceInACell) {
  NavigationOptions options;
  options.footprint_radius_m = 0.5;
  options.margin_m = 0.5;
  options.clearance_weight = 3.0;
  options.comfort_m = 2.0;
  const PathField field =
      make_path_field(floor_of(Drawing(13, ".........")), {1.5, 5.5, 0.0}, options);
  EXPECT_EQ(pull_straight(field, {{1.5, 5.5}, {2.95, 6.5}, {1.5, 7.5}}).size(), 3U)
      << "3.523 m at 1.375, against 2 m at 2.5";
}

TEST(PlanPath, LeadsToAGoalInTheCellThatItStandsIn) {
  const FloorMap map = floor_of({"...", "...", "..."});
  const PathField field = make_path_field(map, {1.2, 1.3, 0.4}, point_robot());
  const PlannedPath path = plan_path(field, {1.8, 1.5, 0.7});
  EXPECT_TRUE(path.reaches_goal);
  ASSERT_EQ(path.waypoints.size(), 2U);
  EXPECT_EQ(path.waypoints.front().yaw_rad, 0.4);
  EXPECT_EQ(path.end.x_m, 1.8);
  EXPECT_EQ(path.end.y_m, 1.5);
  EXPECT_EQ(path.end.yaw_rad, 0.7);
  EXPECT_NEAR(path.length_m, std::hypot(0.6, 0.2), 1e-12);
}

// It is looked at every 0.75 m, from 0.5 m on.
TEST_F(WatchedWay, BeginsAtTheFirstOfTwoPlacesAsNear) {
  const std::vector<Pose2> way{{0.5, 2.5, 0.0}, {3.5, 2.5, 0.0}};
  options_.footprint_radius_m = 1.0;
  options_.watch_m = 1.0;
  FloorMap map = map_;
  map.log_odds[map.index({3, 2})] = 3.0F;
  EXPECT_FALSE(is_way_blocked(map, way, {1.625, 2.5, 0.0}, options_)) << "as far as 2 m";
  EXPECT_TRUE(is_way_blocked(map, way, {1.75, 2.5, 0.0}, options_)) << "as far as 2.75 m";
}

}  // namespace
}  // namespace vantage
