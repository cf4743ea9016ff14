#include "vantage/view/orbit_camera.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "vantage/geometry/pose.hpp"

namespace vantage {
namespace {

/// Where the camera is and how it looks, from the definition of its angles.
Pose T_world_camera(const FreeCamera& camera) {
  const double e = camera.elevation_rad;
  const Eigen::Vector3d forward(std::cos(e) * std::cos(camera.azimuth_rad),
                                std::cos(e) * std::sin(camera.azimuth_rad), std::sin(e));
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Pose T = Pose::Identity();
  T.linear() << right, forward.cross(right), forward;
  T.translation() = camera.lookat_m - camera.distance_m * forward;
  return T;
}

/// In heights of the image from its middle, x right, y down.
Eigen::Vector2d projected(const FreeCamera& camera, const Eigen::Vector3d& p_world) {
  const Eigen::Vector3d p = T_world_camera(camera).inverse() * p_world;
  return p.head<2>() / p.z() / (2.0 * std::tan(0.5 * *camera.fovy_rad));
}

double between(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 100001) / 100000.0;
}

FreeCamera any_camera() {
  return {.lookat_m = {between(-3, 3), between(-3, 3), between(0, 2)},
          .distance_m = between(0.5, 20.0),
          .azimuth_rad = between(-3.1, 3.1),
          .elevation_rad = between(-1.3, 1.3),
          .fovy_rad = between(0.3, 1.5)};
}

RC_GTEST_PROP(OrbitCamera, PanningTakesThePointAlong, ()) {
  const FreeCamera before = any_camera();
  const Eigen::Vector2d drag(between(-0.5, 0.5), between(-0.5, 0.5));
  const FreeCamera after = panned(before, drag);
  RC_ASSERT((projected(after, before.lookat_m) - drag).norm() < 1e-9);
  RC_ASSERT(after.distance_m == before.distance_m);
  RC_ASSERT(after.azimuth_rad == before.azimuth_rad);
}

RC_GTEST_PROP(OrbitCamera, OrbitingKeepsThePointAndItsDistance, ()) {
  const FreeCamera before = any_camera();
  const FreeCamera after = orbited(before, {between(-2.0, 2.0), between(-2.0, 2.0)});
  RC_ASSERT(after.lookat_m == before.lookat_m);
  RC_ASSERT(after.distance_m == before.distance_m);
  RC_ASSERT(std::abs(after.elevation_rad) < 0.5 * std::numbers::pi);
  RC_ASSERT(std::abs(after.azimuth_rad) <= std::numbers::pi);
}

TEST(OrbitCamera, WhatIsNearerThanThePointFollowsTheMouse) {
  const FreeCamera before{
      .distance_m = 2.0, .azimuth_rad = 0.3, .elevation_rad = -0.5, .fovy_rad = 0.8};
  const Eigen::Vector3d p_near = T_world_camera(before) * Eigen::Vector3d(0.0, 0.0, 1.5);
  const Eigen::Vector2d right = projected(orbited(before, {0.05, 0.0}), p_near);
  const Eigen::Vector2d down = projected(orbited(before, {0.0, 0.05}), p_near);
  EXPECT_GT(right.x(), 0.01);
  EXPECT_GT(down.y(), 0.01);
}

TEST(OrbitCamera, HalfATurnPerHeight) {
  const FreeCamera before{.azimuth_rad = 1.0};
  EXPECT_NEAR(orbited(before, {1.0, 0.0}).azimuth_rad, 1.0 - std::numbers::pi, 1e-12);
  EXPECT_NEAR(orbited(before, {2.0, 0.0}).azimuth_rad, 1.0, 1e-12);
}

TEST(OrbitCamera, NotchesThereAndBackAreNone) {
  const FreeCamera before{.distance_m = 4.0};
  EXPECT_NEAR(zoomed(before, 1.0).distance_m, 3.6, 1e-12);
  EXPECT_NEAR(zoomed(zoomed(before, 5.0), -5.0).distance_m, 4.0, 1e-12);
  EXPECT_GT(zoomed(before, 1000.0).distance_m, 0.0);
  EXPECT_LT(zoomed(before, -1000.0).distance_m, 1000.0);
}

TEST(OrbitCamera, NeverOverTheTop) {
  const FreeCamera before{.azimuth_rad = 0.2, .elevation_rad = -0.5};
  EXPECT_NEAR(orbited(before, {0.0, 0.1}).elevation_rad, -0.5 - 0.1 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(orbited(before, {0.0, 0.1}).azimuth_rad, 0.2, 1e-12);
  const double steepest_rad = 0.5 * std::numbers::pi - 0.01;
  EXPECT_NEAR(orbited(before, {0.0, 5.0}).elevation_rad, -steepest_rad, 1e-12);
  EXPECT_NEAR(orbited(before, {0.0, -5.0}).elevation_rad, steepest_rad, 1e-12);
}

TEST(OrbitCamera, StaysBetweenFiveCentimetresAndTwoHundredMetres) {
  const FreeCamera before{.distance_m = 4.0};
  EXPECT_NEAR(zoomed(before, 1000.0).distance_m, 0.05, 1e-12);
  EXPECT_NEAR(zoomed(before, -1000.0).distance_m, 200.0, 1e-9);
  EXPECT_NEAR(zoomed(before, 2.0).distance_m, 4.0 * 0.81, 1e-12);
}

}  // namespace
}  // namespace vantage
