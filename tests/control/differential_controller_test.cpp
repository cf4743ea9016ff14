// Pure pursuit and turns in place, on a unicycle without a simulator.
#include "vantage/control/differential_controller.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

namespace vantage {
namespace {

constexpr double kDrivePeriod_s = 0.025;

/// Exact motion of a unicycle at constant speed and turning rate.
Pose2 moved(const Pose2& pose, double v_m_s, double wz_rad_s, double time_s) {
  const double turn_rad = wz_rad_s * time_s;
  if (std::abs(turn_rad) < 1e-12) return compose(pose, {v_m_s * time_s, 0.0, 0.0});
  const double radius_m = v_m_s / wz_rad_s;
  return compose(pose,
                 {radius_m * std::sin(turn_rad), radius_m * (1.0 - std::cos(turn_rad)), turn_rad});
}

struct Ride {
  Pose2 end;
  double farthest_m = 0.0;  ///< from the path
  double duration_s = 0.0;
  double fastest_turn_rad_s = 0.0;
};

Ride ride(const Pose2& start, const std::vector<Pose2>& waypoints,
          const BaseControllerOptions& options = {}) {
  const DrivePath path(start, waypoints);
  DifferentialFollowing following;
  Ride ride{.end = start};
  for (int tick = 0; tick < 4000; ++tick) {
    const Twist2 twist = follow_path(path, ride.end, kDrivePeriod_s, options, following);
    EXPECT_EQ(twist.vy_m_s, 0.0);
    ride.end = moved(ride.end, twist.vx_m_s, twist.wz_rad_s, kDrivePeriod_s);
    ride.duration_s += kDrivePeriod_s;
    ride.fastest_turn_rad_s = std::max(ride.fastest_turn_rad_s, std::abs(twist.wz_rad_s));
    const Eigen::Vector2d p(ride.end.x_m, ride.end.y_m);
    ride.farthest_m =
        std::max(ride.farthest_m, (path.point(path.project(p, 0.0, path.length_m())) - p).norm());
    const Pose2 left = compose(inverse(ride.end), path.goal());
    if (std::hypot(left.x_m, left.y_m) < 0.005 && std::abs(left.yaw_rad) < 0.005) break;
  }
  return ride;
}

void expect_at(const Pose2& is, const Pose2& goal) {
  const Pose2 left = compose(inverse(is), goal);
  EXPECT_LT(std::hypot(left.x_m, left.y_m), 0.006);
  EXPECT_LT(std::abs(left.yaw_rad), 0.006);
}

RC_GTEST_PROP(PursuitCurvature, IsThatOfTheArcThroughThePoint, ()) {
  const double x_m = *rc::gen::inRange(1, 300) * 0.01;
  const double y_m = *rc::gen::inRange(-300, 300) * 0.01;
  const double curvature_per_m = pursuit_curvature({x_m, y_m});
  // The arc turns by twice the bearing of its end.
  const double turn_rad = 2.0 * std::atan2(y_m, x_m);
  const double length_m =
      curvature_per_m == 0.0 ? x_m : std::abs(turn_rad) / std::abs(curvature_per_m);
  const Pose2 end = moved({}, 1.0, curvature_per_m, length_m);
  RC_ASSERT(std::hypot(end.x_m - x_m, end.y_m - y_m) < 1e-9);
}

TEST(DifferentialController, CruisesStraightAlongAStraightPath) {
  const DrivePath path({}, std::vector<Pose2>{{5.0, 0.0, 0.0}});
  DifferentialFollowing following{.arc_m = 1.0, .v_m_s = 0.6};
  const BaseControllerOptions options;
  const Twist2 twist = follow_path(path, {1.0, 0.0, 0.0}, kDrivePeriod_s, options, following);
  EXPECT_DOUBLE_EQ(twist.vx_m_s, options.speed_m_s);
  EXPECT_DOUBLE_EQ(twist.wz_rad_s, 0.0);
}

TEST(DifferentialController, BesideThePathItTakesTheArcToThePointAhead) {
  const DrivePath path({}, std::vector<Pose2>{{5.0, 0.0, 0.0}});
  const BaseControllerOptions options{
      .speed_m_s = 0.3, .turn_acceleration_rad_s2 = 5.0, .lookahead_m = 0.4};
  constexpr double kBeside_m = 0.02;
  DifferentialFollowing following{.arc_m = 1.0, .v_m_s = options.speed_m_s};
  const Twist2 twist = follow_path(path, {1.0, kBeside_m, 0.0}, kDrivePeriod_s, options, following);
  EXPECT_NEAR(twist.wz_rad_s, -0.3 * 2.0 * kBeside_m / (0.4 * 0.4 + kBeside_m * kBeside_m), 1e-12);
}

TEST(DifferentialController, LooksFartherAheadTheFasterItGoesButNotPastACorner) {
  const std::vector<Pose2> bent = {{2.0, 0.0, 0.0}, {2.0, 2.0, 0.0}};
  const DrivePath path({}, bent);
  DifferentialFollowing following{.arc_m = 1.7, .v_m_s = 0.6};
  EXPECT_EQ(follow_path(path, {1.7, 0.0, 0.0}, kDrivePeriod_s, {}, following).wz_rad_s, 0.0)
      << "the corner is 0.3 m ahead, the point as well";
  following = {.arc_m = 1.95, .v_m_s = 0.1};
  EXPECT_GT(follow_path(path, {1.95, 0.0, 0.0}, kDrivePeriod_s, {}, following).wz_rad_s, 0.0)
      << "within lookahead_m it looks round it";
}

TEST(DifferentialController, DoesNotWeaveAtSpeed) {
  const Ride straight = ride({0.0, 0.05, 0.0}, {{0.1, 0.0, 0.0}, {6.0, 0.0, 0.0}});
  EXPECT_LT(straight.farthest_m, 0.035);
  EXPECT_LT(straight.duration_s, 15.0);
}

TEST(DifferentialController, TurnsInPlaceBeforeItSetsOut) {
  const DrivePath path({}, std::vector<Pose2>{{-2.0, 0.0, std::numbers::pi}});
  DifferentialFollowing following;
  Pose2 pose;
  double turned_rad = 0.0;
  while (turned_rad < std::numbers::pi - 0.1) {
    const Twist2 twist = follow_path(path, pose, kDrivePeriod_s, {}, following);
    ASSERT_EQ(twist.vx_m_s, 0.0) << "at " << turned_rad;
    turned_rad += std::abs(twist.wz_rad_s) * kDrivePeriod_s;
    pose = moved(pose, 0.0, twist.wz_rad_s, kDrivePeriod_s);
  }
}

TEST(DifferentialController, GoesRoundASquareWithoutLeavingItFar) {
  const std::vector<Pose2> square = {
      {1.5, 0.0, 0.0}, {1.5, 1.5, 0.0}, {0.0, 1.5, 0.0}, {0.0, 0.0, std::numbers::pi / 2.0}};
  const Ride round = ride({}, square);
  expect_at(round.end, square.back());
  EXPECT_LT(round.farthest_m, 0.04) << "the planner's margin";
  EXPECT_LE(round.fastest_turn_rad_s, BaseControllerOptions{}.turn_rate_rad_s + 1e-9);
  EXPECT_LT(round.duration_s, 30.0);
}

TEST(DifferentialController, TurnsToAHeadingWhereItStands) {
  const Ride turn = ride({1.0, 2.0, 0.0}, {{1.0, 2.0, 2.5}});
  expect_at(turn.end, {1.0, 2.0, 2.5});
  EXPECT_LT(turn.farthest_m, 1e-3);
}

TEST(DifferentialController, ComesBackToAGoalJustBehindIt) {
  const Ride back = ride({0.1, 0.0, 0.0}, {{0.05, 0.002, 0.0}});
  expect_at(back.end, {0.05, 0.002, 0.0});
  EXPECT_LT(back.duration_s, 6.0) << "backwards, not by turning about";
}

RC_GTEST_PROP(DifferentialController, ArrivesFromAnywhere, ()) {
  const auto metres = [] { return *rc::gen::inRange(-200, 200) * 0.01; };
  const auto angle = [] { return *rc::gen::inRange(-314, 314) * 0.01; };
  const Pose2 start{metres(), metres(), angle()};
  const std::vector<Pose2> goal = {{metres(), metres(), 0.0}, {metres(), metres(), angle()}};
  const Pose2 left = compose(inverse(ride(start, goal).end), goal.back());
  RC_ASSERT(std::hypot(left.x_m, left.y_m) < 0.006);
  RC_ASSERT(std::abs(left.yaw_rad) < 0.006);
}

/// One tick on a straight path along x, from `pose` on.
Twist2 one_tick(const Pose2& pose, DifferentialFollowing& following, double length_m = 5.0) {
  const DrivePath path({}, std::vector<Pose2>{{length_m, 0.0, 0.0}});
  return follow_path(path, pose, kDrivePeriod_s, {}, following);
}

TEST(DifferentialController, LooksAheadByItsSpeedAndTurnsNoFasterThanItCanEnd) {
  DifferentialFollowing following{.arc_m = 1.0, .v_m_s = 0.5, .wz_rad_s = -0.12};
  const Twist2 twist = one_tick({1.0, 0.02, 0.0}, following);
  EXPECT_NEAR(twist.vx_m_s, 0.5125, 1e-12);
  // The point is 0.6 s ahead; the arc there would ask for 0.227 rad/s.
  EXPECT_NEAR(twist.wz_rad_s, -2.0 * std::atan2(0.02, 0.3), 1e-12);
  following = {.arc_m = 1.0, .v_m_s = 0.5, .wz_rad_s = 0.0};
  EXPECT_NEAR(one_tick({1.0, 0.02, 0.0}, following).wz_rad_s, -0.03, 1e-12) << "in one period";
}

TEST(DifferentialController, SlowsForTightArcs) {
  DifferentialFollowing following{.arc_m = 1.0, .v_m_s = 0.07};
  EXPECT_NEAR(one_tick({1.0, 0.0, -0.6}, following).vx_m_s, 0.8 * 0.1 / (2.0 * std::sin(0.6)),
              1e-12);
}

TEST(DifferentialController, BeginsToTurnInPlaceLaterThanItEnds) {
  const auto turns = [](double bearing_rad, bool turning) {
    DifferentialFollowing following{.arc_m = 1.0, .turning = turning};
    const Twist2 twist = one_tick({1.0, 0.0, -bearing_rad}, following);
    EXPECT_EQ(twist.vx_m_s == 0.0, following.turning);
    return following.turning;
  };
  EXPECT_FALSE(turns(0.69, false));
  EXPECT_TRUE(turns(0.71, false));
  EXPECT_TRUE(turns(0.051, true));
  EXPECT_FALSE(turns(0.049, true));
  EXPECT_TRUE(turns(-0.71, false));
}

TEST(DifferentialController, LeavesTheGoalsHeadingFartherOffThanItTakesIt) {
  const auto aligns = [](double off_m, bool aligning) {
    DifferentialFollowing following{.arc_m = 1.0, .aligning = aligning};
    one_tick({1.0, off_m, 0.3}, following, 1.0);
    return following.aligning;
  };
  EXPECT_TRUE(aligns(0.0029, false));
  EXPECT_FALSE(aligns(0.0031, false));
  EXPECT_TRUE(aligns(0.0044, true));
  EXPECT_FALSE(aligns(0.0046, true));
  EXPECT_TRUE(aligns(-0.0029, false));
}

TEST(DifferentialController, AlignsBrakingAsItTurns) {
  const DrivePath path({}, std::vector<Pose2>{{1.0, 0.0, 0.5}});
  DifferentialFollowing following{.arc_m = 1.0, .v_m_s = 0.2, .wz_rad_s = 0.79};
  const Twist2 twist = follow_path(path, {1.0, 0.0, 0.0}, kDrivePeriod_s, {}, following);
  EXPECT_NEAR(twist.vx_m_s, 0.2 - 0.0125, 1e-12);
  EXPECT_NEAR(twist.wz_rad_s, 0.8, 1e-12);
  following = {.arc_m = 1.0, .wz_rad_s = 0.18};
  EXPECT_NEAR(follow_path(path, {1.0, 0.0, 0.4}, kDrivePeriod_s, {}, following).wz_rad_s, 0.2,
              1e-12);
}

TEST(DifferentialController, DrivesBackToAGoalThatIsNear) {
  DifferentialFollowing following{.arc_m = 1.0};
  EXPECT_NEAR(one_tick({1.14, 0.0, 0.0}, following, 1.0).vx_m_s, -0.0125, 1e-12);
  following = {.arc_m = 1.0};
  EXPECT_EQ(one_tick({1.16, 0.0, 0.0}, following, 1.0).vx_m_s, 0.0);
  EXPECT_TRUE(following.turning);
  // Within reach of its speed at so near a goal: 0.1 m/s for 0.05 m.
  following = {.arc_m = 1.0, .v_m_s = -0.1};
  EXPECT_NEAR(one_tick({1.05, 0.0, 0.0}, following, 1.0).vx_m_s, -0.1, 1e-12);
}

TEST(PursuitCurvature, OfKnownArcs) {
  EXPECT_NEAR(pursuit_curvature({0.3, 0.1}), 2.0, 1e-12);
  EXPECT_NEAR(pursuit_curvature({0.0, -0.5}), -4.0, 1e-12);
  EXPECT_EQ(pursuit_curvature({0.0, 0.0}), 0.0);
}

TEST(DifferentialController, LooksPastBendsButNotPastCorners) {
  for (const double bend_rad : {0.2, 0.4}) {
    const Pose2 end{2.0 + 2.0 * std::cos(bend_rad), 2.0 * std::sin(bend_rad), 0.0};
    const DrivePath path({}, std::vector<Pose2>{{2.0, 0.0, 0.0}, end});
    DifferentialFollowing following;
    following.arc_m = 1.8;
    following.v_m_s = 0.6;
    const Twist2 twist = follow_path(path, {1.8, 0.0, 0.0}, kDrivePeriod_s, {}, following);
    EXPECT_EQ(twist.wz_rad_s > 0.0, bend_rad < 0.3) << bend_rad;
  }
}

TEST(DifferentialController, TurnsForTheSpeedThatItReachesWithinThePeriod) {
  BaseControllerOptions options;
  options.speed_m_s = 0.3;
  options.turn_acceleration_rad_s2 = 5.0;
  options.lookahead_m = 0.4;
  const DrivePath path({}, std::vector<Pose2>{{5.0, 0.0, 0.0}});
  DifferentialFollowing following;
  following.arc_m = 1.0;
  following.v_m_s = 0.2;
  const Twist2 twist = follow_path(path, {1.0, 0.02, 0.0}, kDrivePeriod_s, options, following);
  EXPECT_NEAR(twist.vx_m_s, 0.2125, 1e-12);
  EXPECT_NEAR(twist.wz_rad_s, -0.2125 * 2.0 * 0.02 / (0.4 * 0.4 + 0.02 * 0.02), 1e-12);
}

TEST(DifferentialController, FindsItselfWithinTwoLookaheadsOfWhereItWas) {
  for (const auto& [x_m, arc_m] : {std::pair(0.69, 0.69), {0.85, 0.7}}) {
    DifferentialFollowing following;
    following.arc_m = 0.5;
    one_tick({x_m, 0.0, 0.0}, following);
    EXPECT_NEAR(following.arc_m, arc_m, 1e-12);
  }
}

TEST(DifferentialController, NearItsGoalGoesByTheWayThatIsLeftNotByThePath) {
  DifferentialFollowing following;
  following.arc_m = 0.97;
  following.turning = true;
  // The goal is 73 degrees to the left: it turns there rather than its back to it.
  EXPECT_NEAR(one_tick({0.97, -0.1, 0.0}, following, 1.0).wz_rad_s, 0.03, 1e-12);
  const DrivePath path({}, std::vector<Pose2>{{1.0, 0.0, 0.0}});
  following = {};
  following.arc_m = 0.75;
  following.v_m_s = 0.45;
  // The point ahead is the end itself.
  const Twist2 twist = follow_path(path, {0.75, 0.05, 0.0}, 1.0, {}, following);
  EXPECT_NEAR(twist.vx_m_s, std::sqrt(0.7 * (std::hypot(0.25, 0.05) - 0.04375)), 1e-9);
}

}  // namespace
}  // namespace vantage
