// Patch descriptors by shared sums against the same, pixel by pixel and point by point.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "tests/support/object_views.hpp"
#include "vantage/perception/features/patches/cloud_patches.hpp"
#include "vantage/perception/features/patches/image_patches.hpp"
#include "vantage/perception/features/patches/kernel_descriptor.hpp"

namespace vantage {
namespace {

/// E vec(A diag(m) S') of the patch whose upper left pixel is (x, y).
Eigen::VectorXf patch_by_pixels(const AttributeImage& image, const ProductBasis& basis, int x,
                                int y) {
  Eigen::VectorXf sum = Eigen::VectorXf::Zero(basis.rows());
  double norm2 = 0.0;
  for (int row = 0; row < kPatchSide_px; ++row) {
    for (int column = 0; column < kPatchSide_px; ++column) {
      const Eigen::Index i = Eigen::Index{y + row} * image.width_px + x + column;
      std::vector<double> values;
      for (const float value : image.attributes.col(i)) values.push_back(value);
      values.push_back(column / 16.0);
      values.push_back(row / 16.0);
      sum += image.weights[i] * basis.describe(values);
      norm2 += image.weights[i] * image.weights[i];
    }
  }
  return sum / static_cast<float>(std::max(std::sqrt(norm2), 0.8));
}

class ImagePatches : public testing::TestWithParam<PatchKind> {};

AttributeImage image_of(PatchKind kind, const ObjectView& view, const ObjectPixels& pixels) {
  switch (kind) {
    case PatchKind::rgb_gradient: return rgb_gradient_image(view, pixels);
    case PatchKind::lbp: return lbp_image(view, pixels);
    case PatchKind::normalised_rgb: return normalised_rgb_image(view, pixels);
    case PatchKind::depth_gradient: return depth_gradient_image(view, pixels);
    default: return depth_lbp_image(view, pixels);
  }
}

TEST_P(ImagePatches, AreSumsOverTheirPixels) {
  Rng rng(1);
  const ObjectView view = ball_view(45, {.radius_m = 0.05, .noise = 0.02}, rng);
  const ObjectPixels pixels = object_pixels(view);
  const AttributeImage image = image_of(GetParam(), view, pixels);
  const ProductBasis basis = make_product_basis(basis_axes(GetParam()), 30);
  const PatchSet set = describe_patches(image, pixels, basis);
  ASSERT_EQ(set.size(), 16);  // 4 x 4, all with enough of the ball
  Eigen::Index p = 0;
  for (int x = 2; x <= 26; x += 8) {
    for (int y = 2; y <= 26; y += 8, ++p) {
      const Eigen::VectorXf expected = patch_by_pixels(image, basis, x, y);
      ASSERT_GT(expected.norm(), 1e-3F);
      EXPECT_LT((set.descriptors.col(p) - expected).norm(), 1e-4F * expected.norm());
    }
  }
}
INSTANTIATE_TEST_SUITE_P(All, ImagePatches,
                         testing::Values(PatchKind::rgb_gradient, PatchKind::lbp,
                                         PatchKind::normalised_rgb, PatchKind::depth_gradient,
                                         PatchKind::depth_lbp),
                         [](const auto& info) { return std::string(row_of(info.param).name); });

TEST(AttributeImage, AStepOfOneHasAGradientOfOne) {
  ObjectView view = blank_view(20, 20);
  std::ranges::fill(view.mask, 1);
  for (int row = 0; row < 20; ++row) {
    for (int i = 30; i < 60; ++i) view.rgb[60 * static_cast<std::size_t>(row) + i] = 255;
  }
  const AttributeImage image = rgb_gradient_image(view, object_pixels(view));
  EXPECT_NEAR(image.weights.maxCoeff(), 1.0, 0.6);
  const Eigen::Index edge = 10 * 20 + 10;
  EXPECT_NEAR(image.attributes(0, edge), 1.0, 1e-5);
  EXPECT_NEAR(image.attributes(1, edge), 0.0, 1e-5);
  EXPECT_EQ(image.weights[10 * 20 + 2], 0.0F);
}

// 9 8 7      the centre is 5: bits of 9 8 7 (0 1 2), then 6 (3), not 1 2 3, then 5 (7)
// 5 5 6
// 3 2 1
TEST(AttributeImage, PatternsRunClockwiseFromTheUpperLeft) {
  ObjectView view = blank_view(3, 3);
  std::ranges::fill(view.mask, 1);
  view.depth_m = {1.09F, 1.08F, 1.07F, 1.05F, 1.05F, 1.06F, 1.03F, 1.02F, 1.01F};
  ObjectPixels pixels = object_pixels(view);
  std::ranges::fill(pixels.depth, 1);
  const AttributeImage image = depth_lbp_image(view, pixels);
  EXPECT_EQ(image.attributes(0, 4), 0b10001111);
  double mean = 0.0;
  double mean2 = 0.0;
  for (const float z : view.depth_m) mean += static_cast<double>(z) / 9.0;
  for (const float z : view.depth_m) mean2 += (z - mean) * (z - mean) / 9.0;
  EXPECT_NEAR(image.weights[4], std::sqrt(mean2), 1e-6);
  EXPECT_EQ(image.weights[0], 0.0F);  // depth is not known all around
}

TEST(AttributeImage, MissingDepthHasNoGradient) {
  Rng rng(1);
  ObjectView view = ball_view(45, {.radius_m = 0.05}, rng);
  view.depth_m[view.index(22, 22)] = 0.0F;
  const AttributeImage image = depth_gradient_image(view, object_pixels(view));
  for (int row = 20; row <= 24; ++row) {
    for (int column = 20; column <= 24; ++column) {
      EXPECT_EQ(image.weights[row * 45 + column], 0.0F);
    }
  }
  EXPECT_LT(image.weights.maxCoeff(), 0.1F);  // nor any as steep as to the wall
}

TEST(AttributeImage, ColourIsNormalisedByItsSurroundings) {
  ObjectView view = blank_view(20, 20);
  std::ranges::fill(view.mask, 1);
  std::ranges::fill(view.rgb, 128);
  const AttributeImage flat = normalised_rgb_image(view, object_pixels(view));
  EXPECT_LT(flat.attributes.cwiseAbs().maxCoeff(), 1e-5F);
  EXPECT_NEAR(flat.weights[210], std::sqrt(0.001), 1e-5);
}

/// One pixel of another colour: every window round it has the same mean.
TEST(AttributeImage, ColourIsTheFormulaOfTheHeader) {
  ObjectView view = blank_view(20, 20);
  std::ranges::fill(view.mask, 1);
  std::ranges::fill(view.rgb, 128);
  const std::size_t at = view.index(10, 10);
  const std::array<double, 3> colour{1.0, 0.0, 128.0 / 255.0};
  view.rgb[3 * at] = 255;
  view.rgb[3 * at + 1] = 0;
  const double grey = 128.0 / 255.0;
  const double mean = (73.0 * grey + colour[0] + colour[1]) / 75.0;
  double squares = 24.0 * 3.0 * (grey - mean) * (grey - mean);
  for (const double c : colour) squares += (c - mean) * (c - mean);
  const double deviation = std::sqrt(squares / 25.0 + 0.001);
  const AttributeImage image = normalised_rgb_image(view, object_pixels(view));
  const auto pixel = static_cast<Eigen::Index>(at);
  EXPECT_NEAR(image.weights[pixel], deviation, 1e-5);
  for (Eigen::Index c = 0; c < 3; ++c) {
    const double expected = (colour[static_cast<std::size_t>(c)] - mean) / deviation / 4.0;
    EXPECT_NEAR(image.attributes(c, pixel), expected, 1e-5) << c;
  }
}

struct AxisOfABasis {
  Eigen::Index points;
  double low;
  double high;
  double gamma;
};

void expect_axes(PatchKind kind, const std::vector<AxisOfABasis>& expected) {
  const auto axes = basis_axes(kind);
  ASSERT_EQ(axes.size(), expected.size()) << row_of(kind).name;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    EXPECT_EQ(axes[i].points.size(), expected[i].points) << row_of(kind).name << i;
    EXPECT_EQ(axes[i].points.minCoeff(), expected[i].low) << row_of(kind).name << i;
    EXPECT_NEAR(axes[i].points.maxCoeff(), expected[i].high, 1e-12) << row_of(kind).name << i;
    EXPECT_EQ(axes[i].gamma, expected[i].gamma) << row_of(kind).name << i;
  }
}

/// Their kernels are what the descriptors are: a trained model knows them by no other name.
TEST(KernelDescriptor, BasesAreThoseThatModelsWereTrainedWith) {
  const AxisOfABasis position{5, 0.0, 1.0, 3.0};
  const AxisOfABasis component{10, -1.0, 1.0, 5.0};
  const AxisOfABasis pattern{256, 0.0, 255.0, 3.0};
  const AxisOfABasis channel{5, 0.0, 1.0, 5.0};
  for (const PatchKind kind : {PatchKind::rgb_gradient, PatchKind::depth_gradient}) {
    expect_axes(kind, {component, component, position, position});
  }
  for (const PatchKind kind : {PatchKind::lbp, PatchKind::depth_lbp}) {
    expect_axes(kind, {pattern, position, position});
  }
  expect_axes(PatchKind::normalised_rgb, {channel, channel, channel, position, position});
  expect_axes(PatchKind::normal_spin,
              {{50, 0.0, std::numbers::pi, 3.0}, {10, -0.05, 0.05, 300.0}, {5, 0.0, 0.05, 300.0}});
  expect_axes(PatchKind::size, {{100, 0.0, 1.0, 30.0}});
}

TEST(Spins, AreMeansOverTheirNeighbours) {
  Rng rng(1);
  const ObjectView view = ball_view(21, {.radius_m = 0.05, .distance_m = 2.0}, rng);
  const ObjectPixels pixels = object_pixels(view);
  const ObjectSurface surface = object_surface(view, pixels, 0.01);
  const ProductBasis basis = make_product_basis(basis_axes(PatchKind::normal_spin), 30);
  const PatchSet set = describe_spins(view, pixels, surface, basis);
  ASSERT_GE(set.size(), 4);
  // The first grid point on the surface; 5 cm at 2 m are 15 px, every second of which counts.
  const int first = 2;
  std::size_t centre = surface.cloud.size();
  int row0 = 0;
  int column0 = 0;
  for (int row = first; row < 21 && centre == surface.cloud.size(); row += 8) {
    for (int column = first; column < 21 && centre == surface.cloud.size(); column += 8) {
      const int point = surface.point_at[view.index(row, column)];
      if (point < 0 || surface.cloud.normals[static_cast<std::size_t>(point)].isZero()) continue;
      centre = static_cast<std::size_t>(point);
      row0 = row;
      column0 = column;
    }
  }
  ASSERT_LT(centre, surface.cloud.size());
  const Eigen::Vector3f p = surface.cloud.points[centre];
  const Eigen::Vector3f n = surface.cloud.normals[centre];
  Eigen::VectorXf sum = Eigen::VectorXf::Zero(basis.rows());
  int count = 0;
  for (int row = row0 % 2; row < 21; row += 2) {
    for (int column = column0 % 2; column < 21; column += 2) {
      const int point = surface.point_at[view.index(row, column)];
      if (point < 0) continue;
      const Eigen::Vector3f d = surface.cloud.points[static_cast<std::size_t>(point)] - p;
      const Eigen::Vector3f m = surface.cloud.normals[static_cast<std::size_t>(point)];
      if (d.norm() > 0.05F || m.isZero()) continue;
      const double along = n.dot(d);
      const double off = std::sqrt(std::max(0.0, d.squaredNorm() - along * along));
      const double angle = std::acos(std::clamp(static_cast<double>(n.dot(m)), -1.0, 1.0));
      sum += basis.describe(std::array{angle, along, off});
      ++count;
    }
  }
  ASSERT_GE(count, 10);
  const Eigen::VectorXf expected = sum / static_cast<float>(count);
  EXPECT_LT((set.descriptors.col(0) - expected).norm(), 1e-3F * expected.norm());
}

/// All in one place, a metre away, where 5 cm are 9 px: every second pixel counts, up to 8 px away.
TEST(Spins, LookNoFartherInTheImageThanTheirRadius) {
  const ProductBasis basis = make_product_basis(basis_axes(PatchKind::normal_spin), 5);
  const auto spins = [&](int rows) {
    ObjectView view = blank_view(41, rows);
    view.focal_px = 170.0;
    ObjectPixels pixels;
    pixels.width_px = pixels.right_px = 41;
    pixels.height_px = pixels.bottom_px = rows;
    ObjectSurface surface;
    surface.cloud.points.assign(view.mask.size(), {0.0F, 0.0F, 1.0F});
    surface.cloud.normals.assign(view.mask.size(), {0.0F, 0.0F, -1.0F});
    for (int i = 0; i < 41 * rows; ++i) surface.point_at.push_back(i);
    return describe_spins(view, pixels, surface, basis).size();
  };
  EXPECT_EQ(spins(1), 0) << "nine neighbours are too few";
  EXPECT_EQ(spins(5), 6);
}

TEST(Sizes, AreMeansOverThePointsOfTheObject) {
  Rng rng(1);
  const ObjectView view = ball_view(31, {.radius_m = 0.05, .distance_m = 2.0}, rng);
  const ObjectPixels pixels = object_pixels(view);
  const ObjectSurface surface = object_surface(view, pixels, 0.01);
  const ProductBasis basis = make_product_basis(basis_axes(PatchKind::size), 50);
  const PatchSet set = describe_sizes(pixels, surface, basis);
  const int centre = surface.point_at[view.index(11, 11)];  // the grid is 3, 11, 19, 27
  ASSERT_GE(centre, 0);
  Eigen::VectorXf expected = Eigen::VectorXf::Zero(basis.rows());
  for (const auto& q : surface.cloud.points) {
    const double d = (q - surface.cloud.points[static_cast<std::size_t>(centre)]).norm();
    expected += basis.describe(std::array{d}) / static_cast<float>(surface.cloud.size());
  }
  float nearest = 1.0F;
  for (Eigen::Index p = 0; p < set.size(); ++p) {
    nearest = std::min(nearest, (set.descriptors.col(p) - expected).norm() / expected.norm());
  }
  EXPECT_LT(nearest, 1e-3F);
}

/// Every other point is half a metre behind the rest, a row of a pixel each.
TEST(Sizes, OfMoreThan1600PointsEverySecondCounts) {
  const ProductBasis basis = make_product_basis(basis_axes(PatchKind::size), 20);
  const auto first_of = [&](int points) -> Eigen::VectorXf {
    ObjectPixels pixels;
    pixels.width_px = pixels.right_px = points;
    pixels.height_px = pixels.bottom_px = 1;
    ObjectSurface surface;
    for (int i = 0; i < points; ++i) {
      surface.cloud.points.emplace_back(0.0F, 0.0F, i % 2 == 0 ? 1.0F : 1.5F);
      surface.point_at.push_back(i);
    }
    return describe_sizes(pixels, surface, basis).descriptors.col(0);
  };
  const Eigen::VectorXf here = basis.describe(std::array{0.0});
  const Eigen::VectorXf there = basis.describe(std::array{0.5});
  EXPECT_LT((first_of(1601) - here).norm(), 1e-4F * here.norm());
  EXPECT_LT((first_of(1600) - 0.5F * (here + there)).norm(), 1e-4F * here.norm());
}

TEST(ExtractPatches, NormalsAreOfTheCentimetreAround) {
  Rng rng(1);
  const ObjectView view = ball_view(45, {.radius_m = 0.05, .noise = 0.02}, rng);
  const ObjectPixels pixels = object_pixels(view);
  const ProductBasis basis = make_product_basis(basis_axes(PatchKind::normal_spin), 10);
  const auto spins = [&](double radius_m) {
    const ObjectSurface surface = object_surface(view, pixels, radius_m);
    return describe_spins(view, pixels, surface, basis).descriptors;
  };
  const Eigen::MatrixXf found =
      extract_patches(PatchKind::normal_spin, view, basis).patches.descriptors;
  ASSERT_GT(found.cols(), 0);
  EXPECT_EQ(found, spins(0.01));
  EXPECT_NE(found, spins(0.005));
  EXPECT_NE(found, spins(0.02));
}

TEST(ExtractPatches, SaysWhatIsMissing) {
  const auto skipped = [](PatchKind kind, const ObjectView& view) {
    return extract_patches(kind, view, make_product_basis(basis_axes(kind), 5)).skipped;
  };
  ObjectView view = blank_view(45, 45);
  EXPECT_EQ(skipped(PatchKind::lbp, view), "the mask has 0 usable pixels, fewer than 32");
  for (int column = 0; column < 45; ++column) {
    view.mask[view.index(26, column)] = 1;
    view.depth_m[view.index(26, column)] = 1.0F;
  }
  EXPECT_EQ(skipped(PatchKind::lbp, view), "no patch of 16 x 16 px has enough of the object");
  EXPECT_EQ(skipped(PatchKind::normal_spin, view), "no grid point is on a surface large enough");
  EXPECT_EQ(skipped(PatchKind::size, view), "");
  view.focal_px = 0.0;
  EXPECT_EQ(skipped(PatchKind::size, view), "the camera's intrinsics are not finite numbers");
}

TEST(ExtractPatches, DepthIsNeededByWhatGoesByIt) {
  Rng rng(1);
  ObjectView view = ball_view(45, {.radius_m = 0.05}, rng);
  std::ranges::fill(view.depth_m, 0.0F);
  const auto skipped = [&](PatchKind kind) {
    return extract_patches(kind, view, make_product_basis(basis_axes(kind), 5)).skipped;
  };
  for (const PatchKind kind :
       {PatchKind::rgb_gradient, PatchKind::lbp, PatchKind::normalised_rgb}) {
    EXPECT_EQ(skipped(kind), "") << row_of(kind).name;
  }
  for (const PatchKind kind :
       {PatchKind::depth_gradient, PatchKind::depth_lbp, PatchKind::normal_spin, PatchKind::size}) {
    EXPECT_EQ(skipped(kind), "0 pixels of the object have depth, fewer than 32")
        << row_of(kind).name;
  }
}

TEST(ExtractPatches, ThirtyTwoPixelsAreEnough) {
  const ProductBasis basis = make_product_basis(basis_axes(PatchKind::size), 5);
  const auto skipped = [&](int width_px) {
    ObjectView strip = blank_view(width_px, 1);
    std::ranges::fill(strip.mask, 1);
    std::ranges::fill(strip.depth_m, 1.0F);
    return extract_patches(PatchKind::size, strip, basis).skipped;
  };
  EXPECT_EQ(skipped(32), "");
  EXPECT_EQ(skipped(31), "31 pixels of the object have depth, fewer than 32");
}

/// Of 45 x 5 px: every 8th pixel from (2, 2) on, by its middle.
TEST(CloudPatches, PlacesAreTheMiddlesOfTheirPixels) {
  ObjectView view = blank_view(45, 5);
  view.focal_px = 170.0;
  ObjectPixels pixels;
  pixels.width_px = pixels.right_px = 45;
  pixels.height_px = pixels.bottom_px = 5;
  ObjectSurface surface;
  surface.cloud.points.assign(view.mask.size(), {0.0F, 0.0F, 1.0F});
  surface.cloud.normals.assign(view.mask.size(), {0.0F, 0.0F, -1.0F});
  for (int i = 0; i < 45 * 5; ++i) surface.point_at.push_back(i);
  const auto expect_places = [](const PatchSet& set) {
    ASSERT_EQ(set.places.cols(), 6);
    for (Eigen::Index p = 0; p < 6; ++p) {
      EXPECT_FLOAT_EQ(set.places(0, p), (2.5F + 8.0F * static_cast<float>(p)) / 45.0F);
      EXPECT_FLOAT_EQ(set.places(1, p), 0.5F);
    }
  };
  expect_places(describe_spins(view, pixels, surface,
                               make_product_basis(basis_axes(PatchKind::normal_spin), 5)));
  expect_places(
      describe_sizes(pixels, surface, make_product_basis(basis_axes(PatchKind::size), 5)));
}

}  // namespace
}  // namespace vantage
