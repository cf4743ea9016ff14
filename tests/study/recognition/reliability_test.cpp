#include "vantage/study/recognition/reliability.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace vantage
