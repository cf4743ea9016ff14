// Gaps along a wall, which a robot gets into that steps aside without turning.
#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "tests/planners/navigation/drawn_rooms.hpp"

namespace vantage {
namespace {

/// A room to the left and one to the right of a block, and a gap between it and the wall above. A
/// robot that keeps one heading must step aside by a cell before the gap.
DrawnRooms rooms_about_block(double gap_m, double left_m = 2.0) {
  return {6.0, 4.0, {wall(left_m, 0.0, 4.0, 3.9 - gap_m), wall(0.0, 3.9, 6.0, 4.0)}};
}

TEST(PassagesAlongAWall, AreOpenToARobotThatCanStepAside) {
  const FloorOutline outline = rectangle(0.668, 0.668);
  NavigationOptions options;
  options.footprint_radius_m = circumscribed_radius_m(outline);
  const Pose2 right{5.0, 1.0, 0.0};
  const Eigen::Vector2d left(0.6, 1.0);
  const auto reaches_left = [&](const DrawnRooms& rooms, bool goes_sideways) {
    const auto space = rooms.space({.outline = outline, .goes_sideways = goes_sideways}, {});
    return make_path_field(rooms.floor, right, options, space).reachable(left);
  };
  for (const double gap_m : {0.72, 0.76, 0.8}) {
    SCOPED_TRACE(gap_m);
    EXPECT_TRUE(reaches_left(rooms_about_block(gap_m), true));
    EXPECT_TRUE(reaches_left(rooms_about_block(gap_m, 1.3), true)) << "a small room";
    EXPECT_FALSE(reaches_left(rooms_about_block(gap_m), false));
  }
  EXPECT_FALSE(reaches_left(rooms_about_block(0.68), true));
  EXPECT_TRUE(reaches_left(rooms_about_block(0.9, 1.3), true));
}

TEST(PassagesAlongAWall, AreTakenFacingTheWayToAnEighthOfATurn) {
  const FloorOutline outline = rectangle(0.668, 0.668);
  NavigationOptions options;
  options.footprint_radius_m = circumscribed_radius_m(outline);
  const auto off_rad = [&](double gap_m, bool shut) {
    std::vector<Eigen::AlignedBox2d> walls{wall(2.0, 0.0, 4.0, 3.9 - gap_m),
                                           wall(0.0, 3.9, 6.0, 4.0)};
    if (shut) walls.push_back(wall(2.0, 3.9 - gap_m, 2.1, 3.9));
    const DrawnRooms rooms(6.0, 4.0, walls);
    const PathField field = make_path_field(rooms.floor, {5.0, 1.0, 0.0}, options,
                                            rooms.space({.outline = outline}, {}));
    EXPECT_EQ(field.reachable(Eigen::Vector2d(0.6, 1.0)), !shut);
    return farthest_off_rad(field);
  };
  for (const double gap_m : {0.8, 0.9}) {
    SCOPED_TRACE(gap_m);
    EXPECT_NEAR(off_rad(gap_m, false), std::numbers::pi / 4.0, 1e-9);
    EXPECT_LT(off_rad(gap_m, true), 0.8);
  }
}

}  // namespace
}  // namespace vantage
