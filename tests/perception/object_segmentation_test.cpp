// Against images of a table and a box, drawn ray by ray.
#include "vantage/perception/object_segmentation.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/perception/drawn_boxes.hpp"
#include "vantage/perception/column_cut.hpp"
#include "vantage/perception/table_segmentation.hpp"

namespace vantage {
namespace {

using namespace test;

const ObjectSegmentationOptions kExact{.mask_growth_px = 0, .margin_px = 2};

SegmentedObject segmented(const Drawn& drawn, const Pose& T_world_camera,
                          const ObjectSegmentationOptions& options = kExact) {
  Rng rng(1);
  return segment_object(drawn.images, T_world_camera, kTable_m, options, rng);
}

TEST(ObjectSegmentation, CutsABoxOutFromEverySide) {
  const Scene scene{{box_at(0.02, -0.01, {0.08, 0.12, 0.15})}};
  for (int i = 0; i < 6; ++i) {
    const Pose T_world_camera = camera_at(i * std::numbers::pi / 3.0 + 0.1);
    const Drawn drawn = draw(scene, T_world_camera, 0.002);
    const SegmentedObject found = segmented(drawn, T_world_camera);
    ASSERT_TRUE(found.view) << found.reason;
    EXPECT_GT(overlap(drawn, *found.view), 0.93) << "side " << i;
  }
}

TEST(ObjectSegmentation, KeepsTheFootThatIsLowerThanAnObjectMustBe) {
  const Pose T_world_camera = camera_at(0.7);
  const Drawn drawn = draw({{box_at(0.0, 0.0, {0.1, 0.1, 0.03})}}, T_world_camera, 0.001);
  ObjectSegmentationOptions options = kExact;
  options.min_height_m = 0.015;  // half of it
  const SegmentedObject found = segmented(drawn, T_world_camera, options);
  ASSERT_TRUE(found.view) << found.reason;
  EXPECT_GT(overlap(drawn, *found.view), 0.93);
}

TEST(ObjectSegmentation, TakesAPoseThatIsOffAsItIs) {
  const Pose T_true = camera_at(0.4);
  const Drawn drawn = draw({{box_at(0.0, 0.0, {0.07, 0.07, 0.03})}}, T_true, 0.002);
  Pose T_estimated = T_true * Eigen::AngleAxisd(0.02, Vector3d::UnitX());
  T_estimated.translation() += Vector3d(0.02, -0.015, 0.025);
  const SegmentedObject found = segmented(drawn, T_estimated);
  ASSERT_TRUE(found.view) << found.reason;
  EXPECT_GT(overlap(drawn, *found.view), 0.85);
}

/// Where depth errs with distance the table is bent, and a plane through all of it lies millimetres
/// off what is round the object.
TEST(ObjectSegmentation, TheTableIsWhereItsPixelsRoundTheObjectAre) {
  const Pose T_world_camera = camera_at(0.3);
  Drawn drawn = draw({{box_at(0.0, 0.0, {0.07, 0.07, 0.1})}}, T_world_camera, 0.001);
  for (float& z_m : drawn.images.depth_m) z_m += 0.1F * (z_m - 1.0F) * (z_m - 1.0F);
  Rng rng(1);
  const auto found = find_table_top(drawn.images, T_world_camera, kTable_m, kExact, rng);
  ASSERT_TRUE(found.table) << found.reason;
  EXPECT_NEAR(found.table->height_above(kTable_m), 0.0, 0.0007);
}

TEST(ObjectSegmentation, TheViewIsThePartOfTheImageThatItSays) {
  const Pose T_world_camera = camera_at(1.0);
  const Drawn drawn = draw({{box_at(0.0, 0.0, {0.1, 0.1, 0.1})}}, T_world_camera);
  const SegmentedObject found = segmented(drawn, T_world_camera);
  ASSERT_TRUE(found.view) << found.reason;
  const ObjectView& view = *found.view;
  EXPECT_NEAR((view.up - T_world_camera.linear().transpose() * Vector3d::UnitZ()).norm(), 0.0,
              1e-12);
  for (int row = 0; row < view.height_px; row += 5) {
    for (int column = 0; column < view.width_px; column += 5) {
      const float depth_m = drawn.images.depth_at(view.top_px + row, view.left_px + column);
      EXPECT_EQ(view.depth_m[view.index(row, column)], depth_m);
      const Vector3d meant = depth_m * drawn.images.ray(view.top_px + row, view.left_px + column);
      EXPECT_NEAR((view.point(row, column) - meant).norm(), 0.0, 1e-6);
    }
  }
  for (int column = 0; column < view.width_px; ++column) {
    EXPECT_EQ(view.mask[view.index(0, column)], 0) << "the margin is not the object's";
  }
}

TEST(ObjectSegmentation, LeavesAloneWhatStandsBesideTheMiddle) {
  const Pose T_world_camera = camera_at(2.0);
  const Drawn drawn =
      draw({{box_at(0.0, 0.0, {0.05, 0.05, 0.05}), box_at(0.38, 0.3, {0.1, 0.1, 0.2})}},
           T_world_camera, 0.001);
  const SegmentedObject found = segmented(drawn, T_world_camera);
  ASSERT_TRUE(found.view) << found.reason;
  EXPECT_GT(overlap(drawn, *found.view), 0.85);
}

TEST(ObjectSegmentation, GrowsTheMaskByWhatWasAskedFor) {
  const Pose T_world_camera = camera_at(0.0);
  const Drawn drawn = draw({{box_at(0.0, 0.0, {0.1, 0.1, 0.1})}}, T_world_camera);
  ObjectSegmentationOptions grown = kExact;
  grown.mask_growth_px = 2;
  const auto exact = segmented(drawn, T_world_camera).view;
  const auto wide = segmented(drawn, T_world_camera, grown).view;
  ASSERT_TRUE(exact && wide);
  EXPECT_EQ(wide->width_px, exact->width_px + 4);
  EXPECT_EQ(wide->height_px, exact->height_px + 4);
}

TEST(ObjectSegmentation, FillsABottomTooThinToTellButNotAHoleInTheTable) {
  const Pose T_world_camera = camera_at(0.0);
  const auto ring_round = [](double bottom_m) {
    Scene scene{{box_at(0.0, 0.0, {0.1, 0.1, bottom_m})}};
    for (const double side : {-1.0, 1.0}) {
      scene.boxes.push_back(box_at(0.06 * side, 0.0, {0.02, 0.14, 0.03}));
      scene.boxes.push_back(box_at(0.0, 0.06 * side, {0.1, 0.02, 0.03}));
    }
    return scene;
  };
  const auto pixels = [&](double bottom_m) {
    const auto found = segmented(draw(ring_round(bottom_m), T_world_camera, 0.001), T_world_camera);
    EXPECT_TRUE(found.view) << found.reason;
    return found.view ? std::ranges::count(found.view->mask, 1) : 0;
  };
  const Drawn bowl = draw(ring_round(0.004), T_world_camera);
  const auto bottom = std::ranges::count(bowl.first_box, 1);
  EXPECT_GT(pixels(0.004), pixels(0.0001) + bottom / 2);
}

/// A camera measures nothing nearer than its range: between front and top of a tall box.
TEST(ObjectSegmentation, WhatIsTooNearToMeasurePartsNoObject) {
  const Pose T_world_camera = camera_at(0.0);
  Drawn drawn = draw({{box_at(0.0, 0.0, {0.2, 0.06, 0.25})}}, T_world_camera, 0.001);
  float nearest_m = 10.0F;
  for (std::size_t i = 0; i < drawn.first_box.size(); ++i) {
    if (drawn.first_box[i] != 0) nearest_m = std::min(nearest_m, drawn.images.depth_m[i]);
  }
  for (float& z_m : drawn.images.depth_m) {
    if (z_m < nearest_m + 0.02F) z_m = 0.0F;
  }
  const SegmentedObject found = segmented(drawn, T_world_camera);
  ASSERT_TRUE(found.view) << found.reason;
  EXPECT_GT(overlap(drawn, *found.view), 0.93);
}

TEST(ObjectSegmentation, SaysWhatIsMissing) {
  const Pose T_world_camera = camera_at(0.0);
  EXPECT_THAT(segmented(draw({}, T_world_camera, 0.002), T_world_camera).reason,
              testing::HasSubstr("rise from the table"));
  const Drawn floor = draw({.boxes = {}, .half_table_m = 0.0}, T_world_camera);
  EXPECT_THAT(segmented(floor, T_world_camera).reason, testing::StartsWith("no table"));
}

std::size_t pixel_at(int row, int column) {
  return static_cast<std::size_t>(row) * 60 + static_cast<std::size_t>(column);
}

/// 60 x 50 px from 2 m straight above a table at 0.5 m, with a block of 12 x 10 px on it.
CameraImages block_from_above(float height_m) {
  CameraImages images;
  images.width_px = 60;
  images.height_px = 50;
  images.focal_px = 100.0;
  images.depth_m.assign(3000, 2.0F);
  for (int row = 20; row < 30; ++row) {
    for (int column = 24; column < 36; ++column) {
      images.depth_m[pixel_at(row, column)] = 2.0F - height_m;
    }
  }
  return images;
}

Pose above_the_table() {
  Pose T_world_camera = Pose::Identity();
  T_world_camera.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  T_world_camera.translation() = Vector3d(0.0, 0.0, 2.5);
  return T_world_camera;
}

SegmentedObject segmented_from_above(const CameraImages& images,
                                     const ObjectSegmentationOptions& options) {
  const Pose T_world_camera = above_the_table();
  TablePlane table;
  table.centroid_m = {0.0, 0.0, 0.5};
  table.height_m = 0.5;
  return segment_on_table(images, T_world_camera, table, {0.0, 0.0, 0.5}, options);
}

/// The median takes a block's four corners off.
TEST(SegmentOnTable, CutsOutWhatRisesToThePixel) {
  const ObjectSegmentationOptions options{.min_pixels = 116, .mask_growth_px = 0, .margin_px = 2};
  const SegmentedObject found = segmented_from_above(block_from_above(0.1F), options);
  ASSERT_TRUE(found.view) << found.reason;
  EXPECT_EQ(found.view->left_px, 22);
  EXPECT_EQ(found.view->top_px, 18);
  EXPECT_EQ(found.view->width_px, 16);
  EXPECT_EQ(found.view->height_px, 14);
  EXPECT_EQ(std::ranges::count(found.view->mask, 1), 116);
  EXPECT_LT((found.view->up - Vector3d(0.0, 0.0, -1.0)).norm(), 1e-12);
  ObjectSegmentationOptions other = options;
  other.mask_growth_px = 1;
  other.margin_px = 0;
  const SegmentedObject grown = segmented_from_above(block_from_above(0.1F), other);
  ASSERT_TRUE(grown.view) << grown.reason;
  EXPECT_EQ(grown.view->width_px, 14);
  EXPECT_EQ(std::ranges::count(grown.view->mask, 1), 14 * 12 - 4);
  other.min_pixels = 117;
  EXPECT_EQ(segmented_from_above(block_from_above(0.1F), other).reason,
            "116 pixels rise from the table, an object has at least 117");
}

/// 1.06 m to that side is seen from 2 m above: some of the table about the place, nothing of its
/// column.
TEST(ObjectSegmentation, SaysThatAPlaceIsBesideTheImage) {
  CameraImages images;
  images.width_px = 320;
  images.height_px = 240;
  images.focal_px = 300.0;
  images.depth_m.assign(76800, 2.0F);
  Rng rng(1);
  const SegmentedObject found =
      segment_object(images, above_the_table(), {1.42, 0.0, 0.5}, {.radius_m = 0.25}, rng);
  EXPECT_EQ(found.reason, "the image does not show the place");
}

/// Of 12 cm round its middle a fourth is needed.
TEST(ObjectSegmentation, ASmallPlaceNeedsLittleTable) {
  Rng rng(1);
  const Pose T_world_camera = above_the_table();
  const CameraImages images = block_from_above(0.0F);
  const ObjectSegmentationOptions small{.radius_m = 0.03};
  EXPECT_TRUE(find_table_top(images, T_world_camera, {0.0, 0.0, 0.5}, small, rng).table);
}

TEST(SegmentOnTable, KeepsTheLargestPatch) {
  CameraImages images = block_from_above(0.1F);
  for (int row = 21; row < 29; ++row) {
    for (int column = 8; column < 16; ++column) {
      images.depth_m[pixel_at(row, column)] = 1.9F;
    }
  }
  const SegmentedObject found =
      segmented_from_above(images, {.radius_m = 0.6, .min_pixels = 50, .mask_growth_px = 0});
  ASSERT_TRUE(found.view) << found.reason;
  EXPECT_EQ(std::ranges::count(found.view->mask, 1), 116);
}

TEST(SegmentOnTable, HeightsHaveLimits) {
  const auto reason = [](float height_m) {
    return segmented_from_above(block_from_above(height_m), {.min_pixels = 100}).reason;
  };
  EXPECT_EQ(reason(0.007F), "");
  EXPECT_EQ(reason(0.005F), "0 pixels rise from the table, an object has at least 100");
  EXPECT_EQ(reason(0.49F), "");
  EXPECT_EQ(reason(0.51F), "0 pixels rise from the table, an object has at least 100");
}

/// Seen as by block_from_above(), with a sheet on the table that covers the place's surroundings.
TEST(FindTableTop, IsTheSurfaceRoundThePlaceWithinEightMillimetres) {
  const Pose T_world_camera = above_the_table();
  const auto height_m = [&](float sheet_m) {
    CameraImages images = block_from_above(0.0F);
    for (int row = 13; row < 37; ++row) {
      for (int column = 18; column < 42; ++column) {
        images.depth_m[pixel_at(row, column)] = 2.0F - sheet_m;
      }
    }
    Rng rng(1);
    const TableSearch found = find_table_top(images, T_world_camera, {0.0, 0.0, 0.5}, {}, rng);
    EXPECT_TRUE(found.table) << found.reason;
    if (!found.table) return 0.0;
    EXPECT_EQ(found.table->height_m, found.table->centroid_m.z());
    EXPECT_EQ(found.table->inliers, sheet_m < 0.008F ? 400U : 256U) << "of every second pixel";
    return found.table->height_m;
  };
  EXPECT_NEAR(height_m(0.0F), 0.5, 1e-6);
  EXPECT_NEAR(height_m(0.005F), 0.505, 1e-4);
  EXPECT_NEAR(height_m(0.015F), 0.5, 1e-4);
}

/// Of rectangles 10 cm high; as wide as what is cut out, or 0.
int width_cut_of(const std::vector<std::array<int, 4>>& rectangles) {
  CameraImages images = block_from_above(0.0F);
  for (const auto& [left, top, width, height] : rectangles) {
    for (int row = top; row < top + height; ++row) {
      for (int column = left; column < left + width; ++column) {
        images.depth_m[pixel_at(row, column)] = 1.9F;
      }
    }
  }
  const SegmentedObject found = segmented_from_above(
      images, {.radius_m = 0.6, .min_pixels = 10, .mask_growth_px = 0, .margin_px = 0});
  return found.view ? found.view->width_px : 0;
}

TEST(SegmentOnTable, DropsWhatIsThinAndClosesGapsOfFourPixels) {
  EXPECT_EQ(width_cut_of({{20, 20, 20, 2}}), 0);
  EXPECT_EQ(width_cut_of({{20, 20, 20, 4}}), 20);
  EXPECT_EQ(width_cut_of({{10, 20, 12, 10}, {26, 20, 8, 10}}), 24);
  EXPECT_EQ(width_cut_of({{10, 20, 12, 10}, {27, 20, 8, 10}}), 12);
}

/// A foot of 15 mm all round: at 2 m its 3 cm, from which on something rises, are 1.5 px.
TEST(SegmentOnTable, TheFootIsAddedAsFarAsItIsHigh) {
  CameraImages images = block_from_above(0.1F);
  for (int row = 16; row < 34; ++row) {
    for (int column = 20; column < 40; ++column) {
      float& z_m = images.depth_m[pixel_at(row, column)];
      if (z_m == 2.0F) z_m = 1.985F;
    }
  }
  const SegmentedObject found = segmented_from_above(
      images, {.min_height_m = 0.03, .min_pixels = 100, .mask_growth_px = 0, .margin_px = 0});
  ASSERT_TRUE(found.view) << found.reason;
  EXPECT_EQ(found.view->width_px, 12 + 2 * 2);
  EXPECT_EQ(found.view->height_px, 10 + 2 * 2);
}

/// 24 x 20 px round a bottom of 12 x 10 px, too low to be told from noise pixel by pixel. The
/// median takes the corners off both.
TEST(SegmentOnTable, ABottomIsTheObjectsAndAHoleIsTheTables) {
  const auto pixels = [](float bottom_m) {
    CameraImages images = block_from_above(0.0F);
    for (int row = 15; row < 35; ++row) {
      for (int column = 18; column < 42; ++column) {
        const bool bottom = row >= 20 && row < 30 && column >= 24 && column < 36;
        images.depth_m[pixel_at(row, column)] = 2.0F - (bottom ? bottom_m : 0.1F);
      }
    }
    const SegmentedObject found =
        segmented_from_above(images, {.radius_m = 0.6, .min_pixels = 50, .mask_growth_px = 0});
    return found.view ? std::ranges::count(found.view->mask, 1) : 0;
  };
  EXPECT_EQ(pixels(0.003F), 24 * 20 - 4);
  EXPECT_EQ(pixels(0.001F), 24 * 20 - 4 - (12 * 10 - 4)) << "below a third of 6 mm";
}

TEST(ObjectSegmentation, SaysWhetherThePlaceIsSeen) {
  const Pose T_world_camera = camera_at(0.0);
  const Drawn box = draw({{box_at(0.0, 0.0, {0.1, 0.1, 0.1})}}, T_world_camera);
  EXPECT_TRUE(segmented(box, T_world_camera).place_seen);
  EXPECT_TRUE(segmented(draw({}, T_world_camera, 0.002), T_world_camera).place_seen) << "empty";
  const Drawn floor = draw({.boxes = {}, .half_table_m = 0.0}, T_world_camera);
  EXPECT_FALSE(segmented(floor, T_world_camera).place_seen) << "there is no table";
  EXPECT_TRUE(SegmentedObject{}.place_seen);
}

TEST(SegmentOnTable, APlaceBesideTheImageIsNotSeen) {
  const Pose T_world_camera = above_the_table();
  TablePlane table;
  table.centroid_m = {0.0, 0.0, 0.5};
  const CameraImages images = block_from_above(0.1F);
  const SegmentedObject beside =
      segment_on_table(images, T_world_camera, table, {5.0, 0.0, 0.5}, {});
  EXPECT_FALSE(beside.view);
  EXPECT_FALSE(beside.place_seen);
  EXPECT_EQ(beside.reason, "the image does not show the place");
  const SegmentedObject empty =
      segment_on_table(images, T_world_camera, table, {0.0, 0.0, 0.5}, {.min_pixels = 1000});
  EXPECT_FALSE(empty.view);
  EXPECT_TRUE(empty.place_seen);
}

/// A sheet of 4 mm, of which three eighths round the place are 1 mm high.
TEST(FindTableTop, IsTheMedianOfWhatIsRoundThePlace) {
  const Pose T_world_camera = above_the_table();
  CameraImages images = block_from_above(0.0F);
  for (int row = 13; row < 37; ++row) {
    for (int column = 18; column < 42; ++column) {
      images.depth_m[pixel_at(row, column)] = column < 28 ? 1.999F : 1.996F;
    }
  }
  Rng rng(1);
  const TableSearch found = find_table_top(images, T_world_camera, {0.0, 0.0, 0.5}, {}, rng);
  ASSERT_TRUE(found.table) << found.reason;
  EXPECT_NEAR(found.table->height_above({0.0, 0.0, 0.504}), 0.0, 8e-4);
}

}  // namespace
}  // namespace vantage
