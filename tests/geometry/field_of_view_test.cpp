#include "vantage/geometry/field_of_view.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/option_numbers.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/geometry/rgbd_camera.hpp"

namespace vantage {
namespace {

TEST(BeamDirection, AxesAndSigns) {
  EXPECT_TRUE(beam_direction({0, 0}).isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_TRUE(beam_direction({std::numbers::pi / 2, 0.3}).isApprox(Eigen::Vector3d::UnitY()));
  EXPECT_GT(beam_direction({0.2, 0}).y(), 0.0);   // left
  EXPECT_LT(beam_direction({0, 0.2}).z(), 0.0);   // down
  EXPECT_GT(beam_direction({0, -0.2}).z(), 0.0);  // up
}

RC_GTEST_PROP(BeamDirection, IsAUnitVectorAndInvertible, (std::uint64_t seed)) {
  Rng rng(seed);
  const BeamAngles angles{rng.uniform(-std::numbers::pi / 2, std::numbers::pi / 2),
                          rng.uniform(-std::numbers::pi, std::numbers::pi)};
  const Eigen::Vector3d direction = beam_direction(angles);
  RC_ASSERT(std::abs(direction.norm() - 1.0) < 1e-12);
  const BeamAngles back = beam_angles(rng.uniform(0.1, 10.0) * direction);
  RC_ASSERT(std::abs(back.azimuth_rad - angles.azimuth_rad) < 1e-7);
  RC_ASSERT(std::cos(angles.azimuth_rad) < 1e-6 ||
            std::abs(wrap_angle(back.tilt_rad - angles.tilt_rad)) < 1e-7);
}

RC_GTEST_PROP(TurnedOver, IsTheSameDirection, (std::uint64_t seed)) {
  Rng rng(seed);
  const BeamAngles angles{rng.uniform(-std::numbers::pi, std::numbers::pi), rng.uniform(-1, 1)};
  const BeamAngles other = turned_over(angles);
  RC_ASSERT((beam_direction(other) - beam_direction(angles)).norm() < 1e-12);
  RC_ASSERT(std::abs(wrap_angle(other.tilt_rad - angles.tilt_rad)) > 3.0);
}

RC_GTEST_PROP(FieldOfView, ContainsExactlyItsBeams, (std::uint64_t seed)) {
  Rng rng(seed);
  const FieldOfView view{.half_width_rad = 0.4,
                         .tilt_min_rad = -0.3,
                         .tilt_max_rad = 0.6,
                         .range_min_m = 0.5,
                         .range_max_m = 2.0};
  const BeamAngles angles{rng.uniform(-1, 1), rng.uniform(-1, 1)};
  const double range = rng.uniform(0.0, 3.0);
  const bool expected = std::abs(angles.azimuth_rad) <= 0.4 && angles.tilt_rad >= -0.3 &&
                        angles.tilt_rad <= 0.6 && range >= 0.5 && range <= 2.0;
  RC_ASSERT(view.contains(range * beam_direction(angles)) == expected);
}

TEST(FieldOfView, NarrowSectorDoesNotSeeBehind) {
  const FieldOfView view;
  EXPECT_TRUE(view.contains({1, 0, 0}));
  EXPECT_FALSE(view.contains({-1, 0, 0}));
  EXPECT_FALSE(view.contains({0, 0, 0}));
  EXPECT_FALSE(view.contains({std::nan(""), 0, 0}));
}

TEST(FieldOfView, FullTurnSeesAllRound) {
  const FieldOfView view{
      .half_width_rad = std::numbers::pi, .tilt_min_rad = -0.3, .tilt_max_rad = 0.3};
  for (double azimuth = -std::numbers::pi; azimuth <= std::numbers::pi; azimuth += 0.1) {
    EXPECT_TRUE(view.contains(2.0 * beam_direction({azimuth, 0.1}))) << azimuth;
  }
  EXPECT_FALSE(view.contains({0.1, 0, 2}));
}

TEST(FieldOfView, OptionsAreChecked) {
  EXPECT_NO_THROW(check_options(FieldOfView{}));
  EXPECT_THROW(check_options(FieldOfView{.half_width_rad = 0.0}), ConfigError);
  EXPECT_THROW(check_options(FieldOfView{.tilt_min_rad = 0.8}), ConfigError);
  EXPECT_THROW(check_options(FieldOfView{.range_min_m = 11.0}), ConfigError);
}

RC_GTEST_PROP(FieldOfView, PanoramaIsBoundedByTheAngleBelowTheHorizon, (std::uint64_t seed)) {
  Rng rng(seed);
  const FieldOfView view{.tilt_min_rad = -0.4, .tilt_max_rad = 1.1, .panorama = true};
  const double azimuth = rng.uniform(-std::numbers::pi, std::numbers::pi);
  const double tilt = rng.uniform(-1.5, 1.5);
  const Eigen::Vector3d p = make_pose(Eigen::Vector3d::Zero(), azimuth) *
                            Eigen::Vector3d(2.0 * std::cos(tilt), 0.0, -2.0 * std::sin(tilt));
  RC_ASSERT(std::abs(depression_rad(p) - tilt) < 1e-9);
  RC_ASSERT(view.contains(p) == (tilt >= -0.4 && tilt <= 1.1));
}

TEST(FieldOfView, HasTheseDefaultsAndRanges) {
  support::expect_numbers(FieldOfView{}, {{"half_width_rad", 0.1309, {0.0, 3.1416, true}},
                                          {"tilt_min_rad", -0.30, between(-1.5, 1.5)},
                                          {"tilt_max_rad", 0.75, between(-1.5, 1.5)},
                                          {"range_min_m", 0.08, at_least(0.0)},
                                          {"range_max_m", 10.0, above(0.0)},
                                          {"panorama", 0.0}});
}

TEST(FieldOfView, MinimaMustBeBelowMaxima) {
  EXPECT_THROW(check_options(FieldOfView{.tilt_min_rad = 0.5, .tilt_max_rad = 0.5}), ConfigError);
  EXPECT_NO_THROW(check_options(FieldOfView{.tilt_min_rad = 0.4, .tilt_max_rad = 0.5}));
  EXPECT_THROW(check_options(FieldOfView{.range_min_m = 2.0, .range_max_m = 2.0}), ConfigError);
  EXPECT_NO_THROW(check_options(FieldOfView{.range_min_m = 1.9, .range_max_m = 2.0}));
}

TEST(FieldOfView, ItsRimBelongsToIt) {
  constexpr double kEighth = std::numbers::pi / 4.0;  // atan2 of equal numbers is this, to the bit
  FieldOfView view{.half_width_rad = kEighth,
                   .tilt_min_rad = -kEighth,
                   .tilt_max_rad = kEighth,
                   .range_min_m = 0.5,
                   .range_max_m = 2.0};
  EXPECT_TRUE(view.contains({0.5, 0, 0}));
  EXPECT_FALSE(view.contains({0.49, 0, 0}));
  EXPECT_TRUE(view.contains({2.0, 0, 0}));
  EXPECT_FALSE(view.contains({2.01, 0, 0}));
  EXPECT_TRUE(view.contains({1, 1, 0}));
  EXPECT_TRUE(view.contains({1, -1, 0}));
  EXPECT_FALSE(view.contains({1, 1.01, 0}));
  EXPECT_TRUE(view.contains({1, 0, 1}));
  EXPECT_FALSE(view.contains({1, 0, 1.01}));
  EXPECT_TRUE(view.contains({1, 0, -1}));
  EXPECT_FALSE(view.contains({1, 0, -1.01}));
  view.panorama = true;
  EXPECT_TRUE(view.contains({0, -1, 1}));
  EXPECT_FALSE(view.contains({0, -1, 1.01}));
  EXPECT_TRUE(view.contains({0, 1, -1}));
  EXPECT_FALSE(view.contains({0, 1, -1.01}));
}

TEST(FieldOfView, WiderThanHalfATurnSeesBehindItselfOnItsSides) {
  const FieldOfView view{.half_width_rad = 2.0, .tilt_min_rad = -0.3, .tilt_max_rad = 0.3};
  EXPECT_TRUE(view.contains(2.0 * beam_direction({1.9, 0.1})));
  EXPECT_TRUE(view.contains(2.0 * beam_direction({-1.9, -0.2})));
  EXPECT_FALSE(view.contains(2.0 * beam_direction({2.1, 0.1})));
  EXPECT_FALSE(view.contains(2.0 * beam_direction({1.9, 0.4})));
}

TEST(RgbdCamera, SeesAsWideAndAsFarAsAKinect) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  EXPECT_NEAR(2.0 * kRgbdCamera.half_width_rad, 57.8 * kDegree, 1e-4);
  EXPECT_NEAR(kRgbdCamera.tilt_max_rad - kRgbdCamera.tilt_min_rad, 45.0 * kDegree, 1e-4);
  EXPECT_EQ(kRgbdCamera.tilt_min_rad, -kRgbdCamera.tilt_max_rad);
  EXPECT_EQ(kRgbdCamera.range_min_m, 0.8);
  EXPECT_EQ(kRgbdCamera.range_max_m, 3.5);
  EXPECT_FALSE(kRgbdCamera.panorama);
}

RC_GTEST_PROP(FieldOfView, IsInItsBoxAndReachesItsSides, (std::uint64_t seed)) {
  Rng rng(seed);
  FieldOfView view{.half_width_rad = rng.uniform(0.1, 3.1),
                   .tilt_min_rad = rng.uniform(-1.4, 0.6),
                   .tilt_max_rad = 0.0,
                   .range_min_m = 0.0,
                   .range_max_m = rng.uniform(0.5, 5.0)};
  view.tilt_max_rad = rng.uniform(view.tilt_min_rad + 0.1, 1.4);
  view.panorama = rng.uniform_index(4) == 0;
  const Eigen::AlignedBox3d box = view.box_m();
  const bool ahead = !view.panorama && view.half_width_rad < 1.57;
  const double turned_rad = ahead ? view.half_width_rad : std::numbers::pi;
  Eigen::AlignedBox3d held(Eigen::Vector3d::Zero());
  for (int i = 0; i < 3000; ++i) {
    const BeamAngles angles{rng.uniform(-turned_rad, turned_rad),
                            rng.uniform(view.tilt_min_rad, view.tilt_max_rad)};
    const Eigen::Vector3d p = view.range_max_m * (1.0 - 1e-9) * beam_direction(angles);
    if (!view.contains(p)) continue;
    RC_ASSERT(box.contains(p));
    held.extend(p);
  }
  if (!ahead) return;
  const double slack_m = 0.05 * view.range_max_m;
  RC_ASSERT(box.max().y() - held.max().y() < slack_m);
  RC_ASSERT(held.min().y() - box.min().y() < slack_m);
  RC_ASSERT(box.max().z() - held.max().z() < slack_m);
  RC_ASSERT(held.min().z() - box.min().z() < slack_m);
}

/// A point off the y axis by less than an angle can tell is still behind.
TEST(FieldOfView, HalfATurnWideItDoesNotSeeBehind) {
  const FieldOfView view{.half_width_rad = std::numbers::pi / 2.0};
  EXPECT_TRUE(view.contains({0, 1, 0}));
  EXPECT_FALSE(view.contains({-1e-20, 1, 0}));
  EXPECT_FALSE(view.contains({-1e-20, -1, 0}));
  const Eigen::AlignedBox3d box = view.box_m();
  EXPECT_EQ(box.min(), Eigen::Vector3d(-10, -10, -10));
  EXPECT_EQ(box.max(), Eigen::Vector3d(10, 10, 10));
}

}  // namespace
}  // namespace vantage
