// Intervals and tests against closed forms.
#include "vantage/information/resampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace vantage {
namespace {

TEST(Bootstrap, OfAConstantIsThatConstant) {
  Rng rng(1);
  const std::vector<double> values(7, 2.5);
  const Interval interval = bootstrap_mean(values, rng);
  EXPECT_DOUBLE_EQ(interval.low, 2.5);
  EXPECT_DOUBLE_EQ(interval.high, 2.5);
}

TEST(Bootstrap, SameStreamSameBits) {
  const std::vector<double> values{3.0, 1.0, 4.0, 1.0, 5.0, 9.0, 2.0, 6.0};
  Rng first = Rng::stream(1, "a");
  Rng second = Rng::stream(1, "a");
  const Interval a = bootstrap_mean(values, first);
  const Interval b = bootstrap_mean(values, second);
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.high, b.high);
}

TEST(Bootstrap, OfTwoValuesHasTheBinomialQuantiles) {
  // The mean of two draws from {0, 1} is 0, 1/2, 1 with probabilities 1/4, 1/2, 1/4.
  Rng rng(2);
  const std::array values{0.0, 1.0};
  const Interval wide = bootstrap_mean(values, rng, {.confidence = 0.95});
  EXPECT_DOUBLE_EQ(wide.low, 0.0);
  EXPECT_DOUBLE_EQ(wide.high, 1.0);
  const Interval narrow = bootstrap_mean(values, rng, {.confidence = 0.4});
  EXPECT_DOUBLE_EQ(narrow.low, 0.5);
  EXPECT_DOUBLE_EQ(narrow.high, 0.5);
}

TEST(Bootstrap, WidthIsThatOfTheNormalTheory) {
  Rng data(3);
  std::vector<double> values(400);
  for (double& value : values) value = data.normal(10.0, 2.0);
  Rng rng(4);
  const Interval interval = bootstrap_mean(values, rng);
  const double expected = 2.0 * 1.959964 * 2.0 / std::sqrt(400.0);
  EXPECT_NEAR(interval.high - interval.low, expected, 0.1 * expected);
}

TEST(Bootstrap, CoversTheMeanOfNormalData) {
  // n = 40: the percentile interval covers a little less than 95 %, about 93.6 %.
  constexpr int kTrials = 1000;
  int covered = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    Rng rng = Rng::stream(static_cast<std::uint64_t>(trial), "coverage");
    std::vector<double> values(40);
    for (double& value : values) value = rng.normal();
    const Interval interval = bootstrap_mean(values, rng, {.resamples = 500});
    covered += interval.low <= 0.0 && 0.0 <= interval.high ? 1 : 0;
  }
  EXPECT_GT(covered, 0.91 * kTrials);
  EXPECT_LT(covered, 0.965 * kTrials);
}

TEST(Bootstrap, ClustersOfOneAreTheValuesThemselves) {
  const std::vector<double> values{3.0, 1.0, 4.0, 1.0, 5.0, 9.0, 2.0, 6.0};
  const std::vector<std::size_t> marks{7, 1, 2, 3, 4, 5, 6, 0};
  Rng a(1);
  Rng b(1);
  const Interval plain = bootstrap_mean(values, a);
  const Interval clustered = bootstrap_mean(values, clusters_of(marks), b);
  EXPECT_EQ(plain.low, clustered.low);
  EXPECT_EQ(plain.high, clustered.high);
}

/// Ten starts in each of twenty scenes, all that differs is the scene: two hundred values say as
/// much as twenty, and an interval that takes them for independent is sqrt(10) too narrow.
TEST(Bootstrap, CopiesInAClusterSayNothingNew) {
  Rng data(5);
  std::vector<double> of_scene(20);
  for (double& value : of_scene) value = data.normal(10.0, 2.0);
  std::vector<double> values;
  std::vector<std::size_t> marks;
  for (std::size_t scene = 0; scene < of_scene.size(); ++scene) {
    values.insert(values.end(), 10, of_scene[scene]);
    marks.insert(marks.end(), 10, scene);
  }
  Rng a(6);
  Rng b(6);
  Rng c(6);
  const Interval scenes = bootstrap_mean(of_scene, a);
  const Interval clustered = bootstrap_mean(values, clusters_of(marks), b);
  const Interval naive = bootstrap_mean(values, c);
  EXPECT_NEAR(clustered.high - clustered.low, scenes.high - scenes.low, 1e-9);
  EXPECT_NEAR((clustered.high - clustered.low) / (naive.high - naive.low), std::sqrt(10.0), 0.2);
}

/// A resample of clusters of unequal size has the mean of its values, not of its clusters' means.
TEST(Bootstrap, LargeClustersWeighMore) {
  const std::vector<double> values{0.0, 1.0, 1.0, 1.0};
  Rng rng(7);
  const Interval interval = bootstrap_mean(values, {{0}, {1, 2, 3}}, rng, {.confidence = 0.4});
  EXPECT_DOUBLE_EQ(interval.low, 0.75);
  EXPECT_DOUBLE_EQ(interval.high, 0.75);
  Rng alone(7);
  EXPECT_DOUBLE_EQ(bootstrap_mean(values, {{0, 1, 2, 3}}, alone).low, 0.75);
}

TEST(Clusters, AreOfEqualMarks) {
  const std::vector<std::size_t> marks{4, 2, 4, 9, 2};
  const Clusters expected{{0, 2}, {1, 4}, {3}};
  EXPECT_EQ(clusters_of(marks), expected);
  const std::vector<double> values{1.0, 2.0, 4.0, 8.0, 16.0};
  EXPECT_EQ(cluster_sums(values, expected), (std::vector<double>{5.0, 18.0, 8.0}));
}

TEST(BootstrapRatio, OfProportionalPairsIsExact) {
  Rng rng(5);
  const std::vector<double> below{1.0, 5.0, 2.0, 8.0};
  std::vector<double> above = below;
  for (double& value : above) value *= 0.25;
  const Interval interval = bootstrap_ratio(above, below, rng);
  EXPECT_DOUBLE_EQ(interval.low, 0.25);
  EXPECT_DOUBLE_EQ(interval.high, 0.25);
}

TEST(BootstrapRatio, OfNothingIsInfinite) {
  Rng rng(6);
  const std::array above{1.0, 2.0};
  const std::array below{0.0, 0.0};
  EXPECT_TRUE(std::isinf(bootstrap_ratio(above, below, rng).low));
}

/// Four resamples, drawn here by the same numbers: the ends of the interval lie between them.
TEST(Bootstrap, EndsLieBetweenTheResamplesNextToThem) {
  const std::vector<double> values{1.0, 10.0, 100.0, 1000.0, 10000.0};
  Rng same(12);
  std::vector<double> means(4, 0.0);
  for (double& mean_of_one : means) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      mean_of_one += values[same.uniform_index(values.size())] / 5.0;
    }
  }
  std::ranges::sort(means);
  Rng rng(12);
  const Interval interval = bootstrap_mean(values, rng, {.resamples = 4, .confidence = 0.8});
  EXPECT_NEAR(interval.low, 0.7 * means[0] + 0.3 * means[1], 1e-6);
  EXPECT_NEAR(interval.high, 0.3 * means[2] + 0.7 * means[3], 1e-6);
}

TEST(Bootstrap, OfOneResampleIsThatResample) {
  Rng rng(13);
  const std::array values{1.0, 2.0, 4.0};
  const Interval interval = bootstrap_mean(values, rng, {.resamples = 1});
  EXPECT_EQ(interval.low, interval.high);
}

TEST(Bootstrap, TakesTenThousandResamplesForNinetyFivePerCent) {
  EXPECT_EQ(BootstrapOptions{}.resamples, 10000);
  EXPECT_EQ(BootstrapOptions{}.confidence, 0.95);
  EXPECT_EQ(Interval{}.low, 0.0);
  EXPECT_EQ(Interval{}.high, 0.0);
}

TEST(Mean, IsTheSumSharedOut) { EXPECT_DOUBLE_EQ(mean(std::vector{1.0, 2.5, 7.0}), 3.5); }

TEST(SignFlip, AllPatternsOfSixteenAreTriedAndOfMoreSomeAreDrawn) {
  Rng rng(14);
  EXPECT_DOUBLE_EQ(sign_flip_p_value(std::vector<double>(16, 1.0), rng), 2.0 / 65536.0);
  EXPECT_DOUBLE_EQ(sign_flip_p_value(std::vector<double>(17, 1.0), rng, 9), 0.1);
}

TEST(SignFlip, EachOfManyDifferencesCounts) {
  for (const std::size_t at : {0U, 1U, 63U, 64U, 65U, 127U, 128U, 129U}) {
    std::vector<double> differences(130, 0.0);
    differences[at] = 1.0;
    Rng rng(15);
    EXPECT_DOUBLE_EQ(sign_flip_p_value(differences, rng, 19), 1.0) << at;
  }
}

TEST(SignFlip, KnownAnswers) {
  Rng rng(7);
  // All of one sign: only the pattern itself and its mirror are as extreme.
  const std::array all_positive{1.0, 2.0, 3.0, 4.0, 5.0};
  EXPECT_DOUBLE_EQ(sign_flip_p_value(all_positive, rng), 2.0 / 32.0);
  // 3, -1, 2: sums 4, -2, 6, 0 and their mirrors; |4| or more: 4 of 8.
  const std::array mixed{3.0, -1.0, 2.0};
  EXPECT_DOUBLE_EQ(sign_flip_p_value(mixed, rng), 0.5);
  const std::array none{0.0, 0.0, 0.0};
  EXPECT_DOUBLE_EQ(sign_flip_p_value(none, rng), 1.0);
  const std::array one{4.0};
  EXPECT_DOUBLE_EQ(sign_flip_p_value(one, rng), 1.0);
}

TEST(SignFlip, RoundingMakesNoDifference) {
  Rng rng(8);
  const std::array tenths{0.1, 0.2, 0.3, -0.6};  // sums to 0 but for rounding
  EXPECT_DOUBLE_EQ(sign_flip_p_value(tenths, rng), 1.0);
}

TEST(SignFlip, RandomDrawsAgreeWithTheNormalLimit) {
  // 40 differences of size 1, 28 of them positive: z = 16 / sqrt(40); P(|sum| >= 16) = 0.0166.
  std::vector<double> differences(40, 1.0);
  std::fill_n(differences.begin(), 12, -1.0);
  Rng rng(9);
  EXPECT_NEAR(sign_flip_p_value(differences, rng), 0.0166, 0.004);
}

TEST(SignFlip, MoreThanOneWordOfSigns) {
  const std::vector<double> differences(130, 1.0);
  Rng rng(10);
  EXPECT_DOUBLE_EQ(sign_flip_p_value(differences, rng, 999), 0.001);
}

TEST(SignFlip, TenThousandPatternsAreDrawnUnlessSaidOtherwise) {
  Rng rng(16);
  EXPECT_DOUBLE_EQ(sign_flip_p_value(std::vector<double>(130, 1.0), rng), 1.0 / 10001.0);
}

/// Of two values that count, half of all patterns have both with one sign.
TEST(SignFlip, SignsOfDifferentValuesAreIndependent) {
  const std::vector<std::array<std::size_t, 2>> pairs{{62, 63}, {63, 64}, {63, 127}, {0, 64}};
  for (const auto& [a, b] : pairs) {
    std::vector<double> differences(130, 0.0);
    differences[a] = differences[b] = 1.0;
    Rng rng(17);
    EXPECT_NEAR(sign_flip_p_value(differences, rng, 999), 0.5, 0.08) << a << " " << b;
  }
}

TEST(Bootstrap, OfOneValueIsThatValue) {
  Rng rng(18);
  const Interval interval = bootstrap_mean(std::array{3.5}, rng);
  EXPECT_DOUBLE_EQ(interval.low, 3.5);
  EXPECT_DOUBLE_EQ(interval.high, 3.5);
}

/// A quotient of sums, whatever their size.
TEST(BootstrapRatio, OfOnePairIsItsQuotient) {
  for (const double below : {0.5, 1.0, 2.0}) {
    Rng rng(19);
    const Interval interval = bootstrap_ratio(std::array{3.0}, std::array{below}, rng);
    EXPECT_DOUBLE_EQ(interval.low, 3.0 / below);
    EXPECT_DOUBLE_EQ(interval.high, 3.0 / below);
  }
}

}  // namespace
}  // namespace vantage
