// Limits of the search for support surfaces and objects, on level grids of points.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "vantage/perception/search/object_search.hpp"
#include "vantage/perception/search/support_search.hpp"

namespace vantage {
namespace {

/// A point every 2 cm of a rectangle round (x, y), rising along x.
PointCloud level_grid(double x, double y, double z, int columns, int rows, double slope = 0.0) {
  PointCloud cloud;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      const double u = 0.02 * (i - 0.5 * (columns - 1));
      cloud.points.emplace_back(x + u, y + 0.02 * (j - 0.5 * (rows - 1)), z + slope * u);
    }
  }
  return cloud;
}

TEST(SupportLimits, ALevelSurfaceIsFoundWhereItIs) {
  const auto supports = find_supports(level_grid(1.2, -0.7, 0.805, 26, 21), {});
  ASSERT_EQ(supports.size(), 1U);
  EXPECT_NEAR(supports[0].height_m, 0.805, 1e-6);
  EXPECT_LT((supports[0].centroid_m - Eigen::Vector3d(1.2, -0.7, 0.805)).norm(), 1e-6);
  EXPECT_LT((supports[0].normal - Eigen::Vector3d::UnitZ()).norm(), 1e-6);
  EXPECT_EQ(supports[0].inliers, 26U * 21U);
  EXPECT_TRUE(inside_hull(supports[0].hull, {1.2 + 0.249, -0.7 - 0.199}));
  EXPECT_FALSE(inside_hull(supports[0].hull, {1.2 + 0.251, -0.7}));
  EXPECT_NEAR(supports[0].scatter_m2(2, 2), 0.0, 1e-9);
  EXPECT_NEAR(supports[0].scatter_m2(0, 0), 21.0 * 4e-4 * 26.0 * (26.0 * 26.0 - 1.0) / 12.0, 1e-4);
}

TEST(SupportLimits, HeightsAreBetweenTheTwo) {
  const auto found_at = [](double z_m) {
    return find_supports(level_grid(0.0, 0.0, z_m, 21, 21), {}).size();
  };
  EXPECT_EQ(found_at(0.29), 0U);
  EXPECT_EQ(found_at(0.31), 1U);
  EXPECT_EQ(found_at(1.49), 1U);
  EXPECT_EQ(found_at(1.51), 0U);
}

/// Of 50 by 40 cm.
TEST(SupportLimits, AreaIsAtLeastWhatIsAskedFor) {
  const PointCloud grid = level_grid(0.0, 0.0, 0.8, 26, 21);
  EXPECT_EQ(find_supports(grid, {.min_area_m2 = 0.19}).size(), 1U);
  EXPECT_EQ(find_supports(grid, {.min_area_m2 = 0.27}).size(), 0U);
}

TEST(SupportLimits, SurfacesApartAreTwo) {
  PointCloud grid = level_grid(0.0, 0.0, 0.8, 21, 21);
  append(grid, level_grid(0.0, 1.0, 0.8, 21, 21));
  const auto supports = find_supports(grid, {});
  ASSERT_EQ(supports.size(), 2U);
  EXPECT_NEAR(std::abs(supports[0].centroid_m.y() - supports[1].centroid_m.y()), 1.0, 1e-5);
}

TEST(SupportLimits, ATiltIsFittedUpToItsLimit) {
  const auto slight = find_supports(level_grid(0.0, 0.0, 0.8, 26, 21, 0.05), {});
  ASSERT_EQ(slight.size(), 1U);
  const double variance = 4e-4 * (26.0 * 26.0 - 1.0) / 12.0;
  const double slope = 0.05 * variance / (variance + 4e-4);
  EXPECT_LT((slight[0].normal - Eigen::Vector3d(-slope, 0.0, 1.0).normalized()).norm(), 1e-5);
  const auto steep = find_supports(level_grid(0.0, 0.0, 0.8, 11, 21, 0.2), {});
  ASSERT_EQ(steep.size(), 1U);
  EXPECT_NEAR(steep[0].normal.z(), std::cos(0.08), 1e-9);
  EXPECT_LT(steep[0].normal.x(), 0.0);
}

TEST(SupportLimits, WhereNoTiltIsAllowedALevelSurfaceIsLevel) {
  SupportSearchOptions options;
  options.max_tilt_rad = 0.0;
  const auto supports = find_supports(level_grid(0.0, 0.0, 0.5, 26, 21), options);
  ASSERT_EQ(supports.size(), 1U);
  EXPECT_EQ(supports[0].normal, Eigen::Vector3d(0.0, 0.0, 1.0));
}

TEST(SupportLimits, NothingComesOfNothing) {
  EXPECT_TRUE(find_supports({}, {}).empty());
  EXPECT_TRUE(find_supports(level_grid(0.0, 0.0, 0.1, 26, 21), {}).empty());
}

TEST(CutAt, AnObjectMustStandOutOfTheNoiseThere) {
  ObjectSearchOptions options;
  EXPECT_NEAR(cut_at(options, 0.0).min_height_m, 0.006, 1e-12);
  EXPECT_NEAR(cut_at(options, 2.0).min_height_m, 0.006 + 1.5 * 0.0008 * 4.0, 1e-12);
  options.noise_per_m = 0.01;
  options.cut.min_height_m = 0.02;
  EXPECT_NEAR(cut_at(options, 3.0).min_height_m, 0.02 + 0.135, 1e-12);
  EXPECT_EQ(cut_at(options, 3.0).radius_m, 0.3);
  EXPECT_EQ(cut_at(options, 3.0).min_pixels, 60);
}

TEST(DetectionsOf, AreThoseOfTheObjectsInTheirOrder) {
  std::vector<SeenObject> seen(2);
  seen[0].detection.distance_m = 2.5;
  seen[1].detection.distance_m = 1.5;
  seen[1].detection.pixels = 77;
  const auto detections = detections_of(seen);
  ASSERT_EQ(detections.size(), 2U);
  EXPECT_EQ(detections[0].distance_m, 2.5);
  EXPECT_EQ(detections[1].distance_m, 1.5);
  EXPECT_EQ(detections[1].pixels, 77);
}

/// Cells of 1/16 m from the first point on: 4 cm, 12 cm and 14 cm are one, two and three of them.
TEST(SupportLimits, ASurfaceIsThreeCellsWide) {
  const SupportSearchOptions sixteenths{.cell_m = 0.0625};
  EXPECT_TRUE(find_supports(level_grid(0.0, 0.0, 0.8, 3, 51), sixteenths).empty());
  EXPECT_TRUE(find_supports(level_grid(0.0, 0.0, 0.8, 7, 51), sixteenths).empty());
  EXPECT_EQ(find_supports(level_grid(0.0, 0.0, 0.8, 8, 51), sixteenths).size(), 1U);
}

/// Points at one height count in five bins of 1 cm; the middle of the lowest is theirs.
TEST(SupportLimits, PointsAreWithinTwoInlierDistancesOfTheirHeight) {
  const double off_m = 0.5 - 48.5 * 0.01;
  const auto found_with = [](double inlier_m) {
    const SupportSearchOptions options{
        .min_height_m = 0.0, .max_height_m = 1.0, .inlier_distance_m = inlier_m};
    return find_supports(level_grid(0.0, 0.0, 0.5, 26, 21), options).size();
  };
  EXPECT_EQ(found_with(0.5 * off_m), 1U);
  EXPECT_EQ(found_with(0.499 * off_m), 0U);
}

TEST(SupportLimits, OfTwoAtAboutOneHeightTheOneOfMorePointsStays) {
  PointCloud grid = level_grid(0.0, 0.0, 0.8, 12, 12);
  append(grid, level_grid(0.0, 0.0, 0.85, 26, 21));
  const auto supports = find_supports(grid, {});
  ASSERT_EQ(supports.size(), 1U);
  EXPECT_NEAR(supports[0].height_m, 0.85, 1e-6);
  EXPECT_EQ(supports[0].inliers, 26U * 21U);
}

/// A point in each of these cells of 1/16 m.
std::size_t supports_of_cells(const std::vector<std::pair<int, int>>& cells) {
  PointCloud cloud;
  for (const auto& [x, y] : cells) cloud.points.emplace_back(0.0625F * x, 0.0625F * y, 0.805F);
  return find_supports(cloud, {.cell_m = 0.0625, .min_area_m2 = 0.008}).size();
}

TEST(SupportLimits, TwelvePointsShowAHeightAndEightASurface) {
  std::vector<std::pair<int, int>> cells;
  for (int i = 0; i < 12; ++i) cells.emplace_back(i / 4, i % 4);
  EXPECT_EQ(supports_of_cells(cells), 1U);
  cells.erase(cells.begin());
  EXPECT_EQ(supports_of_cells(cells), 0U);
  // Round a cell, and some far away.
  cells = {{0, 0}, {0, 1}, {0, 2}, {1, 2}, {2, 2}, {2, 1}, {2, 0}, {1, 0}};
  for (const int far : {20, 24, 28, 32}) cells.emplace_back(far, 0);
  EXPECT_EQ(supports_of_cells(cells), 1U);
  cells[7] = {36, 0};
  EXPECT_EQ(supports_of_cells(cells), 0U);
}

TEST(SupportLimits, ALesserHeightIsToldFromAGreaterOneFromNineCentimetresOn) {
  const auto found_with = [](double z_m) {
    PointCloud grid = level_grid(0.0, 0.0, 0.805, 21, 21);
    append(grid, level_grid(0.0, 1.0, z_m, 20, 20));
    return find_supports(grid, {}).size();
  };
  EXPECT_EQ(found_with(0.885), 1U);
  EXPECT_EQ(found_with(0.895), 2U);
}

/// A point more, in the middle: 8 cm above the lowest of a surface's five bins is tall, and of the
/// surface is what is within half the inlier distance.
TEST(SupportLimits, APointAboveItIsOfTheSurfaceOrTall) {
  const auto inliers_with = [](double z_m) {
    PointCloud grid = level_grid(0.0, 0.0, 0.805, 26, 21);
    grid.points.emplace_back(0.01, 0.01, z_m);
    const auto supports = find_supports(grid, {});
    return supports.size() == 1 ? supports[0].inliers : 0U;
  };
  EXPECT_EQ(inliers_with(0.805 + 0.0098), 547U);
  EXPECT_EQ(inliers_with(0.805 + 0.0102), 546U);
  EXPECT_EQ(inliers_with(0.86), 546U);
  EXPECT_LT(inliers_with(0.87), 546U);
  EXPECT_GT(inliers_with(0.87), 500U);
}

/// What lies 9 cm below the hole of a frame, and not under the frame's middle.
TEST(SupportLimits, OfTwoAboveEachOtherTheLowerStaysHoweverSmall) {
  PointCloud frame = level_grid(0.0, 0.0, 0.895, 51, 51);
  std::erase_if(frame.points, [](const Eigen::Vector3f& p) {
    return p.head<2>().cwiseAbs().maxCoeff() < 0.301F;
  });
  append(frame, level_grid(0.18, 0.0, 0.805, 12, 12));
  const auto supports = find_supports(frame, {});
  ASSERT_EQ(supports.size(), 1U);
  EXPECT_NEAR(supports[0].height_m, 0.805, 1e-6);
  EXPECT_EQ(supports[0].inliers, 144U);
}

/// The same, just three inlier distances below.
TEST(SupportLimits, ThreeInlierDistancesAreNotAboutOneHeight) {
  SupportSearchOptions options;
  options.inlier_distance_m = 0.03125;
  PointCloud frame = level_grid(0.0, 0.0, 0.59375, 51, 51);
  std::erase_if(frame.points, [](const Eigen::Vector3f& p) {
    return p.head<2>().cwiseAbs().maxCoeff() < 0.301F;
  });
  append(frame, level_grid(0.18, 0.0, 0.5, 12, 12));
  const auto supports = find_supports(frame, options);
  ASSERT_EQ(supports.size(), 1U);
  EXPECT_EQ(supports[0].height_m, 0.5);
}

TEST(SupportLimits, WhatIsOnTheHigherOfTwoSurfacesIsNoThird) {
  PointCloud grid = level_grid(0.0, 0.0, 0.7, 26, 21);
  append(grid, level_grid(0.0, 1.0, 0.8, 41, 41));
  append(grid, level_grid(0.0, 1.0, 0.95, 12, 12));
  const auto supports = find_supports(grid, {});
  ASSERT_EQ(supports.size(), 2U);
  EXPECT_NEAR(supports[0].height_m, 0.7, 1e-6);
  EXPECT_NEAR(supports[1].height_m, 0.8, 1e-6);
}

/// Its hull has 0.2 m^2, its cells more than that.
TEST(SupportLimits, AreaIsThatOfTheHullToo) {
  const PointCloud grid = level_grid(0.0, 0.0, 0.8, 26, 21);
  EXPECT_EQ(find_supports(grid, {.min_area_m2 = 0.199}).size(), 1U);
  EXPECT_EQ(find_supports(grid, {.min_area_m2 = 0.201}).size(), 0U);
}

/// 160 x 120 px from 2 m straight above a table 0.805 m high, a pixel 2 cm wide there.
class BlockFromAbove : public testing::Test {
 protected:
  BlockFromAbove() {
    images_.width_px = 160;
    images_.height_px = 120;
    images_.focal_px = 100.0;
    T_world_camera_.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
    T_world_camera_.translation() = Eigen::Vector3d(0.0, 0.0, 2.805);
  }
  void put(int left, int top, int width, int height, float z_m) {
    for (int row = top; row < top + height; ++row) {
      for (int column = left; column < left + width; ++column) {
        images_.depth_m[static_cast<std::size_t>(row * 160 + column)] = z_m;
      }
    }
  }
  /// Of 10 x 10 px on the table alone.
  void put_block_at(int left, int top, float height_m = 0.2F) {
    images_.depth_m.assign(19200, 2.0F);
    put(left, top, 10, 10, 2.0F - height_m);
  }
  [[nodiscard]] std::vector<SeenObject> found() const {
    return find_objects(images_, T_world_camera_);
  }
  CameraImages images_;
  Pose T_world_camera_ = Pose::Identity();
};

/// Its pixels are 1.8 cm wide, the outermost 4.5 of them off its middle.
TEST_F(BlockFromAbove, IsMeasuredToThePixel) {
  put_block_at(90, 55);
  const auto seen = found();
  ASSERT_EQ(seen.size(), 1U);
  const ObjectDetection& block = seen[0].detection;
  EXPECT_LT((block.p_world_object_m - Eigen::Vector3d(0.27, 0.0, 0.905)).norm(), 1e-5);
  EXPECT_NEAR(block.support_z_m, 0.805, 1e-5);
  EXPECT_NEAR(block.height_m, 0.2, 1e-5);
  EXPECT_NEAR(block.radius_m, 0.018 * std::hypot(4.5, 4.5), 1e-5);
  EXPECT_NEAR(block.distance_m, std::hypot(0.27, 1.9), 1e-5);
  EXPECT_EQ(block.pixels, 100);
}

/// Its mask, a pixel wider, ends 3 px inside the image, or 2.
TEST_F(BlockFromAbove, IsWholeWithinTheBorder) {
  const auto whole = [&](int left, int top) {
    put_block_at(left, top);
    const auto seen = found();
    return seen.size() == 1 ? static_cast<int>(seen[0].detection.whole) : -1;
  };
  EXPECT_EQ(whole(4, 50), 1);
  EXPECT_EQ(whole(3, 50), 0);
  EXPECT_EQ(whole(146, 50), 1);
  EXPECT_EQ(whole(147, 50), 0);
  EXPECT_EQ(whole(90, 4), 1);
  EXPECT_EQ(whole(90, 3), 0);
  EXPECT_EQ(whole(90, 106), 1);
  EXPECT_EQ(whole(90, 107), 0);
}

/// The ring of 2 px round its mask has 112 px, of which five are less than a twentieth.
TEST_F(BlockFromAbove, IsHiddenByWhatIsBeforeItByFifteenCentimetres) {
  const auto found_behind = [&](int pixels, float z_m) {
    put_block_at(90, 50);
    for (int i = 0; i < pixels; ++i) put(i % 2 == 0 ? 101 : 88, 49 + 3 * (i / 2), 1, 1, z_m);
    return found();
  };
  const auto whole = [&](int pixels, float z_m) {
    const auto seen = found_behind(pixels, z_m);
    return seen.size() == 1 && seen[0].detection.whole;
  };
  EXPECT_FALSE(whole(6, 1.64F));
  EXPECT_TRUE(whole(5, 1.64F));
  EXPECT_TRUE(whole(6, 1.66F));
  EXPECT_TRUE(whole(6, 0.0F)) << "nothing was measured there";
  EXPECT_EQ(found_behind(6, 0.9F).size(), 1U) << "more than twice as high as any object";
  EXPECT_EQ(found_behind(6, 1.3F).size(), 0U) << "70 cm high";
}

/// Cut out without a margin, round it are the pixels of its box that are not its own: three corners
/// of the block, and what a row above that is only begun leaves over. One of them is hidden.
TEST_F(BlockFromAbove, IsWholeIfNoMoreThanATwentiethIsHidden) {
  ObjectSearchOptions options;
  options.cut.mask_growth_px = 0;
  options.cut.margin_px = 0;
  const auto whole = [&](int begun) {
    images_.depth_m.assign(19200, 2.0F);
    put(70, 51, 20, 10, 1.8F);
    put(70, 50, begun, 1, 1.8F);
    put(85, 50, 1, 1, 1.64F);
    const auto seen = find_objects(images_, T_world_camera_, options);
    return seen.size() == 1 ? static_cast<int>(seen[0].detection.whole) : -1;
  };
  EXPECT_EQ(whole(4), 1) << "of 20";
  EXPECT_EQ(whole(5), 0) << "of 19";
}

TEST_F(BlockFromAbove, IsWholeFromTheLeastDistanceOn) {
  put_block_at(90, 50);
  ObjectSearchOptions options;
  const auto whole = [&](double nearest_m) {
    options.nearest_m = nearest_m;
    const auto seen = find_objects(images_, T_world_camera_, options);
    return seen.size() == 1 ? static_cast<int>(seen[0].detection.whole) : -1;
  };
  const double top_m = 2.0F - 0.2F;
  EXPECT_EQ(whole(top_m), 1);
  EXPECT_EQ(whole(std::nextafter(top_m, 2.0)), 0);
}

/// Of its 100 px the two highest are left out. The cut knows nothing of what is one pixel wide.
TEST_F(BlockFromAbove, IsAsHighAsAllOfItButAFiftieth) {
  const auto height_m = [&](int higher) {
    put_block_at(90, 55);
    for (int i = 0; i < higher; ++i) put(92 + 2 * i, 57 + 2 * i, 1, 1, 1.75F);
    const auto seen = found();
    return seen.size() == 1 ? seen[0].detection.height_m : -1.0;
  };
  EXPECT_NEAR(height_m(2), 0.2, 1e-5);
  EXPECT_NEAR(height_m(3), 0.25, 1e-5);
}

/// Every fourth pixel is looked at: of its last row alone, three or four.
TEST_F(BlockFromAbove, IsFourPointsAtLeast) {
  ObjectSearchOptions options;
  options.support.columns = 40;
  options.support.cell_m = 0.1;
  options.gap_m = 0.1;
  options.cut.min_pixels = 20;
  for (const int width : {12, 13}) {
    images_.depth_m.assign(19200, 2.0F);
    put(88, 49, width, 4, 1.8F);
    EXPECT_EQ(find_objects(images_, T_world_camera_, options).size(), width == 13 ? 1U : 0U);
  }
}

TEST_F(BlockFromAbove, StandsOutOfTheNoiseAndMostlyOverTheTable) {
  put_block_at(90, 50, 0.0135F);  // 6 mm and 2.5 times 3.2 mm are 14 mm
  EXPECT_EQ(found().size(), 0U);
  put_block_at(90, 50, 0.0145F);
  EXPECT_EQ(found().size(), 1U);
  // The table ends at x = 0.39 m: 5 cm beyond are the block's columns from 104 on.
  for (const int left : {97, 98}) {
    put_block_at(left, 50);
    put(100, 0, 60, 120, 2.805F);
    put(left, 50, 10, 10, 1.8F);
    EXPECT_EQ(found().size(), left == 97 ? 1U : 0U) << left;
  }
}

/// 25 px long; those of its columns from 104 on are beside the table, the last 23 cm from it.
TEST_F(BlockFromAbove, IsBesideTheTableByAllOfItThatIsNearTheTable) {
  for (const int left : {84, 90}) {
    put_block_at(left, 50);
    put(100, 0, 60, 120, 2.805F);
    put(left, 50, 25, 10, 1.8F);
    EXPECT_EQ(found().size(), left == 84 ? 1U : 0U) << left;
  }
}

/// 12 of 42 columns are beside the table, and 10 more farther than 25 cm from it.
TEST_F(BlockFromAbove, IsNotBesideTheTableByWhatIsFarFromTheTable) {
  ObjectSearchOptions options;
  options.cut.radius_m = 0.6;
  images_.depth_m.assign(19200, 2.0F);
  put(100, 0, 60, 120, 2.805F);
  put(74, 50, 52, 10, 1.8F);
  EXPECT_EQ(find_objects(images_, T_world_camera_, options).size(), 1U);
}

/// 1 px of a foot at each side. What is an object's there is 10.8 mm high or a third of that, if
/// beside it; what is measured of it, half of that.
TEST_F(BlockFromAbove, IsMeasuredByWhatIsHalfAsHighAsAnObject) {
  const auto pixels = [&](float foot_m) {
    put_block_at(75, 55);
    put(74, 55, 1, 10, 2.0F - foot_m);
    put(85, 55, 1, 10, 2.0F - foot_m);
    put(75, 54, 10, 1, 2.0F - foot_m);
    put(75, 65, 10, 1, 2.0F - foot_m);
    const auto seen = found();
    return seen.size() == 1 ? seen[0].detection.pixels : -1;
  };
  EXPECT_EQ(pixels(0.008F), 140);
  EXPECT_EQ(pixels(0.0045F), 100);
}

/// A sheet that does not stand out of the noise by itself, beside the block: 11.5 cm and 4 cm round
/// its middle are 7.78 px there.
TEST_F(BlockFromAbove, IsCutOutFourCentimetresRoundWhatStandsOut) {
  put_block_at(75, 55);
  put(85, 55, 16, 10, 2.0F - 0.0125F);
  const auto seen = found();
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(seen[0].detection.pixels, 100 + 10 + 8 + 4);
}

/// 20 x 4 px and, below its left end, 5 x 8 px: the mean of all is level with the camera, 2 px from
/// the middle of its sides and 2.5 px from that of its length.
TEST_F(BlockFromAbove, IsInTheMiddleOfItsExtents) {
  images_.depth_m.assign(19200, 2.0F);
  put(90, 56, 20, 4, 1.8F);
  put(90, 60, 5, 8, 1.8F);
  const auto seen = found();
  ASSERT_EQ(seen.size(), 1U);
  const ObjectDetection& object = seen[0].detection;
  EXPECT_EQ(object.pixels, 120);
  EXPECT_LT((object.p_world_object_m.head<2>() - Eigen::Vector2d(0.36, -0.036)).norm(), 1e-5);
  EXPECT_NEAR(object.radius_m, 0.018 * std::hypot(9.5, 4.5), 1e-5);
}

/// Rising by 1 cm a metre along x.
TEST_F(BlockFromAbove, StandsWhereASlopingTableIsThatHigh) {
  images_.depth_m.clear();
  for (int row = 0; row < 120; ++row) {
    for (int column = 0; column < 160; ++column) {
      const bool block = column >= 100 && column < 110 && row >= 55 && row < 65;
      const double z_m = 2.0 / (1.0 + 0.01 * (column - 79.5) / 100.0) - (block ? 0.2 : 0.0);
      images_.depth_m.push_back(static_cast<float>(z_m));
    }
  }
  const auto seen = found();
  ASSERT_EQ(seen.size(), 1U);
  const ObjectDetection& block = seen[0].detection;
  EXPECT_NEAR(block.support_z_m, 0.805 + 0.01 * block.p_world_object_m.x(), 5e-4);
}

}  // namespace
}  // namespace vantage
