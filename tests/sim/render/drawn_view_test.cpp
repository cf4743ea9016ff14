// From where a scene is drawn, and how large what is drawn into it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "tests/support/mjcf.hpp"
#include "vantage/sim/render/renderer.hpp"

namespace vantage {
namespace {

constexpr int kColumns = 160;
constexpr int kRows = 121;

RenderedImages seen(const test::MjcfModel& scene, const CameraView& view,
                    const RenderRequest& request = {}) {
  RenderedImages images;
  make_offscreen_renderer(*scene.model, kColumns, kRows)
      ->render(*scene.model, *scene.data, view, request, images);
  return images;
}

/// A ball at the origin, and a camera that looks at it along y from 2 m.
test::MjcfModel ball_ahead() {
  return test::compile_mjcf(
      "<mujoco><statistic extent='2'/><worldbody><light pos='0 0 4' dir='0 0 -1'/>"
      "<geom name='ball' size='.05' rgba='0 0 1 1'/>"
      "<camera name='front' pos='0 -2 0' xyaxes='1 0 0 0 0 1'/></worldbody></mujoco>");
}

TEST(DrawnView, AFreeCameraCirclesItsPoint) {
  const FreeCamera camera{
      .lookat_m = {1.0, 2.0, 3.0}, .distance_m = 4.0, .azimuth_rad = 0.5, .elevation_rad = -0.3};
  const RenderedImages images = seen(ball_ahead(), camera);
  const Eigen::Vector3d along(std::cos(0.3) * std::cos(0.5), std::cos(0.3) * std::sin(0.5),
                              -std::sin(0.3));
  const Eigen::Vector3d right(std::sin(0.5), -std::cos(0.5), 0.0);
  const Pose& T = images.T_world_camera;
  EXPECT_LT((T.translation() - (Eigen::Vector3d(1.0, 2.0, 3.0) - 4.0 * along)).norm(), 1e-5);
  EXPECT_LT((T.linear().col(0) - right).norm(), 1e-5);
  EXPECT_LT((T.linear().col(1) - along.cross(right)).norm(), 1e-5);
  EXPECT_LT((T.linear().col(2) - along).norm(), 1e-5);
}

TEST(DrawnView, TheFieldOfViewIsTheModelsUnlessAsked) {
  const auto scene = ball_ahead();
  const auto focal_px = [&](const CameraView& view) { return seen(scene, view).focal_px; };
  const double of_model_px = 0.5 * kRows / std::tan(std::numbers::pi / 8.0);
  EXPECT_NEAR(focal_px(FixedCamera{0}), of_model_px, 1e-3);
  EXPECT_NEAR(focal_px(FreeCamera{}), of_model_px, 1e-3);
  EXPECT_NEAR(focal_px(FixedCamera{0, 0.6}), 0.5 * kRows / std::tan(0.3), 1e-3);
  EXPECT_NEAR(focal_px(FreeCamera{.fovy_rad = 1.2}), 0.5 * kRows / std::tan(0.6), 1e-3);
}

TEST(DrawnView, SitesAreNotDrawn) {
  const auto scene = test::compile_mjcf(
      "<mujoco><statistic extent='2'/><worldbody><geom size='.05'/>"
      "<site size='.2' pos='0 -1 0'/>"
      "<camera pos='0 -2 0' xyaxes='1 0 0 0 0 1'/></worldbody></mujoco>");
  const RenderedImages images = seen(scene, FixedCamera{0});
  const std::size_t centre = kRows / 2 * kColumns + kColumns / 2;
  EXPECT_EQ(images.segmentation[centre], 0);
  EXPECT_NEAR(images.depth_m[centre], 1.95, 2e-3);
}

/// Columns and rows of the pixels that a marker changes.
Eigen::Vector2i size_px(const Marker& marker) {
  const auto scene = ball_ahead();
  const RenderedImages plain = seen(scene, FixedCamera{0});
  const RenderedImages marked = seen(scene, FixedCamera{0}, {.markers = {marker}});
  Eigen::AlignedBox2i changed;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const auto at =
          3 * (static_cast<std::size_t>(row) * kColumns + static_cast<std::size_t>(column));
      if (!std::equal(&plain.rgb[at], &plain.rgb[at] + 3, &marked.rgb[at])) {
        changed.extend(Eigen::Vector2i(column, row));
      }
    }
  }
  EXPECT_FALSE(changed.isEmpty());
  return changed.isEmpty() ? Eigen::Vector2i::Zero().eval()
                           : Eigen::Vector2i(changed.sizes() + Eigen::Vector2i::Ones());
}

/// 1 m before the camera, whose focal length is 146 px.
TEST(DrawnView, MarkersAreAsLargeAsTheySay) {
  const Eigen::Vector3d ahead(0.0, -1.0, 0.0);
  const Eigen::Vector2i sphere = size_px(SphereMarker{.p_world_m = ahead, .radius_m = 0.2});
  EXPECT_NEAR(sphere.x(), 60, 3);
  EXPECT_NEAR(sphere.y(), 60, 3);
  // Its front is 0.98 m away; turned about y its height lies level.
  BoxMarker box{.T_world_box = Eigen::Isometry3d::Identity(), .half_size_m = {0.25, 0.02, 0.1}};
  box.T_world_box.translation() = ahead;
  EXPECT_NEAR(size_px(box).x(), 75, 3);
  EXPECT_NEAR(size_px(box).y(), 30, 3);
  box.T_world_box.rotate(Eigen::AngleAxisd(std::numbers::pi / 2.0, Eigen::Vector3d::UnitY()));
  EXPECT_NEAR(size_px(box).x(), 30, 3);
  EXPECT_NEAR(size_px(box).y(), 75, 3);
  const Eigen::Vector2i line = size_px(LineMarker{
      .from_world_m = {-0.3, -1.0, 0.0}, .to_world_m = {0.3, -1.0, 0.0}, .width_m = 0.1});
  EXPECT_NEAR(line.x(), 102, 4);
  EXPECT_NEAR(line.y(), 15, 2);
}

TEST(DrawnView, TendonsAreNotDrawn) {
  const auto scene = test::compile_mjcf(
      "<mujoco><statistic extent='2'/><worldbody><geom size='.05'/>"
      "<site name='left' pos='-.5 -1 0'/><site name='right' pos='.5 -1 0'/>"
      "<camera pos='0 -2 0' xyaxes='1 0 0 0 0 1'/></worldbody><tendon><spatial width='.1'>"
      "<site site='left'/><site site='right'/></spatial></tendon></mujoco>");
  const RenderedImages images = seen(scene, FixedCamera{0});
  const std::size_t centre = kRows / 2 * kColumns + kColumns / 2;
  EXPECT_EQ(images.segmentation[centre], 0);
  EXPECT_NEAR(images.depth_m[centre], 1.95, 2e-3);
}

TEST(DrawnView, WhatIsNotAskedForIsNotThereFromBefore) {
  const auto scene = ball_ahead();
  const auto renderer = make_offscreen_renderer(*scene.model, kColumns, kRows);
  RenderedImages images;
  renderer->render(*scene.model, *scene.data, FixedCamera{0}, {}, images);
  ASSERT_FALSE(images.rgb.empty() || images.depth_m.empty() || images.segmentation.empty());
  renderer->render(*scene.model, *scene.data, FixedCamera{0},
                   {.rgb = false, .depth_and_segmentation = false}, images);
  EXPECT_TRUE(images.rgb.empty());
  EXPECT_TRUE(images.depth_m.empty());
  EXPECT_TRUE(images.segmentation.empty());
}

/// Two balls before a camera that sees from half a metre on, one at 0.3 m, one behind it at 0.7 m.
TEST(DrawnView, WhereNothingIsCutAwayTheNearPlaneStaysWhereItIs) {
  const auto scene = test::compile_mjcf(
      "<mujoco><statistic extent='1' center='0 0 0'/><visual><map znear='.5' zfar='20'/></visual>"
      "<worldbody><geom size='.05' pos='.65 0 0'/><geom size='.1' pos='.2 0 0'/></worldbody>"
      "</mujoco>");
  const FreeCamera camera{
      .distance_m = 1.0, .azimuth_rad = std::numbers::pi, .elevation_rad = 0.0, .cutaway_m = 1.5};
  const RenderedImages images = seen(scene, camera);
  const std::size_t centre = kRows / 2 * kColumns + kColumns / 2;
  EXPECT_EQ(images.segmentation[centre], 1);
  EXPECT_NEAR(images.depth_m[centre], 0.7, 5e-3);
}

/// A roof over a floor, behind the camera.
TEST(DrawnView, ShadowsFallIntoTheImageIfTheyAreAskedFor) {
  const auto context = make_offscreen_context();
  const auto drawn_under = [&](const std::string& roof) {
    const auto scene = test::compile_mjcf(
        "<mujoco><statistic extent='4' center='0 0 0'/><visual><quality shadowsize='256'/>"
        "</visual><worldbody><light directional='true' pos='0 0 5' dir='0 0 -1'/>"
        "<geom type='plane' size='4 4 .1'/>" +
        roof + "<camera pos='0 0 1.5'/></worldbody></mujoco>");
    const auto renderer = make_offscreen_renderer(*scene.model, 40, 30, context);
    std::array<RenderedImages, 2> images;
    for (const bool shadows : {false, true}) {
      renderer->render(*scene.model, *scene.data, FixedCamera{0},
                       {.depth_and_segmentation = false, .shadows = shadows},
                       images[shadows ? 1 : 0]);
    }
    return images;
  };
  const auto roofed = drawn_under("<geom type='box' size='.3 .3 .02' pos='0 0 3'/>");
  const auto open = drawn_under("");
  EXPECT_EQ(roofed[0].rgb, open[0].rgb);
  EXPECT_NE(roofed[1].rgb, open[1].rgb);
}

TEST(DrawnView, NoGroupIsDrawnIfNoneIsAskedFor) {
  const RenderedImages images = seen(ball_ahead(), FixedCamera{0}, {.max_group = -1});
  EXPECT_EQ(*std::ranges::max_element(images.segmentation), -1);
}

}  // namespace
}  // namespace vantage
