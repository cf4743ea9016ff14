#include "vantage/perception/clouds/usable_readings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace vantage {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

void expect_same(const std::vector<float>& got, const std::vector<float>& wanted) {
  ASSERT_EQ(got.size(), wanted.size());
  for (std::size_t i = 0; i < got.size(); ++i) {
    EXPECT_TRUE(got[i] == wanted[i] || (std::isnan(got[i]) && std::isnan(wanted[i])))
        << i << ": " << got[i];
  }
}

RangeScan scan_of(std::vector<float> range_m, std::size_t beams) {
  RangeScan scan;
  scan.field_of_view.range_max_m = 10.0;
  scan.azimuth_rad.assign(beams, 0.0);
  scan.tilt_rad.assign(range_m.size() / beams, 0.0);
  scan.range_m = std::move(range_m);
  return scan;
}

TEST(UsableReadings, OfAnImage) {
  CameraImages images;
  images.range_max_m = 3.5;
  images.depth_m = {1.0F, kNaN, 0.0F, kInfinity, 3.5F, 4.0F, -1.0F, 3.49F};
  EXPECT_EQ(discard_unusable(images), 4U);
  expect_same(images.depth_m, {1.0F, 0.0F, 0.0F, kInfinity, 0.0F, 0.0F, 0.0F, 3.49F});
}

TEST(UsableReadings, OfScans) {
  RangeScan scan = scan_of({1.0F, kNaN, 0.0F, kInfinity, 10.0F, -kInfinity, -0.5F, 9.99F}, 4);
  EXPECT_EQ(discard_unusable(scan), 5U);
  const std::vector<float> wanted{1.0F, kNaN, kNaN, kInfinity, kNaN, kNaN, kNaN, 9.99F};
  expect_same(scan.range_m, wanted);
  PlanarScan planar;
  planar.range_max_m = 10.0;
  planar.range_m = {10.0F, 2.0F};
  EXPECT_EQ(discard_unusable(planar), 1U);
  expect_same(planar.range_m, {kNaN, 2.0F});
}

TEST(RepeatedImages, AreThoseWithTheSameDepthToTheBit) {
  CameraImages one;
  one.depth_m = {1.0F, 0.0F};
  CameraImages other = one;
  EXPECT_TRUE(is_repeated(one, other));
  other.depth_m[0] = std::nextafter(1.0F, 2.0F);
  EXPECT_FALSE(is_repeated(one, other));
  EXPECT_FALSE(is_repeated({}, one));
  one.depth_m = other.depth_m = {0.0F, kInfinity};
  EXPECT_FALSE(is_repeated(one, other)) << "nothing was measured: it may well be so again";
}

TEST(RepeatedLines, AreDiscardedButTheFirst) {
  RangeScan scan = scan_of({1.0F, kNaN, 1.0F, kNaN, 1.0F, kNaN, 1.1F, kNaN,  //
                            kInfinity, kNaN, kInfinity, kNaN},
                           2);
  std::vector<float> last;
  EXPECT_EQ(discard_repeated_lines(scan, last), 2U);
  expect_same(last, {kInfinity, kNaN});
  expect_same(scan.range_m, {1.0F, kNaN, kNaN, kNaN, kNaN, kNaN, 1.1F, kNaN,  //
                             kInfinity, kNaN, kInfinity, kNaN});
  EXPECT_DOUBLE_EQ(share_of_valid_lines(scan), 4.0 / 6.0);
  EXPECT_EQ(share_of_valid_lines({}), 0.0);
}

TEST(RepeatedLines, AreComparedWithTheLastLineOfTheScanBefore) {
  const auto discarded = [](RangeScan& scan) {
    std::vector<float> last{2.0F, kNaN};
    return discard_repeated_lines(scan, last);
  };
  RangeScan scan = scan_of({2.0F, kNaN, 2.5F, 1.0F}, 2);
  EXPECT_EQ(discarded(scan), 1U);
  expect_same(scan.range_m, {kNaN, kNaN, 2.5F, 1.0F});
  RangeScan other = scan_of({kNaN, 2.0F, 2.5F, 1.0F}, 2);
  EXPECT_EQ(discarded(other), 0U);
  RangeScan shorter = scan_of({2.0F, 3.0F}, 1);
  EXPECT_EQ(discarded(shorter), 0U);
}

/// A sensor that hangs shows again what it showed before a line was lost.
TEST(RepeatedLines, AreRecognisedBehindLostOnes) {
  std::vector<float> last;
  RangeScan scan = scan_of({2.0F, 3.0F, kNaN, kNaN, 2.0F, 3.0F, kNaN, kNaN}, 2);
  EXPECT_EQ(discard_repeated_lines(scan, last), 1U);
  expect_same(scan.range_m, {2.0F, 3.0F, kNaN, kNaN, kNaN, kNaN, kNaN, kNaN});
  RangeScan next = scan_of({2.0F, 3.0F}, 2);
  EXPECT_EQ(discard_repeated_lines(next, last), 1U);
}

/// What is not above 0 is no measurement, however often it is repeated.
TEST(RepeatedLines, MustHaveMeasuredSomething) {
  RangeScan scan = scan_of({0.0F, kInfinity, 0.0F, kInfinity, -1.0F, 0.0F, -1.0F, 0.0F}, 2);
  std::vector<float> last;
  EXPECT_EQ(discard_repeated_lines(scan, last), 0U);
}

TEST(ValidLines, HaveAtLeastOneBeamThatIsANumber) {
  EXPECT_DOUBLE_EQ(share_of_valid_lines(scan_of({kNaN, kNaN, kNaN, 1.0F, kInfinity, kNaN}, 2)),
                   2.0 / 3.0);
  EXPECT_EQ(share_of_valid_lines(scan_of({kNaN, kNaN}, 2)), 0.0);
}

TEST(UsableReadings, OfAnImageDoNotReachItsEnd) {
  CameraImages images;
  images.range_max_m = 2.0;
  images.depth_m = {-kInfinity, 2.0F, std::nextafter(2.0F, 0.0F), 0.001F};
  EXPECT_EQ(discard_unusable(images), 2U);
  expect_same(images.depth_m, {0.0F, 0.0F, std::nextafter(2.0F, 0.0F), 0.001F});
}

}  // namespace
}  // namespace vantage
