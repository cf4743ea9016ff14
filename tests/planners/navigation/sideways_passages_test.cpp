// Gaps along a wall, which a robot gets into that steps aside without turning.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

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
}

TEST(PassagesAlongAWall, AreTakenFacingTheWayToAnEighthOfATurn) {
  const FloorOutline outline = rectangle(0.668, 0.668);
  NavigationOptions options;
  options.footprint_radius_m = circumscribed_radius_m(outline);
  const DrawnRooms rooms(6.0, 4.0, {wall(2.0, 0.0, 4.0, 3.1), wall(0.0, 3.9, 6.0, 4.0)});
  const PathField field =
      make_path_field(rooms.floor, {5.0, 1.0, 0.0}, options, rooms.space({.outline = outline}, {}));
  const auto cell_of = [&](std::size_t id) {
    return field.map.cell(id < field.map.size() ? id : field.narrow[id - field.map.size()].cell);
  };
  double most_off_rad = 0.0;
  for (const NarrowEdge& edge : field.narrow_edges) {
    const Eigen::Array2i step = cell_of(edge.to) - cell_of(edge.from);
    if (step.isZero()) continue;  // a turn
    const std::size_t pose = std::max(edge.from, edge.to) - field.map.size();
    const double way_rad = std::atan2(step.y(), step.x());
    const double off_rad = std::abs(wrap_angle(way_rad - field.narrow[pose].pose.yaw_rad));
    most_off_rad = std::max(most_off_rad, off_rad);
  }
  EXPECT_NEAR(most_off_rad, std::numbers::pi / 4.0, 1e-9);
}

}  // namespace
}  // namespace vantage
