// An object among others, against images of boxes on a table, drawn ray by ray.
#include "vantage/perception/clutter/object_among_others.hpp"

#include <gmock/gmock.h>
#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/perception/drawn_boxes.hpp"

namespace vantage {
namespace {

using namespace test;

const ObjectSegmentationOptions kExactAmongOthers{
    .min_pixels = 60, .mask_growth_px = 0, .margin_px = 2};
/// Where the first box stands, and in front of it as camera_at(0) sees it: towards +x.
const Box kTarget = box_at(0.0, 0.0, {0.08, 0.10, 0.15});

ObjectAmongOthers found(const Drawn& drawn, const Pose& T_world_camera,
                        const std::optional<UprightCylinder>& known = {},
                        const ObjectSegmentationOptions& options = kExactAmongOthers) {
  Rng rng(1);
  return find_among_others(drawn.images, T_world_camera, kTable_m, options, {}, known, rng);
}

std::ptrdiff_t cut_off_pixels(const ObjectView& view) {
  return std::ranges::count(view.cut_off, 1);
}

TEST(ObjectAmongOthers, AloneItIsCutOutAsAWhole) {
  for (int i = 0; i < 6; ++i) {
    const Pose T_world_camera = camera_at(i * std::numbers::pi / 3.0 + 0.1);
    const Drawn drawn = draw({{kTarget}}, T_world_camera, 0.002);
    const ObjectAmongOthers object = found(drawn, T_world_camera);
    ASSERT_TRUE(object.object.view) << object.object.reason;
    EXPECT_GT(overlap(drawn, *object.object.view), 0.93) << "side " << i;
    EXPECT_TRUE(object.object.view->cut_off.empty());
    EXPECT_GT(object.seen_share, 0.97);
    EXPECT_NEAR(object.shape->height_m, 0.15, 0.01);
    EXPECT_NEAR(object.shape->radius_m, 0.064, 0.012) << "half its diagonal";
    EXPECT_NEAR(*object.table_height_m, kTable_m.z(), 0.003);
  }
}

/// The foot's height over the camera, along gravity.
TEST(ObjectAmongOthers, SaysWhereItsSupportIs) {
  const Pose T_world_camera = camera_at(0.4);
  const ObjectAmongOthers object = found(draw({{kTarget}}, T_world_camera, 0.002), T_world_camera);
  ASSERT_TRUE(object.object.view && object.object.view->support_m);
  EXPECT_NEAR(*object.object.view->support_m, kTable_m.z() - T_world_camera.translation().z(),
              0.004);
}

/// Three walls round the place, the fourth side open: their hull is over the place, they are not.
TEST(ObjectAmongOthers, AScreenRoundItIsNotTakenForIt) {
  const Box low = box_at(0.0, 0.0, {0.06, 0.06, 0.05});
  const Scene scene{{low, box_at(-0.1, 0.0, {0.01, 0.2, 0.25}), box_at(0.0, 0.1, {0.2, 0.01, 0.25}),
                     box_at(0.0, -0.1, {0.2, 0.01, 0.25})}};
  const Pose T_world_behind = camera_at(std::numbers::pi);
  const ObjectAmongOthers hidden = found(draw(scene, T_world_behind, 0.002), T_world_behind);
  EXPECT_FALSE(hidden.object.view);
  EXPECT_THAT(hidden.object.reason, testing::HasSubstr("hidden"));
  const Pose T_world_front = camera_at(0.0);
  const Drawn drawn = draw(scene, T_world_front, 0.002);
  const ObjectAmongOthers seen = found(drawn, T_world_front);
  ASSERT_TRUE(seen.object.view) << seen.object.reason;
  EXPECT_GT(overlap(drawn, *seen.object.view), 0.9);
}

/// A rim is all that rises of a plate.
TEST(ObjectAmongOthers, WhatIsFlatInItsMiddleIsFound) {
  const Scene scene{{box_at(-0.1, 0.0, {0.02, 0.22, 0.02}), box_at(0.0, 0.1, {0.22, 0.02, 0.02}),
                     box_at(0.0, -0.1, {0.22, 0.02, 0.02}), box_at(0.1, 0.0, {0.02, 0.22, 0.02})}};
  const Pose T_world_camera = camera_at(0.2);
  const ObjectAmongOthers object = found(draw(scene, T_world_camera, 0.002), T_world_camera);
  ASSERT_TRUE(object.object.view) << object.object.reason;
  EXPECT_NEAR(object.shape->radius_m, 0.13, 0.03);
}

TEST(ObjectAmongOthers, NeighboursAreNotTakenForPartsOfIt) {
  Scene scene{{kTarget}};
  scene.boxes.push_back(box_at(0.14, 0.02, {0.08, 0.08, 0.05}));  // before it
  scene.boxes.push_back(box_at(-0.14, 0.03, {0.1, 0.08, 0.3}));   // behind it, higher
  scene.boxes.push_back(box_at(0.0, 0.15, {0.1, 0.1, 0.2}));      // beside it, larger
  scene.boxes.push_back(box_at(0.02, -0.14, {0.06, 0.08, 0.12}));
  for (const double bearing : {0.0, 0.4, -0.5}) {
    const Pose T_world_camera = camera_at(bearing);
    const Drawn drawn = draw(scene, T_world_camera, 0.002);
    const ObjectAmongOthers object = found(drawn, T_world_camera);
    ASSERT_TRUE(object.object.view) << object.object.reason;
    EXPECT_GT(overlap(drawn, *object.object.view), 0.88) << bearing;
  }
}

TEST(ObjectAmongOthers, WhatHidesItIsNotInTheMaskAndMarksItsEdge) {
  const Pose T_world_camera = camera_at(0.0);
  Scene scene{{kTarget, box_at(0.14, -0.05, {0.04, 0.10, 0.25})}};  // hides about half
  const Drawn drawn = draw(scene, T_world_camera, 0.002);
  const ObjectAmongOthers object = found(drawn, T_world_camera);
  ASSERT_TRUE(object.object.view) << object.object.reason;
  EXPECT_GT(overlap(drawn, *object.object.view), 0.88);
  EXPECT_GT(cut_off_pixels(*object.object.view), 10);
  EXPECT_LT(object.seen_share, 0.8);
  EXPECT_GT(object.seen_share, 0.3);
  EXPECT_EQ(object.object.view->seen_share, object.seen_share);
}

TEST(ObjectAmongOthers, TheShareIsOfWhatEarlierViewsHaveSeen) {
  const Pose T_world_camera = camera_at(0.0);
  Scene scene{{kTarget, box_at(0.12, -0.06, {0.04, 0.10, 0.25})}};
  const Drawn drawn = draw(scene, T_world_camera, 0.002);
  const double by_itself = found(drawn, T_world_camera).seen_share;
  const UprightCylinder wide{kTable_m, 0.064, 0.15};
  const double by_shape = found(drawn, T_world_camera, wide).seen_share;
  EXPECT_LE(by_shape, by_itself + 1e-9);
}

/// Never what stands in front of it.
TEST(ObjectAmongOthers, AHiddenObjectIsNotFound) {
  const Pose T_world_camera = camera_at(0.0);
  Scene scene{{kTarget, box_at(0.16, 0.0, {0.06, 0.24, 0.40})}};
  const ObjectAmongOthers object = found(draw(scene, T_world_camera, 0.002), T_world_camera);
  EXPECT_FALSE(object.object.view);
  EXPECT_THAT(object.object.reason, testing::HasSubstr("hidden"));
  EXPECT_EQ(object.seen_share, 0.0);
}

TEST(ObjectAmongOthers, TooLittleOfItIsToldAndNotUsed) {
  const Pose T_world_camera = camera_at(0.0);
  Scene scene{{kTarget, box_at(0.14, -0.02, {0.04, 0.14, 0.3})}};
  const UprightCylinder known{kTable_m, 0.064, 0.15};
  const ObjectAmongOthers object = found(draw(scene, T_world_camera, 0.002), T_world_camera, known);
  EXPECT_FALSE(object.object.view);
  EXPECT_THAT(object.object.reason, testing::HasSubstr("hidden"));
}

TEST(ObjectAmongOthers, TheImagesBorderCutsItOffToo) {
  Pose T_world_camera = camera_at(0.0);
  T_world_camera.translation() += Vector3d(0.0, 0.51, 0.0);  // it is at the image's side
  const Drawn drawn = draw({{kTarget}, 1.0}, T_world_camera, 0.002);
  const ObjectAmongOthers object = found(drawn, T_world_camera);
  ASSERT_TRUE(object.object.view) << object.object.reason;
  EXPECT_GT(cut_off_pixels(*object.object.view), 5);
}

TEST(ObjectAmongOthers, ItsShapeIsAsWideAndAsHighAsWasEverSeen) {
  const Pose T_world_camera = camera_at(0.3);
  const Drawn drawn = draw({{kTarget}}, T_world_camera, 0.002);
  const ObjectAmongOthers own = found(drawn, T_world_camera);
  const auto after = [&](double radius_m, double height_m) {
    return found(drawn, T_world_camera, UprightCylinder{kTable_m, radius_m, height_m});
  };
  const ObjectAmongOthers wide = after(0.09, 0.05);
  const ObjectAmongOthers high = after(0.02, 0.3);
  ASSERT_TRUE(own.object.view && wide.object.view && high.object.view);
  EXPECT_EQ(wide.shape->radius_m, 0.09);
  EXPECT_EQ(wide.shape->height_m, own.shape->height_m);
  EXPECT_EQ(high.shape->radius_m, own.shape->radius_m);
  EXPECT_EQ(high.shape->height_m, 0.3);
}

/// 2 m straight above this place of the table.
Pose above_table(double x_m, double y_m) {
  Pose T_world_camera = Pose::Identity();
  T_world_camera.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  T_world_camera.translation() = kTable_m + Vector3d(x_m, y_m, 2.0);
  return T_world_camera;
}

/// An image of 60 x 50 px from 2 m straight above the table: a block of 12 x 10 px, 10 cm high.
Drawn block_at(int left, int top) {
  Drawn drawn;
  drawn.images.width_px = 60;
  drawn.images.height_px = 50;
  drawn.images.focal_px = 100.0;
  drawn.images.depth_m.assign(3000, 2.0F);
  cv::Mat1f depth_m(50, 60, drawn.images.depth_m.data());
  depth_m(cv::Rect(left, top, 12, 10)) = 1.9F;
  return drawn;
}

/// Before its upper edge, higher than any object, something of 4 x 5 px.
Drawn half_covered_block() {
  Drawn drawn = block_at(24, 20);
  cv::Mat1f depth_m(50, 60, drawn.images.depth_m.data());
  depth_m(cv::Rect(28, 19, 4, 5)) = 1.0F;
  return drawn;
}

/// The median takes the corners off both.
TEST(ObjectAmongOthers, WhatIsBeforeItsEdgeLeavesTheRestOfItToThePixel) {
  const Pose T_world_camera = above_table(0.0, 0.0);
  const ObjectAmongOthers object = found(half_covered_block(), T_world_camera, {},
                                         {.min_pixels = 102, .mask_growth_px = 1, .margin_px = 0});
  ASSERT_TRUE(object.object.view) << object.object.reason;
  const ObjectView& view = *object.object.view;
  EXPECT_EQ(view.left_px, 23);
  EXPECT_EQ(view.top_px, 19);
  ASSERT_EQ(view.width_px, 14);
  ASSERT_EQ(view.height_px, 12);
  std::vector<std::ptrdiff_t> in_row;
  for (auto row = view.mask.begin(); row != view.mask.end(); row += 14) {
    in_row.push_back(std::count(row, row + 14, 1));
  }
  EXPECT_THAT(in_row, testing::ElementsAre(10, 10, 10, 10, 12, 14, 14, 14, 14, 14, 14, 12));
  EXPECT_EQ(cut_off_pixels(view), 110) << "within 3 px of what has it 2 px beside itself";
  EXPECT_NEAR(object.seen_share, 10.0 / 12.0, 1e-9) << "of twelve samples of its top";
  EXPECT_NEAR(object.shape->radius_m, 0.019 * std::hypot(4.5, 4.5), 1e-6);
  EXPECT_NEAR(object.shape->height_m, 0.1, 1e-6);
}

TEST(ObjectAmongOthers, SaysHowFewPixelsRise) {
  ObjectSegmentationOptions options = kExactAmongOthers;
  options.min_pixels = 103;
  EXPECT_EQ(found(half_covered_block(), above_table(0.0, 0.0), {}, options).object.reason,
            "hidden: 102 pixels rise from the table where it stands, an object has at least 103");
}

TEST(ObjectAmongOthers, WhatWasNotMeasuredWithinItBelongsToIt) {
  Drawn drawn = block_at(24, 20);
  const Pose T_world_camera = above_table(0.0, 0.0);
  const ObjectAmongOthers measured = found(drawn, T_world_camera);
  cv::Mat1f depth_m(50, 60, drawn.images.depth_m.data());
  depth_m(cv::Rect(28, 23, 3, 3)) = 0.0F;
  const ObjectAmongOthers with_hole = found(drawn, T_world_camera);
  ASSERT_TRUE(measured.object.view && with_hole.object.view) << with_hole.object.reason;
  EXPECT_EQ(with_hole.object.view->mask, measured.object.view->mask);
}

std::ptrdiff_t cut_off_of_block_at(int left, int top) {
  const ObjectAmongOthers object =
      found(block_at(left, top), above_table(0.02 * (24 - left), 0.02 * (top - 20)));
  EXPECT_TRUE(object.object.view) << object.object.reason;
  return object.object.view ? cut_off_pixels(*object.object.view) : -1;
}

TEST(ObjectAmongOthers, TheImagesBorderCutsItOffWithinTwoPixels) {
  EXPECT_GT(cut_off_of_block_at(1, 20), 0);
  EXPECT_EQ(cut_off_of_block_at(2, 20), 0);
  EXPECT_GT(cut_off_of_block_at(47, 20), 0);
  EXPECT_EQ(cut_off_of_block_at(46, 20), 0);
  EXPECT_GT(cut_off_of_block_at(24, 1), 0);
  EXPECT_EQ(cut_off_of_block_at(24, 2), 0);
  EXPECT_GT(cut_off_of_block_at(24, 39), 0);
  EXPECT_EQ(cut_off_of_block_at(24, 38), 0);
}

/// Of twelve samples of its top two are hidden.
TEST(ObjectAmongOthers, ShowsAsMuchOfItselfAsIsAskedFor) {
  const Drawn drawn = half_covered_block();
  const auto with = [&](double min_share) {
    Rng rng(1);
    return find_among_others(drawn.images, above_table(0.0, 0.0), kTable_m,
                             {.min_pixels = 102, .mask_growth_px = 1, .margin_px = 0},
                             {.min_share = min_share}, {}, rng);
  };
  const double share = with(0.0).seen_share;
  EXPECT_NEAR(share, 10.0 / 12.0, 1e-9);
  EXPECT_TRUE(with(share).object.view) << "just as much";
  EXPECT_TRUE(with(share).object.place_seen);
  const ObjectAmongOthers hidden = with(0.9);
  EXPECT_FALSE(hidden.object.view);
  EXPECT_FALSE(hidden.object.place_seen);
  EXPECT_EQ(hidden.object.reason, "hidden: 83 % of it is seen, at least 90 % must be");
  EXPECT_EQ(hidden.seen_share, share);
  EXPECT_FALSE(hidden.shape) << "nothing is known of its shape but what such views show";
}

/// The place is thought to be 2 cm higher, or lower.
TEST(ObjectAmongOthers, TheTableIsWhereTheImageHasIt) {
  const Drawn drawn = block_at(24, 20);
  for (const double off_m : {0.02, -0.02}) {
    Rng rng(1);
    const ObjectAmongOthers object =
        find_among_others(drawn.images, above_table(0.0, 0.0), kTable_m + Vector3d(0, 0, off_m),
                          kExactAmongOthers, {}, {}, rng);
    ASSERT_TRUE(object.object.view) << object.object.reason;
    EXPECT_NEAR(object.table_height_m.value(), kTable_m.z(), 1e-4) << off_m;
    EXPECT_NEAR(object.object.view->support_m.value(), -2.0, 1e-4) << off_m;
    EXPECT_NEAR(object.shape->height_m, 0.1, 1e-4) << "above the table";
  }
}

TEST(ObjectAmongOthers, ItsShapeIsFifteenMillimetresHighAtLeast) {
  Drawn drawn = block_at(24, 20);
  cv::Mat1f depth_m(50, 60, drawn.images.depth_m.data());
  depth_m(cv::Rect(24, 20, 12, 10)) = 1.99F;
  const ObjectAmongOthers object = found(drawn, above_table(0.0, 0.0));
  ASSERT_TRUE(object.object.view) << object.object.reason;
  EXPECT_NEAR(object.shape->height_m, 0.015, 1e-9);
  EXPECT_NEAR(object.shape->radius_m, 0.0199 * std::hypot(4.5, 4.5), 1e-5);
}

/// Of the block's pixels the outermost 5.5 and 4.5 of them off its middle, 1.9 cm wide; without its
/// four corners.
TEST(ObjectAmongOthers, ItsOutlineIsThatOfItsPixelsFromAbove) {
  const ObjectAmongOthers object = found(block_at(24, 20), above_table(0.0, 0.0));
  ASSERT_TRUE(object.object.view) << object.object.reason;
  ASSERT_EQ(object.outline.size(), 8U);
  for (const Eigen::Vector2d& p : object.outline) {
    const Eigen::Array2d px = (p - kTable_m.head<2>()).array().abs() / 0.019;
    const bool beside = std::abs(px.x() - 5.5) < 1e-4 && std::abs(px.y() - 3.5) < 1e-4;
    const bool above = std::abs(px.x() - 4.5) < 1e-4 && std::abs(px.y() - 4.5) < 1e-4;
    EXPECT_TRUE(beside || above) << px.transpose();
  }
}

/// Known to be 30 cm in radius, 6.5 px from the image's border: beside the block its top is not
/// there, where the table is seen, or not shown.
TEST(ObjectAmongOthers, WhatIsBeyondTheImageIsNotSeen) {
  const Pose T_world_camera = above_table(0.46, 0.0);
  const UprightCylinder known{kTable_m, 0.3, 0.1};
  const ObjectAmongOthers object = found(block_at(1, 20), T_world_camera, known);
  double seen = 0.0;
  double beyond = 0.0;
  for (const SurfaceSample& sample : facing_samples(known, T_world_camera.translation())) {
    const Vector3d p = T_world_camera.inverse() * sample.p_world_m;
    const double x = 100.0 * p.x() / p.z() + 29.5;
    const double y = 100.0 * p.y() / p.z() + 24.5;
    if (x < -0.5) beyond += sample.weight;
    if (x > 0.5 && x < 12.5 && y > 19.5 && y < 29.5) seen += sample.weight;
  }
  ASSERT_GT(seen, 0.0);
  ASSERT_GT(beyond, seen);
  EXPECT_NEAR(object.seen_share, seen / (seen + beyond), 1e-9);
}

}  // namespace
}  // namespace vantage
