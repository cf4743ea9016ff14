// Colour and bounding box against what can be worked out by hand.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "tests/support/object_views.hpp"
#include "vantage/perception/features/bounding_box.hpp"
#include "vantage/perception/features/colour.hpp"
#include "vantage/perception/features/kit/histogram.hpp"
#include "vantage/perception/features/soft_colour.hpp"
#include "vantage/perception/features/standing_box.hpp"

namespace vantage {
namespace {

ObjectView filled(int width_px, int height_px) {
  ObjectView view = blank_view(width_px, height_px);
  std::ranges::fill(view.mask, 1);
  std::ranges::fill(view.depth_m, 1.0F);
  return view;
}

void paint(ObjectView& view, int row, int column, int r, int g, int b) {
  const std::size_t i = 3 * view.index(row, column);
  view.rgb[i] = static_cast<std::uint8_t>(r);
  view.rgb[i + 1] = static_cast<std::uint8_t>(g);
  view.rgb[i + 2] = static_cast<std::uint8_t>(b);
}

TEST(Colour, OneQuarterGreenAndTheRestRed) {
  ObjectView view = filled(20, 20);
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < 20; ++column) {
      column < 5 ? paint(view, row, column, 0, 255, 0) : paint(view, row, column, 255, 0, 0);
    }
  }
  const FeatureResult result = Colour{}.extract(view);
  ASSERT_TRUE(result.extracted());
  ASSERT_EQ(result.vector.size(), 144);
  const int red = (0 * 3 + 2) * 3 + 2;
  const int green = (120 * 16 / 360 * 3 + 2) * 3 + 2;
  EXPECT_FLOAT_EQ(result.vector[red], std::sqrt(0.75F));
  EXPECT_FLOAT_EQ(result.vector[green], std::sqrt(0.25F));
  EXPECT_FLOAT_EQ(result.vector.squaredNorm(), 1.0F);
}

TEST(Colour, WhatIsBesideTheMaskDoesNotCount) {
  ObjectView view = filled(20, 20);
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < 20; ++column) {
      if (column < 10) view.mask[view.index(row, column)] = 0;
      column < 12 ? paint(view, row, column, 0, 0, 255) : paint(view, row, column, 255, 0, 0);
    }
  }
  EXPECT_FLOAT_EQ(Colour{}.extract(view).vector[(0 * 3 + 2) * 3 + 2], 1.0F);
}

TEST(Colour, APixelIsTooFew) {
  ObjectView view = blank_view(20, 20);
  view.mask[view.index(10, 10)] = 1;
  EXPECT_EQ(Colour{}.extract(view).skipped, "the mask has 1 usable pixels, fewer than 16");
}

ObjectView of_colour(int r, int g, int b) {
  ObjectView view = filled(20, 20);
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < 20; ++column) paint(view, row, column, r, g, b);
  }
  return view;
}

/// Share of the pixels in a bin.
float share(const FeatureResult& result, int hue, int saturation, int value) {
  const float root = result.vector[(hue * 3 + saturation) * 3 + value];
  return root * root;
}

TEST(SoftColour, SharesAPixelAmongTheBinsRoundIt) {
  // Hue 30 deg: 4/3 bins from the start, 5/6 from the first middle. Brightest and most saturated.
  const FeatureResult orange = SoftColour{}.extract(of_colour(254, 127, 0));
  ASSERT_EQ(orange.vector.size(), Colour{}.dimension());
  EXPECT_NEAR(share(orange, 0, 2, 2), 1.0 / 6.0, 1e-3);
  EXPECT_NEAR(share(orange, 1, 2, 2), 5.0 / 6.0, 1e-3);
  // Red is half way between the first hue and the last; value 0.5 is the middle bin's middle.
  const FeatureResult red = SoftColour{}.extract(of_colour(128, 0, 0));
  EXPECT_NEAR(share(red, 0, 2, 1), 0.5, 1e-2);
  EXPECT_NEAR(share(red, 15, 2, 1), 0.5, 1e-2);
}

TEST(SoftColour, ALittleLightMoreChangesLittle) {
  const auto change = [](const auto& feature) {
    return (feature.extract(of_colour(0, 173, 0)).vector -
            feature.extract(of_colour(0, 169, 0)).vector)
        .norm();
  };
  EXPECT_GT(change(Colour{}), 1.4F) << "two thirds of the way up, where a bin ends";
  EXPECT_LT(change(SoftColour{}), 0.05F);
}

// A plate of 100 x 60 px facing the camera: no depth extent at all.
TEST(BoundingBox, OfAPlateFacingTheCamera) {
  const ObjectView view = filled(101, 61);
  const BoundingBox whole{.low_quantile = 0.0, .high_quantile = 1.0};
  const FeatureResult result = whole.extract(view);
  ASSERT_TRUE(result.extracted());
  EXPECT_NEAR(result.vector[0], 60.0 / view.focal_px, 1e-6);
  EXPECT_NEAR(result.vector[1], 100.0 / view.focal_px, 1e-6);
  EXPECT_NEAR(result.vector[2], 0.0, 1e-6);
  const FeatureResult inner = BoundingBox{}.extract(view);
  EXPECT_NEAR(inner.vector[1] / result.vector[1], 0.98, 0.02);
}

TEST(BoundingBox, HeightIsAlongGravityHoweverTheCameraIsHeld) {
  ObjectView view = filled(101, 61);
  view.up = Eigen::Vector3d(1.0, 0.0, 0.0);
  const FeatureResult result = BoundingBox{.low_quantile = 0.0, .high_quantile = 1.0}.extract(view);
  EXPECT_NEAR(result.vector[0], 100.0 / view.focal_px, 1e-6);
  EXPECT_NEAR(result.vector[1], 60.0 / view.focal_px, 1e-6);
}

TEST(BoundingBox, BackgroundInsideTheMaskDoesNotStretchIt) {
  ObjectView view = filled(101, 61);
  for (int row = 0; row < 61; ++row) view.depth_m[view.index(row, 50)] = 2.0F;
  EXPECT_NEAR(BoundingBox{}.extract(view).vector[2], 0.0, 1e-6);
}

TEST(BoundingBox, SaysWhatIsMissing) {
  ObjectView view = filled(20, 20);
  view.up = Eigen::Vector3d::Constant(std::nan(""));
  EXPECT_EQ(BoundingBox{}.extract(view).skipped, "the direction of gravity is not known");
  std::ranges::fill(view.depth_m, 0.0F);
  EXPECT_EQ(BoundingBox{}.extract(view).skipped,
            "0 pixels of the object have depth, fewer than 16");
}

struct Can {
  double tall_m = 0.12;
  double radius_m = 0.06;
  bool full = true;  ///< else open at its top, its wall 4 mm
};

/// On a level stand, seen from `elevation_rad` and a metre, `off_px` beside the image's middle.
ObjectView can_view(const Can& can, double elevation_rad, int off_px = 0) {
  ObjectView view = blank_view(221, 221);
  view.left_px += off_px;
  view.up = {0.0, -std::cos(elevation_rad), -std::sin(elevation_rad)};
  const Eigen::Vector3d foot = view.ray(110, 110).normalized();
  const auto inside = [&](const Eigen::Vector3d& p) {
    const double height = p.dot(view.up);
    const double radius = (p - height * view.up).norm();
    return height < can.tall_m && radius < can.radius_m &&
           (can.full || radius > can.radius_m - 0.004 || height < 0.004);
  };
  for (int row = 0; row < view.height_px; ++row) {
    for (int column = 0; column < view.width_px; ++column) {
      const Eigen::Vector3d ray = view.ray(row, column);
      const double stand = foot.dot(view.up) / ray.dot(view.up);
      double at = 0.75;
      while (at < stand && !inside(at * ray - foot)) at += 0.0005;
      view.depth_m[view.index(row, column)] = static_cast<float>(std::min(at, stand));
      view.mask[view.index(row, column)] = at < stand ? 1 : 0;
    }
  }
  return view;
}

TEST(StandingBox, HeightIsFromTheStandFromWhereverItIsSeen) {
  for (const double elevation_rad : {0.5, 0.8, 1.05}) {
    const FeatureResult box = StandingBox{}.extract(can_view({}, elevation_rad));
    ASSERT_TRUE(box.extracted()) << box.skipped;
    EXPECT_NEAR(box.vector[0], 0.12, 0.003) << elevation_rad;
  }
  const double low = BoundingBox{}.extract(can_view({}, 0.5)).vector[0];
  const double high = BoundingBox{}.extract(can_view({}, 0.8)).vector[0];
  EXPECT_GT(std::abs(low - high), 0.001) << "of what is seen alone it changes with the foot";
}

TEST(StandingBox, ABowlIsTheSameWhereverInThePictureItIs) {
  const Can bowl{.tall_m = 0.06, .radius_m = 0.075, .full = false};
  const ObjectView middle = can_view(bowl, 0.3);
  const ObjectView aside = can_view(bowl, 0.3, 200);
  const auto change = [&](const auto& feature) {
    return (feature.extract(middle).vector - feature.extract(aside).vector).cwiseAbs().maxCoeff();
  };
  EXPECT_LT(change(StandingBox{}), 0.002F);
  EXPECT_GT(change(BoundingBox{}), 0.02F) << "its far wall is no outlier along the optical axis";
}

TEST(StandingBox, TheOutlierFloorKeepsWhatIsLittleBehind) {
  const ObjectView bowl = can_view({.tall_m = 0.06, .radius_m = 0.06, .full = false}, 0.3);
  EXPECT_GT(StandingBox{}.extract(bowl).vector[2],
            StandingBox{.outlier_floor_m = 0.02}.extract(bowl).vector[2] + 0.001F);
}

TEST(StandingBox, WhatIsBehindAndBelowIsNoStand) {
  ObjectView view = can_view({}, 0.7);
  int floor = 0;
  int stand = 0;
  for (int row = 0; row < view.height_px; ++row) {
    for (int column = 0; column < view.width_px; ++column) {
      const std::size_t i = view.index(row, column);
      if (view.mask[i] != 0) continue;
      if (row < 150) view.depth_m[i] += 0.8F;
      ++(row < 150 ? floor : stand);
    }
  }
  ASSERT_GT(floor, stand) << "so that it would be taken for the support surface";
  EXPECT_NEAR(StandingBox{}.extract(view).vector[0], 0.12, 0.003);
  EXPECT_GT(StandingBox{.stand_below_m = 1.0}.extract(view).vector[0], 0.24);
}

TEST(StandingBox, SaysWhatIsMissing) {
  const ObjectView whole = filled(40, 40);
  EXPECT_EQ(StandingBox{}.extract(whole).skipped,
            "0 pixels beside the object show its support surface, fewer than 16");
  ObjectView view = whole;
  view.focal_px = std::nan("");
  EXPECT_EQ(StandingBox{}.extract(view).skipped, "the camera's intrinsics are not finite numbers");
  view = whole;
  view.up = Eigen::Vector3d::Constant(std::nan(""));
  EXPECT_EQ(StandingBox{}.extract(view).skipped, "the direction of gravity is not known");
  view = whole;
  std::ranges::fill(view.depth_m, 0.0F);
  EXPECT_EQ(StandingBox{}.extract(view).skipped,
            "0 pixels of the object have depth, fewer than 16");
}

/// Of grey and of red; 85 and 170 of 255 are where a third ends.
TEST(Colour, SaturationAndValueAreInThirds) {
  const auto value_bin = [](int grey) {
    return Eigen::Vector3f(Colour{}.extract(of_colour(grey, grey, grey)).vector.head<3>());
  };
  EXPECT_EQ(value_bin(85)[0], 1.0F);
  EXPECT_EQ(value_bin(86)[1], 1.0F);
  EXPECT_EQ(value_bin(170)[1], 1.0F);
  EXPECT_EQ(value_bin(171)[2], 1.0F);
  const auto saturation_bin = [](int saturation) {
    const FeatureResult red = Colour{}.extract(of_colour(255, 255 - saturation, 255 - saturation));
    return std::array{red.vector[2], red.vector[5], red.vector[8]};
  };
  EXPECT_EQ(saturation_bin(85)[0], 1.0F);
  EXPECT_EQ(saturation_bin(86)[1], 1.0F);
  EXPECT_EQ(saturation_bin(170)[1], 1.0F);
  EXPECT_EQ(saturation_bin(171)[2], 1.0F);
}

/// To the last bit, as on any processor; Eigen's own begins at an estimate, of which each maker has
/// another.
TEST(Colour, RootsOfSharesAreThoseOfTheStandard) {
  const Eigen::VectorXf shares = Eigen::VectorXf::LinSpaced(64, 1.0F, 64.0F);
  const Eigen::VectorXf roots = root_of_shares(shares);
  for (int i = 0; i < 64; ++i) EXPECT_EQ(roots[i], std::sqrt(shares[i] / 2080.0F)) << i;
}

TEST(SimpleFeatures, SixteenPixelsAreEnough) {
  EXPECT_EQ(Colour{}.extract(filled(4, 4)).skipped, "");
  EXPECT_EQ(SoftColour{}.extract(filled(4, 4)).skipped, "");
  EXPECT_EQ(BoundingBox{}.extract(filled(4, 4)).skipped, "");
  const std::string few = "the mask has 15 usable pixels, fewer than 16";
  EXPECT_EQ(Colour{}.extract(filled(5, 3)).skipped, few);
  EXPECT_EQ(SoftColour{}.extract(filled(5, 3)).skipped, few);
  EXPECT_EQ(BoundingBox{}.extract(filled(5, 3)).skipped,
            "15 pixels of the object have depth, fewer than 16");
}

TEST(BoundingBox, NeedsIntrinsics) {
  ObjectView view = filled(20, 20);
  view.focal_px = 0.0;
  EXPECT_EQ(BoundingBox{}.extract(view).skipped, "the camera's intrinsics are not finite numbers");
}

/// The eye looks level at a line of 20 px, 1 m away; a pixel there is a millimetre, and nothing
/// beside it has depth.
ObjectView line_at_eye_level() {
  ObjectView view = blank_view(40, 140);
  view.focal_px = 1000.0;
  view.centre_px.y() = view.top_px + 20.0;
  for (int column = 0; column < 20; ++column) {
    view.mask[view.index(20, column)] = 1;
    view.depth_m[view.index(20, column)] = 1.0F;
  }
  return view;
}

TEST(StandingBox, TheStandIsLookedForBetweenTwoHeights) {
  const auto skipped = [](int row, float depth_m) {
    ObjectView view = line_at_eye_level();
    for (int column = 24; column < 40; ++column) view.depth_m[view.index(row, column)] = depth_m;
    return StandingBox{}.extract(view).skipped;
  };
  const std::string none = "0 pixels beside the object show its support surface, fewer than 16";
  EXPECT_EQ(skipped(5, 1.0F), none) << "15 mm above its lowest points";
  EXPECT_EQ(skipped(5, 0.999F), "");
  EXPECT_EQ(skipped(120, 1.0F), none) << "10 cm below them";
  EXPECT_EQ(skipped(120, 0.999F), "");
}

TEST(StandingBox, TheStandIsWithin8MillimetresOfItsMedian) {
  const auto skipped = [](int row, float depth_m) {
    ObjectView view = line_at_eye_level();
    for (int column = 24; column < 39; ++column) view.depth_m[view.index(20, column)] = 1.0F;
    view.depth_m[view.index(row, 39)] = depth_m;
    return StandingBox{}.extract(view).skipped;
  };
  const std::string few = "15 pixels beside the object show its support surface, fewer than 16";
  for (const int row : {12, 28}) {
    EXPECT_EQ(skipped(row, 1.0F), "") << row;
    EXPECT_EQ(skipped(row, 1.001F), few) << row;
  }
}

/// Hue 20 deg, saturation 3/4, value 200/255: 0.389, 1.75 and 1.853 bins from the first middles.
TEST(SoftColour, SharesAPixelAmongEightBins) {
  const FeatureResult brown = SoftColour{}.extract(of_colour(200, 100, 50));
  ASSERT_TRUE(brown.extracted()) << brown.skipped;
  const double h = 20.0 / 360.0 * 16.0 - 0.5;
  const double s = 0.75 * 3.0 - 0.5 - 1.0;
  const double v = 200.0 / 255.0 * 3.0 - 0.5 - 1.0;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      for (int k = 0; k < 2; ++k) {
        const double expected =
            (i == 1 ? h : 1.0 - h) * (j == 1 ? s : 1.0 - s) * (k == 1 ? v : 1.0 - v);
        EXPECT_NEAR(share(brown, i, 1 + j, 1 + k), expected, 1e-3) << i << j << k;
      }
    }
  }
}

}  // namespace
}  // namespace vantage
