#include "vantage/study/recognition/reliability.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace vantage {
namespace {

/// So many trials of that probability, of which `right` are right; of ten objects.
void put(std::vector<Trial>& trials, int count, double probability, int right) {
  for (int i = 0; i < count; ++i) {
    trials.push_back({.name = fmt::format("object_{}", i % 10),
                      .correct = i < right,
                      .probability = probability});
  }
}

TEST(Reliability, ErrorIsTheMeanOverTheBins) {
  std::vector<Trial> trials;
  put(trials, 100, 0.95, 80);
  put(trials, 50, 0.5, 30);
  put(trials, 50, 0.51, 20);  // in the same bin: what one is too sure of, the other is not
  const Reliability reliability = reliability_of(trials, 1);
  EXPECT_NEAR(reliability.error, 0.5 * 0.15 + 0.5 * 0.005, 1e-12);
  EXPECT_NEAR(reliability.confidence, 0.5 * 0.95 + 0.25 * 0.5 + 0.25 * 0.51, 1e-12);
  EXPECT_EQ(reliability.bins[7].count, 100U);
  EXPECT_NEAR(reliability.bins[7].accuracy, 0.5, 1e-12);
  EXPECT_EQ(reliability.bins[14].count, 100U);
  EXPECT_LE(reliability.error_interval.low, reliability.error);
  EXPECT_GE(reliability.error_interval.high, reliability.error);
}

TEST(Reliability, OfHonestProbabilitiesIsSmall) {
  Rng rng(2);
  std::vector<Trial> honest;
  std::vector<Trial> too_sure;
  for (int i = 0; i < 20000; ++i) {
    const double p = rng.uniform();
    const bool right = rng.uniform() < p;
    const std::string name = fmt::format("object_{}", i % 100);
    honest.push_back({.name = name, .correct = right, .probability = p});
    too_sure.push_back({.name = name, .correct = right, .probability = std::sqrt(p)});
  }
  EXPECT_LT(reliability_of(honest, 1).error, 0.02);
  // The mean of sqrt(p) - p.
  EXPECT_NEAR(reliability_of(too_sure, 1).error, 2.0 / 3.0 - 0.5, 0.02);
}

TEST(Reliability, OfCertaintyIsInTheLastBin) {
  const std::vector<Trial> sure(4, Trial{.correct = true, .probability = 1.0});
  EXPECT_EQ(reliability_of(sure, 1).bins[kReliabilityBins - 1].count, 4U);
}

TEST(ReliabilityFigure, HasADiagonalAndALineAMethod) {
  std::vector<Trial> trials;
  put(trials, 100, 0.95, 80);
  put(trials, 50, 0.2, 10);
  const Figure figure =
      reliability_figure({{"a single view", {{"ours", reliability_of(trials, 1)}}}});
  ASSERT_EQ(figure.panels.size(), 1U);
  ASSERT_EQ(figure.panels[0].series.size(), 2U);
  const FigureSeries& ours = figure.panels[0].series[1];
  ASSERT_EQ(ours.points.size(), 2U);
  EXPECT_NEAR(ours.points[1].x, 0.95, 1e-12);
  EXPECT_NEAR(ours.points[1].mean, 0.8, 1e-12);
  EXPECT_NE(figure_svg(figure).find("<svg"), std::string::npos);
}

/// Fifteen of them.
TEST(Reliability, BinsAreOfEqualWidth) {
  const auto bin_of = [](double probability) {
    const std::vector<Trial> one(1, Trial{.name = "a", .probability = probability});
    const Reliability reliability = reliability_of(one, 1);
    int found = -1;
    for (int b = 0; b < kReliabilityBins; ++b) {
      if (reliability.bins[static_cast<std::size_t>(b)].count > 0) found = b;
    }
    return found;
  };
  EXPECT_EQ(bin_of(0.0), 0);
  EXPECT_EQ(bin_of(0.066), 0);
  EXPECT_EQ(bin_of(0.067), 1);
  EXPECT_EQ(bin_of(0.466), 6);
  EXPECT_EQ(bin_of(0.467), 7);
  EXPECT_EQ(bin_of(0.934), 14);
  EXPECT_EQ(bin_of(0.932), 13);
}

/// Whole objects are drawn again: of two, one always right and one never, anything may come.
TEST(Reliability, IntervalsAreOfObjects) {
  std::vector<Trial> trials;
  for (int i = 0; i < 6; ++i) {
    trials.push_back({.name = i % 3 == 0 ? "a" : "b", .correct = i % 3 == 0, .probability = 0.5});
  }
  const Reliability reliability = reliability_of(trials, 1);
  const ReliabilityBin& bin = reliability.bins[7];
  EXPECT_EQ(bin.count, 6U);
  EXPECT_EQ(bin.objects, 2U);
  EXPECT_DOUBLE_EQ(bin.confidence, 0.5);
  EXPECT_DOUBLE_EQ(bin.accuracy, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(bin.interval.low, 0.0);
  EXPECT_DOUBLE_EQ(bin.interval.high, 1.0);
  EXPECT_NEAR(reliability.error, 1.0 / 6.0, 1e-12);
  EXPECT_NEAR(reliability.error_interval.high, 0.5, 1e-12);
  EXPECT_EQ(reliability.bins[6].count, 0U);
  EXPECT_EQ(reliability.bins[6].objects, 0U);
  EXPECT_EQ(reliability.bins[6].confidence, 0.0);
  EXPECT_EQ(reliability.bins[6].accuracy, 0.0);
}

TEST(ReliabilityFigure, DrawsBinsAsTheyAre) {
  std::vector<Trial> trials;
  put(trials, 20, 0.95, 15);
  const Reliability reliability = reliability_of(trials, 1);
  const Figure figure =
      reliability_figure({{"one", {{"ours", reliability}, {"theirs", reliability}}}, {"two", {}}});
  EXPECT_EQ(figure.least_x_step, 0.1);
  ASSERT_EQ(figure.panels.size(), 2U);
  EXPECT_EQ(figure.panels[0].title, "one");
  ASSERT_EQ(figure.panels[0].series.size(), 3U);
  ASSERT_EQ(figure.panels[1].series.size(), 1U);
  const FigureSeries& honest = figure.panels[0].series[0];
  ASSERT_EQ(honest.points.size(), 2U);
  EXPECT_EQ(honest.points[0].x, 0.0);
  EXPECT_EQ(honest.points[0].mean, 0.0);
  EXPECT_EQ(honest.points[1].x, 1.0);
  EXPECT_EQ(honest.points[1].mean, 1.0);
  EXPECT_EQ(honest.points[1].interval.low, 1.0);
  for (const FigurePoint& end : honest.points) {
    EXPECT_EQ(end.count, 1U);
    EXPECT_EQ(end.clusters, 1U);
  }
  EXPECT_EQ(honest.style, 0U);
  EXPECT_EQ(figure.panels[0].series[1].style, 1U);
  EXPECT_EQ(figure.panels[0].series[2].style, 2U);
  EXPECT_EQ(figure.panels[0].series[2].name, "theirs");
  const FigurePoint& point = figure.panels[0].series[1].points.at(0);
  EXPECT_EQ(point.count, 20U);
  EXPECT_EQ(point.clusters, 10U);
  EXPECT_NEAR(point.mean, 0.75, 1e-12);
  EXPECT_EQ(point.interval.low, reliability.bins[14].interval.low);
  EXPECT_EQ(point.interval.high, reliability.bins[14].interval.high);
}

/// Of five objects one is right, so that a draw of five has it so often: not at all by 0.33, once
/// by 0.41, up to three times by 0.993; four times or more is beyond the 97.5 %.
TEST(Reliability, AsManyObjectsAreDrawnAsThereAre) {
  std::vector<Trial> trials;
  for (int i = 0; i < 5; ++i) {
    trials.push_back({.name = fmt::format("object_{}", i), .correct = i == 0, .probability = 0.21});
  }
  const Reliability reliability = reliability_of(trials, 1);
  EXPECT_EQ(reliability.bins[3].interval.low, 0.0);
  EXPECT_NEAR(reliability.bins[3].interval.high, 3.0 / 5.0, 1e-12);
  EXPECT_NEAR(reliability.error, 0.21 - 1.0 / 5.0, 1e-12);
  EXPECT_NEAR(reliability.error_interval.low, 0.21 - 1.0 / 5.0, 1e-12);
  EXPECT_NEAR(reliability.error_interval.high, 3.0 / 5.0 - 0.21, 1e-12);
}

TEST(Reliability, OfASingleTrialTheIntervalIsItsAnswer) {
  for (const bool right : {true, false}) {
    const std::vector<Trial> one(1, Trial{.name = "a", .correct = right, .probability = 0.75});
    const ReliabilityBin bin = reliability_of(one, 1).bins[11];
    EXPECT_EQ(bin.count, 1U);
    EXPECT_EQ(bin.interval.low, right ? 1.0 : 0.0);
    EXPECT_EQ(bin.interval.high, right ? 1.0 : 0.0);
  }
}

/// Of ten objects in a bin each, every bin is without any in a third of the draws.
TEST(Reliability, DrawsWithoutATrialInABinSayNothingOfIt) {
  std::vector<Trial> trials;
  for (int i = 0; i < 10; ++i) {
    trials.push_back(
        {.name = fmt::format("object_{}", i), .correct = true, .probability = (i + 0.5) / 15.0});
  }
  const Reliability reliability = reliability_of(trials, 1);
  for (std::size_t b = 0; b < 10; ++b) {
    EXPECT_EQ(reliability.bins[b].objects, 1U) << b;
    EXPECT_EQ(reliability.bins[b].interval.low, 1.0) << b;
    EXPECT_EQ(reliability.bins[b].interval.high, 1.0) << b;
  }
}

/// Of a thousand draws from the seed's stream 25 are below the interval, and as many above. By a
/// seed whose last draw is one of those, so that it shows.
TEST(Reliability, IntervalsAreOfAThousandDraws) {
  std::vector<Trial> trials;
  for (int i = 0; i < 15; ++i) {
    trials.push_back({.name = fmt::format("object_{}", i),
                      .correct = i % 3 == 0,
                      .probability = 0.602 + 0.06 * std::fmod(0.618034 * i, 1.0)});
  }
  const auto interval_of_draws = [&](std::uint64_t seed, int draws) {
    Rng rng = Rng::stream(seed, "reliability");
    std::vector<double> errors;
    for (int draw = 0; draw < draws; ++draw) {
      double excess = 0.0;
      for (int i = 0; i < 15; ++i) {
        const Trial& trial = trials[rng.uniform_index(15)];
        excess += trial.probability - (trial.correct ? 1.0 : 0.0);
      }
      errors.push_back(std::abs(excess) / 15.0);
    }
    std::ranges::sort(errors);
    return Interval{errors[25], errors[errors.size() - 26]};
  };
  const auto shows_the_last = [&](std::uint64_t seed) {
    const Interval all = interval_of_draws(seed, 1000);
    const Interval fewer = interval_of_draws(seed, 999);
    return std::max(std::abs(all.low - fewer.low), std::abs(all.high - fewer.high)) > 1e-9;
  };
  std::uint64_t seed = 1;
  while (seed < 500 && !shows_the_last(seed)) ++seed;
  ASSERT_LT(seed, 500U);
  const Interval expected = interval_of_draws(seed, 1000);
  const Reliability reliability = reliability_of(trials, seed);
  ASSERT_EQ(reliability.bins[9].count, 15U) << "all in one bin";
  EXPECT_NEAR(reliability.error_interval.low, expected.low, 1e-12);
  EXPECT_NEAR(reliability.error_interval.high, expected.high, 1e-12);
}

}  // namespace
}  // namespace vantage
