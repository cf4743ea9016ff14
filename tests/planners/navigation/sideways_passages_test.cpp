// Gaps that a robot gets through that does not face its way there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/planners/navigation/drawn_rooms.hpp"

namespace vantage {
namespace {

/// A room to the left and one to the right of a block, and a gap between it and the wall above. A
/// robot that keeps one heading must step aside by a cell before the gap.
DrawnRooms rooms_about_block(double gap_m, double left_m = 2.0) {
  return {6.0, 4.0, {wall(left_m, 0.0, 4.0, 3.9 - gap_m), wall(0.0, 3.9, 6.0, 4.0)}};
}

TEST(PassagesAlongAWall, AreTakenSidewaysIntoARoomThatIsNotReachedElse) {
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
    EXPECT_FALSE(reaches_left(rooms_about_block(gap_m), false));
    EXPECT_FALSE(reaches_left(rooms_about_block(gap_m, 1.3), true)) << "too small a room";
  }
  EXPECT_FALSE(reaches_left(rooms_about_block(0.68), true));
  EXPECT_TRUE(reaches_left(rooms_about_block(0.9, 1.3), true)) << "it faces its way";
}

/// Where that opens no room all is as it was: the edges are those of a robot that faces its way.
TEST(PassagesAlongAWall, AreTakenAsTheRobotFacesWhereGoingSidewaysDoesNotHelp) {
  const FloorOutline outline = rectangle(0.668, 0.668);
  NavigationOptions options;
  options.footprint_radius_m = circumscribed_radius_m(outline);
  const DrawnRooms open(6.0, 4.0, {wall(2.0, 0.0, 4.0, 3.0), wall(0.0, 3.9, 6.0, 4.0)});
  const DrawnRooms shut(
      6.0, 4.0, {wall(2.0, 0.0, 4.0, 3.0), wall(0.0, 3.9, 6.0, 4.0), wall(2.0, 3.0, 2.1, 3.9)});
  const auto edges = [&](const DrawnRooms& rooms) {
    const PathField field = make_path_field(rooms.floor, {5.0, 1.0, 0.0}, options,
                                            rooms.space({.outline = outline}, {}));
    EXPECT_EQ(field.reachable(Eigen::Vector2d(0.6, 1.0)), &rooms == &open);
    std::set<double> turned_rad;  // off the way, of steps
    for (const NarrowEdge& edge : field.narrow_edges) {
      if (std::min(edge.from, edge.to) < field.map.size()) continue;
      const Pose2& from = field.narrow[edge.from - field.map.size()].pose;
      const Pose2& to = field.narrow[edge.to - field.map.size()].pose;
      const Eigen::Vector2d way = position(to) - position(from);
      if (way.norm() < 0.049) continue;  // a turn
      turned_rad.insert(std::abs(wrap_angle(std::atan2(way.y(), way.x()) - from.yaw_rad)));
    }
    return *turned_rad.rbegin();
  };
  EXPECT_LT(edges(open), 1.2);
  EXPECT_LT(edges(shut), 1.2);
}

}  // namespace
}  // namespace vantage
