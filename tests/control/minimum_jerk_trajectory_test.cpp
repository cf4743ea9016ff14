#include "vantage/control/minimum_jerk_trajectory.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "vantage/core/error.hpp"
#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

std::vector<FlightWaypoint> random_waypoints(std::size_t count, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<FlightWaypoint> waypoints(count);
  for (FlightWaypoint& waypoint : waypoints) {
    waypoint.p_world_m = {rng.uniform(-3.0, 3.0), rng.uniform(-3.0, 3.0), rng.uniform(0.5, 2.0)};
    waypoint.yaw_rad = rng.uniform(-3.1, 3.1);
  }
  return waypoints;
}

TEST(MinimumJerkTrajectory, RestToRestIsTheQuinticOfLeastJerk) {
  const FlightWaypoint goal{.p_world_m = {2.0, 0.0, 0.0}};
  const MinimumJerkTrajectory path({}, std::span(&goal, 1));
  const double T = path.duration_s();
  EXPECT_NEAR(T, 1.875 * 2.0 / 1.0, 1e-9) << "peak speed is 15/8 of the mean";
  for (const double s : {0.0, 0.2, 0.5, 0.9, 1.0}) {
    const double expected = 2.0 * (10.0 * s * s * s - 15.0 * s * s * s * s + 6.0 * std::pow(s, 5));
    EXPECT_NEAR(path.at(s * T).p_world_m.x(), expected, 1e-9) << s;
    EXPECT_NEAR(path.at(s * T).yaw_rad, 0.0, 1e-12) << s;
  }
}

RC_GTEST_PROP(MinimumJerkTrajectory, PassesItsWaypointsAndKeepsTheLimits, ()) {
  const auto count = static_cast<std::size_t>(*rc::gen::inRange(1, 12));
  const auto waypoints = random_waypoints(count, *rc::gen::arbitrary<std::uint64_t>());
  const FlightLimits limits{.speed_m_s = 0.8, .acceleration_m_s2 = 1.5, .yaw_rate_rad_s = 0.7};
  const MinimumJerkTrajectory path({.p_world_m = {0.0, 0.0, 1.0}, .yaw_rad = 0.3}, waypoints,
                                   limits);
  RC_ASSERT(path.knots_s().size() == count + 1);
  for (std::size_t i = 0; i < count; ++i) {
    const FlightReference there = path.at(path.knots_s()[i + 1]);
    RC_ASSERT((there.p_world_m - waypoints[i].p_world_m).norm() < 1e-6);
    RC_ASSERT(std::abs(wrap_angle(there.yaw_rad - waypoints[i].yaw_rad)) < 1e-6);
  }
  for (double t = 0.0; t < path.duration_s(); t += 0.01) {
    const FlightReference now = path.at(t);
    RC_ASSERT(now.v_world_m_s.norm() < 1.02 * limits.speed_m_s);
    RC_ASSERT(now.a_world_m_s2.norm() < 1.05 * limits.acceleration_m_s2);
    RC_ASSERT(std::abs(now.yaw_rate_rad_s) < 1.02 * limits.yaw_rate_rad_s);
  }
}

TEST(MinimumJerkTrajectory, DerivativesAreThoseOfThePosition) {
  const auto waypoints = random_waypoints(5, 3);
  const MinimumJerkTrajectory path({.p_world_m = {0.0, 0.0, 1.0}}, waypoints);
  constexpr double kStep_s = 1e-4;
  for (double t = 0.05; t < path.duration_s() - 0.05; t += 0.173) {
    const FlightReference a = path.at(t - kStep_s);
    const FlightReference b = path.at(t);
    const FlightReference c = path.at(t + kStep_s);
    EXPECT_LT(((c.p_world_m - a.p_world_m) / (2 * kStep_s) - b.v_world_m_s).norm(), 1e-5);
    EXPECT_LT(((c.v_world_m_s - a.v_world_m_s) / (2 * kStep_s) - b.a_world_m_s2).norm(), 1e-4);
    EXPECT_LT(((c.a_world_m_s2 - a.a_world_m_s2) / (2 * kStep_s) - b.j_world_m_s3).norm(), 1e-2);
    EXPECT_NEAR(wrap_angle(c.yaw_rad - a.yaw_rad) / (2 * kStep_s), b.yaw_rate_rad_s, 1e-5);
  }
}

TEST(MinimumJerkTrajectory, IsSmoothAtItsKnots) {
  const auto waypoints = random_waypoints(6, 8);
  const MinimumJerkTrajectory path({.p_world_m = {0.0, 0.0, 1.0}}, waypoints);
  for (std::size_t i = 1; i + 1 < path.knots_s().size(); ++i) {
    const double t = path.knots_s()[i];
    const FlightReference before = path.at(t - 1e-7);
    const FlightReference after = path.at(t + 1e-7);
    EXPECT_LT((after.v_world_m_s - before.v_world_m_s).norm(), 1e-5);
    EXPECT_LT((after.a_world_m_s2 - before.a_world_m_s2).norm(), 1e-5);
    EXPECT_LT((after.j_world_m_s3 - before.j_world_m_s3).norm(), 1e-4);
    EXPECT_GT(before.j_world_m_s3.norm(), 1e-2);
  }
}

TEST(MinimumJerkTrajectory, BeginsAsTheReferenceIsAndEndsAtRest) {
  const FlightReference start{.p_world_m = {1.0, 2.0, 3.0},
                              .v_world_m_s = {0.5, 0.1, 0.0},
                              .a_world_m_s2 = {0.0, 0.3, 0.0},
                              .yaw_rad = 1.0,
                              .yaw_rate_rad_s = 0.2};
  const FlightWaypoint goal{.p_world_m = {4.0, 3.0, 2.0}, .yaw_rad = 2.0};
  const MinimumJerkTrajectory path(start, std::span(&goal, 1));
  const FlightReference first = path.at(0.0);
  EXPECT_TRUE(first.p_world_m.isApprox(start.p_world_m, 1e-12));
  EXPECT_TRUE(first.v_world_m_s.isApprox(start.v_world_m_s, 1e-12));
  EXPECT_TRUE(first.a_world_m_s2.isApprox(start.a_world_m_s2, 1e-12));
  EXPECT_NEAR(first.yaw_rate_rad_s, 0.2, 1e-12);
  for (const double late_s : {0.0, 10.0}) {
    const FlightReference last = path.at(path.duration_s() + late_s);
    EXPECT_TRUE(last.p_world_m.isApprox(goal.p_world_m, 1e-9));
    EXPECT_LT(last.v_world_m_s.norm(), 1e-9);
    EXPECT_LT(last.a_world_m_s2.norm(), 1e-9);
    EXPECT_NEAR(last.yaw_rad, 2.0, 1e-9);
  }
}

TEST(MinimumJerkTrajectory, TurnsTheShortWay) {
  const FlightWaypoint goal{.p_world_m = {0.0, 0.0, 1.0}, .yaw_rad = -3.0};
  const MinimumJerkTrajectory path({.p_world_m = {0.0, 0.0, 1.0}, .yaw_rad = 3.0},
                                   std::span(&goal, 1));
  EXPECT_LT(path.duration_s(), 1.0);
  EXPECT_NEAR(std::abs(path.at(path.duration_s() / 2.0).yaw_rad), std::numbers::pi, 1e-6);
  EXPECT_GT(path.at(path.duration_s() / 2.0).yaw_rate_rad_s, 0.1);
}

TEST(MinimumJerkTrajectory, StaysWhereItIs) {
  const FlightWaypoint here{.p_world_m = {1.0, 1.0, 1.0}, .yaw_rad = 0.5};
  const MinimumJerkTrajectory path({.p_world_m = {1.0, 1.0, 1.0}, .yaw_rad = 0.5},
                                   std::span(&here, 1));
  EXPECT_LE(path.duration_s(), 0.2);
  EXPECT_TRUE(path.at(0.05).p_world_m.isApprox(here.p_world_m, 1e-12));
}

TEST(MinimumJerkTrajectory, WhatIsLeftOfItIsTheSamePath) {
  const auto waypoints = random_waypoints(5, 11);
  const MinimumJerkTrajectory path({.p_world_m = {0.0, 0.0, 1.0}, .yaw_rad = 3.0}, waypoints);
  for (const double since_s : {0.0, 0.3, path.knots_s()[2], 0.99 * path.duration_s()}) {
    const MinimumJerkTrajectory rest = path.from(since_s);
    EXPECT_NEAR(rest.duration_s(), path.duration_s() - since_s, 1e-12);
    for (double t = 0.0; t < rest.duration_s(); t += 0.07) {
      const FlightReference a = rest.at(t);
      const FlightReference b = path.at(since_s + t);
      EXPECT_LT((a.p_world_m - b.p_world_m).norm(), 1e-9);
      EXPECT_LT((a.a_world_m_s2 - b.a_world_m_s2).norm(), 1e-6);
      EXPECT_NEAR(wrap_angle(a.yaw_rad - b.yaw_rad), 0.0, 1e-9);
    }
  }
  EXPECT_EQ(path.from(path.knots_s()[2]).knots_s().size(), path.knots_s().size() - 2);
}

TEST(MinimumJerkTrajectory, RefusesLimitsOutOfRange) {
  const FlightWaypoint goal{.p_world_m = {2.0, 0.0, 0.0}};
  EXPECT_THROW(MinimumJerkTrajectory({}, std::span(&goal, 1), {.speed_m_s = 0.0}), ConfigError);
}

/// When it passes its knots, as shares of its duration: stretching does not change them.
std::vector<double> shares_of(const MinimumJerkTrajectory& path) {
  std::vector<double> shares;
  for (const double knot_s : path.knots_s()) shares.push_back(knot_s / path.duration_s());
  return shares;
}

std::vector<FlightWaypoint> along_x(const std::vector<double>& places_m) {
  std::vector<FlightWaypoint> waypoints;
  for (const double x_m : places_m) waypoints.push_back({.p_world_m = {x_m, 0.0, 0.0}});
  return waypoints;
}

/// 1.4 m/s^2 up to 1 m/s and down to rest: reached after 0.357 m.
TEST(MinimumJerkTrajectory, TimesItsKnotsByATrapezoidOfSpeed) {
  const double a = 1.4;
  const double up_m = 0.5 / a;
  const double total_s = 2.0 / a + (4.0 - 2.0 * up_m);
  const auto shares = shares_of(MinimumJerkTrajectory({}, along_x({0.2, 2.0, 3.9, 4.0})));
  EXPECT_NEAR(shares[1], std::sqrt(2.0 * 0.2 / a) / total_s, 1e-9);
  EXPECT_NEAR(shares[2], (1.0 / a + 2.0 - up_m) / total_s, 1e-9);
  EXPECT_NEAR(shares[3], 1.0 - std::sqrt(2.0 * 0.1 / a) / total_s, 1e-9);
}

TEST(MinimumJerkTrajectory, TimesAStartInMotionByItsSpeed) {
  const double a = 1.4;
  const double up_m = 0.75 / (2.0 * a);
  const double total_s = 1.5 / a + (4.0 - up_m - 0.5 / a);
  const FlightReference start{.v_world_m_s = {0.5, 0.0, 0.0}};
  const auto shares = shares_of(MinimumJerkTrajectory(start, along_x({0.2, 2.0, 4.0})));
  EXPECT_NEAR(shares[1], (0.9 - 0.5) / a / total_s, 1e-9) << "0.9 m/s after 0.2 m";
  EXPECT_NEAR(shares[2], (0.5 / a + 2.0 - up_m) / total_s, 1e-9);
}

TEST(MinimumJerkTrajectory, TimesAShortPathWithoutACruise) {
  const auto shares = shares_of(MinimumJerkTrajectory({}, along_x({0.125, 0.5})));
  EXPECT_NEAR(shares[1], 0.5 * std::sqrt(0.5), 1e-8);
}

TEST(MinimumJerkTrajectory, TurningCountsAsTheWayFlownInItsTime) {
  const std::vector<FlightWaypoint> waypoints{{.yaw_rad = -1.0},
                                              {.p_world_m = {2.0, 0.0, 0.0}, .yaw_rad = -1.0}};
  const auto shares = shares_of(MinimumJerkTrajectory({}, waypoints, {.yaw_rate_rad_s = 0.5}));
  EXPECT_NEAR(shares[1], 0.5, 1e-9) << "1 rad is as long as 2 m";
}

TEST(MinimumJerkTrajectory, TakesATenthOfASecondAtLeast) {
  const MinimumJerkTrajectory path({}, along_x({0.0, 0.0}));
  EXPECT_NEAR(path.knots_s()[1], 0.1, 1e-12);
  EXPECT_NEAR(path.duration_s(), 0.2, 1e-12);
}

TEST(MinimumJerkTrajectory, KnowsItsGoal) {
  const std::vector<FlightWaypoint> waypoints{{.p_world_m = {1.0, 2.0, 3.0}, .yaw_rad = 3.0},
                                              {.p_world_m = {2.0, 2.5, 3.5}, .yaw_rad = -3.0}};
  const FlightWaypoint goal = MinimumJerkTrajectory({}, waypoints).goal();
  EXPECT_EQ(goal.p_world_m, Eigen::Vector3d(2.0, 2.5, 3.5));
  EXPECT_NEAR(goal.yaw_rad, -3.0, 1e-12);
}

TEST(MinimumJerkTrajectory, HasItsJerkUpToBothEndsAndNoneAfterThem) {
  FlightWaypoint goal;
  goal.p_world_m = {2.0, 0.0, 0.0};
  const MinimumJerkTrajectory path({}, std::span(&goal, 1));
  const double T = path.duration_s();
  for (const double time_s : {-1.0, 0.0, T}) {
    EXPECT_NEAR(path.at(time_s).j_world_m_s3.x(), 120.0 / (T * T * T), 1e-9) << time_s;
  }
  EXPECT_TRUE(path.at(T + 1e-3).j_world_m_s3.isZero(0.0));
}

/// It cruises after 0.357 m.
TEST(MinimumJerkTrajectory, TimesTheFirstMetreOfItsCruise) {
  const double a = 1.4;
  const double up_m = 0.5 / a;
  const auto shares = shares_of(MinimumJerkTrajectory({}, along_x({1.0, 4.0})));
  EXPECT_NEAR(shares[1], (1.0 / a + 1.0 - up_m) / (2.0 / a + 4.0 - 2.0 * up_m), 1e-9);
}

/// From 1 m/s it takes 0.357 m to come to rest.
TEST(MinimumJerkTrajectory, TimesAStartTooFastForItsPathAsIfItBrakedAllTheWay) {
  const FlightReference start{.v_world_m_s = {1.0, 0.0, 0.0}};
  const auto shares = shares_of(MinimumJerkTrajectory(start, along_x({0.2, 0.35})));
  const double a = 1.4;
  EXPECT_NEAR(shares[1],
              (1.0 - std::sqrt(1.0 - 2.0 * a * 0.2)) / (1.0 - std::sqrt(1.0 - 2.0 * a * 0.35)),
              1e-9);
}

/// Jerk is of second order in time between two knots: three of its values tell it and its slope at
/// a knot, from either side.
TEST(MinimumJerkTrajectory, ItsSnapIsContinuousFromAStartInMotion) {
  FlightReference start;
  start.p_world_m = {0.0, 0.0, 1.0};
  start.v_world_m_s = {0.3, -0.2, 0.1};
  start.a_world_m_s2 = {-0.2, 0.1, 0.3};
  constexpr double kStep_s = 0.02;
  for (const std::size_t count : {std::size_t{2}, std::size_t{6}}) {
    const MinimumJerkTrajectory path(start, random_waypoints(count, 8));
    double greatest = 0.0;
    for (std::size_t i = 1; i < count; ++i) {
      const auto jerk_and_snap = [&](double side) {
        std::array<Eigen::Vector3d, 3> j;
        for (std::size_t k = 0; k < 3; ++k) {
          const double off_s = side * kStep_s * static_cast<double>(k + 1);
          j[k] = path.at(path.knots_s()[i] + off_s).j_world_m_s3;
        }
        const Eigen::Vector3d snap = (-2.5 * j[0] + 4.0 * j[1] - 1.5 * j[2]) / (side * kStep_s);
        return std::pair<Eigen::Vector3d, Eigen::Vector3d>(3.0 * j[0] - 3.0 * j[1] + j[2], snap);
      };
      const auto [jerk_before, snap_before] = jerk_and_snap(-1.0);
      const auto [jerk_after, snap_after] = jerk_and_snap(1.0);
      EXPECT_LT((jerk_after - jerk_before).norm(), 1e-7) << i << " of " << count;
      EXPECT_LT((snap_after - snap_before).norm(), 1e-6) << i << " of " << count;
      greatest = std::max(greatest, snap_before.norm());
    }
    EXPECT_GT(greatest, 1e-2) << count;
  }
}

TEST(MinimumJerkTrajectory, AWaypointHalfWayChangesNothing) {
  const MinimumJerkTrajectory path({}, along_x({1.0, 2.0}));
  const double T = path.duration_s();
  EXPECT_NEAR(path.knots_s()[1], 0.5 * T, 1e-7);
  for (const double s : {0.25, 0.5, 0.75}) {
    const double expected = 2.0 * (10.0 * s * s * s - 15.0 * s * s * s * s + 6.0 * std::pow(s, 5));
    EXPECT_NEAR(path.at(s * T).p_world_m.x(), expected, 1e-7) << s;
  }
}

TEST(MinimumJerkTrajectory, TakesNoLongerThanItsLimitsAsk) {
  EXPECT_NEAR(MinimumJerkTrajectory({}, along_x({0.002})).duration_s(), 0.1, 1e-12)
      << "it is at three quarters of what they allow";
}

/// From 2 m/s, which no stretching makes less: its time is that of the trapezoid from 1 m/s on.
TEST(MinimumJerkTrajectory, AStartBeyondTheLimitsIsNotStretchedForNothing) {
  FlightReference start;
  start.v_world_m_s = {2.0, 0.0, 0.0};
  const MinimumJerkTrajectory path(start, along_x({4.0}));
  EXPECT_NEAR(path.duration_s(), 4.0 - 0.5 / 1.4 + 1.0 / 1.4, 1e-7);
}

/// From 0.5 m/s over 0.4 m: half of 0.25 m^2/s^2 and 1.4 m/s^2 times the way are its fastest,
/// squared.
TEST(MinimumJerkTrajectory, TimesAShortPathFromAStartInMotion) {
  FlightReference start;
  start.v_world_m_s = {0.5, 0.0, 0.0};
  const auto shares = shares_of(MinimumJerkTrajectory(start, along_x({0.2, 0.4})));
  const double a = 1.4;
  const double fastest = std::sqrt(0.685);
  const double up_m = (0.685 - 0.25) / (2.0 * a);
  const double at_knot = std::sqrt(0.685 - 2.0 * a * (0.2 - up_m));
  EXPECT_NEAR(shares[1], (2.0 * fastest - 0.5 - at_knot) / (2.0 * fastest - 0.5), 1e-7);
}

}  // namespace
}  // namespace vantage
