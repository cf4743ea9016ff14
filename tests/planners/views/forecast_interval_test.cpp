#include "vantage/planners/views/forecast_interval.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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

TEST(ForecastInterval, BeginsWithAFirstViewThatShowsSomething) {
  ForecastInterval interval({});
  EXPECT_DEATH((void)interval.of(100.0), "a first view before the first interval");
  EXPECT_DEATH(interval.start(0.0), "a first view that shows something");
}

TEST(ForecastInterval, RefusesOptionsOutOfRange) {
  EXPECT_THROW(ForecastInterval({.confidence = 1.0}), ConfigError);
  EXPECT_THROW(ForecastInterval({.rate = -0.1}), ConfigError);
}

/// Both ends of an interval in ln (cells / forecast), in which a thousandth of the first view is as
/// good as none.
struct LogEnds {
  double low;
  double high;
};
LogEnds log_ends(const ForecastInterval& interval, double forecast_cells) {
  constexpr double kNone = 1e-3 * kFirstView;
  const CellInterval of = interval.of(forecast_cells);
  return {std::log((of.low + kNone) / (forecast_cells + kNone)),
          std::log((of.high + kNone) / (forecast_cells + kNone))};
}

ForecastInterval started(const ForecastIntervalOptions& options) {
  ForecastInterval interval(options);
  interval.start(kFirstView);
  return interval;
}

/// 18.9 of 21 parts of the errors in training are within 2.21 spreads.
constexpr double kNineInTen = 2.21;

TEST(ForecastInterval, IsAsWideAsForecastsOfThatSizeWereOffInTraining) {
  struct Trained {
    double share, mean, spread;
  };
  const ForecastInterval interval = started({});
  for (const auto& [share, mean, spread] :
       {Trained{0.0015, 0.439, 0.278}, Trained{0.006, 0.325, 0.230}, Trained{0.0167, 0.243, 0.252},
        Trained{0.0517, 0.106, 0.190}, Trained{0.1754, -0.035, 0.148}, Trained{0.96, -0.014, 0.162},
        Trained{3.0, -0.014, 0.162}, Trained{std::sqrt(0.006 * 0.0167), 0.284, 0.241}}) {
    const auto [low, high] = log_ends(interval, share * kFirstView);
    EXPECT_NEAR(0.5 * (low + high), mean, 1e-9) << share;
    EXPECT_NEAR(0.5 * (high - low), kNineInTen * spread, 1e-9) << share;
  }
  EXPECT_NEAR(log_ends(interval, 0.0).high, 0.439 + kNineInTen * 0.278, 1e-9);
  EXPECT_EQ(interval.of(0.0).low, 0.0);
}

/// 18.9 of 21 parts: 2.06 spreads at a table.
TEST(ForecastInterval, IsOfWhatItWasTrainedWith) {
  ForecastInterval at_a_table({}, kForecastsAtTables);
  at_a_table.start(kFirstView);
  const auto [low, high] = log_ends(at_a_table, 0.0536 * kFirstView);
  EXPECT_NEAR(0.5 * (low + high), 0.072, 1e-9);
  EXPECT_NEAR(0.5 * (high - low), 2.06 * 0.140, 1e-9);
  const auto [least, most] = log_ends(at_a_table, std::sqrt(0.1698 * 0.6956) * kFirstView);
  EXPECT_NEAR(0.5 * (least + most), 0.5 * (0.051 + 0.048), 1e-9);
  EXPECT_NEAR(0.5 * (most - least), 2.06 * 0.5 * (0.165 + 0.334), 1e-9);
}

TEST(ForecastInterval, LawsAscend) {
  for (const ForecastLaw& law : {kForecastsInRooms, kForecastsAtTables}) {
    EXPECT_TRUE(std::ranges::is_sorted(law.at, {}, &ForecastLaw::At::share));
    EXPECT_TRUE(std::ranges::is_sorted(law.errors));
  }
}

double width_in_spreads(const ForecastInterval& interval) {
  const auto [low, high] = log_ends(interval, 0.96 * kFirstView);
  return 0.5 * (high - low) / 0.162;
}

TEST(ForecastInterval, HoldsTheShareOfErrorsThatItSays) {
  int rank = 0;
  for (const double within : {0.03, 0.09, 0.14, 0.21, 0.27, 0.31, 0.38, 0.45, 0.52, 0.61,
                              0.69, 0.77, 0.84, 0.93, 1.06, 1.21, 1.39, 1.68, 2.21, 3.47}) {
    const double confidence = (++rank - 0.5) / 21.0;
    EXPECT_NEAR(width_in_spreads(started({.confidence = confidence})), within, 1e-9) << rank;
  }
  EXPECT_NEAR(width_in_spreads(started({.confidence = 0.98})), 1.5 * 3.47, 1e-9)
      << "beyond all errors so far";
}

/// At a rate of a fifth: from 0.5 to 0.4 of 22 parts after a hit, to 0.6 after a miss.
TEST(ForecastInterval, MovesItsLevelAndLearnsTheError) {
  const double forecast = 0.96 * kFirstView;
  const auto actual = [&](double spreads) {
    constexpr double kNone = 1e-3 * kFirstView;
    return (forecast + kNone) * std::exp(-0.014 + 0.162 * spreads) - kNone;
  };
  ForecastInterval hit = started({.confidence = 0.5, .rate = 0.2});
  EXPECT_NEAR(width_in_spreads(hit), 0.69, 1e-9);
  hit.observe(forecast, actual(0.0));
  EXPECT_NEAR(width_in_spreads(hit), 0.45, 1e-9) << "the ninth of 21 with the new one, 0";
  ForecastInterval missed = started({.confidence = 0.5, .rate = 0.2});
  missed.observe(forecast, actual(-0.75));
  EXPECT_NEAR(width_in_spreads(missed), 0.84, 1e-9) << "the 14th with the new one, 0.75";
}

/// Of so small a forecast the errors are 0.439 +- 0.278, and 100 cells are as good as none.
TEST(ForecastInterval, LearnsTheErrorOfAForecastOfNextToNothing) {
  ForecastInterval interval = started({.confidence = 0.5, .rate = 0.0});
  interval.observe(50.0, (50.0 + 100.0) * std::exp(0.439 + 0.65 * 0.278) - 100.0);
  EXPECT_NEAR(width_in_spreads(interval), 0.65, 1e-9) << "the eleventh of 21 with the new one";
}

/// Forecasts at a table are off by much where they are small, so the least is nothing: the most
/// tells.
TEST(ForecastInterval, AtATableItReachesAsFarAsForecastsOfThatSizeWereOffInTraining) {
  struct Trained {
    double share, mean, spread;
  };
  ForecastInterval at_a_table({}, kForecastsAtTables);
  at_a_table.start(kFirstView);
  for (const auto& [share, mean, spread] :
       {Trained{0.0016, -0.520, 0.486}, Trained{0.006, -0.147, 0.695},
        Trained{0.0175, 0.048, 0.926}, Trained{0.0536, 0.072, 0.140}, Trained{0.1698, 0.051, 0.165},
        Trained{0.6956, 0.048, 0.334}, Trained{3.0, 0.048, 0.334}}) {
    EXPECT_NEAR(log_ends(at_a_table, share * kFirstView).high, mean + 2.06 * spread, 1e-9) << share;
  }
  EXPECT_NEAR(log_ends(at_a_table, 0.0).high, -0.520 + 2.06 * 0.486, 1e-9);
}

TEST(ForecastInterval, AtATableHoldsTheShareOfErrorsThatItSays) {
  int rank = 0;
  for (const double within : {0.01, 0.05, 0.10, 0.14, 0.18, 0.23, 0.28, 0.33, 0.39, 0.46,
                              0.53, 0.63, 0.74, 0.87, 1.03, 1.23, 1.43, 1.68, 2.06, 2.74}) {
    const ForecastIntervalOptions options{.confidence = (++rank - 0.5) / 21.0};
    ForecastInterval at_a_table(options, kForecastsAtTables);
    at_a_table.start(kFirstView);
    EXPECT_NEAR(log_ends(at_a_table, kFirstView).high, 0.048 + within * 0.334, 1e-9) << rank;
  }
}

/// A hit at a rate of one makes the share that is aimed at more than all.
TEST(ForecastInterval, IsNoNarrowerThanTheLeastError) {
  ForecastInterval interval = started({.confidence = 0.01, .rate = 1.0});
  EXPECT_NEAR(width_in_spreads(interval), 0.03, 1e-9);
  const double forecast = 0.96 * kFirstView;
  constexpr double kNone = 1e-3 * kFirstView;
  interval.observe(forecast, (forecast + kNone) * std::exp(-0.014 + 0.162 * 0.01) - kNone);
  EXPECT_NEAR(width_in_spreads(interval), 0.01, 1e-6);
}

}  // namespace
}  // namespace vantage
