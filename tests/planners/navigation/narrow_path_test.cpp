// Paths through passages of given steps, and legs moved to the middle.
#include "vantage/planners/navigation/narrow_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/planners/navigation/drawn_rooms.hpp"
#include "vantage/planners/navigation/centred_legs.hpp"

namespace vantage {
namespace {

/// In an empty room; a metre in a passage counts for three.
class StepsThroughAPassage : public testing::Test {
 protected:
  PlannedPath path(const Pose2& start, const std::vector<PathStep>& steps,
                   bool goes_sideways = true) {
    const DrawnRooms rooms(3.0, 3.0, {});
    NavigationOptions options;
    options.footprint_radius_m = radius_m_;
    const RobotOutline robot{
        .outline = rectangle(0.3, 0.2), .goes_sideways = goes_sideways, .speed_m_s = 0.6};
    const PathField field =
        make_path_field(rooms.floor, start, options, rooms.space(robot, {.speed_m_s = 0.2}));
    return path_through_passages(field, steps, 1.1);
  }
  static void expect_pose(const Pose2& pose, double x_m, double y_m, double yaw_rad) {
    EXPECT_NEAR(pose.x_m, x_m, 1e-9);
    EXPECT_NEAR(pose.y_m, y_m, 1e-9);
    EXPECT_NEAR(pose.yaw_rad, yaw_rad, 1e-9);
  }

  double radius_m_ = std::hypot(0.15, 0.1);
  const std::vector<PathStep> two_turns_{{{1.0, 1.0}, {}},  {{1.3, 1.2}, 0.0}, {{1.6, 1.3}, 0.0},
                                         {{1.6, 1.3}, 0.3}, {{1.6, 1.3}, 0.6}, {{1.8, 1.5}, 0.6},
                                         {{2.0, 1.9}, {}}};
};

TEST_F(StepsThroughAPassage, AreLegsAtOneHeadingAndTurnsInPlace) {
  const PlannedPath planned = path({1.0, 1.0, 0.4}, two_turns_);
  ASSERT_EQ(planned.legs.size(), 5U);
  for (const std::size_t i : {0U, 4U}) EXPECT_FALSE(planned.legs[i].narrow) << i;
  for (const std::size_t i : {1U, 2U, 3U}) EXPECT_TRUE(planned.legs[i].narrow) << i;
  expect_pose(planned.legs[0].waypoints.front(), 1.0, 1.0, 0.4);
  expect_pose(planned.legs[0].waypoints.back(), 1.0, 1.0, 0.0);
  ASSERT_EQ(planned.legs[1].waypoints.size(), 2U) << "pulled straight";
  expect_pose(planned.legs[1].waypoints.back(), 1.6, 1.3, 0.0);
  ASSERT_EQ(planned.legs[2].waypoints.size(), 2U) << "two turns are one";
  expect_pose(planned.legs[2].waypoints.back(), 1.6, 1.3, 0.6);
  expect_pose(planned.legs[3].waypoints.back(), 2.0, 1.9, 0.6);
  expect_pose(planned.legs[4].waypoints.back(), 2.0, 1.9, 1.1);
  expect_pose(planned.end, 2.0, 1.9, 1.1);
  EXPECT_EQ(planned.waypoints.size(), 6U);
  EXPECT_NEAR(planned.length_m,
              3.0 * (std::hypot(0.6, 0.3) + 0.6 * radius_m_ + std::hypot(0.4, 0.6)), 1e-9);
}

TEST_F(StepsThroughAPassage, OfWhatGoesAlongItsHeadingHaveTheHeadingOfTheWay) {
  const PlannedPath planned = path({1.0, 1.0, 0.4}, two_turns_, false);
  const double first_rad = std::atan2(0.3, 0.6);
  const double second_rad = std::atan2(0.6, 0.4);
  ASSERT_EQ(planned.legs.size(), 5U);
  expect_pose(planned.legs[1].waypoints.back(), 1.6, 1.3, first_rad);
  expect_pose(planned.legs[2].waypoints.back(), 1.6, 1.3, 0.6);
  expect_pose(planned.legs[3].waypoints.back(), 2.0, 1.9, second_rad);
  // To the first heading, back from it to 0.6, and on to the second.
  EXPECT_NEAR(planned.length_m,
              3.0 * (std::hypot(0.6, 0.3) + std::hypot(0.4, 0.6) + second_rad * radius_m_), 1e-9);
}

/// Three quarters of a turn to the left are no quarter to the right.
TEST_F(StepsThroughAPassage, TurnTheLongWayInSeveralTurns) {
  std::vector<PathStep> steps{{{1.0, 1.2}, 0.0}, {{1.3, 1.2}, 0.0}};
  for (int i = 1; i <= 15; ++i)
    steps.push_back({{1.3, 1.2}, wrap_angle(0.1 * std::numbers::pi * i)});
  steps.push_back({{1.3, 0.8}, wrap_angle(1.5 * std::numbers::pi)});
  steps.push_back({{1.3, 0.6}, {}});
  const PlannedPath planned = path({1.0, 1.2, 0.0}, steps);
  ASSERT_EQ(planned.legs.size(), 6U) << "there, three turns, on, and where there is room";
  double turned_rad = 0.0;
  for (std::size_t i = 0; i < 5; ++i) {
    const auto& waypoints = planned.legs[i].waypoints;
    ASSERT_EQ(waypoints.size(), 2U);
    const double turn_rad = wrap_angle(waypoints[1].yaw_rad - waypoints[0].yaw_rad);
    EXPECT_GE(turn_rad, -1e-9) << "to the left alone";
    turned_rad += turn_rad;
  }
  EXPECT_NEAR(turned_rad, 1.5 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(planned.length_m, 3.0 * (0.9 + 1.5 * std::numbers::pi * radius_m_), 1e-9);
  EXPECT_NEAR(planned.legs[1].waypoints.back().yaw_rad, 0.7 * std::numbers::pi, 1e-9);
}

/// A wall 16.5 cm beside it, and half of its diagonal is 18: the search has moved two headings.
TEST_F(StepsThroughAPassage, TurnWhereEachHeadingFits) {
  const DrawnRooms rooms(3.0, 3.0, {wall(0.0, 1.165, 3.0, 1.3)});
  NavigationOptions options;
  options.footprint_radius_m = radius_m_;
  const std::vector<PathStep> steps{{{0.7, 1.0}, 0.0},  {{1.0, 1.0}, 0.0},   {{1.0, 1.0}, 0.2},
                                    {{1.0, 1.0}, 0.3},  {{1.0, 0.96}, 0.75}, {{1.0, 0.96}, 1.1},
                                    {{1.0, 0.97}, 1.5}, {{1.0, 0.97}, 1.55}};
  const auto turns = [&](double margin_m) {
    const PathField field =
        make_path_field(rooms.floor, {0.7, 1.0, 0.0}, options,
                        rooms.space({.outline = rectangle(0.3, 0.2)}, {.margin_m = margin_m}));
    std::vector<PathLeg> legs = path_through_passages(field, steps, 0.0).legs;
    legs.erase(legs.begin());  // there
    return legs;
  };
  const auto by_half = turns(0.03);
  ASSERT_EQ(by_half.size(), 2U) << "to where the corner passes, and from there";
  expect_pose(by_half[0].waypoints.back(), 1.0, 0.96, 1.1);
  expect_pose(by_half[1].waypoints.back(), 1.0, 0.97, 1.55);
  const auto by_margin = turns(0.02);
  ASSERT_EQ(by_margin.size(), 2U) << "each turn keeps 2 cm, and one to 1.1 would keep 1.6";
  expect_pose(by_margin[0].waypoints.back(), 1.0, 0.96, 0.75);
}

/// Half of its diagonal is 18 cm: that corner points at the wall at 0.98 rad.
TEST_F(StepsThroughAPassage, TurnInOneOnlyWhereItFitsBetweenTheHeadingsToo) {
  NavigationOptions options;
  options.footprint_radius_m = radius_m_;
  const auto legs = [&](double wall_m) {
    const DrawnRooms rooms(3.0, 3.0, {wall(0.0, wall_m, 3.0, 1.4)});
    const PathField field =
        make_path_field(rooms.floor, {0.7, 1.0, 0.0}, options,
                        rooms.space({.outline = rectangle(0.3, 0.2)},
                                    {.margin_m = 0.02, .preferred_margin_m = 0.0}));
    const std::vector<PathStep> steps{
        {{0.7, 1.0}, 0.0}, {{1.0, 1.0}, 0.0}, {{1.0, 1.0}, 0.5}, {{1.0, 1.0}, 1.5}};
    return path_through_passages(field, steps, 0.0).legs.size();
  };
  EXPECT_EQ(legs(1.175), 3U) << "1.5 cm are left at 0.5, and nothing on the way to 1.5";
  EXPECT_EQ(legs(1.215), 2U);
}

/// It stands between two headings of the search.
TEST_F(StepsThroughAPassage, BeginAtTheHeadingNearestToItsOwn) {
  const PlannedPath planned =
      path({1.0, 1.2, 0.02}, {{{1.0, 1.2}, 0.02}, {{1.3, 1.2}, 0.0}, {{1.7, 1.6}, {}}});
  ASSERT_EQ(planned.legs.size(), 2U);
  EXPECT_TRUE(planned.legs[0].narrow);
  ASSERT_EQ(planned.legs[0].waypoints.size(), 2U);
  expect_pose(planned.legs[0].waypoints.front(), 1.0, 1.2, 0.02);
  expect_pose(planned.legs[0].waypoints.back(), 1.7, 1.6, 0.0);
  EXPECT_NEAR(planned.length_m, 3.0 * (std::hypot(0.7, 0.4) + 0.02 * radius_m_), 1e-9);
}

/// A post beside the straight way from the first of four places to the last, not to the third.
class PostBesideTheStraightWay : public StepsThroughAPassage {
 protected:
  /// @param y_m of the post; 1.1 is the outline's edge on the straight way
  PathLeg leg(double y_m, const PassageOptions& passages,
              const Eigen::Vector2d& second_m = {1.2, 1.4}) {
    const std::vector<PathStep> steps{
        {{1.0, 1.2}, 0.0}, {second_m, 0.0}, {{1.4, 1.6}, 0.0}, {{1.9, 1.2}, 0.0}};
    const DrawnRooms rooms(3.0, 3.0, {wall(1.401, y_m - 0.004, 1.409, y_m + 0.004)});
    NavigationOptions options;
    options.footprint_radius_m = radius_m_;
    const PathField field =
        make_path_field(rooms.floor, {1.0, 1.2, 0.0}, options,
                        rooms.space({.outline = rectangle(0.3, 0.2)}, passages));
    return path_through_passages(field, steps, 0.0).legs.at(0);
  }
};

TEST_F(PostBesideTheStraightWay, IsPassedAsFarOffAsByTheSteps) {
  for (const bool preferred : {false, true}) {
    const PassageOptions passages{.margin_m = preferred ? 0.02 : 0.1,
                                  .preferred_margin_m = preferred ? 0.1 : 0.05};
    const PathLeg near = leg(1.015, passages);
    ASSERT_EQ(near.waypoints.size(), 3U) << "8.5 cm beside the outline, and those keep 10";
    expect_pose(near.waypoints[1], 1.4, 1.6, 0.0);
    expect_pose(near.waypoints[2], 1.9, 1.2, 0.0);
    EXPECT_EQ(leg(0.985, passages).waypoints.size(), 2U) << "11.5 cm";
  }
}

/// Where the way by the steps leaves less, too.
TEST_F(PostBesideTheStraightWay, IsPassedByTheMarginOrHalfOfItWhereTheStepsKeepNoMore) {
  const PassageOptions passages{.margin_m = 0.06, .preferred_margin_m = 0.1};
  const Eigen::Vector2d beside(1.25, 1.2);
  EXPECT_EQ(leg(1.015, passages, beside).waypoints.size(), 2U) << "8.5 cm, by either way";
  EXPECT_EQ(leg(1.055, passages, beside).waypoints.size(), 2U) << "4.5 cm, by either way";
  EXPECT_EQ(leg(1.085, passages, beside).waypoints.size(), 3U) << "1.5 cm: less than half of it";
}

double driven_m(const PlannedPath& path) {
  double sum = 0.0;
  for (std::size_t i = 1; i < path.waypoints.size(); ++i) {
    sum += std::hypot(path.waypoints[i].x_m - path.waypoints[i - 1].x_m,
                      path.waypoints[i].y_m - path.waypoints[i - 1].y_m);
  }
  return sum;
}

/// Through doors that leave 3 to 14 cm on either side.
TEST(CentredPath, HangsTogetherAndIsHardlyLonger) {
  const FloorOutline outline = rectangle(0.6, 0.6);
  NavigationOptions options;
  options.footprint_radius_m = circumscribed_radius_m(outline);
  for (const double door_m : {0.66, 0.72, 0.8, 0.88}) {
    for (const double yaw_rad : {0.0, 1.0}) {
      const DrawnRooms rooms = rooms_with_door(door_m);
      const PathField field =
          make_path_field(rooms.floor, {1.25, 1.5, yaw_rad}, options,
                          rooms.space({.outline = outline}, {.margin_m = 0.0199}));
      const PlannedPath planned = plan_path(field, {3.9, 1.5, 1.0});
      ASSERT_TRUE(planned.reaches_goal) << door_m;
      const PlannedPath driven = centred(field, planned);
      ASSERT_FALSE(driven.legs.empty());
      EXPECT_EQ(driven.legs.size(), planned.legs.size());
      EXPECT_LT(driven_m(driven), driven_m(planned) + 0.2) << door_m;
      for (std::size_t i = 1; i < driven.legs.size(); ++i) {
        const Pose2& end = driven.legs[i - 1].waypoints.back();
        const Pose2& begin = driven.legs[i].waypoints.front();
        EXPECT_NEAR(std::hypot(end.x_m - begin.x_m, end.y_m - begin.y_m), 0.0, 1e-12) << i;
      }
      EXPECT_EQ(driven.waypoints.front().x_m, 1.25);
      EXPECT_NEAR(driven.end.x_m, 3.9, 1e-9);
      EXPECT_NEAR(driven.end.yaw_rad, 1.0, 1e-9);
    }
  }
}

/// Of a robot of 0.6 x 0.6 m that comes out of one passage and goes through another one.
PlannedPath centred_between(const std::vector<Eigen::AlignedBox2d>& walls, const Pose2& begin,
                            const Pose2& end) {
  const DrawnRooms rooms(3.0, 1.0, walls);
  PathField field;
  field.start = {0.4, 0.5, 0.0};
  field.space = rooms.space({.outline = rectangle(0.6, 0.6)}, {});
  const Pose2 out{0.5, 0.5, 0.0};
  PlannedPath path;
  path.legs.push_back({.waypoints = {field.start, out}, .narrow = true});
  path.legs.push_back({.waypoints = {out, begin}});
  path.legs.push_back({.waypoints = {begin, end}, .narrow = true});
  path.legs.push_back({.waypoints = {end, {2.6, 0.5, 0.0}}});
  return centred(field, path);
}

/// In the middle, y = 0.5, and only there at that heading, 5 cm are left on either side.
TEST(CentredPath, GoesThroughTheMiddleAtTheHeadingThatLeavesMost) {
  struct Off {
    double begin_m, end_m;
    int quarters;  // of the step between two headings
  };
  for (const auto& [begin_m, end_m, quarters] :
       {Off{-0.04, 0.03, 2}, Off{0.03, -0.04, -2}, Off{0.04, 0.03, 1}, Off{-0.03, -0.04, -1},
        Off{-0.03, 0.04, 1}}) {
    const double yaw_rad = 0.25 * quarters * std::numbers::pi / 24.0;
    const PlannedPath path =
        centred_between({wall(0.0, 0.0, 3.0, 0.15), wall(0.0, 0.85, 3.0, 1.0)},
                        {1.0, 0.5 + begin_m, 1.0}, {2.0, 0.5 + end_m, yaw_rad});
    ASSERT_EQ(path.waypoints.size(), 5U);
    for (const std::size_t i : {2U, 3U}) {
      EXPECT_NEAR(path.waypoints[i].x_m, i - 1.0, 0.004);
      EXPECT_NEAR(path.waypoints[i].y_m, 0.5, 3e-4) << begin_m << " " << end_m;
      EXPECT_NEAR(path.waypoints[i].yaw_rad, 0.0, 1e-9) << quarters;
    }
    EXPECT_NEAR(path.legs[2].waypoints.front().yaw_rad, 0.0, 1e-9);
    EXPECT_EQ(path.legs[2].waypoints.front().y_m, path.waypoints[2].y_m);
    EXPECT_EQ(path.legs[3].waypoints.front().y_m, path.waypoints[3].y_m);
    EXPECT_EQ(path.waypoints[1].x_m, 0.5);
    EXPECT_EQ(path.end.x_m, 2.6);
  }
}

TEST(CentredPath, KeepsEightCentimetresAtMost) {
  const auto y_m = [](double wall_m) {
    const PlannedPath path =
        centred_between({wall(0.0, 0.0, 3.0, 0.5 - wall_m), wall(0.0, 0.5 + wall_m, 3.0, 1.0)},
                        {1.0, 0.46, 1.0}, {2.0, 0.46, 0.0});
    const auto& leg = path.legs.at(2).waypoints;
    EXPECT_EQ(leg.front().x_m, 1.0);
    EXPECT_EQ(leg.back().x_m, 2.0);
    EXPECT_EQ(leg.front().y_m, leg.back().y_m);
    EXPECT_EQ(leg.front().yaw_rad, 0.0) << "it turns before";
    return leg.back().y_m;
  };
  EXPECT_EQ(y_m(0.42), 0.46) << "it has 8.5 cm";
  EXPECT_NEAR(y_m(0.41), 0.47, 1e-9) << "it had 7.5 cm";
}

/// A post 3.5 cm ahead of where the leg ends, or behind where it begins: nothing leaves more.
TEST(CentredPath, KeepsItsClearanceAtBothEnds) {
  for (const double post_m : {0.665, 2.335}) {
    const PlannedPath path = centred_between({wall(0.0, 0.0, 3.0, 0.15), wall(0.0, 0.85, 3.0, 1.0),
                                              wall(post_m - 0.004, 0.501, post_m + 0.004, 0.509)},
                                             {1.0, 0.52, 0.0}, {2.0, 0.52, 0.0});
    for (const Pose2& pose : path.legs.at(2).waypoints) EXPECT_EQ(pose.y_m, 0.52) << post_m;
  }
}

TEST(CentredPath, MovesByFourCentimetresAndHalfAHeadingAtMost) {
  const std::vector<Eigen::AlignedBox2d> walls{wall(0.0, 0.0, 3.0, 0.15),
                                               wall(0.0, 0.85, 3.0, 1.0)};
  const auto leg = [&](double begin_m, double end_m, double yaw_rad) {
    return centred_between(walls, {1.0, 0.5 + begin_m, 0.0}, {2.0, 0.5 + end_m, yaw_rad})
        .legs.at(2)
        .waypoints;
  };
  for (const double side : {-1.0, 1.0}) {
    const auto begin = leg(0.05 * side, 0.0, 0.0);
    EXPECT_NEAR(begin.front().y_m, 0.5 + 0.01 * side, 5e-4);
    EXPECT_NEAR(begin.back().y_m, 0.5, 5e-4);
    const auto end = leg(0.0, 0.05 * side, 0.0);
    EXPECT_NEAR(end.front().y_m, 0.5, 5e-4);
    EXPECT_NEAR(end.back().y_m, 0.5 + 0.01 * side, 5e-4);
    const double quarter_rad = 0.25 * std::numbers::pi / 24.0;
    EXPECT_NEAR(leg(0.0, 0.0, 3.0 * side * quarter_rad).back().yaw_rad, side * quarter_rad, 1e-9);
  }
}

/// A corner meets the post 1.5 cm from one of the places that are looked at.
TEST_F(StepsThroughAPassage, ArePulledStraightOnlyWhereEachCornerPasses) {
  const DrawnRooms rooms(3.0, 3.0, {wall(1.421, 1.391, 1.429, 1.399)});
  NavigationOptions options;
  options.footprint_radius_m = std::hypot(0.15, 0.15);
  const double yaw_rad = 0.25 * std::numbers::pi;
  const PathField field =
      make_path_field(rooms.floor, {1.0, 1.2, yaw_rad}, options,
                      rooms.space({.outline = rectangle(0.3, 0.3)}, {.margin_m = 0.0}));
  const std::vector<PathStep> steps{
      {{1.0, 1.2}, yaw_rad}, {{1.4, 0.9}, yaw_rad}, {{1.91, 1.2}, yaw_rad}};
  EXPECT_EQ(path_through_passages(field, steps, 0.0).legs.at(0).waypoints.size(), 3U);
}

/// A wall 12 cm beside it. At 0.6 rad it fits where the search has moved that heading to, 8 cm away
/// from the wall, and not halfway there.
TEST_F(StepsThroughAPassage, TurnInTwoWhereAHeadingFitsOnlyFartherOn) {
  const DrawnRooms rooms(3.0, 3.0, {wall(0.0, 1.12, 3.0, 1.3)});
  NavigationOptions options;
  options.footprint_radius_m = radius_m_;
  const PathField field = make_path_field(rooms.floor, {0.7, 1.0, 0.0}, options,
                                          rooms.space({.outline = rectangle(0.3, 0.2)}, {}));
  const std::vector<PathStep> steps{{{0.7, 1.0}, 0.0},
                                    {{1.0, 1.0}, 0.0},
                                    {{1.0, 0.92}, 0.6},
                                    {{1.0, 0.92}, 0.8},
                                    {{1.0, 0.6}, 0.8}};
  const PlannedPath planned = path_through_passages(field, steps, 0.0);
  ASSERT_EQ(planned.legs.size(), 4U);
  expect_pose(planned.legs[1].waypoints.back(), 1.0, 0.92, 0.6);
  expect_pose(planned.legs[2].waypoints.back(), 1.0, 0.92, 0.8);
  expect_pose(planned.legs[3].waypoints.back(), 1.0, 0.6, 0.8);
}

/// A post 7.9 cm ahead of its nose where the leg ends, and one as far behind its tail where it
/// begins. Two centimetres to either side there are eight.
TEST(CentredPath, MovesBothEndsToOneSideWhereEitherIsAsGood) {
  const FloorOutline diamond{{-0.1, 0.0}, {0.0, -0.05}, {0.1, 0.0}, {0.0, 0.05}};
  const DrawnRooms rooms(3.0, 1.0,
                         {wall(0.821, 0.501, 0.829, 0.509), wall(2.171, 0.501, 2.179, 0.509)});
  PathField field;
  field.start = {0.4, 0.505, 0.0};
  field.space = rooms.space({.outline = diamond}, {});
  const Pose2 begin{1.004, 0.505, 0.0};
  const Pose2 end{1.996, 0.505, 0.0};
  PlannedPath path;
  path.legs.push_back({.waypoints = {field.start, begin}});
  path.legs.push_back({.waypoints = {begin, end}, .narrow = true});
  path.legs.push_back({.waypoints = {end, {2.6, 0.505, 0.0}}});
  const auto leg = centred(field, path).legs.at(1).waypoints;
  EXPECT_NEAR(std::abs(leg.front().y_m - 0.505), 0.02, 1e-9);
  EXPECT_EQ(leg.front().y_m, leg.back().y_m);
}

TEST_F(PostBesideTheStraightWay, IsNotPassedNearerThanByHalfTheMargin) {
  const PassageOptions passages{.margin_m = 0.06, .preferred_margin_m = 0.1};
  EXPECT_EQ(leg(1.075, passages, {1.25, 1.2}).waypoints.size(), 3U) << "2.5 cm: less than three";
}

/// It has half a centimetre where it begins and where it ends, and 1.5 in the middle.
TEST(CentredPath, GoesForTheFirstCentimetreToo) {
  const PlannedPath path = centred_between({wall(0.0, 0.0, 3.0, 0.19), wall(0.0, 0.81, 3.0, 1.0)},
                                           {1.0, 0.51, 0.0}, {2.0, 0.51, 0.0});
  for (const Pose2& pose : path.legs.at(2).waypoints) EXPECT_NEAR(pose.y_m, 0.5, 1e-9);
}

/// There is room in the middle, 3 cm beside it; but it ends in the passage, or turns there.
TEST(CentredPath, LeavesALegAloneThatDoesNotLeadToAnOpenPlace) {
  const DrawnRooms rooms(3.0, 1.0, {wall(0.0, 0.0, 3.0, 0.15), wall(0.0, 0.85, 3.0, 1.0)});
  PathField field;
  field.start = {0.4, 0.5, 0.0};
  field.space = rooms.space({.outline = rectangle(0.6, 0.6)}, {});
  const Pose2 begin{1.0, 0.53, 0.0};
  const Pose2 end{2.0, 0.53, 0.0};
  PlannedPath path;
  path.legs.push_back({.waypoints = {field.start, begin}});
  path.legs.push_back({.waypoints = {begin, end}, .narrow = true});
  for (const bool turns : {false, true}) {
    if (turns) path.legs.push_back({.waypoints = {end, {2.0, 0.53, 0.02}}, .narrow = true});
    const PlannedPath driven = centred(field, path);
    ASSERT_EQ(driven.legs.size(), path.legs.size());
    for (const Pose2& pose : driven.legs[1].waypoints) EXPECT_EQ(pose.y_m, 0.53);
    EXPECT_EQ(driven.end.yaw_rad, turns ? 0.02 : 0.0);
  }
}

TEST(CentredPath, OfAPathThroughOpenPlacesIsThatPath) {
  const PathField of_a_disc{};
  const PlannedPath path{.waypoints = {{1.0, 1.0, 0.0}, {2.0, 1.0, 0.3}},
                         .legs = {},
                         .length_m = 1.0,
                         .reaches_goal = true,
                         .end = {2.0, 1.0, 0.3}};
  const PlannedPath driven = centred(of_a_disc, path);
  ASSERT_EQ(driven.waypoints.size(), 2U);
  EXPECT_EQ(driven.waypoints[1].x_m, 2.0);
  EXPECT_EQ(driven.end.yaw_rad, 0.3);
}

// A thin robot passes a post unless one of the headings that are looked at points to it.
TEST_F(StepsThroughAPassage, TurnInOneThatFitsEveryFiftiethOfARadian) {
  const FloorOutline diamond{{-0.4, 0.0}, {0.0, -0.004}, {0.4, 0.0}, {0.0, 0.004}};
  const auto turns = [&](double bearing_rad) {
    DrawnRooms rooms(3.0, 3.0, {});
    const Eigen::Array2i post(150, 150);
    rooms.detail.log_odds[rooms.detail.index(post)] = 3.0F;
    const Eigen::Vector2d p_m = rooms.detail.centre(post) -
                                0.3 * Eigen::Vector2d(std::cos(bearing_rad), std::sin(bearing_rad));
    NavigationOptions options;
    options.footprint_radius_m = 0.4;
    const PathField field = make_path_field(
        rooms.floor, {p_m.x(), p_m.y(), 0.0}, options,
        rooms.space({.outline = diamond}, {.margin_m = 0.0, .preferred_margin_m = 0.0}));
    const std::vector<PathStep> steps{{p_m, 0.0}, {p_m, 0.01}, {p_m, 0.03}};
    return path_through_passages(field, steps, 0.0).legs.size();
  };
  EXPECT_EQ(turns(0.0075), 1U) << "half way to its middle";
  EXPECT_EQ(turns(0.015), 2U) << "in its middle";
}

}  // namespace
}  // namespace vantage
