// The steps of cutting an object out by depth, on images of a few pixels.
#include "vantage/perception/column_cut.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "vantage/perception/object_cut.hpp"

namespace vantage {
namespace {

using testing::Each;
using testing::ElementsAre;

cv::Mat1b mask_from(const std::vector<std::string>& rows) {
  cv::Mat1b mask(static_cast<int>(rows.size()), static_cast<int>(rows[0].size()));
  for (int row = 0; row < mask.rows; ++row) {
    for (int x = 0; x < mask.cols; ++x) {
      mask(row, x) =
          rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(x)] == '#' ? 255 : 0;
    }
  }
  return mask;
}

std::vector<std::string> rows_of(const cv::Mat1b& mask) {
  std::vector<std::string> rows;
  for (int row = 0; row < mask.rows; ++row) {
    rows.emplace_back();
    for (int x = 0; x < mask.cols; ++x) rows.back() += mask(row, x) != 0 ? '#' : '.';
  }
  return rows;
}

TEST(FillHoles, ThoseThatAreEnclosedAndHighOnAverage) {
  cv::Mat1b mask = mask_from({"#######",  //
                              "#..#.#.",  //
                              "#######"});
  cv::Mat1f heights_m(3, 7, 0.5F);
  heights_m(1, 1) = 0.004F;
  heights_m(1, 2) = 0.008F;  // 6 mm on average
  heights_m(1, 4) = 0.0049F;
  fill_holes(mask, heights_m, 0.005);
  EXPECT_THAT(rows_of(mask), ElementsAre("#######",  //
                                         "####.#.",  //
                                         "#######"));
  mask = mask_from({"#.#", "###", "#.#"});
  fill_holes(mask, cv::Mat1f(3, 3, 1.0F), 0.005);
  EXPECT_THAT(rows_of(mask), ElementsAre("#.#", "###", "#.#")) << "open above and below";
}

TEST(AddUnmeasured, WhatTheObjectEnclosesForTheMostPart) {
  const auto added = [](const std::vector<std::string>& rows, const cv::Rect& hole) {
    cv::Mat1b mask = mask_from(rows);
    cv::Mat1f depth_m(mask.size(), 1.0F);
    depth_m(hole) = 0.0F;
    add_unmeasured(mask, depth_m);
    return rows_of(mask);
  };
  // Of the eight round the hole, five are the object's, then four.
  EXPECT_THAT(added({".....", ".##..", ".#...", ".##..", "....."}, {2, 2, 1, 1}),
              ElementsAre(".....", ".##..", ".##..", ".##..", "....."));
  EXPECT_THAT(added({".....", ".#...", ".#...", ".##..", "....."}, {2, 2, 1, 1}),
              ElementsAre(".....", ".#...", ".#...", ".##..", "....."));
  // At the patch's border it may go on beyond.
  EXPECT_THAT(added({".##..", ".##..", ".##.."}, {0, 1, 1, 1}),
              ElementsAre(".##..", ".##..", ".##.."));
  EXPECT_THAT(added({"###", "#.#", "###"}, {1, 1, 1, 1}), ElementsAre("###", "###", "###"));
}

TEST(AddUnmeasured, OneHoleAfterTheOther) {
  cv::Mat1b mask = mask_from({"######", ".#####", "####.#", "######"});
  cv::Mat1f depth_m(mask.size(), 1.0F);
  depth_m(1, 0) = depth_m(2, 4) = 0.0F;
  add_unmeasured(mask, depth_m);
  EXPECT_THAT(rows_of(mask), ElementsAre("######", ".#####", "######", "######"));
}

TEST(AddFoot, GrowsOverWhatIsLowByTheHeightOfAFoot) {
  CameraImages images;
  images.focal_px = 300.0;
  cv::Mat1f heights_m(6, 5, 0.0035F);
  heights_m.row(4) = 0.0029F;
  const auto foot = [&](double distance_m) {
    cv::Mat1b mask = mask_from({"..#..", ".....", ".....", ".....", ".....", "....."});
    add_foot(mask, heights_m, images, distance_m, 0.009);
    return rows_of(mask);
  };
  // 2.7 / 1.36 is a little below 2 px, 2.7 / 1.34 above; a third of 9 mm is low.
  EXPECT_THAT(foot(1.36), ElementsAre("#####", ".###.", "..#..", ".....", ".....", "....."));
  EXPECT_THAT(foot(1.34), ElementsAre("#####", "#####", ".###.", "..#..", ".....", "....."));
  EXPECT_THAT(foot(0.5), ElementsAre("#####", "#####", "#####", "#####", ".....", "....."))
      << "not over what is lower than that";
}

TEST(Square, IsAsWideAsTwiceItsHalfAndOne) {
  EXPECT_EQ(square(2).size(), cv::Size(5, 5));
  EXPECT_EQ(cv::countNonZero(square(1)), 9);
}

/// 6 x 5 px, depth and colour by the pixel's number.
CameraImages numbered() {
  CameraImages images;
  images.width_px = 6;
  images.height_px = 5;
  images.focal_px = 100.0;
  for (int i = 0; i < 30; ++i) {
    images.depth_m.push_back(1.0F + 0.5F * static_cast<float>(i));
    for (int c = 0; c < 3; ++c) images.rgb.push_back(static_cast<std::uint8_t>(3 * i + c));
  }
  return images;
}

TEST(Cut, IsTheMasksBoxWithAMarginInsideTheImage) {
  CameraImages images = numbered();
  images.depth_m[3 * 6 + 4] = INFINITY;
  const ObjectView view = cut(images, mask_from({"...", ".#.", ".#."}), {2, 1}, 1);
  EXPECT_EQ(view.left_px, 2);
  EXPECT_EQ(view.top_px, 1);
  EXPECT_EQ(view.width_px, 3);
  EXPECT_EQ(view.height_px, 4);
  EXPECT_EQ(view.focal_px, 100.0);
  EXPECT_EQ(view.centre_px, Eigen::Vector2d(2.5, 2.0));
  EXPECT_THAT(view.mask, ElementsAre(0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0));
  EXPECT_THAT(view.depth_m, ElementsAre(5.0F, 5.5F, 6.0F, 8.0F, 8.5F, 9.0F, 11.0F, 11.5F, 0.0F,
                                        14.0F, 14.5F, 15.0F));
  ASSERT_EQ(view.rgb.size(), 36U);
  EXPECT_EQ(view.rgb[0], 3 * 8);
  EXPECT_EQ(view.rgb[35], 3 * 28 + 2);
  images.rgb.clear();
  const ObjectView wide = cut(images, mask_from({"...", ".#.", ".#."}), {2, 1}, 10);
  EXPECT_EQ(wide.width_px, 6);
  EXPECT_EQ(wide.height_px, 5);
  EXPECT_TRUE(wide.rgb.empty());
}

TEST(TakeColour, IsOfTheViewsPartOfTheImage) {
  ObjectView view;
  view.left_px = 1;
  view.top_px = 2;
  view.width_px = 2;
  view.height_px = 2;
  take_colour(numbered(), view);
  EXPECT_THAT(view.rgb, ElementsAre(39, 40, 41, 42, 43, 44, 57, 58, 59, 60, 61, 62));
}

/// It looks straight down from 2 m above the table, x right, y towards -y of the world.
Pose overhead() {
  Pose T = Pose::Identity();
  T.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  T.translation() = Eigen::Vector3d(0.0, 0.0, 2.5);
  return T;
}

/// Without depth: a place needs none.
CameraImages wide_image() {
  CameraImages images;
  images.width_px = 401;
  images.height_px = 301;
  images.focal_px = 150.0;
  return images;
}

TEST(PlaceOfColumn, IsItsProjectionWithAMargin) {
  const CameraImages images = wide_image();
  const ObjectSegmentationOptions options{.radius_m = 0.2, .max_height_m = 0.5};
  // The column's top is 1.5 m away: 0.5 m and 0.1 m are 50 px and 10 px, 0.2 m are 20 px.
  const cv::Rect place = place_of_column(images, overhead(), {0.5, 0.1, 0.5}, options);
  EXPECT_NEAR(place.x, 200 + 22 - 8, 1);
  EXPECT_NEAR(place.br().x, 200 + 70 + 9, 1);
  EXPECT_NEAR(place.y, 150 - 30 - 8, 1);
  EXPECT_NEAR(place.br().y, 150 + 10 + 9, 1);
  // From 22.3 px and -31.5 px beside the middle to 70.5 px and 8.5 px.
  EXPECT_EQ(place_of_column(images, overhead(), {0.505, 0.115, 0.5}, options),
            cv::Rect(214, 110, 66, 58));
  Pose near = overhead();
  near.translation().z() = 1.09;
  EXPECT_EQ(place_of_column(images, near, {0.5, 0.1, 0.5}, options), cv::Rect(0, 0, 401, 301));
  EXPECT_TRUE(place_of_column(images, overhead(), {9.0, 0.1, 0.5}, options).empty());
}

TEST(HeightsOver, AreThoseInTheColumn) {
  CameraImages images;
  images.width_px = 5;
  images.height_px = 1;
  images.focal_px = 10.0;  // 2 m away, a pixel is 20 cm wide
  images.depth_m = {2.0F, 1.9F, 1.5F, 0.0F, INFINITY};
  TablePlane table;
  table.centroid_m = {0.0, 0.0, 0.5};
  Patch patch{cv::Rect(0, 0, 5, 1), cv::Mat1f(1, 5)};
  std::ranges::copy(images.depth_m, patch.depth_m.begin());
  const auto heights = [&](const ObjectSegmentationOptions& options) {
    const cv::Mat1f found =
        heights_over(patch, images, overhead(), table, {0.0, 0.0, 0.5}, options);
    return std::vector<float>(found.begin(), found.end());
  };
  EXPECT_THAT(heights({.radius_m = 0.41, .max_height_m = 0.51}),
              ElementsAre(0.0F, testing::FloatNear(0.1F, 1e-6F), testing::FloatNear(0.5F, 1e-6F),
                          kOutside, kOutside));
  EXPECT_THAT(heights({.radius_m = 0.39, .max_height_m = 0.49}),
              ElementsAre(kOutside, testing::FloatNear(0.1F, 1e-6F), kOutside, kOutside, kOutside));
}

TEST(CropToMask, KeepsEightPixelsRoundIt) {
  ObjectView picture;
  picture.width_px = 40;
  picture.height_px = 30;
  picture.left_px = 100;
  picture.top_px = 50;
  picture.focal_px = 321.0;
  picture.centre_px = {11.0, 12.0};
  picture.up = {0.6, -0.8, 0.0};
  std::vector<std::uint8_t> mask(1200, 0);
  for (int i = 0; i < 1200; ++i) {
    picture.depth_m.push_back(static_cast<float>(i));
    for (int c = 0; c < 3; ++c) picture.rgb.push_back(static_cast<std::uint8_t>((i + c) % 251));
  }
  for (const auto& [row, column] : {std::pair{10, 12}, {13, 17}})
    mask[picture.index(row, column)] = 1;
  const ObjectView view = crop_to_mask(picture, mask);
  EXPECT_EQ(view.left_px, 104);
  EXPECT_EQ(view.top_px, 52);
  EXPECT_EQ(view.width_px, 22);
  EXPECT_EQ(view.height_px, 20);
  EXPECT_EQ(view.focal_px, 321.0);
  EXPECT_EQ(view.centre_px, Eigen::Vector2d(11.0, 12.0));
  EXPECT_EQ(view.up, Eigen::Vector3d(0.6, -0.8, 0.0));
  EXPECT_EQ(std::ranges::count(view.mask, 1), 2);
  EXPECT_EQ(view.mask[view.index(8, 8)], 1);
  EXPECT_EQ(view.mask[view.index(11, 13)], 1);
  EXPECT_EQ(view.depth_m[view.index(3, 5)], 5.0F * 40.0F + 9.0F);
  EXPECT_EQ(view.rgb[3 * view.index(3, 5) + 2], 211);
  EXPECT_THAT(cut_nothing(picture).mask, Each(1));
  EXPECT_EQ(cut_nothing(picture).mask.size(), 1200U);
}

TEST(FillHoles, NoneThatIsOpenOnOneSide) {
  const std::vector<std::vector<std::string>> open{
      {"###", "..#", "###"}, {"###", "#..", "###"}, {"#.#", "#.#", "###"}, {"###", "#.#", "#.#"}};
  for (const auto& rows : open) {
    cv::Mat1b mask = mask_from(rows);
    fill_holes(mask, cv::Mat1f(3, 3, 1.0F), 0.005);
    EXPECT_EQ(rows_of(mask), rows);
  }
}

TEST(AddUnmeasured, WhatIsBeyondTheRangeWasNotMeasured) {
  cv::Mat1b mask = mask_from({"###", "#.#", "###"});
  cv::Mat1f depth_m(3, 3, 1.0F);
  depth_m(1, 1) = INFINITY;
  add_unmeasured(mask, depth_m);
  EXPECT_THAT(rows_of(mask), ElementsAre("###", "###", "###"));
}

/// 9 mm are 2.7 px at 10 cm.
TEST(AddFoot, IsNoLargerNearerThanTenCentimetres) {
  CameraImages images;
  images.focal_px = 30.0;
  cv::Mat1b mask = mask_from({"..#..", ".....", ".....", ".....", ".....", "....."});
  add_foot(mask, cv::Mat1f(6, 5, 0.0035F), images, 0.01, 0.009);
  EXPECT_THAT(rows_of(mask), ElementsAre("#####", "#####", ".###.", "..#..", ".....", "....."));
}

TEST(HeightsOver, GoOnBehindWhatWasNotMeasured) {
  CameraImages images;
  images.width_px = 5;
  images.height_px = 1;
  images.focal_px = 10.0;
  images.depth_m = {0.0F, 1.9F, INFINITY, 1.5F, 2.0F};
  TablePlane table;
  table.centroid_m = {0.0, 0.0, 0.5};
  Patch patch{cv::Rect(0, 0, 5, 1), cv::Mat1f(1, 5)};
  std::ranges::copy(images.depth_m, patch.depth_m.begin());
  const cv::Mat1f heights_m = heights_over(patch, images, overhead(), table, {0.0, 0.0, 0.5},
                                           {.radius_m = 0.41, .max_height_m = 0.51});
  EXPECT_EQ(heights_m(0, 0), kOutside);
  EXPECT_NEAR(heights_m(0, 1), 0.1, 1e-6);
  EXPECT_EQ(heights_m(0, 2), kOutside);
  EXPECT_NEAR(heights_m(0, 3), 0.5, 1e-6);
  EXPECT_NEAR(heights_m(0, 4), 0.0, 1e-6);
}

TEST(PlaceOfColumn, BeginsFiveCentimetresBelowTheTableAndTenBeforeTheCamera) {
  const CameraImages images = wide_image();
  const ObjectSegmentationOptions options{.radius_m = 0.2, .max_height_m = 0.5};
  // 0.314 m at 2.05 m are 22.98 px, at 2.025 m they would be 23.26.
  EXPECT_EQ(place_of_column(images, overhead(), {0.514, 0.115, 0.5}, options),
            cv::Rect(214, 110, 67, 58));
  // Its top, 15 cm away, ends 96.5 px below the middle.
  Pose near = overhead();
  near.translation().z() = 1.15;
  EXPECT_EQ(place_of_column(images, near, {0.5, 0.1035, 0.5}, options), cv::Rect(256, 0, 145, 256));
}

/// Turned by an eighth, each upper corner is the outermost to one side of the image; of a place
/// that is ahead along the turned x axis the nearest is a lower one.
TEST(PlaceOfColumn, HoldsEachCornerOfTheColumn) {
  Pose turned = overhead();
  turned.linear() << std::sqrt(0.5), std::sqrt(0.5), 0, std::sqrt(0.5), -std::sqrt(0.5), 0, 0, 0,
      -1;
  const CameraImages images = wide_image();
  const ObjectSegmentationOptions options{.radius_m = 0.2, .max_height_m = 0.5};
  EXPECT_EQ(place_of_column(images, turned, {0.0, 0.0, 0.5}, options), cv::Rect(163, 113, 75, 75));
  EXPECT_EQ(place_of_column(images, turned, {0.5, 0.5, 0.5}, options), cv::Rect(223, 113, 85, 75));
}

/// The camera itself, 2 m above the table, would be in a column of 2.5 m.
TEST(HeightsOver, WhatWasNotMeasuredIsNotAtTheCamera) {
  CameraImages images;
  images.width_px = 3;
  images.height_px = 1;
  images.focal_px = 10.0;
  images.depth_m = {2.0F, 0.0F, 1.5F};
  TablePlane table;
  table.centroid_m = {0.0, 0.0, 0.5};
  Patch patch{cv::Rect(0, 0, 3, 1), cv::Mat1f(1, 3)};
  std::ranges::copy(images.depth_m, patch.depth_m.begin());
  ObjectSegmentationOptions options;
  options.radius_m = 1.0;
  options.max_height_m = 2.5;
  const cv::Mat1f heights_m =
      heights_over(patch, images, overhead(), table, {0.0, 0.0, 0.5}, options);
  EXPECT_NEAR(heights_m(0, 0), 0.0, 1e-6);
  EXPECT_EQ(heights_m(0, 1), kOutside);
  EXPECT_NEAR(heights_m(0, 2), 0.5, 1e-6);
}

TEST(CropToMask, EndsAtThePicturesBorder) {
  ObjectView picture;
  picture.width_px = 40;
  picture.height_px = 30;
  picture.left_px = 100;
  picture.top_px = 50;
  picture.depth_m.assign(1200, 1.0F);
  picture.rgb.assign(3600, 9);
  std::vector<std::uint8_t> mask(1200, 0);
  mask.front() = mask.back() = 1;
  const ObjectView view = crop_to_mask(picture, mask);
  EXPECT_EQ(view.left_px, 100);
  EXPECT_EQ(view.top_px, 50);
  EXPECT_EQ(view.width_px, 40);
  EXPECT_EQ(view.height_px, 30);
  EXPECT_EQ(view.mask, mask);
}

}  // namespace
}  // namespace vantage
