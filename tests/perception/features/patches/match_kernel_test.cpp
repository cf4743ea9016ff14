#include "vantage/perception/features/patches/match_kernel.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

PatchSet random_patches(Eigen::Index count, Rng& rng) {
  const auto normal = [&] { return static_cast<float>(rng.normal()); };
  const auto uniform = [&] { return static_cast<float>(rng.uniform()); };
  return {Eigen::MatrixXf::NullaryExpr(6, count, normal),
          Eigen::Matrix2Xf::NullaryExpr(2, count, uniform)};
}

Eigen::MatrixXf random_words(Rng& rng) { return random_patches(10, rng).descriptors; }

double kernel(const Eigen::VectorXf& a, const Eigen::VectorXf& b, double gamma) {
  return std::exp(-gamma * static_cast<double>((a - b).squaredNorm()));
}

/// Mean kernel vector of the patches in [x0, x1) x [y0, y1), by the definition.
Eigen::VectorXd mean_kernels(const PatchSet& patches, const Eigen::MatrixXf& words, double gamma,
                             float x0, float x1, float y0, float y1) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(words.cols());
  int count = 0;
  for (Eigen::Index w = 0; w < words.cols(); ++w) {
    double best = -1.0;
    Eigen::Index winner = 0;
    for (Eigen::Index p = 0; p < patches.size(); ++p) {
      const float x = patches.places(0, p);
      const float y = patches.places(1, p);
      if (x < x0 || x >= x1 || y < y0 || y >= y1) continue;
      const auto patch = patches.descriptors.col(p);
      const double to_word = kernel(patch, words.col(w), gamma);
      bool nearest = true;
      for (Eigen::Index v = 0; v < words.cols(); ++v) {
        nearest = nearest && kernel(patch, words.col(v), gamma) <= to_word;
      }
      if (nearest && to_word > best) {
        best = to_word;
        winner = p;
      }
    }
    if (best < 0.0) continue;
    for (Eigen::Index v = 0; v < words.cols(); ++v) {
      sum[v] += kernel(patches.descriptors.col(winner), words.col(v), gamma);
    }
    ++count;
  }
  return count > 0 ? Eigen::VectorXd(sum / count) : sum;
}

TEST(PooledKernels, AreMeansOfTheBestPatchesOfEachCell) {
  Rng rng(1);
  const MatchOptions options{.gamma = 0.1, .words = 10, .levels = 2};
  const Eigen::MatrixXf words = random_words(rng);
  const PatchSet patches = random_patches(40, rng);
  const Eigen::VectorXf pooled = pooled_kernels(patches, words, options);
  ASSERT_EQ(pooled.size(), 5 * 10);
  const Eigen::VectorXd whole = mean_kernels(patches, words, 0.1, 0, 1, 0, 1);
  EXPECT_LT((pooled.head(10).cast<double>() - 0.8 * whole).norm(), 1e-5);
  const Eigen::VectorXd lower_left = mean_kernels(patches, words, 0.1, 0, 0.5F, 0.5F, 1);
  EXPECT_LT((pooled.segment(30, 10).cast<double>() - 0.2 * lower_left).norm(), 1e-5);
}

TEST(PooledKernels, EmptyCellsAreZero) {
  Rng rng(1);
  const Eigen::MatrixXf words = random_words(rng);
  PatchSet patches = random_patches(5, rng);
  patches.places.setConstant(0.1F);
  const Eigen::VectorXf pooled = pooled_kernels(patches, words, {.gamma = 0.1, .levels = 2});
  EXPECT_GT(pooled.segment(10, 10).norm(), 0.0F);
  EXPECT_TRUE(pooled.tail(30).isZero());
}

// <G k_x, G k_y> = k_x' K^-1 k_y
TEST(InverseRoot, InnerProductsAreTheMatchKernel) {
  Rng rng(1);
  const Eigen::MatrixXf words = random_words(rng);
  Eigen::MatrixXd gram(10, 10);
  for (Eigen::Index i = 0; i < 10; ++i) {
    for (Eigen::Index j = 0; j < 10; ++j) gram(i, j) = kernel(words.col(i), words.col(j), 0.1);
  }
  gram.diagonal().array() += 1e-6;
  const Eigen::MatrixXd root = inverse_root(words, 0.1);
  const Eigen::MatrixXd inverse = gram.inverse();
  EXPECT_LT((root.transpose() * root - inverse).norm(), 1e-4 * inverse.norm());
}

/// K = (1 + r, 1; 1, 1 + r), of which the last entry of L is sqrt(2 r) but for a millionth.
TEST(InverseRoot, TheRidgeIsAMillionth) {
  const Eigen::MatrixXd root = inverse_root(Eigen::MatrixXf::Ones(3, 2), 0.1);
  EXPECT_NEAR(root(0, 0), 1.0 - 0.5e-6, 1e-9);
  EXPECT_NEAR(root(1, 1), std::sqrt(0.5e6), 1e-2);
}

TEST(InverseRoot, ExistsForWordsThatAreAlike) {
  const Eigen::MatrixXd root = inverse_root(Eigen::MatrixXf::Constant(200, 50, 3.0F), 0.1);
  EXPECT_TRUE(root.allFinite());
}

// The fused map does what its parts do one after the other: centred, uncorrelated, then a power.
TEST(MatchKernel, ComponentsOfTheTrainingViewsAreUncorrelated) {
  Rng rng(1);
  const MatchOptions options{
      .gamma = 0.1, .words = 10, .levels = 2, .components = 20, .power = 1.0};
  const Eigen::MatrixXf words = random_words(rng);
  std::vector<PatchSet> views;
  Eigen::MatrixXf pooled(50, 60);
  for (Eigen::Index v = 0; v < 60; ++v) {
    views.push_back(random_patches(30, rng));
    pooled.col(v) = pooled_kernels(views.back(), words, options);
  }
  const MatchKernel match = MatchKernel::learn(options, words, pooled);
  ASSERT_EQ(match.dimension(), 20);
  Eigen::MatrixXf components(20, 60);
  for (Eigen::Index v = 0; v < 60; ++v) {
    components.col(v) = match.extract(views[static_cast<std::size_t>(v)]);
  }
  EXPECT_LT(components.rowwise().mean().cwiseAbs().maxCoeff(), 1e-4F);
  const Eigen::MatrixXf covariance = components * components.transpose();
  const Eigen::MatrixXf diagonal = covariance.diagonal().asDiagonal();
  EXPECT_LT((covariance - diagonal).cwiseAbs().maxCoeff(), 1e-3F * covariance(0, 0));
}

TEST(MatchKernel, ThePowerKeepsSigns) {
  Rng rng(1);
  const Eigen::MatrixXf words = random_words(rng);
  Eigen::MatrixXf pooled(10, 30);
  MatchOptions options{.gamma = 0.1, .words = 10, .levels = 1, .components = 5, .power = 1.0};
  for (Eigen::Index v = 0; v < 30; ++v) {
    pooled.col(v) = pooled_kernels(random_patches(20, rng), words, options);
  }
  const PatchSet patches = random_patches(20, rng);
  const Eigen::VectorXf plain = MatchKernel::learn(options, words, pooled).extract(patches);
  options.power = 0.3;
  const Eigen::VectorXf powered = MatchKernel::learn(options, words, pooled).extract(patches);
  for (Eigen::Index i = 0; i < 5; ++i) {
    EXPECT_NEAR(powered[i], std::copysign(std::pow(std::abs(plain[i]), 0.3F), plain[i]), 1e-5);
  }
}

}  // namespace
}  // namespace vantage
