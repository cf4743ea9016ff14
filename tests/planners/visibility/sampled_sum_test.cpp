#include "vantage/planners/visibility/sampled_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/planners/visibility/partly_seen.hpp"

namespace vantage {
namespace {

PartlySeen::Cell no_cell(int) { return {}; }

/// Cells of which a share is seen, though the sweep takes every one for dimly lit.
class Population {
 public:
  Population(double share_seen, Rng& rng) {
    for (int i = 0; i < 3000; ++i) {
      visible_.push_back(static_cast<float>(rng.uniform(0.1, 0.6)));
      seen_.push_back(rng.uniform() < share_seen ? 1.0F : 0.0F);
    }
  }
  [[nodiscard]] double sum() const { return std::accumulate(seen_.begin(), seen_.end(), 0.0); }

  /// Their sum from one in 16 of the cells, or more for the tolerance, in rows of any length.
  [[nodiscard]] SampledSum estimate(Rng& rng, double tolerance = 1e9) const {
    PartlySeen sample(static_cast<int>(seen_.size()));
    const std::size_t start = rng.uniform_index(1000);
    for (std::size_t row = 0; row < start; ++row) sample.offer(0, no_cell);
    for (std::size_t begin = 0; begin < seen_.size();) {
      const std::size_t count = std::min(1 + rng.uniform_index(60), seen_.size() - begin);
      sample.offer(static_cast<int>(count), [&](int k) {
        const std::size_t i = begin + static_cast<std::size_t>(k);
        return PartlySeen::Cell{
            .cell = {static_cast<int>(i), 0, 0}, .visible = visible_[i], .weight = 1.0F};
      });
      begin += count;
    }
    auto sum = SampledSum::exact(std::accumulate(visible_.begin(), visible_.end(), 0.0));
    sum += sample.sum_errors(tolerance, [&](const PartlySeen::Cell& cell) {
      const auto i = static_cast<std::size_t>(cell.cell.x());
      return static_cast<double>(seen_[i] - visible_[i]);
    });
    return sum;
  }

 private:
  std::vector<float> visible_;
  std::vector<float> seen_;
};

double settled(const SampledSum& sum, double exact) {
  return std::max(sum.is_settled() ? sum.estimate : sum.settled_by(exact), 0.0);
}

// Zero for what is below zero would be 5 to 7 standard errors off at the first two shares, the
// exact sum for all that is not settled up to 17 at the others.
TEST(SampledSum, IsUnbiasedHoweverNearZero) {
  Rng rng(1);
  for (const double share_seen : {0.0, 0.01, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4}) {
    constexpr int kTrials = 1000;
    double sum = 0.0;
    double squares = 0.0;
    for (int trial = 0; trial < kTrials; ++trial) {
      const Population population(share_seen, rng);
      const double exact = population.sum();
      const double error = settled(population.estimate(rng), exact) - exact;
      sum += error;
      squares += error * error;
    }
    const double standard_error = std::sqrt(squares) / kTrials;
    EXPECT_LE(std::abs(sum / kTrials), 3.0 * standard_error) << share_seen;
  }
}

TEST(SampledSum, StandsAsEstimatedFarFromZero) {
  Rng rng(2);
  for (const double tolerance : {1e9, 100.0, 70.0, 50.0}) {  // one cell in 16, 8, 4, 2
    const SampledSum sum = Population(0.6, rng).estimate(rng, tolerance);
    EXPECT_TRUE(sum.is_settled());
    EXPECT_FALSE(sum.is_exact());
    EXPECT_NEAR(0.5 * (sum.halves[0].estimate + sum.halves[1].estimate), sum.estimate, 1e-9);
    for (const auto& half : sum.halves) {
      EXPECT_NEAR(half.estimate, sum.estimate, 4.0 * std::sqrt(half.variance)) << tolerance;
    }
  }
}

TEST(SampledSum, OfEveryTermIsExact) {
  PartlySeen sample(100, 1);
  sample.offer(60, [](int i) {
    return PartlySeen::Cell{.cell = {i, 0, 0}, .visible = 0.25F, .weight = 1.0F};
  });
  const SampledSum sum = sample.sum_errors(
      1e9, [](const PartlySeen::Cell& cell) { return cell.cell.x() < 20 ? 0.75 : -0.25; });
  EXPECT_TRUE(sum.is_exact());
  EXPECT_TRUE(sum.is_settled());
  EXPECT_DOUBLE_EQ(sum.estimate, 20 * 0.75 - 40 * 0.25);
}

/// A sample of n of 64 cells with an error of 1 each has a standard error of 64 / sqrt(n).
TEST(SampledSum, IsOfNoMoreCellsThanTheToleranceAsksFor) {
  PartlySeen sample(100);
  sample.offer(64, [](int i) {
    return PartlySeen::Cell{.cell = {i, 0, 0}, .visible = 0.5F, .weight = 1.0F};
  });
  struct Asked {
    double tolerance;
    int cells;
  };
  for (const auto& [tolerance, cells] : {Asked{1e9, 4}, Asked{32.0, 4}, Asked{31.9, 8},
                                         Asked{16.0, 16}, Asked{12.0, 32}, Asked{0.0, 64}}) {
    std::set<int> asked;
    const SampledSum sum = sample.sum_errors(tolerance, [&](const PartlySeen::Cell& cell) {
      EXPECT_TRUE(asked.insert(cell.cell.x()).second) << "asked for again";
      return 1.0;
    });
    EXPECT_EQ(static_cast<int>(asked.size()), cells) << tolerance;
    EXPECT_EQ(sum.estimate, 64.0) << tolerance;
    const double weight = 64.0 / cells;
    const double variance = cells < 64 ? 4.0 * weight * weight * (0.5 * cells + 0.25) : 0.0;
    for (const auto& half : sum.halves) {
      EXPECT_EQ(half.estimate, 64.0) << tolerance;
      EXPECT_EQ(half.variance, variance) << tolerance;
    }
  }
}

/// Of 64 cells the 33rd is one too many: every other one is kept.
TEST(SampledSum, OfAThinnedSampleIsThatOfTheCellsKeptTimesTheStride) {
  PartlySeen sample(32, 1);
  sample.offer(64, [](int i) {
    return PartlySeen::Cell{.cell = {i, 0, 0}, .visible = 0.5F, .weight = 1.0F};
  });
  int asked = 0;
  const SampledSum sum = sample.sum_errors(0.0, [&](const PartlySeen::Cell&) {
    ++asked;
    return 1.0;
  });
  EXPECT_EQ(asked, 32);
  EXPECT_EQ(sum.estimate, 64.0);
  for (const auto& half : sum.halves) {
    EXPECT_EQ(half.estimate, 64.0);
    EXPECT_EQ(half.variance, 16.0 * (16.0 + 0.25));
  }
}

TEST(SampledSum, IsSettledWithBothHalvesFourStandardErrorsFromZero) {
  const SampledSum::Half clear{.estimate = 8.0, .variance = 4.0};
  const SampledSum::Half nearly{.estimate = 7.99, .variance = 4.0};
  const auto of = [](const SampledSum::Half& first, const SampledSum::Half& second) {
    return SampledSum{.estimate = 8.0, .halves = {first, second}};
  };
  EXPECT_TRUE(of(clear, clear).is_settled());
  EXPECT_FALSE(of(clear, nearly).is_settled());
  EXPECT_FALSE(of(nearly, clear).is_settled());
  EXPECT_EQ(of(clear, clear).settled_by(3.0), 3.0);
  EXPECT_EQ(of(nearly, nearly).settled_by(3.0), 3.0);
  EXPECT_EQ(of(clear, nearly).settled_by(3.0), 0.5 * (3.0 + 7.99));
  EXPECT_EQ(of(nearly, clear).settled_by(3.0), 0.5 * (3.0 + 7.99));
}

/// Rows are counted whole, though the sample is full in the middle of some.
TEST(SampledSum, OfAThinnedSampleIsUnbiased) {
  constexpr std::size_t kTrials = 1000;
  double sum = 0.0;
  for (std::size_t trial = 0; trial < kTrials; ++trial) {
    PartlySeen sample(64, 1);
    for (std::size_t row = 0; row < trial; ++row) sample.offer(0, no_cell);
    for (int row = 0; row < 20; ++row) {
      sample.offer(50, [](int i) {
        return PartlySeen::Cell{.cell = {i, 0, 0}, .visible = 1.0F, .weight = 1.0F};
      });
    }
    sum += sample.sum_errors(1e9, [](const PartlySeen::Cell&) { return 1.0; }).estimate;
  }
  EXPECT_NEAR(sum / kTrials, 1000.0, 1.0);
}

/// A sample that met no error says nothing of the cells it left out.
TEST(SampledSum, OfAFewCellsIsNotSettled) {
  PartlySeen sample(100);
  sample.offer(15, [](int) {
    return PartlySeen::Cell{.cell = {0, 0, 0}, .visible = 0.25F, .weight = 1.0F};
  });
  SampledSum sum = SampledSum::exact(15 * 0.25);
  sum += sample.sum_errors(1e9, [](const PartlySeen::Cell&) { return 0.0; });
  EXPECT_FALSE(sum.is_settled());
  EXPECT_EQ(sum.settled_by(0.0), 0.0);
}

TEST(SampledSum, CellsWithoutWeightTakeNoPlaceInTheSample) {
  PartlySeen sample(32, 1);
  sample.offer(64, [](int i) {
    return PartlySeen::Cell{.cell = {i, 0, 0}, .visible = 0.5F, .weight = i % 2 == 0 ? 1.0F : 0.0F};
  });
  int asked = 0;
  const SampledSum sum = sample.sum_errors(0.0, [&](const PartlySeen::Cell&) {
    ++asked;
    return 1.0;
  });
  EXPECT_EQ(asked, 32);
  EXPECT_TRUE(sum.is_exact());
  EXPECT_EQ(sum.estimate, 32.0);
}

/// Golden sections of the stride apart: so cells of neighbouring rows, which are alike, are neither
/// all taken nor all left out.
TEST(SampledSum, RowsStartAGoldenSectionApart) {
  PartlySeen sample(100, 1);
  for (int row = 0; row < 5; ++row) {
    sample.offer(1, [](int) {
      return PartlySeen::Cell{.cell = {0, 0, 0}, .visible = 0.5F, .weight = 1.0F};
    });
  }
  std::vector<double> starts;
  const SampledSum sum = sample.sum_errors(0.0, [&](const PartlySeen::Cell& cell) {
    starts.push_back(static_cast<double>(cell.order) / (1 << 20));
    return 1.0;
  });
  EXPECT_EQ(sum.estimate, 5.0);
  ASSERT_EQ(starts.size(), 5U);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    EXPECT_NEAR(starts[i], std::fmod(0.6180339887 * static_cast<double>(i + 1), 1.0), 1e-5) << i;
  }
}

}  // namespace
}  // namespace vantage
