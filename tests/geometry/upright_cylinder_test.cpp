// Samples of the surface of a cylinder that an eye sees.
#include "vantage/geometry/upright_cylinder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace vantage {
namespace {

const UprightCylinder kCan{{1.0, -2.0, 0.7}, 0.04, 0.12};

TEST(FacingSamples, LieOnTheSideOfTheEyeAndOnTop) {
  const Eigen::Vector3d eye(2.5, -1.0, 1.6);
  double sum = 0.0;
  double on_top = 0.0;
  for (const SurfaceSample& sample : facing_samples(kCan, eye)) {
    sum += sample.weight;
    EXPECT_TRUE(kCan.contains(sample.p_world_m, 1e-9));
    const Eigen::Vector3d d = sample.p_world_m - kCan.p_foot_m;
    if (d.z() > kCan.height_m - 1e-9) {
      on_top += sample.weight;
      continue;
    }
    EXPECT_NEAR(d.head<2>().norm(), kCan.radius_m, 1e-12);
    EXPECT_GT(d.head<2>().dot((eye - kCan.p_foot_m).head<2>()), 0.0) << "it faces the eye";
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  // Seen areas: 2 r h cos(e) of the side, pi r^2 sin(e) of the top.
  const Eigen::Vector3d to = eye - (kCan.p_foot_m + 0.06 * Eigen::Vector3d::UnitZ());
  const double e = std::atan2(to.z(), to.head<2>().norm());
  const double side = 2.0 * 0.04 * 0.12 * std::cos(e);
  const double top = 3.14159265358979 * 0.04 * 0.04 * std::sin(e);
  EXPECT_NEAR(on_top, top / (side + top), 1e-9);
}

TEST(FacingSamples, FromBelowNoTopIsSeen) {
  for (const SurfaceSample& sample : facing_samples(kCan, {3.0, -2.0, 0.2})) {
    EXPECT_LT(sample.p_world_m.z(), 0.82);
  }
}

TEST(UprightCylinder, HoldsWhatIsWithinItsMargin) {
  const Eigen::Vector3d foot = kCan.p_foot_m;
  const auto holds = [&](double out_m, double up_m, double margin_m) {
    // 0.6 and 0.8 of it along x and y
    return kCan.contains(foot + Eigen::Vector3d(0.6 * out_m, -0.8 * out_m, up_m), margin_m);
  };
  EXPECT_TRUE(holds(0.039, 0.06, 0.0));
  EXPECT_FALSE(holds(0.041, 0.06, 0.0));
  EXPECT_TRUE(holds(0.049, 0.06, 0.01));
  EXPECT_FALSE(holds(0.051, 0.06, 0.01));
  EXPECT_TRUE(holds(0.03, 0.001, 0.0));
  EXPECT_FALSE(holds(0.03, -0.001, 0.0));
  EXPECT_TRUE(holds(0.03, -0.009, 0.01));
  EXPECT_FALSE(holds(0.03, -0.011, 0.01));
  EXPECT_TRUE(holds(0.03, 0.119, 0.0));
  EXPECT_FALSE(holds(0.03, 0.121, 0.0));
  EXPECT_TRUE(holds(0.03, 0.129, 0.01));
  EXPECT_FALSE(holds(0.03, 0.131, 0.01));
}

/// Along and across the line of sight from above the y axis, in radii of the cylinder.
Eigen::Vector2d along_and_across(const SurfaceSample& sample) {
  const Eigen::Vector3d d = sample.p_world_m - kCan.p_foot_m;
  return Eigen::Vector2d(d.y(), d.x()) / kCan.radius_m;
}

TEST(FacingSamples, AreAsManyWhereverTheyAreAsSeen) {
  const Eigen::Vector3d eye(1.0, 3.0, 0.76 + 2.5);  // half as high as it is far
  const auto samples = facing_samples(kCan, eye);
  ASSERT_EQ(samples.size(), 48U + 12U);
  std::vector<double> across;
  std::vector<double> heights_m;
  for (std::size_t i = 0; i < 48; ++i) {
    EXPECT_NEAR(samples[i].weight, samples[0].weight, 1e-12);
    EXPECT_NEAR(along_and_across(samples[i]).norm(), 1.0, 1e-9);
    EXPECT_GT(along_and_across(samples[i]).x(), 0.0);
    across.push_back(along_and_across(samples[i]).y());
    heights_m.push_back(samples[i].p_world_m.z() - 0.7);
  }
  std::ranges::sort(across);
  std::ranges::sort(heights_m);
  for (std::size_t i = 0; i < 48; ++i) {
    const std::size_t column = i / 6;
    const std::size_t row = i / 8;
    EXPECT_NEAR(across[i], -0.875 + 0.25 * static_cast<double>(column), 1e-9) << i;
    EXPECT_NEAR(heights_m[i], 0.01 + 0.02 * static_cast<double>(row), 1e-9) << i;
  }
  // 2 r h cos(e) of the side and pi r^2 sin(e) of the top, tan(e) = 1/2.
  const double side = 2.0 * 0.12;
  const double top = 3.14159265358979 * 0.04 * 0.5;
  EXPECT_NEAR(samples[0].weight, side / (side + top) / 48.0, 1e-12);
  EXPECT_NEAR(samples[48].weight, top / (side + top) / 12.0, 1e-12);
}

TEST(FacingSamples, ThoseOnTopAreInThreeRings) {
  const auto samples = facing_samples(kCan, {1.0, 3.0, 4.0});
  ASSERT_EQ(samples.size(), 60U);
  std::vector<double> out;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t i = 48; i < 60; ++i) {
    EXPECT_NEAR(samples[i].p_world_m.z(), 0.82, 1e-12);
    out.push_back(along_and_across(samples[i]).norm());
    sum += along_and_across(samples[i]);
  }
  std::ranges::sort(out);
  const std::vector<double> rings{0.29, 0.29, 0.63, 0.63, 0.63, 0.63,
                                  0.88, 0.88, 0.88, 0.88, 0.88, 0.88};
  for (std::size_t i = 0; i < 12; ++i) EXPECT_NEAR(out[i], rings[i], 1e-9) << i;
  EXPECT_NEAR(sum.norm(), 0.0, 1e-9) << "evenly all round";
  EXPECT_NEAR(along_and_across(samples[48]).x(), 0.0, 1e-9) << "the innermost two are abreast";
  EXPECT_NEAR(along_and_across(samples[49]).x(), 0.0, 1e-9);
}

TEST(FacingSamples, FromBelowTheHeightOfItsMiddleOnlyTheSide) {
  EXPECT_EQ(facing_samples(kCan, {3.0, -1.0, 0.75}).size(), 48U);
  EXPECT_EQ(facing_samples(kCan, {3.0, -1.0, 0.1}).size(), 48U);
  EXPECT_EQ(facing_samples(kCan, {3.0, -1.0, 0.77}).size(), 60U);
}

TEST(UprightCylinder, ItsSurfaceBelongsToIt) {
  const UprightCylinder cylinder{{0.0, 0.0, 0.0}, 1.0, 2.0};
  EXPECT_TRUE(cylinder.contains({1.0, 0.0, 1.0}));
  EXPECT_FALSE(cylinder.contains({1.01, 0.0, 1.0}));
  EXPECT_TRUE(cylinder.contains({0.0, 0.0, 0.0}));
  EXPECT_TRUE(cylinder.contains({0.0, 0.0, 2.0}));
  EXPECT_TRUE(cylinder.contains({0.0, 1.5, 1.0}, 0.5));
  EXPECT_TRUE(cylinder.contains({0.0, 0.0, -0.5}, 0.5));
  EXPECT_TRUE(cylinder.contains({0.0, 0.0, 2.5}, 0.5));
}

}  // namespace
}  // namespace vantage
