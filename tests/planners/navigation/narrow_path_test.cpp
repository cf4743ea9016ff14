// Paths through passages of given steps, and legs moved to the middle.
#include "vantage/planners/navigation/narrow_path.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/planners/navigation/drawn_rooms.hpp"

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

}  // namespace
}  // namespace vantage
