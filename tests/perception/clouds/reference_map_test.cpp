#include "vantage/perception/clouds/reference_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/synthetic_room.hpp"

namespace vantage {
namespace {

constexpr double kScannerHeight_m = 0.25;

PlanarScan walls_from(const Pose2& pose, const support::SyntheticScene& scene = {}) {
  Rng rng(1);
  return support::floor_scan(scene, pose, 0.0, rng);
}

/// Four legs of a table, no wall near.
PlanarScan legs_from(const Pose2& pose) {
  support::SyntheticScene scene;
  scene.room = {Eigen::Vector3d(-30, -30, 0), Eigen::Vector3d(30, 30, 2.5)};
  for (const double x : {-0.45, 0.45}) {
    for (const double y : {-0.45, 0.45}) {
      scene.boxes.push_back(support::box_at({x, y, 0.34}, {0.05, 0.05, 0.68}));
    }
  }
  Rng rng(1);
  return support::floor_scan(scene, pose, 0.01, rng);
}

TEST(ReferenceMap, KnowsNoPlaceBeforeItRemembersOne) {
  const Pose2 guess{0.1, -0.2, 0.3};
  const auto result =
      ReferenceMap(RegistrationOptions{}).locate(walls_from({}), kScannerHeight_m, guess);
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.reason, "no wall is known yet");
  EXPECT_EQ(result.T_world_base.x_m, 0.1);
  EXPECT_EQ(result.T_world_base.y_m, -0.2);
  EXPECT_EQ(result.T_world_base.yaw_rad, 0.3);
}

TEST(ReferenceMap, RemembersWallsWhereTheyStandInTheWorld) {
  const Pose2 pose{0.4, -0.3, 0.5};
  ReferenceMap map(RegistrationOptions{});
  map.remember(walls_from(pose), kScannerHeight_m, pose);
  ASSERT_GT(map.cloud().size(), 100U);
  EXPECT_TRUE(map.cloud().has_normals());
  for (const auto& p : map.cloud().points) {
    EXPECT_NEAR(p.z(), 0.25F, 1e-5F);
    EXPECT_GT(p.head<2>().cwiseAbs().maxCoeff(), 2.95F);
    EXPECT_LT(p.head<2>().cwiseAbs().maxCoeff(), 3.001F);
  }
}

TEST(ReferenceMap, WallsSayWhereTheBaseIs) {
  const Pose2 first{0.4, -0.3, 0.5};
  const Pose2 truth{0.55, -0.2, 0.6};
  const Pose2 guess{0.57, -0.215, 0.61};
  ReferenceMap map(RegistrationOptions{});
  map.remember(walls_from(first), kScannerHeight_m, first);
  const PlanarScan scan = walls_from(truth);
  const auto result = map.locate(scan, kScannerHeight_m, guess);
  ASSERT_TRUE(result.converged) << result.reason;
  EXPECT_NEAR(result.T_world_base.x_m, 0.55, 0.01);
  EXPECT_NEAR(result.T_world_base.y_m, -0.2, 0.01);
  EXPECT_NEAR(result.T_world_base.yaw_rad, 0.6, 0.005);
  const auto refused = map.locate(scan, kScannerHeight_m, guess, {.shift_m = 0.005});
  EXPECT_FALSE(refused.converged);
  EXPECT_THAT(refused.reason, testing::HasSubstr("odometry explains"));
  EXPECT_EQ(refused.T_world_base.x_m, 0.57);
}

TEST(ReferenceMap, WhatIsKnownIsNotRememberedAgain) {
  const PlanarScan scan = walls_from({});
  ReferenceMap all(RegistrationOptions{});
  ReferenceMap novel(RegistrationOptions{}, 0.05);
  for (ReferenceMap* map : {&all, &novel}) map->remember(scan, kScannerHeight_m, {});
  const std::size_t once = all.cloud().size();
  ASSERT_GT(once, 100U);
  EXPECT_EQ(novel.cloud().size(), once);
  for (ReferenceMap* map : {&all, &novel}) map->remember(scan, kScannerHeight_m, {});
  EXPECT_EQ(all.cloud().size(), 2 * once);
  EXPECT_EQ(novel.cloud().size(), once);
  novel.remember(scan, kScannerHeight_m + 0.1, {});
  EXPECT_EQ(novel.cloud().size(), 2 * once) << "10 cm above all that is known";
}

TEST(ReferenceMap, AskedForWallsThatFixAPose) {
  const ReferenceMap map(RegistrationOptions{});
  EXPECT_TRUE(map.walls_fix_pose(walls_from({}), kScannerHeight_m));
  support::SyntheticScene corridor;
  corridor.room = {Eigen::Vector3d(-30, -1, 0), Eigen::Vector3d(30, 1, 2.5)};
  EXPECT_FALSE(map.walls_fix_pose(walls_from({}, corridor), kScannerHeight_m));
}

TEST(ReferenceMap, AskedForPostsThatFixAPose) {
  const ReferenceMap map(RegistrationOptions{});
  EXPECT_TRUE(map.posts_fix_pose(legs_from(support::view_of_table(0.0))));
  EXPECT_FALSE(map.posts_fix_pose(walls_from({})));
}

TEST(ReferenceMap, GoesByPostsOnceItIsTold) {
  const Pose2 truth = support::view_of_table(0.0);
  const Pose2 guess{truth.x_m + 0.02, truth.y_m - 0.02, truth.yaw_rad - 0.01};
  const PlanarScan scan = legs_from(truth);
  ReferenceMap map(RegistrationOptions{});
  map.remember(scan, kScannerHeight_m, truth);
  EXPECT_FALSE(map.goes_by_posts());
  EXPECT_FALSE(map.locate(scan, kScannerHeight_m, guess).converged);
  map.go_by_posts();
  EXPECT_TRUE(map.goes_by_posts());
  const auto result = map.locate(scan, kScannerHeight_m, guess);
  ASSERT_TRUE(result.converged) << result.reason;
  EXPECT_EQ(result.reason, "");
  EXPECT_NEAR(result.T_world_base.x_m, truth.x_m, 1e-9);
  EXPECT_NEAR(result.T_world_base.y_m, truth.y_m, 1e-9);
  EXPECT_NEAR(wrap_angle(result.T_world_base.yaw_rad - truth.yaw_rad), 0.0, 1e-9);
  EXPECT_NEAR(result.information(0, 0), 4.0 / 2.25e-4, 1e-6);
}

/// The guess is 2 cm off along either axis and 0.01 rad.
TEST(ReferenceMap, PostsMayMoveTheGuessAsFarAsOdometryDrifts) {
  const Pose2 truth = support::view_of_table(0.0);
  const Pose2 guess{truth.x_m + 0.02, truth.y_m - 0.02, truth.yaw_rad - 0.01};
  const PlanarScan scan = legs_from(truth);
  ReferenceMap map(RegistrationOptions{});
  map.remember(scan, kScannerHeight_m, truth);
  map.go_by_posts();
  const auto found = [&](const Correction& plausible) {
    return map.locate(scan, kScannerHeight_m, guess, plausible).converged;
  };
  EXPECT_TRUE(found({.shift_m = 0.0284, .turn_rad = 0.0101}));
  EXPECT_FALSE(found({.shift_m = 0.0282, .turn_rad = 0.0101}));
  EXPECT_FALSE(found({.shift_m = 0.0284, .turn_rad = 0.0099}));
  const Pose2 pose = map.locate(scan, kScannerHeight_m, guess).T_world_base;
  EXPECT_TRUE(found({.shift_m = std::hypot(pose.x_m - guess.x_m, pose.y_m - guess.y_m),
                     .turn_rad = std::abs(wrap_angle(pose.yaw_rad - guess.yaw_rad))}))
      << "just as far";
}

}  // namespace
}  // namespace vantage
