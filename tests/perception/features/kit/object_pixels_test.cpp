#include "vantage/perception/features/kit/object_pixels.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/object_views.hpp"

namespace vantage {
namespace {

/// A 20 x 20 view with the mask of columns and rows `from` .. `to` - 1, 1 m away.
ObjectView square(int from, int to) {
  ObjectView view = blank_view(20, 20);
  for (int row = from; row < to; ++row) {
    for (int column = from; column < to; ++column) {
      view.mask[view.index(row, column)] = 1;
      view.depth_m[view.index(row, column)] = 1.0F;
    }
  }
  return view;
}

TEST(ObjectPixels, TwoPixelsGoOffEachEdge) {
  const ObjectPixels pixels = object_pixels(square(2, 18));
  EXPECT_EQ(pixels.colour_count, 12 * 12);
  EXPECT_EQ(pixels.depth_count, 12 * 12);
  EXPECT_EQ(pixels.left_px, 4);
  EXPECT_EQ(pixels.bottom_px, 16);
}

TEST(ObjectPixels, TheFrameIsNoEdge) { EXPECT_EQ(object_pixels(square(0, 20)).colour_count, 400); }

TEST(ObjectPixels, ThinObjectsKeepTheirPixels) {
  ObjectView view = blank_view(20, 20);
  for (int column = 0; column < 20; ++column) view.mask[view.index(10, column)] = 1;
  EXPECT_EQ(object_pixels(view).colour_count, 20);
}

TEST(ObjectPixels, BackgroundIsAnOutlier) {
  ObjectView view = square(2, 18);
  for (int row = 4; row < 16; ++row) view.depth_m[view.index(row, 4)] = 1.5F;
  view.depth_m[view.index(8, 8)] = 0.0F;
  view.depth_m[view.index(8, 9)] = std::numeric_limits<float>::quiet_NaN();
  view.depth_m[view.index(8, 10)] = std::numeric_limits<float>::infinity();
  view.depth_m[view.index(8, 11)] = -1.0F;
  const ObjectPixels pixels = object_pixels(view);
  EXPECT_EQ(pixels.colour_count, 144);
  EXPECT_EQ(pixels.depth_count, 144 - 12 - 4);
}

TEST(ObjectPixels, AnObjectSpreadInDepthIsWhole) {
  ObjectView view = square(2, 18);
  for (int row = 2; row < 18; ++row) {
    for (int column = 2; column < 18; ++column) {
      view.depth_m[view.index(row, column)] = 1.0F + 0.02F * static_cast<float>(row);
    }
  }
  EXPECT_EQ(object_pixels(view).depth_count, 144);
}

TEST(ObjectPixels, OutliersAlongTheSightAreTheSameBesideThePicturesMiddle) {
  const auto counted = [](int left_px, bool along_sight) {
    ObjectView view = square(0, 20);
    view.left_px = left_px;
    const Eigen::Vector3d sight =
        (view.ray(9, 9) + view.ray(9, 10) + view.ray(10, 9) + view.ray(10, 10)).normalized();
    for (int row = 0; row < 20; ++row) {
      for (int column = 0; column < 20; ++column) {  // a plane across the sight, with a far part
        const Eigen::Vector3d ray = view.ray(row, column);
        const double away_m = row < 8 ? 1.021 : 1.0;
        view.depth_m[view.index(row, column)] = static_cast<float>(away_m / sight.dot(ray));
      }
    }
    return object_pixels(view, {.floor_m = 0.02, .along_sight = along_sight}).depth_count;
  };
  EXPECT_EQ(counted(310, true), 20 * 12);
  EXPECT_EQ(counted(600, true), 20 * 12);
  EXPECT_NE(counted(600, false), 20 * 12) << "it counts as nearer along the optical axis";
}

TEST(ObjectPixels, EmptyMasksAndViewsAreSaidToLackPixels) {
  EXPECT_EQ(object_pixels(blank_view(20, 20)).colour_count, 0);
  const ObjectPixels none = object_pixels(blank_view(0, 0));
  EXPECT_EQ(lacks_colour(none, 1), "the mask has 0 usable pixels, fewer than 1");
  EXPECT_EQ(lacks_depth(none, 1), "0 pixels of the object have depth, fewer than 1");
  EXPECT_TRUE(lacks_colour(none, 0).empty());
}

TEST(ResizedView, PointsStayWhereTheyAre) {
  Rng rng(1);
  const ObjectView view = ball_view(60, {}, rng);
  const ObjectView half = resized(view, 30, 30);
  const Eigen::Vector3d p = view.point(30, 30) / view.depth_m[view.index(30, 30)];
  const Eigen::Vector3d q = half.point(15, 15) / half.depth_m[half.index(15, 15)];
  EXPECT_LT((p - q).norm(), 1.0 / view.focal_px);
}

}  // namespace
}  // namespace vantage
