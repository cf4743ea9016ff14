#include "vantage/dataset/sensing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/dataset/cube.hpp"

namespace vantage {
namespace {

constexpr int kObject = 4;

/// 15 x 15 px: an object of 5 x 3 px at rows 6-8, columns 5-9, 0.5 m away before a wall at 0.8 m.
RenderedImages image(int rays = 1) {
  RenderedImages images;
  images.width_px = images.height_px = 15 * rays;
  for (int row = 0; row < 15 * rays; ++row) {
    for (int column = 0; column < 15 * rays; ++column) {
      const int r = row / rays;
      const int c = column / rays;
      const bool object = r >= 6 && r <= 8 && c >= 5 && c <= 9;
      images.segmentation.push_back(object ? kObject : 1);
      images.depth_m.push_back(object ? 0.5F : 0.8F);
      for (const int value : {object ? 200 : 50, 100, 30}) {
        images.rgb.push_back(static_cast<std::uint8_t>(value));
      }
    }
  }
  return images;
}

DatasetOptions exact() {
  return {.colour_noise = 0.0,
          .depth_noise = false,
          .edge_dropout = 0.0,
          .mask_growth_px = 0,
          .margin_px = 2,
          .supersampling = 1};
}

ObjectView sensed(const DatasetOptions& options, const RenderedImages& images = image()) {
  Rng rng(5);
  return sense(images, kObject, support::plain_session(0.7), options, rng);
}

int count(const std::vector<std::uint8_t>& mask) {
  int sum = 0;
  for (const auto value : mask) sum += value;
  return sum;
}

TEST(Sensing, CutsTheObjectOutWhereTheVirtualCameraSeesIt) {
  const ObjectView view = sensed(exact());
  EXPECT_EQ(view.width_px, 5 + 4);
  EXPECT_EQ(view.height_px, 3 + 4);
  EXPECT_EQ(view.left_px, 320 - 7 + 3);
  EXPECT_EQ(view.top_px, 240 - 7 + 4);
  EXPECT_EQ(count(view.mask), 15);
  EXPECT_FLOAT_EQ(view.depth_m[view.index(2, 2)], 0.5F);
  EXPECT_FLOAT_EQ(view.depth_m[view.index(1, 2)], 0.8F);
  EXPECT_EQ(view.rgb[3 * view.index(2, 2)], 200);
  // The window's middle pixel is on the optical axis.
  const Eigen::Vector3d p = view.point(7 - 4, 7 - 3);
  EXPECT_LT((p - Eigen::Vector3d(0.0, 0.0, 0.5)).norm(), 1e-6);
}

TEST(Sensing, AveragesRaysAndTakesDepthFromTheMiddle) {
  DatasetOptions options = exact();
  options.supersampling = 3;
  RenderedImages images = image(3);
  const std::size_t ray = (3 * 7 + 0) * 45 + 3 * 7;  // a corner ray of pixel (7, 7)
  images.rgb[3 * ray] = 20;
  images.depth_m[ray] = 0.1F;
  const ObjectView view = sensed(options, images);
  const std::size_t pixel = view.index(7 - 4, 7 - 3);
  EXPECT_EQ(view.rgb[3 * pixel], (8 * 200 + 20) / 9);
  EXPECT_FLOAT_EQ(view.depth_m[pixel], 0.5F);
}

TEST(Sensing, MaskReachesOverTheEdge) {
  DatasetOptions options = exact();
  options.mask_growth_px = 1;
  EXPECT_EQ(count(sensed(options).mask), 7 * 5);
  options.mask_growth_px = 2;
  EXPECT_EQ(count(sensed(options).mask), 9 * 7);
}

TEST(Sensing, DropsDepthBesideEdgesOnly) {
  DatasetOptions options = exact();
  options.edge_dropout = 1.0;
  const ObjectView view = sensed(options);
  EXPECT_EQ(view.depth_m[view.index(2, 2)], 0.0F);
  EXPECT_EQ(view.depth_m[view.index(1, 4)], 0.0F);
  EXPECT_FLOAT_EQ(view.depth_m[view.index(3, 4)], 0.5F);
  EXPECT_FLOAT_EQ(view.depth_m[view.index(0, 0)], 0.8F);
}

TEST(Sensing, ColourNoiseHasItsDeviation) {
  DatasetOptions options = exact();
  options.colour_noise = 6.0;
  double sum = 0.0;
  int pixels = 0;
  Rng rng(8);
  for (int repeat = 0; repeat < 40; ++repeat) {
    const ObjectView view = sense(image(), kObject, support::plain_session(0.7), options, rng);
    for (std::size_t i = 1; i < view.rgb.size(); i += 3) {
      sum += std::pow(view.rgb[i] - 100.0, 2.0);
      ++pixels;
    }
  }
  EXPECT_NEAR(std::sqrt(sum / pixels), 6.0, 0.3);
}

TEST(Sensing, NothingSeenIsAnEmptyView) {
  RenderedImages images = image();
  for (int& id : images.segmentation) id = 1;
  EXPECT_EQ(sensed(exact(), images).width_px, 0);
}

}  // namespace
}  // namespace vantage
