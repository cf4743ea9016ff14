#include "vantage/perception/features/kit/object_pixels.hpp"

#include <gtest/gtest.h>

#include <array>
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

/// A square of pixels that the frame does not touch, eroded by 2 px, by 1 px or not at all.
TEST(ObjectPixels, ErosionLeavesAtLeastHalf) {
  const auto counted = [](int side) { return object_pixels(square(3, 3 + side)).colour_count; };
  EXPECT_EQ(counted(14), 10 * 10);
  EXPECT_EQ(counted(13), 11 * 11);
  EXPECT_EQ(counted(7), 5 * 5);
  EXPECT_EQ(counted(6), 6 * 6);
}

TEST(ObjectPixels, BoundsAreThoseOfTheErodedMask) {
  ObjectView view = blank_view(30, 24);
  for (int row = 3; row < 19; ++row) {
    for (int column = 6; column < 26; ++column) view.mask[view.index(row, column)] = 7;
  }
  const ObjectPixels pixels = object_pixels(view);
  EXPECT_EQ(pixels.left_px, 8);
  EXPECT_EQ(pixels.right_px, 24);
  EXPECT_EQ(pixels.top_px, 5);
  EXPECT_EQ(pixels.bottom_px, 17);
  EXPECT_EQ(pixels.colour_count, 16 * 12);
  EXPECT_EQ(pixels.depth_count, 0);
}

/// 150 pixels at 1 m, 250 of 1 cm more or less: their median deviation is 1 cm.
TEST(ObjectPixels, OutliersAreFourMedianDeviationsOff) {
  ObjectView view = square(0, 20);
  for (std::size_t i = 0; i < 125; ++i) {
    view.depth_m[2 * i] = 0.99F;
    view.depth_m[2 * i + 1] = 1.01F;
  }
  EXPECT_EQ(object_pixels(view).depth_count, 400);
  view.depth_m[1] = 1.039F;
  view.depth_m[0] = 0.961F;
  EXPECT_EQ(object_pixels(view).depth_count, 400);
  view.depth_m[1] = 1.041F;
  EXPECT_EQ(object_pixels(view).depth_count, 399);
  view.depth_m[0] = 0.959F;
  EXPECT_EQ(object_pixels(view).depth_count, 398);
  EXPECT_EQ(object_pixels(view, {.floor_m = 0.05}).depth_count, 400);
}

TEST(ObjectPixels, NoneIsAnOutlierWithinTheFloor) {
  ObjectView view = square(0, 20);
  view.depth_m[7] = 1.019F;
  EXPECT_EQ(object_pixels(view).depth_count, 400);
  view.depth_m[7] = 1.021F;
  EXPECT_EQ(object_pixels(view).depth_count, 399);
}

TEST(ObjectPixels, EnoughIsAsManyAsAreAskedFor) {
  ObjectPixels pixels;
  pixels.colour_count = 7;
  pixels.depth_count = 5;
  EXPECT_EQ(lacks_colour(pixels, 7), "");
  EXPECT_EQ(lacks_colour(pixels, 8), "the mask has 7 usable pixels, fewer than 8");
  EXPECT_EQ(lacks_depth(pixels, 5), "");
  EXPECT_EQ(lacks_depth(pixels, 6), "5 pixels of the object have depth, fewer than 6");
}

TEST(PlaceInBox, IsAShareOfEachSide) {
  ObjectPixels pixels;
  pixels.left_px = 10;
  pixels.right_px = 30;
  pixels.top_px = 5;
  pixels.bottom_px = 45;
  EXPECT_EQ(place_in_box(pixels, 15.0, 35.0), (std::array{0.25F, 0.75F}));
  EXPECT_EQ(place_in_box(pixels, 9.0, 46.0), (std::array{0.0F, 1.0F}));
  EXPECT_EQ(place_in_box(pixels, 31.0, 4.0), (std::array{1.0F, 0.0F}));
  EXPECT_EQ(place_in_box({}, 0.5, 0.25), (std::array{0.5F, 0.25F})) << "a box of nothing";
}

TEST(ResizedPixels, AreThoseOfTheNearest) {
  ObjectPixels pixels;
  pixels.width_px = 4;
  pixels.height_px = 2;
  pixels.colour = {0, 1, 1, 0, 0, 0, 1, 0};
  pixels.depth = {0, 0, 1, 0, 0, 0, 0, 0};
  const ObjectPixels large = resized(pixels, 8, 4);
  EXPECT_EQ(large.width_px, 8);
  EXPECT_EQ(large.height_px, 4);
  EXPECT_EQ(large.colour_count, 12);
  EXPECT_EQ(large.depth_count, 4);
  EXPECT_EQ(large.left_px, 2);
  EXPECT_EQ(large.right_px, 6);
  EXPECT_EQ(large.top_px, 0);
  EXPECT_EQ(large.bottom_px, 4);
  EXPECT_EQ(large.depth[8 + 5], 1);
}

TEST(ResizedView, TakesItsPlaceAndIntrinsicsAlong) {
  ObjectView view = blank_view(4, 2);
  view.left_px = 101;
  view.top_px = 50;
  view.focal_px = 400.0;
  view.centre_px = {300.0, 200.0};
  view.rgb = {10, 20, 30, 20, 30, 40, 0, 0, 0, 8, 8, 8, 30, 40, 50, 40, 50, 60, 0, 0, 0, 8, 8, 8};
  view.cut_off.assign(8, 1);
  const ObjectView half = resized(view, 2, 1);
  EXPECT_EQ(half.left_px, 51) << "50.5, rounded away from zero";
  EXPECT_EQ(half.top_px, 25);
  EXPECT_EQ(half.focal_px, 200.0);
  EXPECT_EQ(half.centre_px, Eigen::Vector2d(150.0, 100.0));
  EXPECT_EQ(half.rgb, (std::vector<std::uint8_t>{25, 35, 45, 4, 4, 4})) << "the means of four";
  EXPECT_EQ(half.depth_m.size(), 2U);
  EXPECT_TRUE(half.cut_off.empty());
  EXPECT_EQ(resized(view, 4, 2).cut_off.size(), 8U) << "of its own size it stays as it is";
}

TEST(ResizedView, OfOneSideAloneIsResizedToo) {
  const ObjectView view = blank_view(4, 2);
  EXPECT_EQ(resized(view, 4, 1).height_px, 1);
  EXPECT_EQ(resized(view, 4, 1).mask.size(), 4U);
  EXPECT_EQ(resized(view, 2, 2).width_px, 2);
}

}  // namespace
}  // namespace vantage
