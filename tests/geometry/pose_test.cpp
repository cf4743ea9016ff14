#include "vantage/geometry/pose.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "vantage/core/rng.hpp"
#include "vantage/geometry/object_detection.hpp"
#include "vantage/geometry/range_scan.hpp"
#include "vantage/geometry/twist.hpp"
#include "vantage/geometry/upright_cylinder.hpp"

namespace vantage {
namespace {

Pose2 random_pose2(Rng& rng) {
  return {rng.uniform(-10, 10), rng.uniform(-10, 10),
          rng.uniform(-std::numbers::pi, std::numbers::pi)};
}

bool near(const Pose2& a, const Pose2& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m) < 1e-9 &&
         std::abs(wrap_angle(a.yaw_rad - b.yaw_rad)) < 1e-9;
}

RC_GTEST_PROP(WrapAngle, IsTheSameDirectionInRange, (std::uint64_t seed)) {
  Rng rng(seed);
  const double angle = rng.uniform(-100, 100);
  const double wrapped = wrap_angle(angle);
  RC_ASSERT(wrapped > -std::numbers::pi);
  RC_ASSERT(wrapped <= std::numbers::pi);
  RC_ASSERT(std::abs(std::sin(wrapped) - std::sin(angle)) < 1e-12);
  RC_ASSERT(std::abs(std::cos(wrapped) - std::cos(angle)) < 1e-12);
  RC_ASSERT(wrap_angle(wrapped) == wrapped);
}

TEST(WrapAngle, HalfTurnsArePositive) {
  EXPECT_EQ(wrap_angle(std::numbers::pi), std::numbers::pi);
  EXPECT_EQ(wrap_angle(-std::numbers::pi), std::numbers::pi);
  EXPECT_EQ(wrap_angle(0.0), 0.0);
  EXPECT_NEAR(wrap_angle(2.0 * std::numbers::pi + 0.25), 0.25, 1e-15);
}

RC_GTEST_PROP(Pose2, GroupLaws, (std::uint64_t seed)) {
  Rng rng(seed);
  const Pose2 a = random_pose2(rng);
  const Pose2 b = random_pose2(rng);
  const Pose2 c = random_pose2(rng);
  RC_ASSERT(near(compose(compose(a, b), c), compose(a, compose(b, c))));
  RC_ASSERT(near(compose(a, inverse(a)), Pose2{}));
  RC_ASSERT(near(compose(inverse(a), a), Pose2{}));
  RC_ASSERT(near(compose(a, Pose2{}), a));
  RC_ASSERT(near(inverse(compose(a, b)), compose(inverse(b), inverse(a))));
}

RC_GTEST_PROP(Pose2, AgreesWithThePoseInSpace, (std::uint64_t seed)) {
  Rng rng(seed);
  const Pose2 a = random_pose2(rng);
  const Pose2 b = random_pose2(rng);
  RC_ASSERT(near(project_to_se2(to_se3(a, 3.0)), a));
  RC_ASSERT(near(project_to_se2(to_se3(a) * to_se3(b)), compose(a, b)));
  RC_ASSERT(near(project_to_se2(to_se3(a).inverse()), inverse(a)));
}

TEST(Pose2, InverseOfAHalfTurnStaysInRange) {
  EXPECT_EQ(inverse({0.0, 0.0, std::numbers::pi}).yaw_rad, std::numbers::pi);
}

//        y
//        ^  b's origin at (1, 2), facing +y: its x axis is the world's y axis
TEST(Pose2, KnownTransform) {
  const Pose p = to_se3({1.0, 2.0, std::numbers::pi / 2.0}, 0.5);
  EXPECT_TRUE((p * Eigen::Vector3d(3, 0, 0)).isApprox(Eigen::Vector3d(1, 5, 0.5)));
  EXPECT_TRUE((p * Eigen::Vector3d(0, 3, 0)).isApprox(Eigen::Vector3d(-2, 2, 0.5)));
}

TEST(MakePose, PositivePitchLooksDown) {
  const Pose pose = make_pose({0, 0, 1}, std::numbers::pi / 2.0, 0.3);
  const Eigen::Vector3d forward = pose.linear().col(0);
  EXPECT_NEAR(forward.x(), 0.0, 1e-12);
  EXPECT_NEAR(forward.y(), std::cos(0.3), 1e-12);
  EXPECT_NEAR(forward.z(), -std::sin(0.3), 1e-12);
  EXPECT_NEAR(project_to_se2(pose).yaw_rad, std::numbers::pi / 2.0, 1e-12);
}

TEST(Geometry, PosesAreTheOriginAndTwistsAndAnglesNoneAtFirst) {
  for (const double value :
       {Pose2{}.x_m, Pose2{}.y_m, Pose2{}.yaw_rad, Twist2{}.vx_m_s, Twist2{}.vy_m_s,
        Twist2{}.wz_rad_s, BeamAngles{}.azimuth_rad, BeamAngles{}.tilt_rad}) {
    EXPECT_EQ(value, 0.0);
  }
}

TEST(Geometry, ImagesScansAndDetectionsAreEmptyAtFirst) {
  const CameraImages images;
  const ObjectDetection detection;
  const UprightCylinder cylinder;
  for (const double value :
       {images.focal_px, images.range_max_m, PlanarScan{}.range_max_m, detection.support_z_m,
        detection.radius_m, detection.height_m, detection.distance_m, cylinder.radius_m,
        cylinder.height_m, SurfaceSample{}.weight}) {
    EXPECT_EQ(value, 0.0);
  }
  EXPECT_EQ(images.width_px, 0);
  EXPECT_EQ(images.height_px, 0);
  EXPECT_EQ(detection.pixels, 0);
  EXPECT_FALSE(detection.whole);
  EXPECT_TRUE(detection.p_world_object_m.isZero());
  EXPECT_TRUE(cylinder.p_foot_m.isZero());
}

}  // namespace
}  // namespace vantage
