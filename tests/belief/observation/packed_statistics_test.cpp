#include "vantage/belief/observation/packed_statistics.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <string>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

GaussianStatistics random_statistics(int dimensions, int states, double scale, Rng& rng) {
  GaussianStatistics statistics = empty_statistics(dimensions, states);
  for (int j = 0; j < states; ++j) {
    const auto views = static_cast<int>(rng.uniform_index(4));
    for (int v = 0; v < views; ++v) {
      add_view(statistics, j, Eigen::VectorXf::NullaryExpr(dimensions, [&] {
                 return static_cast<float>(scale * (rng.normal(j, 1.0) + 5.0));
               }));
    }
  }
  return statistics;
}

GaussianStatistics packed_and_back(const GaussianStatistics& statistics) {
  std::string bytes;
  put_packed(bytes, statistics);
  ByteReader reader(bytes, "test");
  const GaussianStatistics read = take_packed(reader, statistics.states());
  EXPECT_EQ(reader.left(), 0U);
  return read;
}

Eigen::ArrayXf range_of(const Eigen::MatrixXf& values) {
  return (values.rowwise().maxCoeff() - values.rowwise().minCoeff()).array();
}

RC_GTEST_PROP(PackedStatistics, AreWithinHalfAStep, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  const double scale = std::pow(10.0, *rc::gen::inRange(-9, 9));
  const GaussianStatistics statistics = random_statistics(5, 6, scale, rng);
  const GaussianStatistics read = packed_and_back(statistics);
  RC_ASSERT(read.count == statistics.count);
  const Eigen::ArrayXf half_step = range_of(statistics.mean) / 65535.0F * 0.51F;
  const Eigen::ArrayXf rounding = statistics.mean.cwiseAbs().rowwise().maxCoeff() * 1e-6F;
  const Eigen::MatrixXf spread = statistics.squared_deviation.cwiseSqrt();
  const Eigen::ArrayXf half_spread = spread.rowwise().maxCoeff().array() / 65535.0F * 0.51F;
  for (int j = 0; j < 6; ++j) {
    RC_ASSERT(
        ((read.mean.col(j) - statistics.mean.col(j)).array().abs() <= half_step + rounding).all());
    RC_ASSERT(((read.squared_deviation.col(j).cwiseSqrt() - spread.col(j)).array().abs() <=
               half_spread * 1.01F)
                  .all());
  }
}

RC_GTEST_PROP(PackedStatistics, DoNotDriftWhenPackedAgain, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  const GaussianStatistics once = packed_and_back(random_statistics(4, 5, 1.0, rng));
  GaussianStatistics often = once;
  for (int i = 0; i < 20; ++i) often = packed_and_back(often);
  const float step = range_of(once.mean).maxCoeff() / 65535.0F;
  RC_ASSERT((often.mean - once.mean).cwiseAbs().maxCoeff() <= 0.5F * step);
  const Eigen::MatrixXf change = often.squared_deviation - once.squared_deviation;
  RC_ASSERT(change.cwiseAbs().maxCoeff() <= 1e-5F * once.squared_deviation.maxCoeff());
}

TEST(PackedStatistics, KeepStatesWithoutViewsEmpty) {
  GaussianStatistics statistics = empty_statistics(2, 3);
  add_view(statistics, 1, Eigen::Vector2f(7.0F, -3.0F));
  const GaussianStatistics read = packed_and_back(statistics);
  EXPECT_EQ(read.count, (std::vector{0, 1, 0}));
  EXPECT_EQ(read.mean, statistics.mean);
  EXPECT_EQ(read.squared_deviation, statistics.squared_deviation);
}

TEST(PackedStatistics, RefuseRangesThatAreNotFinite) {
  GaussianStatistics statistics = empty_statistics(1, 1);
  add_view(statistics, 0, Eigen::VectorXf::Ones(1));
  std::string whole;
  put_packed(whole, statistics);
  const std::size_t ranges = 2 * sizeof(std::int32_t);
  for (const std::size_t field : {0U, 1U, 2U}) {  // low and step of means, step of spreads
    for (const float bad : {NAN, INFINITY, -INFINITY, 3e38F}) {
      if (field == 0 && bad == 3e38F) continue;
      std::string bytes = whole;
      std::memcpy(bytes.data() + ranges + field * sizeof(float), &bad, sizeof bad);
      ByteReader reader(bytes, "test");
      EXPECT_THROW(take_packed(reader, 1), InputError) << field << " " << bad;
    }
  }
}

TEST(PackedStatistics, MayBeOfOneDimension) {
  GaussianStatistics statistics = empty_statistics(1, 2);
  add_view(statistics, 1, Eigen::VectorXf::Constant(1, 7.0F));
  const GaussianStatistics read = packed_and_back(statistics);
  EXPECT_EQ(read.count, statistics.count);
  EXPECT_EQ(read.mean, statistics.mean);
}

TEST(PackedStatistics, RefuseANegativeNumberOfViews) {
  std::string bytes;
  put_packed(bytes, empty_statistics(1, 2));
  const std::int32_t negative = -1;
  std::memcpy(bytes.data() + sizeof negative, &negative, sizeof negative);
  ByteReader reader(bytes, "test");
  EXPECT_THROW(take_packed(reader, 2), InputError);
}

/// A state without views has no mean, not one of zero: the steps are those of 1, not of 1001.
TEST(PackedStatistics, AreAsFineAsTheMeansThereAre) {
  GaussianStatistics statistics = empty_statistics(1, 4);
  add_view(statistics, 0, Eigen::VectorXf::Constant(1, 1000.0F));
  add_view(statistics, 1, Eigen::VectorXf::Constant(1, 1000.3F));
  add_view(statistics, 3, Eigen::VectorXf::Constant(1, 1001.0F));
  const GaussianStatistics read = packed_and_back(statistics);
  for (const int j : {0, 1, 3}) EXPECT_NEAR(read.mean(0, j), statistics.mean(0, j), 5e-4) << j;
}

TEST(PackedStatistics, RefuseAFeatureWithoutDimensions) {
  std::string bytes;
  put(bytes, std::int32_t{1});   // views of the only state
  put(bytes, std::uint32_t{0});  // dimensions
  ByteReader reader(bytes, "test");
  EXPECT_THROW(take_packed(reader, 1), InputError);
}

/// Low and step of the means, and step of the spreads, of one dimension.
TEST(PackedStatistics, HaveRangesThatEndInFiniteNumbers) {
  GaussianStatistics statistics = empty_statistics(1, 1);
  add_view(statistics, 0, Eigen::VectorXf::Ones(1));
  std::string whole;
  put_packed(whole, statistics);
  const auto is_read = [&](float low, float step, float spread) {
    const std::array<float, 3> ranges{low, step, spread};
    std::string bytes = whole;
    std::memcpy(bytes.data() + 2 * sizeof(std::int32_t), ranges.data(), sizeof ranges);
    ByteReader reader(bytes, "test");
    try {
      take_packed(reader, 1);
      return true;
    } catch (const InputError&) {
      return false;
    }
  };
  EXPECT_TRUE(is_read(1.0F, 0.0F, 0.0F));
  EXPECT_TRUE(is_read(-3e38F, 3e38F / 65535.0F, 0.0F));
  EXPECT_FALSE(is_read(3e38F, 2e38F / 65535.0F, 0.0F)) << "up to 5e38";
  EXPECT_FALSE(is_read(1.0F, -1e-3F, 0.0F));
  EXPECT_FALSE(is_read(1.0F, 0.0F, -1e-3F));
  EXPECT_TRUE(is_read(1.0F, 0.0F, 1e18F / 65535.0F));
  EXPECT_FALSE(is_read(1.0F, 0.0F, 1e20F / 65535.0F)) << "spreads are squared";
}

TEST(PackedStatistics, KeepMeansAsFarApartAsFloatsMayBe) {
  GaussianStatistics statistics = empty_statistics(1, 2);
  add_view(statistics, 0, Eigen::VectorXf::Constant(1, -3e38F));
  add_view(statistics, 1, Eigen::VectorXf::Zero(1));
  const GaussianStatistics read = packed_and_back(statistics);
  EXPECT_EQ(read.mean(0, 0), -3e38F);
  EXPECT_NEAR(read.mean(0, 1), 0.0, 1e32);
}

/// Behind the ranges: the steps of the mean and of the spread, of which there are none.
TEST(PackedStatistics, HaveNoStepsWhereAllStatesAreTheSame) {
  GaussianStatistics statistics = empty_statistics(1, 1);
  add_view(statistics, 0, Eigen::VectorXf::Constant(1, 5.0F));
  std::string bytes;
  put_packed(bytes, statistics);
  EXPECT_EQ(bytes.substr(bytes.size() - 4), std::string(4, '\0'));
}

}  // namespace
}  // namespace vantage
