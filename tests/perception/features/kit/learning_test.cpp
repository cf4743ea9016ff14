// Principal components and vocabularies.
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "vantage/core/error.hpp"
#include "vantage/perception/features/kit/k_means.hpp"
#include "vantage/perception/features/kit/pca.hpp"
#include "vantage/perception/features/kit/training_views.hpp"

namespace vantage {
namespace {

Eigen::MatrixXf noise(Eigen::Index rows, Eigen::Index columns, Rng& rng) {
  return Eigen::MatrixXf::NullaryExpr(rows, columns,
                                      [&] { return static_cast<float>(rng.normal()); });
}

/// `n` samples whose deviation along axis i is 1 / (i + 1).
Eigen::MatrixXf samples_of(Eigen::Index dimensions, Eigen::Index n, Rng& rng) {
  Eigen::MatrixXf samples = noise(dimensions, n, rng);
  for (Eigen::Index i = 0; i < dimensions; ++i) samples.row(i) /= static_cast<float>(i + 1);
  return samples.array() + 3.0F;
}

// More samples than dimensions, and fewer: both ways of solving.
class PcaOf : public testing::TestWithParam<int> {};

TEST_P(PcaOf, ComponentsAreOrthonormalAndUncorrelated) {
  Rng rng(1);
  const Eigen::MatrixXf samples = samples_of(20, GetParam(), rng);
  const Pca pca = learn_pca(samples, 10);
  ASSERT_EQ(pca.axes.cols(), 10);
  const Eigen::MatrixXf identity = Eigen::MatrixXf::Identity(10, 10);
  EXPECT_LT((pca.axes.transpose() * pca.axes - identity).cwiseAbs().maxCoeff(), 1e-4F);
  Eigen::MatrixXf projected(10, samples.cols());
  for (Eigen::Index i = 0; i < samples.cols(); ++i) projected.col(i) = pca.project(samples.col(i));
  const Eigen::MatrixXf covariance =
      projected * projected.transpose() / static_cast<float>(samples.cols() - 1);
  const Eigen::MatrixXf expected = pca.variance.asDiagonal();
  EXPECT_LT((covariance - expected).cwiseAbs().maxCoeff(), 1e-4F * pca.variance[0]);
  EXPECT_LT(projected.rowwise().mean().cwiseAbs().maxCoeff(), 1e-4F);
}
INSTANTIATE_TEST_SUITE_P(Samples, PcaOf, testing::Values(15, 200));

TEST(Pca, OfFewSamplesHasOneComponentLess) {
  Rng rng(1);
  EXPECT_EQ(learn_pca(samples_of(20, 4, rng), 10).axes.cols(), 3);
}

TEST(Pca, ComponentsThatAreRoundingAreLeftOut) {
  Rng rng(1);
  const Eigen::MatrixXf plane = noise(8, 2, rng) * noise(2, 50, rng);
  EXPECT_EQ(learn_pca(plane, 8).axes.cols(), 2);
}

TEST(Pca, NeedsSamplesThatDiffer) {
  EXPECT_THROW(learn_pca(Eigen::MatrixXf::Ones(4, 1), 2), InputError);
  EXPECT_THROW(learn_pca(Eigen::MatrixXf::Ones(4, 5), 2), InputError);
}

TEST(Words, FindSeparateClusters) {
  Rng rng(1);
  Eigen::MatrixXf samples = 0.1F * noise(2, 300, rng);
  for (Eigen::Index i = 0; i < 300; ++i) samples(0, i) += static_cast<float>(10 * (i % 3));
  const Eigen::MatrixXf words = learn_words(samples, 3, 20, rng);
  const auto nearest = nearest_words(words, samples);
  for (std::size_t i = 0; i < 300; ++i) {
    EXPECT_EQ(nearest[i], nearest[i % 3]);
    EXPECT_LT((words.col(nearest[i]) - samples.col(static_cast<Eigen::Index>(i))).norm(), 1.0F);
  }
}

TEST(Words, SameSeedSameBits) {
  Rng data(1);
  const Eigen::MatrixXf samples = noise(5, 400, data);
  Rng a(7);
  Rng b(7);
  Rng other(8);
  const Eigen::MatrixXf words = learn_words(samples, 12, 10, a);
  EXPECT_EQ(words, learn_words(samples, 12, 10, b));
  EXPECT_NE(words, learn_words(samples, 12, 10, other));
}

TEST(Words, NoMoreThanSamplesAndNoneLost) {
  Rng rng(1);
  EXPECT_EQ(learn_words(noise(3, 4, rng), 10, 5, rng).cols(), 4);
  const Eigen::MatrixXf alike = Eigen::MatrixXf::Ones(3, 6);
  EXPECT_EQ(learn_words(alike, 2, 5, rng), Eigen::MatrixXf::Ones(3, 2));
}

TEST(Words, DistancesAreThoseOfTheDefinition) {
  Rng rng(1);
  const Eigen::MatrixXf words = noise(4, 3, rng);
  const Eigen::MatrixXf samples = noise(4, 5, rng);
  const Eigen::MatrixXf distances = squared_distances(words, samples);
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 5; ++j) {
      EXPECT_NEAR(distances(i, j), (words.col(i) - samples.col(j)).squaredNorm(), 1e-5);
    }
  }
}

TEST(SomeIndices, AreDrawnOnceAndEvenly) {
  Rng rng(1);
  std::vector<int> drawn(10, 0);
  for (int i = 0; i < 2000; ++i) {
    const auto indices = some_indices(10, 4, rng);
    ASSERT_EQ(indices.size(), 4U);
    for (std::size_t k = 0; k < 4; ++k) {
      ++drawn[static_cast<std::size_t>(indices[k])];
      if (k > 0) {
        ASSERT_LT(indices[k - 1], indices[k]);
      }
    }
  }
  for (const int count : drawn) EXPECT_NEAR(count, 800, 110);  // 5 standard deviations
  EXPECT_EQ(some_indices(3, 9, rng).size(), 3U);
}

TEST(Words, SettleInTheMiddleOfTheirSamples) {
  Eigen::MatrixXf samples(1, 5);
  samples << 0.0F, 10.0F, 1.0F, 11.0F, 12.0F;
  for (std::uint64_t seed = 1; seed < 9; ++seed) {
    Rng rng(seed);
    const Eigen::MatrixXf words = learn_words(samples, 2, 10, rng);
    ASSERT_EQ(words.cols(), 2);
    EXPECT_FLOAT_EQ(words.minCoeff(), 0.5F) << seed;
    EXPECT_FLOAT_EQ(words.maxCoeff(), 11.0F) << seed;
  }
}

TEST(Words, MoveToTheMeansOfTheirSamplesOnceAnIteration) {
  Rng data(1);
  const Eigen::MatrixXf samples = noise(3, 60, data);
  Eigen::MatrixXf words;
  for (int iterations = 0; iterations < 3; ++iterations) {
    Rng rng(7);
    const Eigen::MatrixXf learnt = learn_words(samples, 4, iterations, rng);
    if (iterations > 0) {
      const std::vector<int> nearest = nearest_words(words, samples);
      for (int k = 0; k < 4; ++k) {
        Eigen::Vector3f sum = Eigen::Vector3f::Zero();
        for (std::size_t i = 0; i < nearest.size(); ++i) {
          if (nearest[i] == k) sum += samples.col(static_cast<Eigen::Index>(i));
        }
        const auto count = static_cast<float>(std::ranges::count(nearest, k));
        EXPECT_LT((learnt.col(k) - sum / count).norm(), 1e-5F) << iterations << " " << k;
      }
    }
    words = learnt;
  }
}

/// Those that are words already are at no distance, and not drawn again.
TEST(Words, BeginAtSamplesThatDiffer) {
  Eigen::MatrixXf samples(2, 5);
  samples << 0.0F, 10.0F, 1.0F, 11.0F, 12.0F,  //
      3.0F, 3.0F, 4.0F, 5.0F, 3.0F;
  for (std::uint64_t seed = 1; seed < 9; ++seed) {
    Rng rng(seed);
    const Eigen::MatrixXf words = learn_words(samples, 5, 0, rng);
    ASSERT_EQ(words.cols(), 5);
    for (Eigen::Index i = 0; i < 5; ++i) {
      const auto off2 = (words.colwise() - samples.col(i)).colwise().squaredNorm().array();
      EXPECT_EQ((off2 == 0.0F).count(), 1) << seed << " " << i;
    }
  }
}

TEST(Words, EqualDistancesGoToTheLowerIndex) {
  Eigen::MatrixXf words(1, 3);
  words << 4.0F, 0.0F, 2.0F;
  Eigen::MatrixXf samples(1, 4);
  samples << 1.0F, 3.0F, 2.1F, 0.4F;
  EXPECT_EQ(nearest_words(words, samples), (std::vector<int>{1, 0, 2, 1}));
}

TEST(Words, EachOfManySamplesHasItsNearest) {
  Eigen::MatrixXf words(1, 2);
  words << 0.0F, 1.0F;
  Eigen::MatrixXf samples(1, 5000);
  for (Eigen::Index i = 0; i < 5000; ++i) samples(0, i) = i % 3 == 0 ? 0.9F : 0.2F;
  const std::vector<int> nearest = nearest_words(words, samples);
  ASSERT_EQ(nearest.size(), 5000U);
  for (std::size_t i = 0; i < 5000; ++i) ASSERT_EQ(nearest[i], i % 3 == 0 ? 1 : 0) << i;
}

TEST(SomeColumns, KeepTheirOrder) {
  Rng rng(2);
  Eigen::MatrixXf matrix(1, 6);
  matrix << 1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F;
  EXPECT_EQ(some_columns(matrix, 6, rng), matrix);
  const Eigen::MatrixXf some = some_columns(matrix, 3, rng);
  ASSERT_EQ(some.cols(), 3);
  EXPECT_LT(some(0, 0), some(0, 1));
  EXPECT_LT(some(0, 1), some(0, 2));
}

/// Views of 5, 2 and 4 columns that hold their own number.
TEST(SampledColumns, AreAsManyOfEachView) {
  Rng rng(3);
  std::vector<ObjectView> views(3);
  const std::vector<Eigen::Index> columns{5, 2, 4};
  for (std::size_t i = 0; i < 3; ++i) views[i].width_px = static_cast<int>(i);
  const auto columns_of = [&](const ObjectView& view) {
    const auto i = static_cast<std::size_t>(view.width_px);
    return Eigen::MatrixXf(Eigen::MatrixXf::Constant(2, columns[i], static_cast<float>(i)));
  };
  const Eigen::MatrixXf drawn = sampled_columns(views, 10, 7, rng, columns_of);
  ASSERT_EQ(drawn.rows(), 2);
  ASSERT_EQ(drawn.cols(), 3 + 2 + 3);
  for (Eigen::Index c = 0; c < 8; ++c) {
    EXPECT_EQ(drawn(1, c), c < 3 ? 0.0F : c < 5 ? 1.0F : 2.0F) << c;
  }
  EXPECT_EQ(sampled_columns(views, 10, 6, rng, columns_of).cols(), 2 + 2 + 2);
  const Eigen::MatrixXf of_two = sampled_columns(views, 2, 100, rng, columns_of);
  EXPECT_TRUE(of_two.cols() == 7 || of_two.cols() == 6 || of_two.cols() == 9) << of_two.cols();
  EXPECT_EQ(sampled_columns({}, 2, 100, rng, columns_of).size(), 0);
}

/// Samples on a line through (3, 1, 2) along (2, -1, 2) / 3, with variance 9 x 14 / 3.
TEST(Pca, OfALineIsItsDirection) {
  const Eigen::Vector3f along(2.0F, -1.0F, 2.0F);
  Eigen::MatrixXf samples(3, 4);
  const std::array<float, 4> at{-2.0F, -1.0F, 0.0F, 3.0F};
  for (std::size_t i = 0; i < 4; ++i) {
    samples.col(static_cast<Eigen::Index>(i)) = Eigen::Vector3f(3.0F, 1.0F, 2.0F) + at[i] * along;
  }
  const Pca pca = learn_pca(samples, 3);
  ASSERT_EQ(pca.axes.cols(), 1);
  EXPECT_LT((pca.mean - Eigen::Vector3f(3.0F, 1.0F, 2.0F)).norm(), 1e-5F);
  EXPECT_NEAR(std::abs(pca.axes.col(0).dot(along) / 3.0F), 1.0F, 1e-5F);
  EXPECT_NEAR(pca.variance[0], 42.0F, 1e-3F);
  EXPECT_NEAR(std::abs(pca.project(samples.col(3))[0]), 9.0F, 1e-4F);
}

TEST(FixSigns, TheLargestEntryOfEachColumnIsPositive) {
  Eigen::Matrix<double, 2, 3> columns;
  columns << 1.0, -3.0, 0.5,  //
      -2.0, 1.0, 4.0;
  fix_signs(columns);
  Eigen::Matrix<double, 2, 3> expected;
  expected << -1.0, 3.0, 0.5,  //
      2.0, -1.0, 4.0;
  EXPECT_EQ(columns, expected);
}

/// The corners of a rectangle, their variance across it that share of the one along it.
TEST(Pca, ComponentsBelowAMillionthOfTheFirstAreLeftOut) {
  const auto kept = [](double share) {
    const auto half = static_cast<float>(std::sqrt(share));
    Eigen::MatrixXf corners(2, 4);
    corners << 1.0F, 1.0F, -1.0F, -1.0F,  //
        half, -half, half, -half;
    return learn_pca(corners, 2).axes.cols();
  };
  EXPECT_EQ(kept(0.75e-6), 1);
  EXPECT_EQ(kept(1.25e-6), 2);
}

/// Of 0, 1 and 3 the first is any; after 0 it is 1 once and 3 nine times of ten, and so on.
TEST(Words, AreDrawnBySquaredDistance) {
  Eigen::MatrixXf samples(1, 3);
  samples << 0.0F, 1.0F, 3.0F;
  constexpr int kDrawn = 3000;
  std::array<int, 4> first{};
  std::array<int, 4> second{};
  Rng rng(5);
  for (int i = 0; i < kDrawn; ++i) {
    const Eigen::MatrixXf words = learn_words(samples, 2, 0, rng);
    ++first[static_cast<std::size_t>(words(0, 0))];
    ++second[static_cast<std::size_t>(words(0, 1))];
  }
  // Five standard deviations.
  EXPECT_NEAR(first[0], kDrawn / 3.0, 130.0);
  EXPECT_NEAR(first[3], kDrawn / 3.0, 130.0);
  EXPECT_NEAR(second[0], kDrawn * (1.0 / 5.0 + 9.0 / 13.0) / 3.0, 126.0);
  EXPECT_NEAR(second[1], kDrawn * (1.0 / 10.0 + 4.0 / 13.0) / 3.0, 95.0);
  EXPECT_NEAR(second[3], kDrawn * (9.0 / 10.0 + 4.0 / 5.0) / 3.0, 136.0);
}

}  // namespace
}  // namespace vantage
