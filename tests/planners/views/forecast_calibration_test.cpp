#include "vantage/planners/views/forecast_calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace vantage {
namespace {

/// Cells seen within 60 cells when each stops a beam at the rate `hazard`.
double seen_cells(double hazard) {
  return 1e5 * (1.0 - std::exp(-60.0 * hazard)) / (60.0 * hazard);
}

TEST(ForecastCalibration, FindsTheHazardThatMakesForecastsRight) {
  constexpr double kCounted = 0.03;
  for (const double truth : {0.01, 0.03, 0.06}) {
    ForecastCalibration calibration({.calibrate = true, .prior_scans = 0.001});
    for (int scan = 0; scan < 40; ++scan) {
      const double hazard = kCounted * calibration.scale();
      calibration.observe(seen_cells(hazard), seen_cells(0.5 * hazard), seen_cells(truth));
    }
    const double forecast = seen_cells(kCounted * calibration.scale());
    EXPECT_NEAR(forecast / seen_cells(truth), 1.0, 0.02) << truth;
  }
}

/// ln P falls by ln 2 from half the hazard to the whole of it, so b = -1: a scan that shows twice
/// the forecast says half the hazard, and counts as much as the prior.
TEST(ForecastCalibration, OneScanIsWeighedAgainstThePrior) {
  ForecastCalibration calibration({.calibrate = true, .prior_scans = 1.0});
  EXPECT_EQ(calibration.scale(), 1.0);
  calibration.observe(1000.0, 2000.0, 2000.0);
  EXPECT_NEAR(calibration.scale(), std::sqrt(0.5), 1e-12);
  const BlockField half = calibration.transmission(uniform_field({2, 2, 2}, 0.25), 2.0);
  EXPECT_NEAR(half.per_block[0], std::pow(0.25, 2.0 * std::sqrt(0.5)), 1e-12);
}

TEST(ForecastCalibration, LeavesTheHazardAloneWhereNothingIsSaid) {
  ForecastCalibration off({.calibrate = false});
  off.observe(1000.0, 2000.0, 4000.0);
  EXPECT_EQ(off.scale(), 1.0);
  ForecastCalibration on({.calibrate = true});
  on.observe(1000.0, 1000.0, 4000.0);  // whatever the hazard, the same forecast
  on.observe(0.0, 0.0, 4000.0);
  on.observe(1000.0, 2000.0, 0.0);
  EXPECT_EQ(on.scale(), 1.0);
  EXPECT_EQ(on.transmission(uniform_field({2, 2, 2}, 0.3)).per_block[0], 0.3);
}

/// One scan, of 1000 cells forecast and so many with half the hazard, and a prior worth as much.
double scale_after(double at_half_cells, double actual_cells, double forecast_cells = 1000.0) {
  ForecastCalibration calibration({.calibrate = true, .prior_scans = 1.0});
  calibration.observe(forecast_cells, at_half_cells, actual_cells);
  return calibration.scale();
}

TEST(ForecastCalibration, ScansAreWeighedByTheirCellsAndTheSquareOfTheirSlope) {
  ForecastCalibration calibration({.calibrate = true, .prior_scans = 3.0});
  calibration.observe(1000.0, 2000.0, 2000.0);  // slope -1
  EXPECT_NEAR(std::log(calibration.scale()), -std::log(2.0) / 4.0, 1e-12);
  calibration.observe(1000.0, 1000.0 * std::sqrt(2.0), 500.0);  // slope -0.5
  const double second = -std::log(2.0) / 4.0 + std::log(2.0) / 0.5;
  const double mean = (2000.0 * -std::log(2.0) + 125.0 * second) / 2125.0;
  EXPECT_NEAR(std::log(calibration.scale()), mean / (1.0 + 3.0 / 2.0), 1e-12)
      << "the prior is worth three scans of two";
}

TEST(ForecastCalibration, OneScanClaimsNoMoreThanTwoInTheLogarithm) {
  EXPECT_NEAR(scale_after(2000.0, 1000.0 * std::exp(5.0)), std::exp(-1.0), 1e-12);
  EXPECT_NEAR(scale_after(2000.0, 1000.0 * std::exp(-5.0)), std::exp(1.0), 1e-12);
  EXPECT_NEAR(scale_after(2000.0, 1000.0 * std::exp(1.9)), std::exp(-0.95), 1e-12);
}

TEST(ForecastCalibration, NeedsACellAndASlope) {
  EXPECT_NEAR(scale_after(2.0, 2.0, 1.0), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(scale_after(4.0, 1.0, 2.0), std::sqrt(2.0), 1e-12);
  EXPECT_EQ(scale_after(1.98, 2.0, 0.99), 1.0);
  EXPECT_EQ(scale_after(4.0, 0.99, 2.0), 1.0);
  EXPECT_NEAR(scale_after(1000.0 * std::exp2(0.0015), 2000.0), std::exp(-1.0), 1e-9);
  EXPECT_EQ(scale_after(1000.0 * std::exp2(0.0007), 2000.0), 1.0);
}

TEST(ForecastCalibration, TakesOpticalDepthsTimesAnyFactor) {
  const ForecastCalibration calibration({.calibrate = false, .prior_scans = 1.0});
  for (const double factor : {0.25, 0.5, 1.0, 2.0, 3.0}) {
    const BlockField field = calibration.transmission(uniform_field({2, 2, 2}, 0.25), factor);
    EXPECT_NEAR(field.per_block[0], std::pow(0.25, factor), 1e-15) << factor;
  }
}

}  // namespace
}  // namespace vantage
