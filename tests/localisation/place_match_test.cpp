// Whether a scan is of a place, and from where.
#include "vantage/localisation/place_match.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/localisation/plan_world.hpp"

namespace vantage {
namespace {

using namespace test_plan;

RegistrationOptions options() {
  RegistrationOptions registration;
  registration.normals.radius_m = 0.25;
  return registration;
}

TEST(PlaceMatch, FindsACornerFromFarOff) {
  Rng rng(1);
  const auto walls = ring(15.0, 28.0, 2.0);
  const Pose2 truth{-6.5, -12.0, 1.2};
  const PointCloud place = scan(walls, {-6.3, -12.6, 1.0}, 0.01, rng, options());
  const PointCloud now = scan(walls, truth, 0.01, rng, options());
  const Pose2 T_place_now = compose(inverse(Pose2{-6.3, -12.6, 1.0}), truth);
  const Pose2 off{T_place_now.x_m + 0.55, T_place_now.y_m - 0.35, T_place_now.yaw_rad + 0.06};
  const Pose2 found = search_pose(now, place, off, {0.8, 0.1});
  EXPECT_NEAR(found.x_m, T_place_now.x_m, 0.1);
  EXPECT_NEAR(found.y_m, T_place_now.y_m, 0.1);
  EXPECT_NEAR(found.yaw_rad, T_place_now.yaw_rad, 0.025);
  EXPECT_GT(agreement(now, place, T_place_now).share, 0.95);
  EXPECT_LT(agreement(now, place, off).share, 0.1);
}

/// Between plain walls all places along them fit alike, but for the ends of what is known of them:
/// none is much better than the guess.
TEST(PlaceMatch, AlongPlainWallsTheGuessStays) {
  Rng rng(2);
  std::vector<Segment> walls;
  add_box(walls, -50.0, -1.0, 50.0, 1.0);
  const PointCloud place = scan(walls, {0.0, 0.0, 0.0}, 0.01, rng, options());
  const PointCloud now = scan(walls, {0.0, 0.0, 0.0}, 0.01, rng, options());
  const Pose2 found = search_pose(now, place, {0.4, 0.3, 0.0}, {0.6, 0.05});
  EXPECT_NEAR(found.x_m, 0.4, 0.21) << "along";
  EXPECT_NEAR(found.y_m, 0.0, 0.06) << "across";
}

TEST(PlaceMatch, AnotherPlaceDoesNotAgree) {
  Rng rng(3);
  const auto walls = ring(15.0, 28.0, 2.0);
  const PointCloud corner = scan(walls, {-6.5, -12.6, 0.0}, 0.01, rng, options());
  const PointCloud other = scan(walls, {6.5, -12.6, 0.0}, 0.01, rng, options());
  const Pose2 best = search_pose(other, corner, {}, {1.0, 0.1});
  EXPECT_LT(agreement(other, corner, best).share, 0.72);
}

}  // namespace
}  // namespace vantage
