#include "vantage/core/rng.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <vector>

namespace vantage {
namespace {

// xoshiro256++ whose state is four outputs of splitmix64 from 1, computed from the authors' paper.
TEST(Rng, FirstNumbersOfSeedOne) {
  Rng rng(1);
  for (const std::uint64_t expected :
       {0xcfc5d07f6f03c29bULL, 0xbf424132963fe08dULL, 0x19a37d5757aaf520ULL, 0xbf08119f05cd56d6ULL,
        0x2f47184b86186fa4ULL}) {
    EXPECT_EQ(rng.next(), expected);
  }
}

TEST(Rng, UniformIsTheTop53Bits) {
  Rng bits(1);
  Rng real(1);
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(real.uniform(), std::ldexp(static_cast<double>(bits.next() >> 11U), -53));
  }
}

RC_GTEST_PROP(Rng, SameSeedSameNumbers, (std::uint64_t seed)) {
  Rng a(seed);
  Rng b(seed);
  for (int i = 0; i < 20; ++i) RC_ASSERT(a.normal() == b.normal());
}

TEST(Rng, StreamsOfOneSeedDifferAndDoNotShiftEachOther) {
  const std::vector<std::string_view> names{"laser", "odometry", "scene", "laser2", ""};
  std::set<std::uint64_t> firsts;
  for (const auto name : names) firsts.insert(Rng::stream(1, name).next());
  firsts.insert(Rng::stream(2, "laser").next());
  firsts.insert(Rng(1).next());
  EXPECT_EQ(firsts.size(), names.size() + 2);

  Rng laser = Rng::stream(1, "laser");
  const double alone = laser.uniform();
  Rng odometry = Rng::stream(1, "odometry");
  for (int i = 0; i < 10; ++i) odometry.next();
  EXPECT_EQ(Rng::stream(1, "laser").uniform(), alone);
}

TEST(Rng, StreamsAreUncorrelated) {
  Rng a = Rng::stream(1, "a");
  Rng b = Rng::stream(1, "b");
  constexpr int kCount = 100000;
  double sum = 0.0;
  for (int i = 0; i < kCount; ++i) sum += a.normal() * b.normal();
  EXPECT_LT(std::abs(sum / kCount), 4.0 / std::sqrt(kCount));
}

TEST(Rng, UniformMoments) {
  Rng rng(3);
  constexpr int kCount = 200000;
  double sum = 0.0;
  double sum2 = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double x = rng.uniform(2.0, 5.0);
    ASSERT_GE(x, 2.0);
    ASSERT_LT(x, 5.0);
    sum += x;
    sum2 += x * x;
  }
  const double mean = sum / kCount;
  EXPECT_NEAR(mean, 3.5, 0.01);
  EXPECT_NEAR(sum2 / kCount - mean * mean, 9.0 / 12.0, 0.01);
}

TEST(Rng, NormalMomentsAndTails) {
  Rng rng(3);
  constexpr int kCount = 200000;
  std::array<double, 5> moment{};
  int beyond_two = 0;
  for (int i = 0; i < kCount; ++i) {
    const double x = rng.normal();
    for (std::size_t k = 1; k < moment.size(); ++k) moment[k] += std::pow(x, k) / kCount;
    beyond_two += std::abs(x) > 2.0 ? 1 : 0;
  }
  EXPECT_NEAR(moment[1], 0.0, 0.01);
  EXPECT_NEAR(moment[2], 1.0, 0.02);
  EXPECT_NEAR(moment[3], 0.0, 0.04);
  EXPECT_NEAR(moment[4], 3.0, 0.1);
  EXPECT_NEAR(static_cast<double>(beyond_two) / kCount, 0.0455, 0.002);
}

TEST(Rng, NormalWithMeanAndSigma) {
  Rng plain(4);
  Rng scaled(4);
  for (int i = 0; i < 10; ++i)
    EXPECT_DOUBLE_EQ(scaled.normal(3.0, 0.5), 3.0 + 0.5 * plain.normal());
}

// Chi-square with 6 degrees of freedom: 22.5 is the 99.9 % point.
TEST(Rng, UniformIndexIsEven) {
  Rng rng(5);
  constexpr std::size_t kBins = 7;
  constexpr double kCount = 70000.0;
  std::array<double, kBins> seen{};
  for (int i = 0; i < static_cast<int>(kCount); ++i) seen[rng.uniform_index(kBins)] += 1.0;
  double chi2 = 0.0;
  for (const double n : seen) chi2 += std::pow(n - kCount / kBins, 2) / (kCount / kBins);
  EXPECT_LT(chi2, 22.5);
}

// Of a range of 3/4 * 2^64, plain remainders would fall into the first third twice as often.
TEST(Rng, UniformIndexOfAHugeRangeHasNoBias) {
  Rng rng(6);
  constexpr std::uint64_t kRange = 3ULL << 62U;
  constexpr int kCount = 30000;
  int first_third = 0;
  for (int i = 0; i < kCount; ++i) first_third += rng.uniform_index(kRange) < kRange / 3 ? 1 : 0;
  EXPECT_NEAR(static_cast<double>(first_third) / kCount, 1.0 / 3.0, 0.015);
}

RC_GTEST_PROP(Rng, UniformIndexStaysInRange, (std::uint64_t seed, std::size_t count)) {
  RC_PRE(count > 0U);
  Rng rng(seed);
  for (int i = 0; i < 20; ++i) RC_ASSERT(rng.uniform_index(count) < count);
}

TEST(RngDeathTest, UniformIndexOfNothing) {
  EXPECT_DEATH(Rng(1).uniform_index(0), "uniform_index of an empty range");
}

/// Two numbers of each pair of coordinates, in their order.
TEST(Rng, NormalNumbersComeInPairs) {
  Rng rng(8);
  Rng same(8);
  for (int pair = 0; pair < 50; ++pair) {
    double u = 0.0;
    double v = 0.0;
    do {
      u = 2.0 * same.uniform() - 1.0;
      v = 2.0 * same.uniform() - 1.0;
    } while (u * u + v * v >= 1.0);
    const double s = u * u + v * v;
    const double scale = std::sqrt(-2.0 * std::log(s) / s);
    EXPECT_DOUBLE_EQ(rng.normal(), u * scale);
    EXPECT_DOUBLE_EQ(rng.normal(), v * scale);
  }
}

/// But for those numbers that would give the first of the range more than their share.
TEST(Rng, UniformIndexIsTheRestOfTheNextNumber) {
  for (const std::uint64_t count : {1ULL, 7ULL, (1ULL << 32U) + 1, (1ULL << 63U) - 1}) {
    Rng rng(9);
    Rng same(9);
    for (int i = 0; i < 100; ++i) EXPECT_EQ(rng.uniform_index(count), same.next() % count) << count;
  }
  constexpr std::uint64_t kRange = 3ULL << 62U;
  Rng rng(9);
  Rng same(9);
  for (int i = 0; i < 100; ++i) {
    std::uint64_t next = same.next();
    while (next >= kRange) next = same.next();
    EXPECT_EQ(rng.uniform_index(kRange), next);
  }
}

}  // namespace
}  // namespace vantage
