#include "src/geometry/range_scan.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace vantage
