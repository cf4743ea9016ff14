#include "vantage/planners/views/forecast_interval.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

constexpr double kFirstView = 1e5;

/// Share of scans within their interval, where ln (actual / forecast) is normal.
double coverage(ForecastIntervalOptions options, double mean, double sigma, int scans) {
  Rng rng(7);
  ForecastInterval interval(options);
  interval.start(kFirstView);
  int within = 0;
  for (int scan = 0; scan < scans; ++scan) {
    const double forecast = kFirstView * std::exp(rng.uniform(-4.0, -0.5));
    const double actual = forecast * std::exp(mean + sigma * rng.normal());
    within += interval.of(forecast).contains(actual) ? 1 : 0;
    interval.observe(forecast, actual);
  }
  return static_cast<double>(within) / scans;
}

/// [Gibbs2021, proposition 4.1]: whatever the errors are, the share outside is off by at most
/// (max(a, 1 - a) + rate) / (rate T).
TEST(ForecastInterval, CoversAsOftenAsItSaysWhateverTheErrorsAre) {
  constexpr int kScans = 3000;
  for (const double confidence : {0.5, 0.8, 0.9}) {
    for (const double sigma : {0.02, 0.3, 2.0}) {
      for (const double mean : {-1.0, 0.0, 0.7}) {
        const ForecastIntervalOptions options{.confidence = confidence, .rate = 0.05};
        const double bound =
            (std::max(confidence, 1.0 - confidence) + options.rate) / (options.rate * kScans);
        EXPECT_NEAR(coverage(options, mean, sigma, kScans), confidence, bound + 0.01)
            << confidence << ' ' << sigma << ' ' << mean;
      }
    }
  }
}

TEST(ForecastInterval, WidensAfterAMissAndNarrowsAfterHits) {
  ForecastInterval interval({.confidence = 0.9, .rate = 0.2});
  interval.start(kFirstView);
  const auto width = [&] { return interval.of(1e4).high - interval.of(1e4).low; };
  const double before = width();
  interval.observe(1e4, 9e4);
  const double after_a_miss = width();
  EXPECT_GT(after_a_miss, before);
  for (int scan = 0; scan < 30; ++scan) interval.observe(1e4, 1e4);
  EXPECT_LT(width(), after_a_miss);
}

TEST(ForecastInterval, IsOfCellsThatThereCanBe) {
  ForecastInterval interval({.confidence = 0.99, .rate = 0.5});
  interval.start(kFirstView);
  for (const double forecast : {0.0, 1.0, 50.0, 2e5}) {
    const CellInterval of = interval.of(forecast);
    EXPECT_GE(of.low, 0.0);
    EXPECT_GT(of.high, of.low);
  }
}

/// Another sensor or another map shows other numbers of cells: the shares are what counts.
TEST(ForecastInterval, ScalesWithTheFirstView) {
  ForecastInterval coarse({});
  ForecastInterval fine({});
  coarse.start(kFirstView);
  fine.start(8.0 * kFirstView);
  for (const double forecast : {100.0, 3000.0, 5e4}) {
    EXPECT_NEAR(8.0 * coarse.of(forecast).low, fine.of(8.0 * forecast).low, 1e-6 * forecast);
    EXPECT_NEAR(8.0 * coarse.of(forecast).high, fine.of(8.0 * forecast).high, 1e-6 * forecast);
    coarse.observe(forecast, 1.4 * forecast);
    fine.observe(8.0 * forecast, 8.0 * 1.4 * forecast);
  }
}

TEST(ForecastInterval, RefusesOptionsOutOfRange) {
  EXPECT_THROW(ForecastInterval({.confidence = 1.0}), ConfigError);
  EXPECT_THROW(ForecastInterval({.rate = -0.1}), ConfigError);
}

}  // namespace
}  // namespace vantage
