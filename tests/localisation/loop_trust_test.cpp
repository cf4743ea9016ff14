// How sure a loop is, how far it is believed against the way, and what is no loop: of a robot in a
// room whose points it sees without noise.
#include <gtest/gtest.h>

#include <array>
#include <utility>

#include "tests/localisation/room_of_points.hpp"
#include "vantage/localisation/keyframe_graph.hpp"

namespace vantage {
namespace {

using test_room::kSureWheels_m;
using test_room::room_and_pillar;
using test_room::seen_from;
using test_room::tall;
using TrustRoom = test_room::InARoom;

/// Keyframes of a robot that goes as it is told, from where the world is turned.
class GuidedRobot {
 public:
  explicit GuidedRobot(const PointCloud& seen, const RegistrationOptions& registration = {})
      : graph_({.close = true}, registration) {
    graph_.begin(seen, kStart);
  }
  /// @return whether there are new loops
  bool go(const PointCloud& seen, double driven_m, const Pose2& T_previous_now = {},
          double sigma_m = kSureWheels_m, double sigma_rad = 0.001) {
    WheelStep step;
    step.T_previous_now = T_previous_now;
    step.covariance = Eigen::Vector3d(sigma_m, sigma_m, sigma_rad).cwiseAbs2().asDiagonal();
    step.driven_m = driven_m;
    graph_.add(seen, step);
    return graph_.close_loops();
  }
  [[nodiscard]] const KeyframeGraph& graph() const { return graph_; }
  /// Where it believes to be, from where it began.
  [[nodiscard]] Pose2 gone() const {
    return compose(inverse(kStart), graph_.T_world_bases().back());
  }

 private:
  static constexpr Pose2 kStart{1.5, -2.5, 0.4};
  KeyframeGraph graph_;
};

PointCloud walls_from(const Pose2& T_room_base) {
  return seen_from(T_room_base, test_room::walls());
}

/// The pillar where the wheels have it, the walls as from somewhere else.
PointCloud pillar_and_walls_from(const Pose2& T_room_base) {
  PointCloud seen = walls_from(T_room_base);
  append(seen, test_room::pillar());
  return seen;
}

/// 300 points on walls across either axis, of which a tenth may be trimmed, say 3 cm each; loops
/// share 5 mm and 1.5 mrad. Two of them make half of that. Whatever voxels are asked for.
TEST(LoopTrust, IsNoMoreThanWhatRegistrationsShare) {
  RegistrationOptions registration;
  registration.voxel_m = 0.06;
  PointCloud both = tall(test_room::walls());
  append(both, tall(test_room::pillar()));
  GuidedRobot robot(tall(test_room::walls()), registration);
  robot.go(tall(test_room::pillar()), 5.5, {}, 0.05, 0.05);
  EXPECT_FALSE(robot.go(both, 8.0));
  EXPECT_TRUE(robot.go(both, 1.0));
  const Eigen::Matrix3d covariance =
      robot.graph().covariances(std::array<std::size_t, 1>{3}).front();
  EXPECT_NEAR(covariance(0, 0), 1.435e-5, 6e-7);
  EXPECT_NEAR(covariance(1, 1), 1.435e-5, 6e-7);
  EXPECT_NEAR(covariance(2, 2), 1.9e-6, 2.5e-7);
}

/// The way to the room is weak. Two loops say that it has not drifted, two more that it has, and
/// between them the way is sure: each is off by half of that, headings at 4 m.
TEST(LoopTrust, EndsWhereALoopDoesNotFitAsideOrInItsHeading) {
  for (const auto& [off, fits] : {std::pair(Pose2{0.0, 0.15, 0.0}, true),
                                  {Pose2{0.0, 0.30, 0.0}, false},
                                  {Pose2{0.0, 0.0, 0.045}, true},
                                  {Pose2{0.0, 0.0, 0.08}, false}}) {
    GuidedRobot robot(test_room::walls());
    robot.go(test_room::pillar(), 5.5, {}, 0.1, 0.05);
    robot.go(pillar_and_walls_from({}), 8.0);
    EXPECT_TRUE(robot.go(pillar_and_walls_from({}), 1.0));
    robot.go(test_room::pillar(), 5.5);
    EXPECT_FALSE(robot.go(pillar_and_walls_from(off), 5.5)) << "it waits";
    EXPECT_EQ(robot.go(pillar_and_walls_from(off), 3.5), fits) << off.y_m << ' ' << off.yaw_rad;
    EXPECT_EQ(robot.graph().loops(), fits ? 4U : 2U);
    EXPECT_EQ(robot.graph().refused(), fits ? 0U : 2U);
  }
}

/// Four loops against two: those give way by a third, these by two.
TEST(LoopTrust, EndsWhereAnyOfTheLoopsDoesNotFit) {
  TrustRoom room(test_room::walls());
  room.go(test_room::pillar(), 5.5, 0.0, 0.1);
  room.go(room_and_pillar(0.0F, 0.0F), 8.0);
  for (const double driven_m : {1.0, 3.0, 3.0}) {
    EXPECT_TRUE(room.go(room_and_pillar(0.0F, 0.0F), driven_m));
  }
  EXPECT_EQ(room.graph().loops(), 4U);
  room.go(test_room::pillar(), 5.5);
  EXPECT_FALSE(room.go(room_and_pillar(0.21F, 0.0F), 5.5)) << "it waits";
  EXPECT_FALSE(room.go(room_and_pillar(0.21F, 0.0F), 3.5));
  EXPECT_EQ(room.graph().loops(), 4U);
  EXPECT_EQ(room.graph().refused(), 2U);
}

/// Wheels that are surer than a loop, 6.5 mm, which is off by 18 mm or by 50.
TEST(LoopTrust, IsAsFarAsTheLoopItselfMayBeOff) {
  for (const float off_m : {0.018F, 0.05F}) {
    TrustRoom room(test_room::walls());
    room.go(test_room::pillar(), 5.5);
    EXPECT_FALSE(room.go(room_and_pillar(off_m, 0.0F), 8.0));
    EXPECT_EQ(room.go(room_and_pillar(off_m, 0.0F), 1.0), off_m < 0.03F) << off_m;
  }
}

/// Of the last step as well: after it the walls are 21 cm off, before it there were none.
TEST(LoopTrust, IsOfTheWholeWay) {
  TrustRoom room(test_room::walls());
  room.go(test_room::pillar(), 5.5);
  EXPECT_FALSE(room.go(test_room::walls(0.21F), 8.0, 0.0, 0.05));
  EXPECT_TRUE(room.go(test_room::walls(0.21F), 1.0));
  EXPECT_NEAR(room.moved_m(), 0.21, 0.01);
}

/// It has turned by 0.1 rad more than its wheels say, good to 0.05 rad, and goes 2.1 m from there.
TEST(LoopTrust, KnowsThatATurnTakesTheWayBehindItAside) {
  const Pose2 turned{0.6, 0.0, 0.1};
  const Pose2 onward{2.1, 0.0, 0.0};
  const Pose2 there = compose(turned, onward);
  PointCloud in_room = test_room::walls();
  append(in_room, test_room::pillar());
  const PointCloud seen = seen_from(there, in_room);
  GuidedRobot robot(test_room::walls());
  robot.go(seen_from(turned, test_room::pillar()), 5.5, {0.6, 0.0, 0.0}, kSureWheels_m, 0.05);
  EXPECT_FALSE(robot.go(seen, 8.0, onward));
  EXPECT_TRUE(robot.go(seen, 3.5));
  EXPECT_NEAR(robot.gone().x_m, there.x_m, 0.01);
  EXPECT_NEAR(robot.gone().y_m, there.y_m, 0.01);
  EXPECT_NEAR(robot.gone().yaw_rad, there.yaw_rad, 3e-3);
}

/// 1.2 m off where the way is good to 30 cm to either axis.
TEST(LoopTrust, IsAsFarAsThreeTimesTheDrift) {
  const Pose2 off{1.2, 0.0, 0.0};
  PointCloud in_room = test_room::walls();
  append(in_room, test_room::pillar());
  GuidedRobot robot(test_room::walls());
  robot.go(seen_from(off, test_room::pillar()), 5.5, {}, 0.3);
  EXPECT_FALSE(robot.go(seen_from(off, in_room), 8.0));
  EXPECT_TRUE(robot.go(seen_from(off, in_room), 3.5));
  EXPECT_NEAR(robot.gone().x_m, 1.2, 0.02);
}

/// From near the first place to near the second, where it heads elsewhere each time.
TEST(LoopTrust, IsOfTwoPlacesAsOfOne) {
  const Pose2 second{2.1, 0.0, 0.5};
  const Pose2 near_first{0.3, -0.2, 0.3};
  const Pose2 near_second{2.4, 0.3, -0.2};
  const auto between = [](const Pose2& from, const Pose2& to) {
    return compose(inverse(from), to);
  };
  GuidedRobot robot(test_room::walls());
  robot.go(walls_from(second), 4.0, second);
  EXPECT_FALSE(robot.go(walls_from(near_first), 12.0, between(second, near_first)));
  EXPECT_TRUE(robot.go(walls_from(near_second), 3.5, between(near_first, near_second)));
  EXPECT_EQ(robot.graph().loops(), 2U);
  EXPECT_EQ(robot.graph().refused(), 0U);
  EXPECT_NEAR(robot.gone().y_m, 0.3, 5e-3);
}

TEST(LoopTrust, IsWholeWhereAllPointsMustAgree) {
  TrustRoom room(test_room::walls(), {.close = true, .min_agreement = 1.0});
  EXPECT_FALSE(room.stay(12.0));
  EXPECT_TRUE(room.stay(1.0));
}

/// Two walls leave the way along them open; a line of points leaves its heading open too.
TEST(LoopTrust, IsOfPlacesThatLeaveOneDirectionOpenAtMost) {
  test_room::Room two_walls;
  two_walls.across_y(1.935F, -1.0F, -15, 15);
  two_walls.across_y(-1.935F, 1.0F, -15, 15);
  TrustRoom corridor(tall(two_walls.seen));
  EXPECT_FALSE(corridor.go(tall(two_walls.seen), 12.0));
  EXPECT_TRUE(corridor.go(tall(two_walls.seen), 1.0));
  PointCloud line;
  for (int row = 0; row < 120; ++row) {
    line.points.emplace_back(2.985F, 0.015F, 0.015F + 0.03F * static_cast<float>(row));
    line.normals.emplace_back(-1.0F, 0.0F, 0.0F);
  }
  TrustRoom before_it(line);
  EXPECT_FALSE(before_it.go(line, 12.0));
  EXPECT_FALSE(before_it.go(line, 1.0));
  EXPECT_EQ(before_it.graph().loops(), 0U);
}

/// A hundred points of which two lie within 3 cm are no hundred; 4 cm apart they are.
TEST(LoopTrust, CountsPointsOfThreeCentimetresOnce) {
  for (const float apart_m : {0.02F, 0.04F}) {
    test_room::Room few;
    few.across_x(2.985F, -1.0F, -12, 13);
    few.across_x(-2.985F, 1.0F, -12, 13);
    few.across_y(1.935F, -1.0F, -12, 13);
    few.across_y(-1.935F, 1.0F, -12, 12);
    few.add(1.445F, -1.935F, 0.0F, 1.0F);
    few.seen.points.back().x() = few.seen.points[few.seen.size() - 2].x() + apart_m - 0.01F;
    few.seen.points[few.seen.size() - 2].x() -= 0.01F;
    ASSERT_EQ(few.seen.size(), 100U);
    TrustRoom room(few.seen);
    room.go(few.seen, 12.0);
    EXPECT_EQ(room.go(few.seen, 3.5), apart_m > 0.03F) << apart_m;
  }
}

/// However little a step of a registration has to be at last: it is never none at all.
TEST(KeyframeGraph, LetsRegistrationsComeToRest) {
  const Pose2 there{0.05, -0.03, 0.02};
  for (double RegistrationOptions::*tolerance :
       {&RegistrationOptions::tolerance_m, &RegistrationOptions::tolerance_rad}) {
    RegistrationOptions registration;
    registration.*tolerance = 1e-300;
    GuidedRobot robot(test_room::walls(), registration);
    robot.go(walls_from(there), 1.0, {}, 0.3, 0.3);
    EXPECT_NEAR(robot.gone().x_m, there.x_m, 3e-3);
    EXPECT_NEAR(robot.gone().y_m, there.y_m, 3e-3);
    EXPECT_NEAR(robot.gone().yaw_rad, there.yaw_rad, 2e-3);
  }
}

/// 45 cm are beyond the 40 cm of the second attempt.
TEST(KeyframeGraph, LooksForPartnersNoFartherThanTwice) {
  test_room::Room wall;
  wall.across_x(2.985F, -1.0F, -15, 15);
  test_room::Room nearer{{}, 0.45F};
  nearer.across_x(2.985F, -1.0F, -15, 15);
  RegistrationOptions registration;
  registration.max_correction_m = 1.0;
  GuidedRobot robot(tall(wall.seen), registration);
  robot.go(tall(nearer.seen), 1.0, {}, 0.3);
  EXPECT_NEAR(robot.gone().x_m, 0.0, 1e-9);
}

TEST(LoopTrust, BeginsWithTheFirstMetre) {
  const LoopOptions short_ways{.close = true, .min_way_m = 0.5};
  TrustRoom room(test_room::walls(), short_ways);
  EXPECT_FALSE(room.stay(1.0));
  EXPECT_TRUE(room.stay(1.0)) << "looked for after the first metre";
  TrustRoom slower(test_room::walls(), short_ways);
  EXPECT_FALSE(slower.stay(0.5));
  EXPECT_FALSE(slower.stay(1.0)) << "not before it";
}

/// Where it began it saw nothing.
TEST(LoopTrust, IsOnceWithinThreeMetresOfAPlaceThatIsNotTheFirst) {
  for (const double driven_m : {2.875, 3.0}) {
    TrustRoom room({});
    room.go(test_room::walls(2.1F), 2.0, 2.1);
    EXPECT_FALSE(room.go(test_room::walls(2.1F), 12.0));
    EXPECT_TRUE(room.go(test_room::walls(2.1F), 1.0));
    EXPECT_EQ(room.go(test_room::walls(2.1F), driven_m), driven_m == 3.0) << driven_m;
  }
}

/// Seven metres ago it saw more of the room, whose walls stood 30 cm nearer.
TEST(LoopTrust, IsOfNoPlaceThatItLeftJustNow) {
  PointCloud at_first = test_room::front();
  append(at_first, test_room::pillar());
  test_room::Room smaller{{}, 2.4F};
  smaller.across_x(2.685F, -1.0F, -15, 15);
  smaller.across_x(-2.685F, 1.0F, -15, 15);
  smaller.across_y(1.635F, -1.0F, -15, 15);
  smaller.across_y(-1.635F, 1.0F, -15, 15);
  append(smaller.seen, test_room::pillar(2.4F));
  TrustRoom room(at_first);
  room.go(smaller.seen, 6.0, 2.4);
  EXPECT_FALSE(room.go(room_and_pillar(2.4F, 2.4F), 7.0));
  EXPECT_TRUE(room.go(room_and_pillar(2.4F, 2.4F), 1.0));
}

/// A try counts that has a place to look at.
TEST(LoopTrust, TriesAgainAsSoonAsItSeesAPlace) {
  TrustRoom room(test_room::walls());
  EXPECT_FALSE(room.go({}, 12.0));
  EXPECT_FALSE(room.stay(0.5));
  EXPECT_TRUE(room.stay(1.0));
}

}  // namespace
}  // namespace vantage
