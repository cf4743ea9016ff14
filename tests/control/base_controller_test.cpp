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

}  // namespace
}  // namespace vantage
