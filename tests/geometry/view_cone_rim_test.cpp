// Rims of a view cone, and rows of cells whose ends can be told by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "vantage/geometry/view_cone.hpp"

namespace vantage {
namespace {

FieldOfView sector(double half_width_rad, double tilt_min_rad, double tilt_max_rad,
                   double range_min_m = 0.08, double range_max_m = 10.0) {
  FieldOfView fov;
  fov.half_width_rad = half_width_rad;
  fov.tilt_min_rad = tilt_min_rad;
  fov.tilt_max_rad = tilt_max_rad;
  fov.range_min_m = range_min_m;
  fov.range_max_m = range_max_m;
  return fov;
}

/// The same by the cone and by its row; the sensor is at the origin and looks along x.
void expect_contained(const FieldOfView& fov, const Eigen::Vector3d& p, bool expected) {
  const ViewCone cone(Pose::Identity(), fov);
  EXPECT_EQ(cone.contains(p), expected) << p.transpose();
  EXPECT_EQ(cone.row(p, {0.5, 0.0, 0.0}).contains(0.0F), expected) << p.transpose() << " in a row";
}

TEST(ViewConeRim, BelongsToIt) {
  for (const bool panorama : {false, true}) {
    FieldOfView fov = sector(0.4, 0.0, 0.3, 0.5, 2.0);
    fov.panorama = panorama;
    expect_contained(fov, {1.0, 0.0, 0.0}, true);
    expect_contained(fov, {0.5, 0.0, 0.0}, true);
    expect_contained(fov, {2.0, 0.0, 0.0}, true);
    expect_contained(fov, {1.0, 0.0, 0.0625}, false);
    fov.tilt_min_rad = -0.3;
    fov.tilt_max_rad = 0.0;
    expect_contained(fov, {1.0, 0.0, 0.0}, true);
    expect_contained(fov, {1.0, 0.0, -0.0625}, false);
  }
}

TEST(ViewConeRim, OfHalfATurnIsAcross) {
  const FieldOfView fov = sector(0.5 * std::numbers::pi, -0.3, 0.3);
  expect_contained(fov, {0.0, 1.0, 0.0}, true);
  expect_contained(fov, {0.0, -1.0, 0.0}, true);
  EXPECT_FALSE(ViewCone(Pose::Identity(), fov).contains({-1e-20, 1.0, 0.0}));
}

TEST(ViewConeRim, OfAFullTurnIsRightBehind) {
  const FieldOfView fov = sector(std::numbers::pi, -0.3, 0.3);
  expect_contained(fov, {-1.0, 0.0, 0.0}, true);
  expect_contained(fov, {-1.0, 0.0, 1.0}, false);
}

/// |y| <= tan(w) sqrt(1 + tan^2 of the steeper tilt) x.
TEST(ViewConePlanes, BoundTheSector) {
  const Pose T_world_sensor = make_pose({1.0, 2.0, 3.0}, 0.7, 0.2);
  const Eigen::Matrix3d R = T_world_sensor.linear();
  for (const double half_width_rad : {0.4, 1.2}) {
    for (const double turned : {1.0, -1.0}) {
      const double steep = turned * 0.5;
      const ViewCone cone(T_world_sensor, sector(half_width_rad, std::min(-0.3 * turned, steep),
                                                 std::max(-0.3 * turned, steep)));
      const double slope = std::tan(half_width_rad) * std::hypot(1.0, std::tan(0.5));
      ASSERT_EQ(cone.normals().size(), 5U);
      EXPECT_TRUE(cone.normals()[0].isApprox(R * Eigen::Vector3d::UnitX()));
      for (const double side : {1.0, -1.0}) {
        const Eigen::Vector3d expected = R * Eigen::Vector3d(slope, side, 0.0).normalized();
        EXPECT_TRUE(cone.normals()[side > 0.0 ? 3 : 4].isApprox(expected)) << half_width_rad;
      }
    }
  }
  const ViewCone cone(T_world_sensor, sector(0.4, -0.5, 0.3));
  const Eigen::Vector3d upper = R * Eigen::Vector3d(std::tan(0.5), 0.0, -1.0).normalized();
  const Eigen::Vector3d lower = R * Eigen::Vector3d(std::tan(0.3), 0.0, 1.0).normalized();
  EXPECT_TRUE(cone.normals()[1].isApprox(upper));
  EXPECT_TRUE(cone.normals()[2].isApprox(lower));
}

TEST(ViewConePlanes, OfHalfATurnAreThatAcross) {
  const ViewCone cone(Pose::Identity(), sector(0.5 * std::numbers::pi, -0.3, 0.3));
  ASSERT_EQ(cone.normals().size(), 5U);
  for (const std::size_t i : {0U, 3U, 4U}) {
    EXPECT_EQ(cone.normals()[i], Eigen::Vector3d(1.0, 0.0, 0.0)) << i;
  }
}

void expect_bounds(const FieldOfView& fov, const Eigen::Vector3d& p, const Eigen::Vector3d& step,
                   int count, int begin, int end) {
  const ViewCone cone(Pose::Identity(), fov);
  const auto row = RowBounds(cone, step).of_row(p, count);
  EXPECT_EQ(row.begin, begin);
  EXPECT_EQ(row.end, end);
}

TEST(RowBoundsByHand, EndWhereThePlanesDo) {
  const FieldOfView level = sector(0.2, -0.01, 0.01, 0.08, 1000.0);
  expect_bounds(level, {100.0, -40.0, 0.0}, {0.0, 4.0, 0.0}, 21, 5, 16);
  expect_bounds(level, {1.0, 0.0, 0.0}, {0.1, 0.0, 0.0}, 1, 0, 1);
  const FieldOfView high = sector(0.4, -0.3, 0.3);
  expect_bounds(high, {-1.0, 0.0, 0.0}, {0.5, 0.0, 0.0}, 10, 2, 10);
  expect_bounds(high, {1.0, 0.0, 0.0}, {-0.5, 0.0, 0.0}, 10, 0, 3);
}

/// A row along a plane is all within it or all without.
TEST(RowBoundsByHand, AreNoneAboveTheView) {
  expect_bounds(sector(0.2, -0.01, 0.01), {1.0, -5.0, 1.0}, {0.0, 0.1, 0.0}, 101, 0, 0);
  expect_bounds(sector(0.2, -0.01, 0.01), {1.0, -5.0, -1.0}, {0.0, 0.1, 0.0}, 101, 0, 0);
}

TEST(RowBoundsByHand, EndWhereTheRangeDoes) {
  const FieldOfView ahead = sector(0.4, -0.3, 0.3);
  expect_bounds(ahead, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 20, 0, 11);
  FieldOfView all_round = sector(0.4, -0.3, 0.3, 0.0, 1.0);
  all_round.panorama = true;
  expect_bounds(all_round, {-1.0, 0.8, 0.0}, {0.1, 0.0, 0.0}, 21, 4, 17);
  expect_bounds(all_round, {-1.0, 1.2, 0.0}, {0.1, 0.0, 0.0}, 21, 0, 0);
}

struct HandMadeRuns {
  RowBounds::Interval first = {};
  RowBounds::Interval second = {};
};

void expect_exact(const FieldOfView& fov, const Eigen::Vector3d& p, const Eigen::Vector3d& step,
                  const HandMadeRuns& expected) {
  const ViewCone cone(Pose::Identity(), fov);
  const auto seen = RowBounds(cone, step).runs_of_row(p, 0, 21);
  EXPECT_TRUE(seen.exact);
  EXPECT_EQ(seen.runs[0].begin, expected.first.begin);
  EXPECT_EQ(seen.runs[0].end, expected.first.end);
  EXPECT_EQ(seen.runs[1].begin, expected.second.begin);
  EXPECT_EQ(seen.runs[1].end, expected.second.end);
}

/// The sector is |y| <= tan(w) sqrt(x^2 + z^2) between its tilts.
TEST(RowBoundsByHand, AreExactAcrossAlongAndUpTheSector) {
  const FieldOfView fov = sector(0.4, -0.6, 0.6);
  // Across: |y| <= 0.4233.
  expect_exact(fov, {1.0, -1.0, 0.05}, {0.0, 0.1, 0.0}, {{6, 15}, {}});
  // Along: all of it.
  expect_exact(fov, {1.0, 0.0, 0.1}, {0.1, 0.0, 0.0}, {{0, 21}, {}});
  // Up beside it: |z| between 0.3643 and 0.6841.
  expect_exact(fov, {1.0, 0.45, -1.0}, {0.0, 0.0, 0.1}, {{4, 7}, {14, 17}});
  // Beyond its range.
  expect_exact(fov, {20.0, -1.0, 0.05}, {0.0, 0.1, 0.0}, {{}, {}});
}

}  // namespace
}  // namespace vantage
