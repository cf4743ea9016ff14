#include "vantage/geometry/range_scan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace vantage {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

//               azimuth -0.1   0    0.1
//   tilt 0.0             1     2     3
//   tilt 0.2             4     5    inf
//   tilt 0.4             6    nan    7
RangeScan small_scan() {
  RangeScan scan;
  scan.tilt_rad = {0.0, 0.2, 0.4};
  scan.azimuth_rad = {-0.1, 0.0, 0.1};
  scan.range_m = {1, 2, 3, 4, 5, kInf, 6, kNan, 7};
  return scan;
}

TEST(RangeScan, LinesOfBeams) {
  const RangeScan scan = small_scan();
  EXPECT_EQ(scan.lines(), 3U);
  EXPECT_EQ(scan.beams(), 3U);
  EXPECT_EQ(scan.range(1, 0), 4.0F);
}

TEST(SweptRange, OnABeamIsThatBeam) {
  const RangeScan scan = small_scan();
  EXPECT_EQ(scan.swept_range({-0.1, 0.0}), 1.0F);
  EXPECT_EQ(scan.swept_range({0.0, 0.2}), 5.0F);
  EXPECT_EQ(scan.swept_range({0.1, 0.2}), kInf);
  EXPECT_EQ(scan.swept_range({0.1, 0.4}), 7.0F);
}

TEST(SweptRange, BetweenBeamsIsTheShortestAround) {
  const RangeScan scan = small_scan();
  EXPECT_EQ(scan.swept_range({-0.05, 0.1}), 1.0F);
  EXPECT_EQ(scan.swept_range({0.05, 0.1}), 2.0F);
  EXPECT_EQ(scan.swept_range({0.05, 0.2}), 5.0F);  // between two beams of one line
  EXPECT_EQ(scan.swept_range({-0.1, 0.3}), 4.0F);  // between two lines of one beam
}

TEST(SweptRange, OutsideOrBesideAnInvalidBeamIsUnknown) {
  const RangeScan scan = small_scan();
  EXPECT_TRUE(std::isnan(scan.swept_range({-0.11, 0.1})));
  EXPECT_TRUE(std::isnan(scan.swept_range({0.11, 0.1})));
  EXPECT_TRUE(std::isnan(scan.swept_range({0.0, -0.01})));
  EXPECT_TRUE(std::isnan(scan.swept_range({0.0, 0.41})));
  EXPECT_TRUE(std::isnan(scan.swept_range({0.05, 0.3})));
  EXPECT_TRUE(std::isnan(scan.swept_range({0.0, 0.4})));
  EXPECT_TRUE(std::isnan(RangeScan{}.swept_range({0.0, 0.0})));
}

TEST(SweptRange, AScanAllRoundAnswersForWhatIsBehind) {
  RangeScan scan;
  scan.tilt_rad = {-0.1, 0.0, 0.1};
  for (int i = -18; i <= 18; ++i) scan.azimuth_rad.push_back(i * std::numbers::pi / 18.0);
  scan.range_m.assign(scan.lines() * scan.beams(), 3.0F);
  for (double azimuth = -3.1; azimuth <= 3.1; azimuth += 0.1) {
    EXPECT_EQ(scan.swept_range(beam_angles(beam_direction({azimuth, 0.05}))), 3.0F) << azimuth;
  }
}

/// Beams to one side only, past its y axis.
TEST(SweptRange, OneSideIsEnoughToLookBehind) {
  for (const double side : {1.0, -1.0}) {
    RangeScan scan;
    scan.tilt_rad = {-0.1, 0.1};
    scan.azimuth_rad = {side * 1.5 - 1.0, side * 1.5, side * 1.5 + 1.0};
    scan.range_m = {3, 3, 3, 3, 3, 3};
    EXPECT_EQ(scan.swept_range(beam_angles(beam_direction({side * 2.2, 0.05}))), 3.0F);
    EXPECT_TRUE(std::isnan(scan.swept_range(beam_angles(beam_direction({side * 2.6, 0.05})))));
    EXPECT_TRUE(std::isnan(scan.swept_range(beam_angles(beam_direction({side * 2.2, 0.2})))));
  }
}

/// Four by three pixels, 90 degrees wide: pixel (row, column) looks along ((c - 1.5) / 2,
/// (r - 1) / 2, 1).
CameraImages small_image() {
  CameraImages image;
  image.width_px = 4;
  image.height_px = 3;
  image.focal_px = 2.0;
  image.range_max_m = 5.0;
  image.depth_m = {1, 2, 3, 4, 2, 2, 3, 4, 3, 3, 3, 4};
  return image;
}

TEST(CameraImages, RayOfAPixel) {
  EXPECT_TRUE(small_image().ray(1, 3).isApprox(Eigen::Vector3d(0.75, 0.0, 1.0)));
  EXPECT_EQ(small_image().depth_at(2, 3), 4.0F);
}

TEST(CameraImages, PixelsAreInRows) {
  CameraImages image = small_image();
  for (int i = 0; i < 12; ++i) image.depth_m[static_cast<std::size_t>(i)] = static_cast<float>(i);
  EXPECT_EQ(image.depth_at(0, 3), 3.0F);
  EXPECT_EQ(image.depth_at(1, 2), 6.0F);
  EXPECT_EQ(image.depth_at(2, 1), 9.0F);
  EXPECT_TRUE(image.ray(0, 1).isApprox(Eigen::Vector3d(-0.25, -0.5, 1.0)));
  EXPECT_TRUE(image.ray(2, 2).isApprox(Eigen::Vector3d(0.25, 0.5, 1.0)));
}

/// A quarter of a pixel beside the middle of one, at two metres.
TEST(CameraImages, SweptDepthCountsEachPixelRound) {
  const Eigen::Vector3d p(2.0 * (-0.25 + 0.125), 2.0 * 0.125, 2.0);  // columns 1, 2; rows 1, 2
  for (const std::size_t near : {5U, 6U, 9U, 10U}) {
    CameraImages image = small_image();
    std::ranges::fill(image.depth_m, 4.0F);
    image.depth_m[near] = 1.5F;
    EXPECT_EQ(image.swept_depth_m(p), 1.5) << near;
  }
  for (const std::size_t other : {0U, 1U, 2U, 4U, 7U, 8U, 11U}) {
    CameraImages image = small_image();
    std::ranges::fill(image.depth_m, 4.0F);
    image.depth_m[other] = 1.5F;
    EXPECT_EQ(image.swept_depth_m(p), 4.0) << other;
  }
}

TEST(CameraImages, TheOutermostPixelsAreOfTheImage) {
  const CameraImages image = small_image();
  EXPECT_EQ(image.swept_depth_m(image.ray(0, 0)), 1.0);
  EXPECT_EQ(image.swept_depth_m(image.ray(0, 3)), 4.0);
  EXPECT_EQ(image.swept_depth_m(image.ray(2, 0)), 3.0);
}

TEST(CameraImages, SweptDepthIsTheLeastOfThePixelsRound) {
  const CameraImages image = small_image();
  EXPECT_EQ(image.swept_depth_m({-0.5, -0.25, 1.0}), 1.0);
  EXPECT_EQ(image.swept_depth_m({-1.0, -0.5, 2.0}), 1.0);
  EXPECT_EQ(image.swept_depth_m({0.5, 0.25, 1.0}), 3.0);
  EXPECT_EQ(image.swept_depth_m(image.ray(2, 3)), 4.0);
}

TEST(CameraImages, NothingWasSweptOutsideTheImageOrBehindTheCamera) {
  const CameraImages image = small_image();
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(0.8, 0.0, 1.0),
                                   {-0.8, 0.0, 1.0},
                                   {0.0, 0.6, 1.0},
                                   {0.0, -0.6, 1.0},
                                   {0.0, 0.0, -1.0},
                                   {0.0, 0.0, 0.0},
                                   {1.0, 0.0, 0.0}}) {
    EXPECT_EQ(image.swept_depth_m(p), 0.0) << p.transpose();
  }
}

TEST(CameraImages, BeyondRangeIsSweptToTheRangeAndNoReadingIsNot) {
  CameraImages image = small_image();
  std::ranges::fill(image.depth_m, std::numeric_limits<float>::infinity());
  EXPECT_EQ(image.swept_depth_m({0.0, 0.0, 1.0}), 5.0);
  image.depth_m[5] = 0.0F;
  EXPECT_EQ(image.swept_depth_m({0.0, 0.0, 1.0}), 0.0);
}

}  // namespace
}  // namespace vantage
