// Extents of few points, and what is known of them where an edge is cut off.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/object_views.hpp"
#include "vantage/perception/features/kit/cut_off_extents.hpp"
#include "vantage/perception/features/kit/histogram.hpp"
#include "vantage/perception/features/kit/object_surface.hpp"
#include "vantage/perception/features/kit/upright_extents.hpp"

namespace vantage {
namespace {

using testing::ElementsAre;

TEST(RootOfShares, IsOfUnitLength) {
  const Eigen::Vector3f roots = root_of_shares(Eigen::Vector3f(9.0F, 0.0F, 16.0F));
  EXPECT_FLOAT_EQ(roots[0], 0.6F);
  EXPECT_EQ(roots[1], 0.0F);
  EXPECT_FLOAT_EQ(roots[2], 0.8F);
  EXPECT_TRUE(root_of_shares(Eigen::Vector2f::Zero()).isZero());
  const Eigen::Vector2f negative = root_of_shares(Eigen::Vector2f(-1.0F, 3.0F));
  EXPECT_EQ(negative[0], 0.0F);
  EXPECT_FLOAT_EQ(negative[1], std::sqrt(0.75F));
}

/// A level cross of arms of 0.5 m and 0.2 m round (1, 2), its ends at different heights.
TEST(UprightExtents, AreAlongThePrincipalAxesSeenFromAbove) {
  const Eigen::Vector3d a(std::cos(0.4), std::sin(0.4), 0.0);
  const Eigen::Vector3d b(-std::sin(0.4), std::cos(0.4), 0.0);
  const Eigen::Vector3d middle(1.0, 2.0, 0.0);
  Eigen::Matrix3Xd points(3, 4);
  points.col(0) = middle + 0.5 * a + Eigen::Vector3d(0.0, 0.0, 0.7);
  points.col(1) = middle - 0.5 * a + Eigen::Vector3d(0.0, 0.0, 0.3);
  points.col(2) = middle + 0.2 * b + Eigen::Vector3d(0.0, 0.0, 0.4);
  points.col(3) = middle - 0.2 * b + Eigen::Vector3d(0.0, 0.0, 0.5);
  const UprightExtents box = upright_extents(points, Eigen::Vector3d::UnitZ(), 0.0, 1.0);
  EXPECT_NEAR(box.bottom_m, 0.3, 1e-12);
  EXPECT_NEAR(box.top_m, 0.7, 1e-12);
  EXPECT_NEAR(box.greater_m, 1.0, 1e-9);
  EXPECT_NEAR(box.smaller_m, 0.4, 1e-9);
  EXPECT_NEAR(std::abs(box.greater.axis.dot(a)), 1.0, 1e-9);
  EXPECT_NEAR(std::abs(box.smaller.axis.dot(b)), 1.0, 1e-9);
  EXPECT_NEAR(box.greater.ends_m.sum(), 2.0 * box.greater.axis.dot(middle), 1e-9);
  EXPECT_NEAR(box.smaller.ends_m.y() - box.smaller.ends_m.x(), 0.4, 1e-9);
  const UprightExtents inner = upright_extents(points, Eigen::Vector3d::UnitZ(), 0.3, 0.7);
  EXPECT_NEAR(inner.bottom_m, 0.4, 1e-12);
  EXPECT_NEAR(inner.top_m, 0.5, 1e-12);
}

/// 11 x 11 px of 1 cm, 1 m away, all of the object; x and height from -5 to 5 cm.
class CutOffReadings : public testing::Test {
 protected:
  CutOffReadings() {
    view_ = blank_view(11, 11);
    view_.focal_px = 100.0;
    std::ranges::fill(view_.mask, 1);
    std::ranges::fill(view_.depth_m, 1.0F);
    view_.cut_off.assign(121, 0);
    box_.bottom_m = -0.05;
    box_.top_m = 0.05;
    box_.greater = {Eigen::Vector3d::UnitX(), {-0.05, 0.05}};
    box_.smaller = {Eigen::Vector3d::UnitZ(), {0.9, 1.1}};
  }
  void cut(int row, int first, int last) {
    for (int column = first; column <= last; ++column) view_.cut_off[view_.index(row, column)] = 1;
  }
  [[nodiscard]] std::vector<Reading> readings(Foot foot = Foot::of_object) const {
    return extent_readings(view_, box_, -Eigen::Vector3d::UnitY(), foot);
  }

  ObjectView view_;
  UprightExtents box_;
};

constexpr Reading kExactly = Reading::exact;
constexpr Reading kAtLeast = Reading::at_least;

TEST_F(CutOffReadings, TheSideThatIsCutOffIsALowerBound) {
  for (const int row : {4, 5, 6}) cut(row, 0, 0);
  EXPECT_THAT(readings(), ElementsAre(kExactly, kAtLeast, kExactly));
  view_.depth_m[view_.index(5, 0)] = 0.0F;
  EXPECT_THAT(readings(), ElementsAre()) << "two pixels are noise";
}

TEST_F(CutOffReadings, TheOtherSideToo) {
  for (const int row : {4, 5, 6}) cut(row, 10, 10);
  EXPECT_THAT(readings(), ElementsAre(kExactly, kAtLeast, kExactly));
}

TEST_F(CutOffReadings, TheTopAndAFootOfItsOwnAreCutOffToo) {
  cut(0, 4, 6);
  EXPECT_THAT(readings(), ElementsAre(kAtLeast, kExactly, kExactly));
  EXPECT_THAT(readings(Foot::of_support), ElementsAre(kAtLeast, kExactly, kExactly));
  std::ranges::fill(view_.cut_off, 0);
  cut(10, 4, 6);
  EXPECT_THAT(readings(), ElementsAre(kAtLeast, kExactly, kExactly));
  EXPECT_THAT(readings(Foot::of_support), ElementsAre(kExactly, kExactly, kExactly));
}

TEST_F(CutOffReadings, AnEndIsNearBySoMuch) {
  for (const int row : {4, 5, 6}) cut(row, 0, 0);  // x = -5 cm
  const auto greater_of = [&](double low_m, double high_m) {
    box_.greater.ends_m = {low_m, high_m};
    return readings().at(1);
  };
  EXPECT_EQ(greater_of(-0.064, 0.03), kAtLeast) << "1.5 cm at least";
  EXPECT_EQ(greater_of(-0.066, 0.03), kExactly);
  EXPECT_EQ(greater_of(-0.109, 0.291), kAtLeast) << "15 % of 40 cm";
  EXPECT_EQ(greater_of(-0.111, 0.289), kExactly);
  box_.top_m = 0.024;  // the highest of them is at 1 cm
  EXPECT_EQ(readings()[0], kExactly) << "one pixel";
  box_.top_m = 0.004;
  EXPECT_EQ(readings()[0], kAtLeast);
}

/// Beside holes in the mask, so that they are of its edge.
TEST_F(CutOffReadings, WhatIsJustSoFarFromAnEndIsNotNearIt) {
  for (const int row : {4, 5, 6}) {
    view_.mask[view_.index(row, 4)] = 0;
    cut(row, 5, 5);  // x = 0
  }
  const auto greater_of = [&](double low_m, double high_m) {
    box_.greater.ends_m = {low_m, high_m};
    return readings().at(1);
  };
  EXPECT_EQ(greater_of(-0.05, 0.015), kExactly);
  EXPECT_EQ(greater_of(-0.05, 0.0149), kAtLeast);
  EXPECT_EQ(greater_of(-0.015, 0.05), kExactly);
  EXPECT_EQ(greater_of(-0.0149, 0.05), kAtLeast);
}

/// The edge has 40 px.
TEST_F(CutOffReadings, WhereMuchIsCutOffNoExtentIsWhole) {
  cut(0, 0, 9);
  EXPECT_EQ(readings()[2], kExactly);
  cut(0, 10, 10);
  EXPECT_EQ(readings()[2], kAtLeast);
}

TEST_F(CutOffReadings, OnlyTheEdgeOfTheMaskCounts) {
  cut(5, 3, 7);
  EXPECT_THAT(readings(), ElementsAre());
  view_.mask[view_.index(6, 5)] = 0;  // beside one of them
  EXPECT_THAT(readings(), ElementsAre());
  for (int column = 3; column <= 7; ++column) view_.mask[view_.index(4, column)] = 0;
  EXPECT_EQ(readings().size(), 3U);
}

TEST(LacksUp, WhereItIsNoDirection) {
  ObjectView view = blank_view(2, 2);
  EXPECT_EQ(lacks_up(view), "");
  view.up = {0.0, 0.0, 0.4};
  EXPECT_EQ(lacks_up(view), "the direction of gravity is not known");
}

TEST(LacksGeometry, WhereIntrinsicsAreNotFinite) {
  const std::string why = "the camera's intrinsics are not finite numbers";
  for (const float focal_px : {0.0F, -1.0F, INFINITY, NAN}) {
    ObjectView view = blank_view(2, 2);
    view.focal_px = focal_px;
    EXPECT_EQ(lacks_geometry(view), why) << focal_px;
  }
  ObjectView view = blank_view(2, 2);
  view.centre_px.y() = NAN;
  EXPECT_EQ(lacks_geometry(view), why);
}

/// A plane that leans fills the view.
TEST(ObjectSurface, NormalsAreFittedToASquareOfPixels) {
  ObjectView view = blank_view(9, 9);
  view.focal_px = 100.0;
  std::ranges::fill(view.mask, 1);
  const Eigen::Vector3d normal = Eigen::Vector3d(0.3, -0.2, -1.0).normalized();
  for (int row = 0; row < 9; ++row) {
    for (int column = 0; column < 9; ++column) {
      view.depth_m[view.index(row, column)] =
          static_cast<float>(normal.z() / normal.dot(view.ray(row, column)));
    }
  }
  const ObjectSurface surface = object_surface(view, object_pixels(view), 0.02);
  ASSERT_EQ(surface.cloud.size(), 81U);
  for (std::size_t i = 0; i < 81; ++i) {
    EXPECT_LT((surface.cloud.normals[i].cast<double>() - normal).norm(), 1e-4) << i;
    EXPECT_EQ(surface.point_at[i], static_cast<int>(i));
  }
}

TEST(ObjectSurface, ANormalNeedsSixPixels) {
  const auto normals = [](int rows) {
    ObjectView view = blank_view(2, rows);
    view.focal_px = 100.0;
    std::ranges::fill(view.mask, 1);
    std::ranges::fill(view.depth_m, 1.0F);
    return object_surface(view, object_pixels(view), 0.01).cloud.normals;
  };
  EXPECT_NEAR(normals(3)[0].z(), -1.0F, 1e-5F) << "six in the square of 2 px to each side";
  EXPECT_TRUE(normals(2)[0].isZero());
  EXPECT_NEAR(normals(5)[0].z(), -1.0F, 1e-5F);
}

TEST(RootOfShares, OfASumBelowOneIsOfUnitLengthToo) {
  const Eigen::Vector2f roots = root_of_shares(Eigen::Vector2f(0.0625F, 0.1875F));
  EXPECT_FLOAT_EQ(roots[0], 0.5F);
  EXPECT_FLOAT_EQ(roots[1], std::sqrt(0.75F));
}

/// A step of 20 cm between columns 19 and 20. At a metre the radius would be 20 px.
TEST(ObjectSurface, NormalsAreFittedToEightPixelsToEachSideAtMost) {
  ObjectView view = blank_view(40, 20);
  view.focal_px = 100.0;
  ObjectPixels pixels;
  pixels.width_px = 40;
  pixels.height_px = 20;
  pixels.depth.assign(800, 1);
  pixels.depth_count = 800;
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < 40; ++column) {
      view.depth_m[view.index(row, column)] = column < 20 ? 1.0F : 1.2F;
    }
  }
  const ObjectSurface surface = object_surface(view, pixels, 0.2);
  ASSERT_EQ(surface.cloud.size(), 800U);
  EXPECT_NEAR(surface.cloud.normals[view.index(10, 11)].z(), -1.0F, 1e-4F) << "columns 3 to 19";
  EXPECT_GT(std::abs(surface.cloud.normals[view.index(10, 12)].x()), 0.1F) << "columns 4 to 20";
}

/// The same step between rows 19 and 20.
TEST(ObjectSurface, NormalsAreFittedToEightPixelsUpAndDownAtMost) {
  ObjectView view = blank_view(20, 40);
  view.focal_px = 100.0;
  ObjectPixels pixels;
  pixels.width_px = 20;
  pixels.height_px = 40;
  pixels.depth.assign(800, 1);
  pixels.depth_count = 800;
  for (int row = 0; row < 40; ++row) {
    for (int column = 0; column < 20; ++column) {
      view.depth_m[view.index(row, column)] = row < 20 ? 1.0F : 1.2F;
    }
  }
  const auto normals = object_surface(view, pixels, 0.2).cloud.normals;
  ASSERT_EQ(normals.size(), 800U);
  EXPECT_NEAR(normals[view.index(11, 10)].z(), -1.0F, 1e-4F) << "rows 3 to 19";
  EXPECT_GT(std::abs(normals[view.index(12, 10)].y()), 0.1F) << "rows 4 to 20";
  EXPECT_GT(std::abs(normals[view.index(27, 10)].y()), 0.1F) << "rows 19 to 35";
  EXPECT_NEAR(normals[view.index(28, 10)].z(), -1.0F, 1e-4F) << "rows 20 to 36";
}

}  // namespace
}  // namespace vantage
