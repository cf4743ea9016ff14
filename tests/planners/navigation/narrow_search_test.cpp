// What ways through passages cost, where the answer is known.
#include "vantage/planners/navigation/narrow_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "tests/planners/navigation/drawn_rooms.hpp"
#include "vantage/core/cancellation/stop_poll.hpp"
#include "vantage/planners/navigation/narrow_poses.hpp"
#include "vantage/planners/navigation/path_planning.hpp"
#include "vantage/planners/travel/path_lengths.hpp"

namespace vantage {
namespace {

constexpr double kHeadingStep_rad = 2.0 * std::numbers::pi / 48.0;

/// The middle of a robot of 0.9 x 0.5 m in a closed corridor of 0.7 m: it goes along it, at no more
/// than one heading beside its own. It stands in the middle of a cell.
class Corridor : public testing::Test {
 protected:
  [[nodiscard]] PathField field(const RobotOutline& robot, const PassageOptions& passages) const {
    NavigationOptions options;
    options.footprint_radius_m = std::hypot(0.45, 0.25);
    options.clearance_weight = 1.5;
    return make_path_field(rooms_.floor, start_, options, rooms_.space(robot, passages));
  }
  /// Cost of the pose of that heading in a cell; infinite if there is none.
  static double cost_at(const PathField& field, const Eigen::Array2i& cell, double yaw_rad) {
    for (const NarrowPose& node : field.narrow) {
      if (node.cell == field.map.index(cell) && std::abs(node.pose.yaw_rad - yaw_rad) < 1e-6) {
        return node.cost;
      }
    }
    return std::numeric_limits<double>::infinity();
  }

  DrawnRooms rooms_{4.0, 2.0, {wall(0.0, 0.0, 4.0, 0.67), wall(0.0, 1.38, 4.0, 2.0)}};
  Pose2 start_{2.025, 1.025, 0.0};
  Eigen::Array2i start_cell_{40, 20};
  RobotOutline robot_{.outline = rectangle(0.9, 0.5), .speed_m_s = 0.6};
};

/// At a third of the speed a metre counts for three, and as one that touches the margin all along.
TEST_F(Corridor, AStepCostsItsTimeAndATurnThatOfTheOutermostPoint) {
  const PathField narrow = field(robot_, {.speed_m_s = 0.2});
  EXPECT_EQ(cost_at(narrow, start_cell_, 0.0), 0.0);
  EXPECT_EQ(narrow.cost[narrow.map.index(start_cell_)], 0.0) << "it is a nook";
  EXPECT_NEAR(cost_at(narrow, start_cell_ + Eigen::Array2i(10, 0), 0.0), 0.5 * 3.0 * 2.5, 1e-9);
  EXPECT_NEAR(cost_at(narrow, start_cell_ - Eigen::Array2i(4, 0), 0.0), 0.2 * 3.0 * 2.5, 1e-9);
  const double turn_m = kHeadingStep_rad * std::hypot(0.45, 0.25);
  for (const double side : {-1.0, 1.0}) {
    EXPECT_NEAR(cost_at(narrow, start_cell_, side * kHeadingStep_rad), turn_m * 3.0 * 2.5, 1e-9);
    EXPECT_TRUE(std::isinf(cost_at(narrow, start_cell_, 2.0 * side * kHeadingStep_rad)));
  }
  const PathField as_fast = field(robot_, {.speed_m_s = 0.9});
  EXPECT_NEAR(cost_at(as_fast, start_cell_ + Eigen::Array2i(10, 0), 0.0), 0.5 * 2.5, 1e-9)
      << "it never counts for less than a metre";
}

TEST_F(Corridor, APathIsAsLongAsItTakesTheTimeOf) {
  const PathField narrow = field(robot_, {.speed_m_s = 0.2});
  const PlannedPath path = plan_path(narrow, {2.525, 1.025, 2.0});
  ASSERT_TRUE(path.reaches_goal);
  EXPECT_NEAR(path.length_m, 3.0 * 0.5, 1e-6);
  EXPECT_NEAR(path.end.yaw_rad, 0.0, 1e-9) << "it cannot turn there";
  EXPECT_NEAR(path.end.x_m, 2.525, 1e-9);
}

/// Steps that lead more than about half a right angle off its heading are none.
TEST_F(Corridor, WhatGoesAlongItsHeadingStaysInItsRow) {
  robot_.goes_sideways = false;
  const PathField narrow = field(robot_, {});
  EXPECT_FALSE(std::isinf(cost_at(narrow, start_cell_ + Eigen::Array2i(10, 0), 0.0)));
  EXPECT_TRUE(std::isinf(cost_at(narrow, start_cell_ - Eigen::Array2i(1, 0), 0.0))) << "backwards";
  for (const NarrowPose& node : narrow.narrow) {
    if (std::isinf(node.cost)) continue;
    EXPECT_EQ(narrow.map.cell(node.cell).y(), start_cell_.y());
  }
  EXPECT_FALSE(narrow.reachable(Eigen::Vector2d(2.525, 1.025))) << "nor could it turn round there";
}

/// Beside the row of the start there is room for its middle, at its heading, in one row on either
/// side.
TEST_F(Corridor, AStepAsideCostsItsTimeToo) {
  const PathField narrow = field(robot_, {.speed_m_s = 0.2});
  for (const int side : {-1, 1}) {
    EXPECT_NEAR(cost_at(narrow, start_cell_ + Eigen::Array2i(0, side), 0.0), 0.05 * 3.0 * 2.5,
                1e-9);
    EXPECT_NEAR(cost_at(narrow, start_cell_ + Eigen::Array2i(1, side), 0.0),
                0.05 * std::sqrt(2.0) * 3.0 * 2.5, 1e-9);
  }
}

TEST_F(Corridor, ANearlySquareRobotFacesWhereItGoes) {
  rooms_ = rooms_with_door(0.64);
  start_ = {1.25, 1.5, 0.0};
  const auto off_rad = [&](const RobotOutline& robot) {
    return farthest_off_rad(field(robot, {}));
  };
  EXPECT_LE(off_rad({.outline = rectangle(0.5, 0.5)}), 0.8 + 1e-9);
  EXPECT_LE(off_rad({.outline = rectangle(0.5, 0.47)}), 0.8 + 1e-9) << "1.5 cm a side";
  EXPECT_LE(off_rad({.outline = rectangle(0.47, 0.5)}), 0.8 + 1e-9);
  EXPECT_GT(off_rad({.outline = rectangle(0.5, 0.44)}), 3.0) << "3 cm a side: backwards, too";
  const FloorOutline ahead{{-0.2, -0.25}, {0.3, -0.25}, {0.3, 0.25}, {-0.2, 0.25}};
  EXPECT_GT(off_rad({.outline = ahead}), 3.0) << "its middle is not";
  EXPECT_LE(off_rad({.outline = rectangle(0.9, 0.5), .goes_sideways = false}), 0.48 + 1e-9);
  // Of headings 7.5 degrees apart: 45 degrees off is the last, 22.5 if it cannot go sideways.
  EXPECT_NEAR(off_rad({.outline = rectangle(0.5, 0.5)}), std::numbers::pi / 4.0, 1e-9);
  EXPECT_NEAR(off_rad({.outline = rectangle(0.9, 0.5), .goes_sideways = false}),
              std::numbers::pi / 8.0, 1e-9);
}

TEST_F(Corridor, ANearlySquareRobotBacksWhereAheadIsNoWayOut) {
  const RobotOutline square{.outline = rectangle(0.6, 0.6)};
  EXPECT_GT(farthest_off_rad(field(square, {})), 3.0) << "closed at both ends";
  EXPECT_NEAR(cost_at(field(square, {}), start_cell_ - Eigen::Array2i(1, 0), 0.0), 0.05 * 3.0 * 2.5,
              1e-9)
      << "from where it stands, too";
  rooms_ = DrawnRooms(5.0, 2.0, {wall(0.0, 0.0, 2.8, 0.67), wall(0.0, 1.38, 2.8, 2.0)});
  EXPECT_LE(farthest_off_rad(field(square, {})), 0.8 + 1e-9) << "open ahead";
  EXPECT_GT(farthest_off_rad(field(square, {.least_area_m2 = 1.3})), 3.0) << "no place to go to";
  start_.yaw_rad = std::numbers::pi;
  EXPECT_GT(farthest_off_rad(field(square, {})), 3.0) << "open behind";
}

/// In one that is smaller, its way out keeps its heading in mind.
TEST_F(Corridor, APlaceIsOpenFromItsLeastAreaOn) {
  rooms_ = DrawnRooms(5.0, 2.0, {wall(0.0, 0.0, 2.8, 0.67), wall(0.0, 1.38, 2.8, 2.0)});
  start_ = {3.9, 1.0, 0.0};
  const auto of_cells = [&](double least) {
    return field({.outline = rectangle(0.6, 0.6)}, {.least_area_m2 = least * 0.05 * 0.05});
  };
  const auto keeps_heading = [](const PathField& field) {
    return std::ranges::any_of(field.narrow, [](const NarrowPose& node) { return node.cost == 0; });
  };
  const PathField any = of_cells(0.0);
  double cells = 0.0;
  for (std::size_t cell = 0; cell < any.map.size(); ++cell) cells += any.traversable(cell) ? 1 : 0;
  ASSERT_GT(cells, 100.0);
  const PathField large_enough = of_cells(cells - 0.5);
  EXPECT_TRUE(large_enough.reaches_open_place());
  EXPECT_FALSE(keeps_heading(large_enough));
  const PathField too_small = of_cells(cells + 0.5);
  EXPECT_FALSE(too_small.reaches_open_place());
  EXPECT_TRUE(keeps_heading(too_small));
}

/// Of a robot of 4 x 2 cm, whose passages have a third of its speed.
PathField small_robots_field(const DrawnRooms& rooms, const Pose2& start,
                             double preferred_margin_m = 0.0) {
  const FloorOutline outline = rectangle(0.04, 0.02);
  NavigationOptions options;
  options.footprint_radius_m = circumscribed_radius_m(outline);
  options.margin_m = 0.005;
  const auto space =
      rooms.space({.outline = outline, .speed_m_s = 0.6}, {.margin_m = 0.001,
                                                           .preferred_margin_m = preferred_margin_m,
                                                           .speed_m_s = 0.2,
                                                           .least_area_m2 = 0.0});
  return make_path_field(rooms.floor, start, options, space);
}

/// A row of eight cells of 5 cm: the first is open, the next four are narrow, where a metre counts
/// for three.
TEST(NarrowSearch, BeginsAndEndsInTheFirstCellOfAMap) {
  const DrawnRooms rooms(0.4, 0.05, {wall(0.05, 0.04, 0.25, 0.05)});
  const Pose2 first{0.025, 0.025, 0.0};
  const Pose2 last{0.375, 0.025, 0.0};
  const double length_m = 5.0 * 0.05 * 3.0 + 2.0 * 0.05;
  const PathField there = small_robots_field(rooms, first);
  EXPECT_NEAR(path_length_m(there, last), length_m, 1e-6);
  const PathField back = small_robots_field(rooms, last);
  EXPECT_NEAR(path_length_m(back, first), length_m, 1e-6);
  const std::vector<Eigen::Vector2d> places{position(first), position(last)};
  EXPECT_NEAR(path_lengths_m(there, places, 1)(0, 1), length_m, 1e-5);
}

TEST_F(Corridor, WaysBetweenNooksAreThoseOfTheirPoses) {
  const PathField narrow = field(robot_, {.speed_m_s = 0.2});
  const std::vector<Eigen::Vector2d> places{{2.025, 1.025}, {2.525, 1.025}, {1.825, 1.025}};
  const Eigen::MatrixXd lengths_m = path_lengths_m(narrow, places, 1);
  EXPECT_NEAR(lengths_m(0, 1), 3.0 * 0.5, 1e-5);
  EXPECT_NEAR(lengths_m(0, 2), 3.0 * 0.2, 1e-5);
  EXPECT_NEAR(lengths_m(1, 2), 3.0 * 0.7, 1e-5);
}

TEST_F(Corridor, WhatIsRoundGoesToANookThoughAlongItsHeadingAlone) {
  FloorOutline round;
  for (int i = 0; i < 16; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / 16.0;
    round.emplace_back(0.33 * std::cos(angle_rad), 0.33 * std::sin(angle_rad));
  }
  const PathField narrow = field({.outline = round, .goes_sideways = false},
                                 {.preferred_margin_m = 0.02, .least_area_m2 = 0.1});
  EXPECT_TRUE(narrow.reachable(Eigen::Vector2d(2.525, 1.025)));
  EXPECT_TRUE(narrow.reachable(Eigen::Vector2d(1.525, 1.025))) << "it can turn round";
}

/// Walls leave it 11 cm on either side.
TEST_F(Corridor, ANookIsGoneToWhereItKeepsThePreferredMargin) {
  for (const double preferred_m : {0.10, 0.12}) {
    const PathField narrow = field(robot_, {.preferred_margin_m = preferred_m});
    EXPECT_FALSE(std::isinf(cost_at(narrow, start_cell_ + Eigen::Array2i(10, 0), 0.0)));
    EXPECT_EQ(narrow.reachable(Eigen::Vector2d(2.525, 1.025)), preferred_m < 0.11);
  }
}

TEST_F(Corridor, WhereTheMarginDoesNotFitATightOneIsKept) {
  rooms_ = DrawnRooms(6.0, 2.0, {wall(0.0, 0.0, 2.8, 0.77), wall(0.0, 1.28, 2.8, 2.0)});
  start_ = {2.425, 1.025, 0.0};
  const PathField narrow = field(robot_, {});
  ASSERT_FALSE(narrow.space->fits({242, 102}, 0));
  ASSERT_TRUE(narrow.space->fits({242, 102}, 0, Margin::tight));
  EXPECT_TRUE(plan_path(narrow, {4.5, 1.0, 0.0}).reaches_goal);
}

/// A row of sixteen cells: the first nine are narrow, and the first one is far enough from what is
/// open to be a nook.
TEST(NarrowSearch, LeadsToANookInTheFirstCellOfAMap) {
  const DrawnRooms rooms(0.8, 0.05, {wall(0.0, 0.04, 0.45, 0.05)});
  const PathField field = small_robots_field(rooms, {0.775, 0.025, 0.0});
  EXPECT_NEAR(path_length_m(field, {0.025, 0.025, 0.0}), 6.0 * 0.05 + 9.0 * 0.05 * 3.0, 1e-6);
}

/// The first of five steps leads into the passage, the last one out of it. A metre in it counts for
/// three, and double, as one that touches the margin.
TEST(NarrowSearch, AStepIntoAPassageCostsNoMoreThanOneInIt) {
  const DrawnRooms rooms(0.4, 0.05, {wall(0.05, 0.04, 0.25, 0.05)});
  const PathField there = small_robots_field(rooms, {0.025, 0.025, 0.0});
  EXPECT_NEAR(there.cost[there.map.index({5, 0})], 5.0 * 0.05 * 3.0 * 2.0, 1e-9);
}

/// Walls leave it 11 cm, and 5.3 at the next heading.
TEST_F(Corridor, WhatKeepsLessThanThePreferredMarginCountsDouble) {
  const double turn_m = kHeadingStep_rad * std::hypot(0.45, 0.25);
  const auto expect_counts = [&](double preferred_m, double ahead, double turning) {
    const PathField narrow = field(robot_, {.preferred_margin_m = preferred_m, .speed_m_s = 0.2});
    EXPECT_NEAR(cost_at(narrow, start_cell_ + Eigen::Array2i(10, 0), 0.0), ahead * 0.5 * 3.0 * 2.5,
                1e-9);
    EXPECT_NEAR(cost_at(narrow, start_cell_, kHeadingStep_rad), turning * turn_m * 3.0 * 2.5, 1e-9);
  };
  expect_counts(0.05, 1.0, 1.0);
  expect_counts(0.06, 1.0, 2.0);
  expect_counts(0.10, 1.0, 2.0);
  expect_counts(0.12, 2.0, 2.0);
}

TEST(NarrowSearch, AStepInOrOutOfAPassageWithLessThanThePreferredMarginCountsDouble) {
  const DrawnRooms rooms(0.4, 0.05, {wall(0.05, 0.04, 0.25, 0.05)});
  for (const double preferred_m : {0.009, 0.011}) {
    const PathField there = small_robots_field(rooms, {0.025, 0.025, 0.0}, preferred_m);
    const double counts = preferred_m > 0.01 ? 2.0 : 1.0;
    EXPECT_NEAR(there.cost[there.map.index({5, 0})], counts * 5.0 * 0.05 * 3.0 * 2.0, 1e-9);
  }
}

/// Posts a centimetre beside the way between the places of two cells, not beside those places.
TEST(NarrowSearch, AStepCountsDoubleByWhatIsBesideItsMiddle) {
  std::vector<Eigen::AlignedBox2d> posts;
  for (const double x_m : {0.055, 0.105, 0.155, 0.205}) {
    posts.push_back(wall(x_m - 0.001, 0.04, x_m + 0.001, 0.05));
  }
  const DrawnRooms rooms(0.4, 0.05, posts);
  const FloorOutline outline = rectangle(0.016, 0.02);
  NavigationOptions options;
  options.footprint_radius_m = circumscribed_radius_m(outline);
  options.margin_m = 0.005;
  const auto space =
      rooms.space({.outline = outline, .speed_m_s = 0.6}, {.margin_m = 0.001,
                                                           .preferred_margin_m = 0.0101,
                                                           .headings = 4,
                                                           .speed_m_s = 0.2,
                                                           .least_area_m2 = 0.0});
  const double steps = 4.0 * 2.0 + 1.0;
  const PathField there = make_path_field(rooms.floor, {0.025, 0.025, 0.0}, options, space);
  EXPECT_NEAR(there.cost[there.map.index({5, 0})], steps * 0.05 * 3.0 * 2.0, 1e-9);
  const PathField back = make_path_field(rooms.floor, {0.275, 0.025, 0.0}, options, space);
  EXPECT_NEAR(back.cost[back.map.index({0, 0})], steps * 0.05 * 3.0 * 2.0, 1e-9);
}

/// Of two doors the nearer leaves it 3 cm, the other 10.
TEST(NarrowSearch, GoesRoundByADoorThatLeavesMore) {
  const FloorOutline outline = rectangle(0.6, 0.6);
  const DrawnRooms rooms(
      5.1, 4.0, {wall(2.5, 0.0, 2.6, 1.195), wall(2.5, 1.855, 2.6, 2.4), wall(2.5, 3.2, 2.6, 4.0)});
  NavigationOptions options;
  options.footprint_radius_m = circumscribed_radius_m(outline);
  options.margin_m = 0.04;
  for (const double preferred_m : {0.0, 0.05}) {
    const PathField field =
        make_path_field(rooms.floor, {1.25, 1.5, 0.0}, options,
                        rooms.space({.outline = outline}, {.preferred_margin_m = preferred_m}));
    const PlannedPath path = plan_path(field, {3.9, 1.5, 0.0});
    ASSERT_TRUE(path.reaches_goal);
    const auto highest = std::ranges::max(path.waypoints, {}, &Pose2::y_m);
    EXPECT_EQ(highest.y_m > 2.5, preferred_m > 0.0) << highest.y_m;
  }
}

/// The middle of the door is 2 cm beside that of a cell, where 4 cm are left on one side.
TEST(NarrowSearch, PutsAPoseWhereInItsCellThePreferredMarginIsKept) {
  const FloorOutline outline = rectangle(0.6, 0.6);
  const DrawnRooms rooms(5.1, 3.0, {wall(2.5, 0.0, 2.6, 1.185), wall(2.5, 1.905, 2.6, 3.0)});
  NavigationOptions options;
  options.footprint_radius_m = circumscribed_radius_m(outline);
  options.margin_m = 0.04;
  for (const double preferred_m : {0.0, 0.05, 0.1}) {
    const PathField field =
        make_path_field(rooms.floor, {1.25, 1.5, 0.0}, options,
                        rooms.space({.outline = outline}, {.preferred_margin_m = preferred_m}));
    const std::size_t cell = field.map.index(field.map.cell_at({2.53, 1.54}));
    const auto node = std::ranges::find_if(field.narrow, [&](const NarrowPose& pose) {
      return pose.cell == cell && pose.pose.yaw_rad == 0.0;
    });
    ASSERT_NE(node, field.narrow.end());
    EXPECT_NEAR(node->pose.y_m, preferred_m == 0.05 ? 1.535 : 1.525, 1e-9) << preferred_m;
  }
}

/// A door of 0.72 m leaves the PR2 2.6 cm on either side, where it keeps 2; cells are of 1.67 cm.
TEST(NarrowSearch, GoesThroughADoorWhereverItStandsAmongTheCells) {
  const FloorOutline outline = rectangle(0.668, 0.668);
  NavigationOptions options;
  options.footprint_radius_m = circumscribed_radius_m(outline);
  options.margin_m = 0.04;
  for (int step = 0; step < 20; ++step) {
    const double off_m = 0.005 * (step / 2);
    const Eigen::AlignedBox2d wall_m = wall(2.5 + off_m, 0.0, 2.6 + off_m + 0.1 * (step % 2), 3.0);
    DrawnRooms rooms(5.2, 3.0, {});
    FloorMap detail = make_floor_detail(rooms.floor, {.parts = 3});
    std::ranges::fill(detail.log_odds, -3.0F);
    for (std::size_t cell = 0; cell < detail.size(); ++cell) {
      const Eigen::Vector2d p_m = detail.centre(detail.cell(cell));
      if (!wall_m.contains(p_m) || std::abs(p_m.y() - 1.5 - off_m) < 0.36) continue;
      detail.log_odds[cell] = 3.0F;
      rooms.floor.log_odds[rooms.floor.index(rooms.floor.cell_at(p_m))] = 3.0F;
    }
    const auto space = std::make_shared<const FootprintSpace>(
        detail, 3, RobotOutline{.outline = outline}, PassageOptions{});
    const PathField field = make_path_field(rooms.floor, {1.25, 1.5, 0.3}, options, space);
    EXPECT_TRUE(field.reachable(Eigen::Vector2d(3.9, 1.5))) << step;
  }
}

/// A post beside its corner's way from one heading to the next, not beside either of them.
TEST(NarrowSearch, DoesNotTurnThroughWhatIsBetweenTwoHeadings) {
  const FloorOutline outline = rectangle(0.6, 0.6);
  const double tip_rad = 0.25 * std::numbers::pi + 0.5 * kHeadingStep_rad;
  const Eigen::Vector2d p_m =
      Eigen::Vector2d(1.525, 0.525) + 0.413 * Eigen::Vector2d(std::cos(tip_rad), std::sin(tip_rad));
  for (const bool post : {false, true}) {
    DrawnRooms rooms(3.05, 1.05, {});
    if (post) rooms.detail.log_odds[rooms.detail.index(rooms.detail.cell_at(p_m))] = 3.0F;
    std::ranges::fill(rooms.floor.log_odds, 3.0F);  // all of it is narrow
    NavigationOptions options;
    options.footprint_radius_m = circumscribed_radius_m(outline);
    const auto space =
        rooms.space({.outline = outline}, {.margin_m = 0.001, .preferred_margin_m = 0.0});
    ASSERT_TRUE(space->fits({152, 52}, 0));
    ASSERT_TRUE(space->fits({152, 52}, 1));
    const PathField field = make_path_field(rooms.floor, {1.525, 0.525, 0.0}, options, space);
    const auto turned = std::ranges::find_if(field.narrow, [&](const NarrowPose& node) {
      return node.cell == field.start_cell && std::abs(node.pose.yaw_rad - kHeadingStep_rad) < 1e-6;
    });
    ASSERT_NE(turned, field.narrow.end());
    const double turn_m = kHeadingStep_rad * circumscribed_radius_m(outline);
    EXPECT_EQ(turned->cost < 2.5 * turn_m * space->slowness() * (1.0 + options.clearance_weight),
              !post)
        << turned->cost;
  }
}

/// From the heading beside that of the corridor to that one: on to the next there is no room.
TEST_F(Corridor, TurnsTheOtherWayWhereOneWayIsClosed) {
  const double turn_m = kHeadingStep_rad * std::hypot(0.45, 0.25);
  for (const double side : {-1.0, 1.0}) {
    start_.yaw_rad = side * kHeadingStep_rad;
    const PathField narrow = field(robot_, {.speed_m_s = 0.2});
    EXPECT_NEAR(cost_at(narrow, start_cell_, 0.0), turn_m * 3.0 * 2.5, 1e-9) << side;
    EXPECT_TRUE(std::isinf(cost_at(narrow, start_cell_, 2.0 * start_.yaw_rad)));
  }
}

/// A corridor that leaves room for its middle in one row of cells, or in one column.
TEST(NarrowPoses, AreWithinTwoCellsOfTheMiddleOfTheirOwn) {
  for (const bool along_x : {false, true}) {
    for (int off = -3; off <= 3; ++off) {
      const double low_m = 1.525 + 0.01 * off - 0.328;
      const double high_m = 1.525 + 0.01 * off + 0.328;
      const DrawnRooms rooms(
          3.05, 3.05,
          along_x ? std::vector{wall(0.0, 0.0, 3.05, low_m), wall(0.0, high_m, 3.05, 3.05)}
                  : std::vector{wall(0.0, 0.0, low_m, 3.05), wall(high_m, 0.0, 3.05, 3.05)});
      PathField field;
      field.map = rooms.floor;
      field.space = rooms.space({.outline = rectangle(0.61, 0.61)},
                                {.preferred_margin_m = 0.0, .headings = 4});
      NarrowPoses poses(field, std::vector<Leeway>(field.map.size(), Leeway::passage));
      const std::size_t cell = field.map.index({30, 30});
      const std::uint32_t pose = poses.at(cell, 0);
      ASSERT_EQ(pose == NarrowPoses::kNone, std::abs(off) > 2) << off;
      if (pose == NarrowPoses::kNone) continue;
      const Eigen::Array2i there = along_x ? Eigen::Array2i(0, off) : Eigen::Array2i(off, 0);
      EXPECT_TRUE((poses.place(pose).fine == poses.middle(cell) + there).all()) << off;
      EXPECT_EQ(poses.at(cell, 0), pose) << "it is made once";
    }
  }
}

/// A post at its left front corner: it fits a cell to the right, and a cell farther back.
TEST(NarrowPoses, OfEquallyNearPlacesTheFirstInTheMapIsTaken) {
  DrawnRooms rooms(3.05, 3.05, {});
  rooms.detail.log_odds[rooms.detail.index({152 + 32, 152 + 31})] = 3.0F;
  PathField field;
  field.map = rooms.floor;
  field.space =
      rooms.space({.outline = rectangle(0.61, 0.61)}, {.preferred_margin_m = 0.0, .headings = 4});
  ASSERT_FALSE(field.space->fits({152, 152}, 0));
  ASSERT_TRUE(field.space->fits({151, 152}, 0));
  NarrowPoses poses(field, std::vector<Leeway>(field.map.size(), Leeway::passage));
  const std::uint32_t pose = poses.at(field.map.index({30, 30}), 0);
  ASSERT_NE(pose, NarrowPoses::kNone);
  EXPECT_TRUE((poses.place(pose).fine == Eigen::Array2i(152, 151)).all());
}

/// Five columns of 30 cells are open, the other 35 are a nook of 48 headings a cell. After each row
/// and each column of the clearance, and once in 32 768 nodes.
TEST(NarrowSearch, AsksNowAndThenWhetherToGoOn) {
  DrawnRooms rooms(2.0, 1.5, {});
  for (std::size_t cell = 0; cell < rooms.floor.size(); ++cell) {
    if (rooms.floor.cell(cell).x() >= 5) rooms.floor.log_odds[cell] = 3.0F;
  }
  int asked = 0;
  const StopPoll poll([&] { ++asked; });
  const PathField field = small_robots_field(rooms, {0.125, 0.75, 0.0});
  const auto reached = static_cast<std::size_t>(std::ranges::count_if(
      field.narrow, [](const NarrowPose& node) { return !std::isinf(node.cost); }));
  ASSERT_GT(reached, kNodesBetweenPolls);
  ASSERT_LT(reached + 150U, 2 * kNodesBetweenPolls);
  EXPECT_EQ(asked, 42 + 32 + 1);
}

TEST_F(Corridor, EachStepIsNotedOnceThoughItIsSearchedAgain) {
  const PathField narrow = field({.outline = rectangle(0.6, 0.6)}, {});
  ASSERT_GT(farthest_off_rad(narrow), 3.0) << "backwards only when searched again";
  std::set<std::pair<std::size_t, std::size_t>> steps;
  for (const NarrowEdge& edge : narrow.narrow_edges) {
    EXPECT_TRUE(steps.emplace(edge.from, edge.to).second) << edge.from << " to " << edge.to;
  }
}

}  // namespace
}  // namespace vantage
