#include "vantage/sim/sensors/exposure.hpp"

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "tests/sim/test_world.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

/// A white bar before black that moves sideways past a camera.
struct MovingBar {
  MovingBar()
      : folder(
            "<mujoco><visual><headlight ambient='1 1 1' diffuse='0 0 0' specular='0 0 0'/>"
            "</visual><worldbody>"
            "<camera name='eye' pos='0 0 0' xyaxes='0 -1 0 0 0 1'/>"
            "<body pos='2 0 0'><joint name='rail' type='slide' axis='0 1 0'/>"
            "<geom type='box' size='0.05 0.2 1' mass='1' rgba='1 1 1 1'/></body>"
            "</worldbody></mujoco>"),
        world(folder.alone()),
        camera(model_id(world.model(), ModelObject::camera, "eye")),
        renderer(make_offscreen_renderer(world.model(), 160, 120)) {}

  CameraImages take(double speed_m_s, const ExposureOptions& exposure) {
    world.data().qvel[0] = speed_m_s;
    Rng rng(1);
    return rgbd_exposed(*renderer, world, camera,
                        {.width_px = 160, .height_px = 120, .noise = false}, exposure, rng);
  }
  /// Pixels of the middle row that are neither bar nor background.
  static int grey(const CameraImages& images) {
    int count = 0;
    for (std::size_t column = 0; column < 160; ++column) {
      const int value = images.rgb[3 * (60 * 160 + column)];
      if (value > 20 && value < 235) ++count;
    }
    return count;
  }

  test::SceneFolder folder;
  World world;
  int camera;
  std::unique_ptr<Renderer> renderer;
};

TEST(Exposure, AtRestIsSharp) {
  MovingBar bar;
  const CameraImages sharp = bar.take(0.0, {.samples = 1});
  EXPECT_EQ(bar.take(0.0, {.exposure_s = 0.1, .samples = 5}).rgb, sharp.rgb);
}

TEST(Exposure, WhatMovesIsBlurredAsFarAsItMoves) {
  MovingBar bar;
  const int sharp = MovingBar::grey(bar.take(1.0, {.samples = 1}));
  const CameraImages blurred = bar.take(1.0, {.exposure_s = 0.1, .samples = 16});
  // 0.1 m at 1.95 m, 145 px focal length: both edges are 7.4 px wide.
  EXPECT_NEAR(MovingBar::grey(blurred) - sharp, 2 * 7.4, 3.0);
  EXPECT_EQ(blurred.depth_m, bar.take(1.0, {.samples = 1}).depth_m);
}

TEST(Exposure, LeavesTheWorldAlone) {
  MovingBar bar;
  bar.take(1.0, {});
  const std::vector<double> before = bar.world.state();
  bar.take(1.0, {.exposure_s = 0.05, .samples = 3});
  EXPECT_EQ(bar.world.state(), before);
}

TEST(Exposure, RefusesOptionsOutOfRange) {
  MovingBar bar;
  EXPECT_THROW(bar.take(0.0, {.samples = 0}), ConfigError);
}

TEST(Exposure, ShowsHowItWasFromItsBeginningToNow) {
  MovingBar bar;
  const CameraImages now = bar.take(6.0, {.samples = 1});
  const CameraImages both = bar.take(6.0, {.exposure_s = 0.1, .samples = 2});
  const auto shade = [](const CameraImages& images, std::size_t column) {
    return static_cast<int>(images.rgb[3 * (60 * 160 + column)]);
  };
  const int white = shade(now, 80);
  const int black = shade(now, 20);
  ASSERT_GT(white, 235);
  ASSERT_LT(black, 20);
  const int grey = (white + black + 1) / 2;
  // 0.6 m at 1.95 m, 145 px focal length: the bar, 30 px wide, was 45 px to the right.
  for (std::size_t column = 70; column <= 90; ++column) EXPECT_EQ(shade(both, column), grey);
  for (std::size_t column = 98; column <= 105; ++column) EXPECT_EQ(shade(both, column), black);
  for (std::size_t column = 115; column <= 133; ++column) EXPECT_EQ(shade(both, column), grey);
  for (std::size_t column = 20; column <= 60; ++column) EXPECT_EQ(shade(both, column), black);
}

/// Draws two pixels of a shade, the next one each time, and keeps what it was asked for.
class ExposureRenderer final : public Renderer {
 public:
  explicit ExposureRenderer(const std::vector<std::uint8_t>& shades) : shades_(shades) {}
  [[nodiscard]] int width_px() const override { return 2; }
  [[nodiscard]] int height_px() const override { return 1; }
  void render(const mjModel&, const mjData& data, const CameraView&, const RenderRequest& request,
              RenderedImages& out) override {
    out.width_px = 2;
    out.height_px = 1;
    out.rgb.assign(6, shades_.at(rail_m.size()));
    out.depth_m.assign(2, 1.5F);
    with_depth.push_back(request.depth_and_segmentation ? 1 : 0);
    rail_m.push_back(data.qpos[0]);
    camera_m.push_back(data.cam_xpos[1]);
  }
  std::vector<int> with_depth;
  std::vector<double> rail_m;    ///< where the bar was
  std::vector<double> camera_m;  ///< and the first camera

 private:
  std::vector<std::uint8_t> shades_;
};

TEST(Exposure, IsTheMeanOfImagesEvenlyApartOfWhichOneHasDepth) {
  MovingBar bar;
  bar.world.data().qvel[0] = 8.0;
  ExposureRenderer renderer({10, 11, 11});
  Rng rng(1);
  const CameraImages images =
      rgbd_exposed(renderer, bar.world, bar.camera, {.width_px = 2, .height_px = 1, .noise = false},
                   {.exposure_s = 0.0625, .samples = 3}, rng);
  EXPECT_EQ(renderer.rail_m, (std::vector<double>{0.0, -0.25, -0.5}));
  EXPECT_EQ(renderer.with_depth, (std::vector<int>{1, 0, 0}));
  EXPECT_EQ(images.rgb, std::vector<std::uint8_t>(6, 11)) << "10.67, rounded";
  EXPECT_EQ(images.depth_m, std::vector<float>(2, 1.5F));
}

TEST(Exposure, ACameraThatFollowsAMassIsWhereThatWas) {
  const test::SceneFolder folder(
      "<mujoco><worldbody><body pos='2 0 0'><joint type='slide' axis='0 1 0'/>"
      "<geom type='box' size='.05 .2 1' mass='1'/><camera name='eye' mode='trackcom' pos='-1 0 0'/>"
      "</body></worldbody></mujoco>");
  World world(folder.alone());
  world.data().qvel[0] = 8.0;
  ExposureRenderer renderer({10, 10, 10});
  Rng rng(1);
  rgbd_exposed(renderer, world, 0, {.width_px = 2, .height_px = 1, .noise = false},
               {.exposure_s = 0.0625, .samples = 3}, rng);
  ASSERT_EQ(renderer.camera_m.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(renderer.camera_m[i], -0.25 * static_cast<double>(i), 1e-12) << i;
  }
}

/// Colour of a camera that moves at 8 m/s, and where it was for each image that was drawn.
std::pair<int, std::vector<double>> shade_and_places(const std::vector<std::uint8_t>& shades,
                                                     const ExposureOptions& exposure) {
  const test::SceneFolder folder(
      "<mujoco><worldbody><body><joint type='slide' axis='0 1 0'/><geom size='.1'/>"
      "<camera name='eye'/></body></worldbody></mujoco>");
  World world(folder.alone());
  world.data().qvel[0] = 8.0;
  ExposureRenderer renderer(shades);
  Rng rng(1);
  const CameraImages images = rgbd_exposed(
      renderer, world, 0, {.width_px = 2, .height_px = 1, .noise = false}, exposure, rng);
  return {images.rgb[0], renderer.rail_m};
}

TEST(Exposure, AMomentIsDrawnOnce) {
  EXPECT_EQ(shade_and_places({10, 11, 11}, {.exposure_s = 0.0, .samples = 3}).second,
            std::vector<double>{0.0});
}

TEST(Exposure, MeansAreRoundedToTheNearest) {
  const ExposureOptions four{.exposure_s = 0.0625, .samples = 4};
  EXPECT_EQ(shade_and_places({10, 10, 10, 11}, four).first, 10) << "10.25";
  EXPECT_EQ(shade_and_places({10, 10, 11, 11}, four).first, 11) << "10.5";
}

}  // namespace
}  // namespace vantage
