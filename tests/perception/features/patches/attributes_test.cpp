// Kernels, tables, gradients and grids that can be worked out by hand.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/object_views.hpp"
#include "vantage/perception/features/patches/attribute_image.hpp"
#include "vantage/perception/features/patches/image_patches.hpp"
#include "vantage/perception/features/patches/kernel_descriptor.hpp"

namespace vantage {
namespace {

TEST(BasisAxis, KernelsAreOfItsKind) {
  BasisAxis axis = even_axis(5, -1.0, 2.0, 0.5);
  ASSERT_EQ(axis.points.size(), 5);
  EXPECT_NEAR(axis.points[0], -1.0, 1e-12);
  EXPECT_NEAR(axis.points[1], -0.25, 1e-12);
  EXPECT_NEAR(axis.points[4], 2.0, 1e-12);
  EXPECT_EQ(axis.low, -1.0);
  EXPECT_EQ(axis.high, 2.0);
  EXPECT_EQ(axis.samples, 2049);
  EXPECT_NEAR(axis.kernel(0.5, 2.0), std::exp(-0.5 * 2.25), 1e-12);
  axis.kind = BasisAxis::Kind::angle;
  EXPECT_NEAR(axis.kernel(0.1, 0.1 + std::numbers::pi), std::exp(-0.5 * 4.0), 1e-12);
  EXPECT_NEAR(axis.kernel(0.1, 0.1 + std::numbers::pi / 2.0), std::exp(-0.5 * 2.0), 1e-12);
  const BasisAxis bits = bits_axis(3, 0.7);
  ASSERT_EQ(bits.points.size(), 8);
  for (Eigen::Index i = 0; i < 8; ++i) EXPECT_EQ(bits.points[i], static_cast<double>(i));
  EXPECT_EQ(bits.low, 0.0);
  EXPECT_EQ(bits.high, 7.0);
  EXPECT_EQ(bits.samples, 8);
  EXPECT_EQ(bits.kind, BasisAxis::Kind::bits);
  EXPECT_NEAR(bits.kernel(5.0, 3.0), std::exp(-1.4), 1e-12) << "two bits differ";
  EXPECT_EQ(bits.kernel(6.0, 6.0), 1.0);
}

TEST(BasisTable, HoldsTheNearestSample) {
  ProductBasis::Axis axis;
  axis.low = -1.0;
  axis.per_unit = 4.0;
  axis.values = Eigen::MatrixXf::Zero(2, 9);
  EXPECT_EQ(axis.functions(), 2);
  EXPECT_EQ(axis.sample(-1.0), 0);
  EXPECT_EQ(axis.sample(-0.88), 0);
  EXPECT_EQ(axis.sample(-0.87), 1);
  EXPECT_EQ(axis.sample(0.37), 5);
  EXPECT_EQ(axis.sample(0.38), 6);
  EXPECT_EQ(axis.sample(1.0), 8);
  EXPECT_EQ(axis.sample(7.0), 8);
  EXPECT_EQ(axis.sample(-7.0), 0);
  EXPECT_EQ(axis.sample(1e300), 8);
  EXPECT_EQ(axis.sample(std::numeric_limits<double>::quiet_NaN()), 0);
}

TEST(BasisOfADescriptor, TablesReachAsFarAsAttributesDo) {
  const auto ends = [](PatchKind kind, std::size_t axis) {
    const BasisAxis found = basis_axes(kind)[axis];
    return std::array{found.low, found.high};
  };
  EXPECT_EQ(ends(PatchKind::rgb_gradient, 0), (std::array{-1.0, 1.0}));
  EXPECT_EQ(ends(PatchKind::normalised_rgb, 2), (std::array{-1.25, 2.25}));
  EXPECT_EQ(ends(PatchKind::normalised_rgb, 3), (std::array{0.0, 1.0}));
  EXPECT_EQ(ends(PatchKind::normal_spin, 1), (std::array{-0.05, 0.05}));
  EXPECT_EQ(basis_axes(PatchKind::normal_spin)[0].kind, BasisAxis::Kind::angle);
  EXPECT_EQ(basis_axes(PatchKind::normal_spin)[1].kind, BasisAxis::Kind::line);
  EXPECT_EQ(basis_axes(PatchKind::lbp)[0].kind, BasisAxis::Kind::bits);
}

TEST(KernelSize, SidesAreBroughtBetweenTheLimits) {
  const auto sides = [](int width_px, int height_px) {
    const ObjectView view = at_kernel_size(blank_view(width_px, height_px));
    return std::pair(view.width_px, view.height_px);
  };
  EXPECT_EQ(sides(45, 300), std::pair(45, 300));
  EXPECT_EQ(sides(100, 80), std::pair(100, 80));
  EXPECT_EQ(sides(20, 30), std::pair(45, 68)) << "67.5, rounded";
  EXPECT_EQ(sides(30, 20), std::pair(68, 45));
  EXPECT_EQ(sides(600, 400), std::pair(300, 200));
  EXPECT_EQ(sides(10, 200), std::pair(15, 300)) << "as far as the longer side allows";
  EXPECT_EQ(sides(1, 3000), std::pair(1, 300));
  EXPECT_EQ(sides(0, 7), std::pair(0, 7));
}

/// Black above or left of pixel 10, white from there on; the taps are those of a Gaussian.
TEST(Gradients, OfAStepAreThoseOfAGaussian) {
  const double one = std::exp(-1.0 / 1.28);
  const double two = std::exp(-4.0 / 1.28);
  const double tail = 2.0 * two / (one + 2.0 * two);
  for (const bool across : {true, false}) {
    ObjectView view = blank_view(20, 20);
    std::ranges::fill(view.mask, 1);
    for (int row = 0; row < 20; ++row) {
      for (int column = 0; column < 20; ++column) {
        const bool white = (across ? column : row) >= 10;
        for (std::size_t c = 0; c < 3; ++c) {
          view.rgb[3 * view.index(row, column) + c] = white ? 255 : 0;
        }
      }
    }
    const AttributeImage image = rgb_gradient_image(view, object_pixels(view));
    EXPECT_TRUE(image.attributes.allFinite()) << "where there is no gradient too";
    const auto weight = [&](int at) { return image.weights[across ? 100 + at : 20 * at + 5]; };
    EXPECT_NEAR(weight(7), 0.0, 1e-6);
    EXPECT_NEAR(weight(8), tail, 1e-5);
    EXPECT_NEAR(weight(9), 1.0, 1e-5);
    EXPECT_NEAR(weight(10), 1.0, 1e-5);
    EXPECT_NEAR(weight(11), tail, 1e-5);
    EXPECT_NEAR(weight(12), 0.0, 1e-6);
    const Eigen::Index edge = across ? 5 * 20 + 10 : 10 * 20 + 5;
    EXPECT_NEAR(image.attributes(across ? 0 : 1, edge), 1.0, 1e-5);
    EXPECT_NEAR(image.attributes(across ? 1 : 0, edge), 0.0, 1e-5);
  }
}

/// Of 14 x 9 px, rising by 1/1024 m to the right and by twice that downwards.
TEST(Gradients, OfDepthAreThoseOfItsSlope) {
  ObjectView view = blank_view(14, 9);
  std::ranges::fill(view.mask, 1);
  for (int row = 0; row < 9; ++row) {
    for (int column = 0; column < 14; ++column) {
      view.depth_m[view.index(row, column)] = 1.0F + static_cast<float>(column + 2 * row) / 1024.0F;
    }
  }
  const double one = std::exp(-1.0 / 1.28);
  const double two = std::exp(-4.0 / 1.28);
  const double of_one_a_pixel = 2.0 * (one + 4.0 * two) / (one + 2.0 * two);
  const AttributeImage image = depth_gradient_image(view, object_pixels(view));
  ASSERT_EQ(image.width_px, 14);
  ASSERT_EQ(image.height_px, 9);
  for (int row = 0; row < 9; ++row) {
    for (int column = 0; column < 14; ++column) {
      const int i = 14 * row + column;
      const bool known = row >= 2 && row < 7 && column >= 2 && column < 12;
      EXPECT_NEAR(image.weights[i], known ? of_one_a_pixel * std::sqrt(5.0) / 1024.0 : 0.0, 2e-6);
      EXPECT_NEAR(image.attributes(0, i), known ? 1.0 / std::sqrt(5.0) : 0.0, 3e-4);
      EXPECT_NEAR(image.attributes(1, i), known ? 2.0 / std::sqrt(5.0) : 0.0, 3e-4);
    }
  }
}

/// The lower right corner: what is beside the image is as its border.
TEST(Patterns, RepeatTheBorderOfTheImage) {
  ObjectView view = blank_view(3, 2);
  std::ranges::fill(view.mask, 1);
  const std::array<std::uint8_t, 6> grey{90, 40, 60, 10, 80, 50};
  for (std::size_t i = 0; i < 6; ++i) std::fill_n(view.rgb.begin() + 3 * i, 3, grey[i]);
  const AttributeImage image = lbp_image(view, object_pixels(view));
  // Of 50, clockwise from the upper left: 40 60 60 50 50 50 80 80, the last three below and left.
  EXPECT_EQ(image.attributes(0, 5), static_cast<float>(0b11111110));
  // Of 90: 90 90 40 40 80 10 10 90.
  EXPECT_EQ(image.attributes(0, 0), static_cast<float>(0b10000011));
  const std::array<double, 9> of_corner{40, 60, 60, 50, 50, 50, 80, 80, 50};
  double mean = 0.0;
  double mean2 = 0.0;
  for (const double g : of_corner) mean += g / 255.0 / 9.0;
  for (const double g : of_corner) mean2 += (g / 255.0 - mean) * (g / 255.0 - mean) / 9.0;
  EXPECT_NEAR(image.weights[5], std::sqrt(mean2), 1e-5);
}

ObjectPixels all_of(int width_px, int height_px) {
  ObjectPixels pixels;
  pixels.width_px = pixels.right_px = width_px;
  pixels.height_px = pixels.bottom_px = height_px;
  pixels.colour.assign(static_cast<std::size_t>(width_px) * height_px, 1);
  return pixels;
}

PatchSet patches_of(const ObjectPixels& pixels) {
  const Eigen::Index count = Eigen::Index{pixels.width_px} * pixels.height_px;
  const AttributeImage image{pixels.width_px, pixels.height_px, Eigen::MatrixXf::Zero(1, count),
                             Eigen::VectorXf::Zero(count)};
  return describe_patches(image, pixels, make_product_basis(basis_axes(PatchKind::lbp), 5));
}

TEST(PatchGrid, IsInTheMiddleOfTheImage) {
  const PatchSet set = patches_of(all_of(30, 40));
  ASSERT_EQ(set.size(), 2 * 4);
  EXPECT_NEAR(set.places(0, 0), 11.0 / 30.0, 1e-6);
  EXPECT_NEAR(set.places(1, 0), 8.0 / 40.0, 1e-6);
  EXPECT_NEAR(set.places(1, 1), 16.0 / 40.0, 1e-6);
  EXPECT_NEAR(set.places(0, 7), 19.0 / 30.0, 1e-6);
  EXPECT_NEAR(set.places(1, 7), 32.0 / 40.0, 1e-6);
  EXPECT_EQ(patches_of(all_of(16, 16)).size(), 1);
  EXPECT_EQ(patches_of(all_of(15, 40)).size(), 0);
  EXPECT_EQ(patches_of(all_of(24, 16)).size(), 2);
}

TEST(PatchGrid, APatchHasAQuarterOfItsPixelsOnTheObject) {
  ObjectPixels pixels = all_of(16, 16);
  std::fill(pixels.colour.begin() + 64, pixels.colour.end(), 0);
  EXPECT_EQ(patches_of(pixels).size(), 1);
  pixels.colour[63] = 0;
  EXPECT_EQ(patches_of(pixels).size(), 0);
}

/// A patch on the first of two words, at a place.
Eigen::VectorXf pooled_at(float x, float y) {
  Eigen::MatrixXf words(2, 2);
  words << 1.0F, 2.0F,  //
      3.0F, 4.0F;
  PatchSet patches{Eigen::Vector2f(1.0F, 3.0F), Eigen::Vector2f(x, y)};
  return pooled_kernels(patches, words, {.gamma = 0.25, .levels = 3});
}

TEST(PooledKernels, CellsOfAPyramidAreWeighedByTheirNumber) {
  const double sum = 1.0 + 1.0 / 4.0 + 1.0 / 9.0;
  const auto expect = [&](float x, float y, int half, int third) {
    const Eigen::VectorXf pooled = pooled_at(x, y);
    ASSERT_EQ(pooled.size(), 14 * 2);
    Eigen::VectorXf expected = Eigen::VectorXf::Zero(28);
    const Eigen::Vector2d kernels(1.0, std::exp(-0.25 * 2.0));
    expected.segment(0, 2) = (kernels / sum).cast<float>();
    expected.segment(2 * (1 + half), 2) = (kernels / sum / 4.0).cast<float>();
    expected.segment(2 * (5 + third), 2) = (kernels / sum / 9.0).cast<float>();
    EXPECT_LT((pooled - expected).cwiseAbs().maxCoeff(), 1e-6F) << x << " " << y;
  };
  expect(0.1F, 0.1F, 0, 0);
  expect(0.9F, 0.1F, 1, 2);
  expect(0.1F, 0.9F, 2, 6);
  expect(0.4F, 0.6F, 2, 4);
  expect(1.0F, 1.0F, 3, 8);
}

}  // namespace
}  // namespace vantage
