#include "vantage/dataset/sensing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

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

/// A seed stands for the same pictures for ever.
TEST(Sensing, ColourNoiseIsDrawnForEachValueInTurn) {
  const ObjectView clean = sensed(exact());
  DatasetOptions options = exact();
  options.colour_noise = 6.0;
  const ObjectView noisy = sensed(options);
  Rng again(5);
  for (std::size_t i = 0; i < clean.rgb.size(); ++i) {
    const double value = clean.rgb[i] + 6.0 * again.normal();
    ASSERT_EQ(noisy.rgb[i], std::lround(std::clamp(value, 0.0, 255.0))) << i;
  }
}

TEST(Sensing, NothingSeenIsAnEmptyView) {
  RenderedImages images = image();
  for (int& id : images.segmentation) id = 1;
  EXPECT_EQ(sensed(exact(), images).width_px, 0);
}

TEST(Sensing, ColoursHaveTheGainOfTheirSession) {
  Session session = support::plain_session(0.7);
  const auto colours_with = [&](const Eigen::Vector3d& gain) {
    session.gain = gain;
    Rng rng(5);
    const ObjectView view = sense(image(), kObject, session, exact(), rng);
    const auto first = view.rgb.begin() + static_cast<std::ptrdiff_t>(3 * view.index(2, 2));
    return std::vector<int>(first, first + 3);
  };
  EXPECT_EQ(colours_with({1.0, 1.0, 1.0}), (std::vector<int>{200, 100, 30}));
  EXPECT_EQ(colours_with({0.5, 2.0, 1.25}), (std::vector<int>{100, 200, 38})) << "37.5 is 38";
  EXPECT_EQ(colours_with({1.5, 3.0, 0.98}), (std::vector<int>{255, 255, 29})) << "29.4 is 29";
  EXPECT_EQ(colours_with({0.0, 1.0, 1.0}), (std::vector<int>{0, 100, 30}));
}

TEST(Sensing, DepthIsMeasuredFromTenCentimetresToFiveMetres) {
  const auto measured = [](float z_m) {
    RenderedImages images = image();
    images.depth_m.assign(images.depth_m.size(), z_m);
    return sensed(exact(), images).depth_m.front();
  };
  EXPECT_EQ(measured(0.09F), 0.0F);
  EXPECT_EQ(measured(0.11F), 0.11F);
  EXPECT_EQ(measured(4.9F), 4.9F);
  EXPECT_EQ(measured(5.1F), 0.0F);
}

/// Round 5 x 3 px there are 12 px inside and 16 px outside of the edge.
TEST(Sensing, AnEdgeIsAStepOfTwoCentimetres) {
  const auto lost = [](float step_m, double dropout, int repeats) {
    RenderedImages images = image();
    for (float& z_m : images.depth_m) z_m = z_m < 0.6F ? 0.8F - step_m : 0.8F;
    DatasetOptions options = exact();
    options.edge_dropout = dropout;
    Rng rng(9);
    int count_lost = 0;
    for (int i = 0; i < repeats; ++i) {
      for (const float z_m :
           sense(images, kObject, support::plain_session(0.7), options, rng).depth_m) {
        count_lost += z_m == 0.0F ? 1 : 0;
      }
    }
    return count_lost;
  };
  EXPECT_EQ(lost(0.021F, 1.0, 1), 28);
  EXPECT_EQ(lost(0.019F, 1.0, 1), 0);
  EXPECT_EQ(lost(0.021F, 0.0, 1), 0);
  EXPECT_NEAR(lost(0.021F, 0.3, 200) / (28.0 * 200.0), 0.3, 0.03);
}

/// The window of 15 x 15 px begins 7 px before the middle of the image.
TEST(Sensing, TheMarginEndsWithTheWindow) {
  DatasetOptions options = exact();
  options.margin_px = 5;
  const ObjectView view = sensed(options);
  EXPECT_EQ(view.width_px, 15);
  EXPECT_EQ(view.height_px, 13);
  EXPECT_EQ(view.left_px, 320 - 7);
  EXPECT_EQ(view.top_px, 240 - 7 + 1);
  options.margin_px = 50;
  EXPECT_EQ(sensed(options).height_px, 15);
  EXPECT_EQ(sensed(options).depth_m.size(), 15U * 15U);
}

TEST(Sensing, ThePixelIsWhatItsMiddleRayMeets) {
  DatasetOptions options = exact();
  options.supersampling = 3;
  RenderedImages images = image(3);
  const std::size_t ray = (3 * 7 + 1) * 45 + 3 * 7 + 1;
  images.depth_m[ray] = 0.45F;
  images.segmentation[ray] = 1;
  const ObjectView view = sensed(options, images);
  const std::size_t pixel = view.index(7 - 4, 7 - 3);
  EXPECT_FLOAT_EQ(view.depth_m[pixel], 0.45F);
  EXPECT_EQ(view.mask[pixel], 0);
  EXPECT_EQ(count(view.mask), 14);
  EXPECT_EQ(view.focal_px, 570.3);
  EXPECT_LT((view.up - Eigen::Vector3d(0.0, -std::cos(0.7), -std::sin(0.7))).norm(), 1e-12);
}

TEST(Sensing, MaskReachesAlmostToTheEdgeOfTheWindow) {
  RenderedImages images = image();
  for (std::size_t i = 0; i < images.segmentation.size(); ++i) {
    const auto inside = [](std::size_t at) { return at >= 2 && at <= 12; };
    images.segmentation[i] = inside(i / 15) && inside(i % 15) ? kObject : 1;
  }
  DatasetOptions options = exact();
  options.mask_growth_px = 1;
  EXPECT_EQ(count(sensed(options, images).mask), 13 * 13);
}

/// The corners of the margin are beside no edge.
TEST(Sensing, AnEdgeIsBetweenPixelsOfOneRowOrColumn) {
  DatasetOptions options = exact();
  options.edge_dropout = 1.0;
  options.margin_px = 1;
  const ObjectView view = sensed(options);
  ASSERT_EQ(view.depth_m.size(), 7U * 5U);
  EXPECT_EQ(std::ranges::count(view.depth_m, 0.0F), 28);
  for (const std::size_t corner : {0U, 6U, 28U, 34U}) {
    EXPECT_FLOAT_EQ(view.depth_m[corner], 0.8F) << corner;
  }
}

}  // namespace
}  // namespace vantage
