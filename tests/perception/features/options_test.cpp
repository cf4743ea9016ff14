// Defaults and ranges of the features' options, by number.
#include <gtest/gtest.h>

#include "tests/support/option_numbers.hpp"
#include "vantage/perception/features/feature.hpp"
#include "vantage/perception/features/kit/object_pixels.hpp"
#include "vantage/perception/features/kit/upright_extents.hpp"
#include "vantage/perception/features/patches/attribute_image.hpp"

namespace vantage {
namespace {

using support::expect_numbers;

TEST(FeatureOptions, OfHistograms) {
  expect_numbers(Colour{}, {{"min_pixels", 16, at_least(1)}});
  expect_numbers(SoftColour{}, {{"min_pixels", 16, at_least(1)}});
  expect_numbers(
      Vfh{},
      {{"normal_radius_m", 0.01, above(0.0)}, {"size_block", 0}, {"min_points", 32, at_least(3)}});
  EXPECT_EQ(Vfh{}.dimension(), 308);
}

TEST(FeatureOptions, OfBoxes) {
  expect_numbers(BoundingBox{}, {{"low_quantile", 0.01, between(0.0, 0.5)},
                                 {"high_quantile", 0.99, between(0.5, 1.0)},
                                 {"min_pixels", 16, at_least(3)}});
  expect_numbers(StandingBox{}, {{"low_quantile", 0.01, between(0.0, 0.5)},
                                 {"high_quantile", 0.99, between(0.5, 1.0)},
                                 {"outlier_floor_m", 0.06, between(0.0, 1.0)},
                                 {"stand_below_m", 0.1, between(0.0, 1.0)},
                                 {"min_pixels", 16, at_least(3)}});
  EXPECT_EQ(BoundingBox{}.dimension(), 3);
  EXPECT_EQ(StandingBox{}.dimension(), 3);
  EXPECT_EQ(OutlierOptions{}.floor_m, 0.02);
  EXPECT_FALSE(OutlierOptions{}.along_sight);
}

TEST(FeatureOptions, OfWordsAndNetworks) {
  expect_numbers(Sift{}, {{"step_px", 8, at_least(1)},
                          {"size_px", 4.0, between(1.0, 32.0)},
                          {"min_side_px", 96, at_least(16)},
                          {"max_side_px", 160, at_least(16)},
                          {"words", 200, between(1, 100000)},
                          {"training_views", 2000, at_least(1)},
                          {"samples_per_word", 100, at_least(1)},
                          {"iterations", 20, at_least(1)}});
  expect_numbers(Onnx{},
                 {{"components", 256, between(1, 100000)}, {"training_views", 2000, at_least(2)}});
}

template <PatchKind kind>
void expect_kernel_options(int rows, double gamma) {
  expect_numbers(KernelDescriptor<kind>{}, {{"rows", static_cast<double>(rows), between(1, 1000)},
                                            {"match.gamma", gamma, above(0.0)},
                                            {"match.words", 1000, between(1, 100000)},
                                            {"match.levels", 3, between(1, 8)},
                                            {"match.components", 1000, between(1, 100000)},
                                            {"match.power", 0.3, between(0.01, 1.0)},
                                            {"learning.training_views", 2000, at_least(2)},
                                            {"learning.samples_per_word", 20, at_least(1)},
                                            {"learning.iterations", 10, at_least(1)}});
}

TEST(FeatureOptions, OfKernelDescriptors) {
  expect_kernel_options<PatchKind::rgb_gradient>(200, 0.001);
  expect_kernel_options<PatchKind::lbp>(200, 0.01);
  expect_kernel_options<PatchKind::normalised_rgb>(200, 0.01);
  expect_kernel_options<PatchKind::depth_gradient>(200, 0.001);
  expect_kernel_options<PatchKind::depth_lbp>(200, 0.1);
  expect_kernel_options<PatchKind::normal_spin>(200, 0.1);
  expect_kernel_options<PatchKind::size>(50, 1.0);
  EXPECT_EQ(MatchOptions{}.gamma, 0.01);
}

TEST(FeatureOptions, APyramidHasOneFourNineCells) {
  EXPECT_EQ((MatchOptions{.levels = 1}.cells()), 1);
  EXPECT_EQ((MatchOptions{.levels = 2}.cells()), 5);
  EXPECT_EQ((MatchOptions{.levels = 3}.cells()), 14);
  EXPECT_EQ((MatchOptions{.levels = 4}.cells()), 30);
}

TEST(FeatureOptions, PatchesAreSixteenPixelsWideEveryEight) {
  EXPECT_EQ(kPatchSide_px, 16);
  EXPECT_EQ(kPatchStep_px, 8);
}

TEST(FeatureResults, AreEmptyAtFirst) {
  const ObjectPixels pixels;
  for (const int value :
       {pixels.width_px, pixels.height_px, pixels.colour_count, pixels.depth_count, pixels.left_px,
        pixels.top_px, pixels.right_px, pixels.bottom_px, AttributeImage{}.width_px,
        AttributeImage{}.height_px}) {
    EXPECT_EQ(value, 0);
  }
  const UprightExtents box;
  for (const double value : {box.bottom_m, box.top_m, box.greater_m, box.smaller_m}) {
    EXPECT_EQ(value, 0.0);
  }
  EXPECT_EQ(LevelExtent{}.axis, Eigen::Vector3d(1.0, 0.0, 0.0));
  EXPECT_TRUE(LevelExtent{}.ends_m.isZero());
  EXPECT_EQ(FeatureResult{}.weight, 1.0);
  EXPECT_EQ(ProductBasis::Axis{}.low, 0.0);
  EXPECT_EQ(ProductBasis::Axis{}.per_unit, 1.0);
  EXPECT_EQ(BasisAxis{}.gamma, 1.0);
  EXPECT_EQ(BasisAxis{}.low, 0.0);
  EXPECT_EQ(BasisAxis{}.high, 1.0);
  EXPECT_EQ(BasisAxis{}.kind, BasisAxis::Kind::line);
}

}  // namespace
}  // namespace vantage
