#include "vantage/control/base_controller.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vantage {
namespace {

constexpr double kPeriod_s = 0.025;

/// An L:   2----3     1 m each
///         |          (the corner is a right angle)
///         1
const std::vector<Pose2> kCorner = {{0.0, 1.0, 0.0}, {1.0, 1.0, std::numbers::pi / 2.0}};

/// Drives a base that does what it is told.
struct IdealRun {
  Pose2 end;
  double fastest_m_s = 0.0;
  double sharpest_m_s2 = 0.0;
  double max_off_m = 0.0;
  double time_s = 0.0;
};
IdealRun run(const Pose2& start, const std::vector<Pose2>& waypoints,
             const BaseControllerOptions& options = {}) {
  const DrivePath path(start, waypoints);
  PathFollowing following;
  IdealRun result{.end = start};
  Eigen::Vector2d before = Eigen::Vector2d::Zero();
  for (; result.time_s < 60.0; result.time_s += kPeriod_s) {
    const Twist2 twist = follow_path(path, result.end, kPeriod_s, options, following);
    const Eigen::Vector2d v = following.v_world_m_s;
    EXPECT_NEAR(std::hypot(twist.vx_m_s, twist.vy_m_s), v.norm(), 1e-12);
    result.fastest_m_s = std::max(result.fastest_m_s, v.norm());
    result.sharpest_m_s2 = std::max(result.sharpest_m_s2, (v - before).norm() / kPeriod_s);
    before = v;
    result.end = compose(result.end, {twist.vx_m_s * kPeriod_s, twist.vy_m_s * kPeriod_s,
                                      twist.wz_rad_s * kPeriod_s});
    const Eigen::Vector2d p(result.end.x_m, result.end.y_m);
    const double nearest_m = (path.point(path.project(p, 0.0, path.length_m())) - p).norm();
    result.max_off_m = std::max(result.max_off_m, nearest_m);
    const Pose2 left = compose(inverse(result.end), path.goal());
    if (std::hypot(left.x_m, left.y_m) < 0.003 && std::abs(left.yaw_rad) < 0.003) break;
  }
  return result;
}

TEST(DrivePath, KnowsLengthPointsAndHeadings) {
  const DrivePath path({0.0, 0.0, 0.0}, kCorner);
  EXPECT_NEAR(path.length_m(), 2.0, 1e-12);
  EXPECT_NEAR(path.turn_rad(), std::numbers::pi / 2.0, 1e-12);
  EXPECT_TRUE(path.point(0.5).isApprox(Eigen::Vector2d(0.0, 0.5)));
  EXPECT_TRUE(path.point(1.25).isApprox(Eigen::Vector2d(0.25, 1.0)));
  EXPECT_TRUE(path.point(9.0).isApprox(Eigen::Vector2d(1.0, 1.0)));
  EXPECT_NEAR(path.yaw(1.0), std::numbers::pi / 4.0, 1e-12);
  EXPECT_NEAR(path.project({0.2, 0.5}, 0.0, 2.0), 0.5, 1e-12);
  EXPECT_NEAR(path.project({0.5, 1.1}, 0.0, 2.0), 1.5, 1e-12);
  EXPECT_NEAR(path.project({0.5, 1.1}, 0.0, 0.4), 0.4, 1e-12) << "only where it was asked";
}

TEST(DrivePath, RepeatedPointsAndEmptyPaths) {
  const std::vector<Pose2> repeated = {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  EXPECT_NEAR(DrivePath({0, 0, 0}, repeated).length_m(), 2.0, 1e-12);
  const DrivePath nowhere({1.0, 2.0, 0.5}, {});
  EXPECT_EQ(nowhere.length_m(), 0.0);
  EXPECT_EQ(nowhere.goal().yaw_rad, 0.5);
  EXPECT_TRUE(nowhere.point(0.3).isApprox(Eigen::Vector2d(1.0, 2.0)));
}

TEST(DrivePath, SlowsForCornersAndTheEnd) {
  const DrivePath path({0.0, 0.0, 0.0}, kCorner);
  const BaseControllerOptions options;
  const double in_corner_m_s = path.speed_limit(1.0, options);
  EXPECT_NEAR(in_corner_m_s, std::sqrt(0.4 * 0.5 * 0.1), 1e-9)
      << "the radius at a right angle is the lookahead";
  EXPECT_EQ(path.speed_limit(0.2, options), options.speed_m_s);
  EXPECT_LT(path.speed_limit(0.85, options), options.speed_m_s);
  EXPECT_NEAR(path.speed_limit(2.0, options), 0.0, 1e-12);
  const std::vector<Pose2> straight = {{0.5, 0, 0}, {1, 0, 0}, {3, 0, 0}};
  EXPECT_EQ(DrivePath({0, 0, 0}, straight).speed_limit(0.5, options), options.speed_m_s)
      << "a point on a straight line is no corner";
}

TEST(FollowPath, ArrivesWithinItsLimits) {
  const BaseControllerOptions options;
  const IdealRun result = run({0.0, 0.0, 0.0}, kCorner);
  EXPECT_NEAR(result.end.x_m, 1.0, 0.003);
  EXPECT_NEAR(result.end.y_m, 1.0, 0.003);
  EXPECT_NEAR(result.end.yaw_rad, std::numbers::pi / 2.0, 0.003);
  EXPECT_LE(result.fastest_m_s, options.speed_m_s + 1e-12);
  EXPECT_LE(result.sharpest_m_s2, options.acceleration_m_s2 + 1e-9);
  EXPECT_LT(result.max_off_m, 0.05);
  EXPECT_LT(result.time_s, 12.0);
}

TEST(FollowPath, TheHeadingTurnsTheShortWay) {
  const IdealRun result = run({0.0, 0.0, 3.0}, {{1.0, 0.0, -3.0}});
  EXPECT_NEAR(wrap_angle(result.end.yaw_rad + 3.0), 0.0, 0.003);
  const DrivePath path({0.0, 0.0, 3.0}, std::vector<Pose2>{{1.0, 0.0, -3.0}});
  EXPECT_NEAR(path.turn_rad(), 2.0 * std::numbers::pi - 6.0, 1e-9);
}

TEST(FollowPath, TurnsInPlace) {
  const IdealRun result = run({1.0, 1.0, 0.0}, {{1.0, 1.0, 2.0}});
  EXPECT_NEAR(result.end.yaw_rad, 2.0, 0.003);
  EXPECT_NEAR(result.end.x_m, 1.0, 1e-9);
  EXPECT_LT(result.time_s, 8.0);
}

TEST(FollowPath, TurnsBackOnItself) {
  const IdealRun result = run({0.0, 0.0, 0.0}, {{1.0, 0.0, 0.0}, {0.5, 0.0, 0.0}});
  EXPECT_NEAR(result.end.x_m, 0.5, 0.004);
  EXPECT_LT(result.time_s, 15.0);
}

TEST(ApproachSpeed, IsProportionalNearTheStopAndBrakesEvenlyBefore) {
  // 0.35 m/s^2 of braking: proportional up to 0.0875 m.
  EXPECT_NEAR(approach_speed(0.05, 0.5, 2.0), 0.1, 1e-12);
  EXPECT_NEAR(approach_speed(0.0875, 0.5, 2.0), 0.175, 1e-12);
  EXPECT_NEAR(approach_speed(0.3, 0.5, 2.0), std::sqrt(0.7 * (0.3 - 0.04375)), 1e-12);
  EXPECT_EQ(approach_speed(0.0, 0.5, 2.0), 0.0);
}

/// Turns of 90 degrees to the left after 2 m and of 45 degrees to the right after 3 m.
TEST(DrivePath, KnowsItsNextCorner) {
  const DrivePath path({}, std::vector<Pose2>{{2, 0, 0}, {2, 1, 0}, {3, 2, 0}});
  EXPECT_NEAR(path.length_m(), 3.0 + std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(path.next_corner(0.0, 0.3), 2.0, 1e-12);
  EXPECT_NEAR(path.next_corner(2.0, 0.3), 2.0, 1e-12);
  EXPECT_NEAR(path.next_corner(2.1, 0.3), 3.0, 1e-12);
  EXPECT_NEAR(path.next_corner(2.1, 0.78), 3.0, 1e-12);
  EXPECT_NEAR(path.next_corner(2.1, 0.79), path.length_m(), 1e-12);
  EXPECT_NEAR(path.next_corner(0.0, 1.58), path.length_m(), 1e-12);
  EXPECT_NEAR(path.next_corner(3.1, 0.3), path.length_m(), 1e-12);
}

TEST(DrivePath, LimitsItsSpeedByWhatIsAhead) {
  const BaseControllerOptions options;
  const DrivePath square({}, std::vector<Pose2>{{5, 0, 0}, {5, 5, 0}});
  EXPECT_NEAR(square.speed_limit(4.7, options), 0.4, 1e-9) << "0.2 m before the curve";
  EXPECT_NEAR(square.speed_limit(4.95, options), std::sqrt(0.02), 1e-9);
  EXPECT_EQ(square.speed_limit(5.01, options), 0.6);
  EXPECT_NEAR(square.speed_limit(9.95, options), 0.1, 1e-9);
  const DrivePath half({}, std::vector<Pose2>{{5, 0, 0}, {9, 4, 0}});
  const double radius_m = 0.1 / std::tan(std::numbers::pi / 8.0);
  EXPECT_NEAR(half.speed_limit(5.0, options), std::sqrt(0.4 * 0.5 * radius_m), 1e-9);
  const DrivePath back({}, std::vector<Pose2>{{5, 0, 0}, {2, 0, 0}});
  EXPECT_NEAR(back.speed_limit(5.0, options), std::sqrt(0.4 * 0.5 * 0.1 / std::tan(1.4)), 1e-9);
}

TEST(DrivePath, TurnsEvenlyAlongItsWay) {
  const DrivePath path({0.0, 0.0, 0.5}, std::vector<Pose2>{{4, 0, 1.5}});
  EXPECT_NEAR(path.yaw(1.0), 0.75, 1e-12);
  EXPECT_NEAR(path.yaw(-1.0), 0.5, 1e-12);
  EXPECT_NEAR(path.yaw(9.0), 1.5, 1e-12);
  EXPECT_TRUE(path.point(-1.0).isApprox(Eigen::Vector2d(0.0, 0.0)));
  EXPECT_NEAR(path.project({2.0, 1.0}, 0.5, 3.0), 2.0, 1e-12);
  EXPECT_NEAR(path.project({-2.0, 1.0}, 0.5, 3.0), 0.5, 1e-12);
  EXPECT_NEAR(path.project({9.0, 1.0}, 0.5, 3.0), 3.0, 1e-12);
}

/// 6 cm beside a straight path it steers for the point 10 cm ahead, and changes its velocity by
/// 0.5 m/s^2 in a period of 25 ms.
TEST(FollowPath, SteersForThePointAhead) {
  const DrivePath path({}, std::vector<Pose2>{{5, 0, 1.0}});
  PathFollowing following{.arc_m = 0.95, .v_world_m_s = {0.3, 0.0}, .wz_rad_s = 0.01};
  const Twist2 twist = follow_path(path, {1.0, 0.06, 0.2}, kPeriod_s, {}, following);
  const Eigen::Vector2d wanted = 0.6 * Eigen::Vector2d(0.1, -0.06).normalized();
  const Eigen::Vector2d change = wanted - Eigen::Vector2d(0.3, 0.0);
  const Eigen::Vector2d v = Eigen::Vector2d(0.3, 0.0) + 0.0125 * change.normalized();
  EXPECT_NEAR(following.arc_m, 1.0, 1e-12);
  EXPECT_LT((following.v_world_m_s - v).norm(), 1e-12);
  EXPECT_NEAR(twist.vx_m_s, std::cos(0.2) * v.x() + std::sin(0.2) * v.y(), 1e-12);
  EXPECT_NEAR(twist.vy_m_s, std::cos(0.2) * v.y() - std::sin(0.2) * v.x(), 1e-12);
  // Of 1 rad along 5 m it is to have turned by 0.22 rad at the point ahead: 0.02 rad are left.
  EXPECT_NEAR(twist.wz_rad_s, 0.04, 1e-12) << "as 0.03 more are allowed";
  following.wz_rad_s = 0.0;
  EXPECT_NEAR(follow_path(path, {1.0, 0.06, 0.2}, kPeriod_s, {}, following).wz_rad_s, 0.03, 1e-12);
  following.wz_rad_s = -0.5;
  EXPECT_NEAR(follow_path(path, {1.0, 0.06, 0.2}, kPeriod_s, {}, following).wz_rad_s, -0.47, 1e-12);
  following.wz_rad_s = -0.79;
  EXPECT_NEAR(follow_path(path, {1.0, 0.06, 2.2}, kPeriod_s, {}, following).wz_rad_s, -0.8, 1e-12)
      << "no faster turn than allowed";
}

TEST(FollowPath, ComesToRestAtTheEndWhereverItIsBesideIt) {
  const DrivePath path({}, std::vector<Pose2>{{1, 0, 0}});
  PathFollowing following{.arc_m = 0.95, .v_world_m_s = {0.06, -0.04}, .wz_rad_s = 0.0};
  const Twist2 twist = follow_path(path, {0.97, 0.02, 0.0}, kPeriod_s, {}, following);
  EXPECT_NEAR(twist.vx_m_s, 0.06, 1e-12);
  EXPECT_NEAR(twist.vy_m_s, -0.04, 1e-12);
  EXPECT_EQ(twist.wz_rad_s, 0.0);
}

TEST(FollowPath, FindsItselfWithinTwoLookaheadsOfWhereItWas) {
  const DrivePath path({}, std::vector<Pose2>{{5, 0, 0}});
  for (const auto& [x_m, arc_m] : {std::pair(0.69, 0.69), {0.85, 0.7}}) {
    PathFollowing following;
    following.arc_m = 0.5;
    follow_path(path, {x_m, 0.0, 0.0}, kPeriod_s, {}, following);
    EXPECT_NEAR(following.arc_m, arc_m, 1e-12);
  }
}

TEST(DrivePath, TakesTheFirstOfTwoNearestPointsAndCountsEveryCornerAhead) {
  const DrivePath corner({}, kCorner);
  EXPECT_NEAR(corner.project({0.5, 0.5}, 0.0, 2.0), 0.5, 1e-12) << "as near to 1.5";
  EXPECT_EQ(DrivePath({}, std::vector<Pose2>{{0.7e-6, 0, 0}}).length_m(), 0.0);
  EXPECT_GT(DrivePath({}, std::vector<Pose2>{{1.5e-6, 0, 0}}).length_m(), 0.0);
  const DrivePath steps({}, std::vector<Pose2>{{2, 0, 0}, {2, 2, 0}, {4, 2, 0}});
  EXPECT_NEAR(steps.speed_limit(3.7, {}), 0.4, 1e-9) << "one is behind, one 0.3 m ahead";
}

/// From (3, 4) / 5 by 45 degrees to either side: no leg lies along an axis.
TEST(DrivePath, ABendIsAsSharpWhicheverWayItGoes) {
  const double radius_m = 0.1 / std::tan(std::numbers::pi / 8.0);
  for (const double side : {1.0, -1.0}) {
    const double bearing_rad = std::atan2(4.0, 3.0) + side * std::numbers::pi / 4.0;
    const Pose2 end{3.0 + 4.0 * std::cos(bearing_rad), 4.0 + 4.0 * std::sin(bearing_rad), 0.0};
    const DrivePath path({}, std::vector<Pose2>{{3, 4, 0}, end});
    EXPECT_NEAR(path.speed_limit(5.0, {}), std::sqrt(0.4 * 0.5 * radius_m), 1e-9) << side;
  }
}

/// By the tangent of half its angle, with a lookahead so short that even such a bend would count.
TEST(DrivePath, ABendOfLessThanAThousandthIsNone) {
  BaseControllerOptions options;
  options.lookahead_m = 1e-4;
  const auto limit_m_s = [&](double half_tan) {
    const double turn_rad = 2.0 * std::atan(half_tan);
    const Pose2 end{5.0 + 5.0 * std::cos(turn_rad), 5.0 * std::sin(turn_rad), 0.0};
    return DrivePath({}, std::vector<Pose2>{{5, 0, 0}, end}).speed_limit(5.0, options);
  };
  EXPECT_EQ(limit_m_s(0.9e-3), 0.6);
  EXPECT_NEAR(limit_m_s(1.1e-3), std::sqrt(0.4 * 0.5 * 1e-4 / 1.1e-3), 1e-9);
}

/// 5 cm beside the path, 10 cm before its end, which is just the point ahead.
TEST(FollowPath, WhereThePointAheadIsTheEndTheWayThatIsLeftCounts) {
  const DrivePath path({}, std::vector<Pose2>{{1, 0, 0}});
  PathFollowing following;
  following.arc_m = 0.9;
  const Twist2 twist = follow_path(path, {0.9, 0.05, 0.0}, 1.0, {}, following);
  EXPECT_NEAR(std::hypot(twist.vx_m_s, twist.vy_m_s),
              std::sqrt(0.7 * (std::hypot(0.1, 0.05) - 0.04375)), 1e-9);
}

TEST(FollowPath, WithinANanometreItHasArrived) {
  const DrivePath path({}, std::vector<Pose2>{{1, 0, 0}});
  for (const double off_m : {0.7e-9, 1.5e-9}) {
    PathFollowing following;
    following.arc_m = 1.0;
    const Twist2 twist = follow_path(path, {1.0 - off_m, 0.0, 0.0}, kPeriod_s, {}, following);
    EXPECT_EQ(twist.vx_m_s == 0.0, off_m < 1e-9) << off_m;
  }
}

}  // namespace
}  // namespace vantage
