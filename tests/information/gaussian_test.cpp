#include "vantage/information/gaussian.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

namespace vantage {
namespace {

using ::testing::HasSubstr;

constexpr double kGaussianTolerance = 1e-9;

DiagonalGaussian gaussian(std::initializer_list<double> mean,
                          std::initializer_list<double> variance) {
  DiagonalGaussian g;
  g.mean = Eigen::Map<const Eigen::VectorXd>(mean.begin(), static_cast<Eigen::Index>(mean.size()));
  g.variance = Eigen::Map<const Eigen::VectorXd>(variance.begin(),
                                                 static_cast<Eigen::Index>(variance.size()));
  return g;
}

DiagonalGaussian random_gaussian(int size) {
  DiagonalGaussian g;
  g.mean.resize(size);
  g.variance.resize(size);
  for (int i = 0; i < size; ++i) {
    g.mean[i] = *rc::gen::inRange(-500, 500) / 100.0;
    g.variance[i] = *rc::gen::inRange(1, 1000) / 100.0;
  }
  return g;
}

bool same(double a, double b) {
  return std::abs(a - b) <= kGaussianTolerance * (1.0 + std::abs(a));
}

/// Of one dimension.
double log_density(const DiagonalGaussian& g, double x) {
  const double d = x - g.mean[0];
  return -0.5 * (d * d / g.variance[0] + std::log(2.0 * M_PI * g.variance[0]));
}

/// KL by the trapezium rule, one dimension.
double numeric_kl_nats(const DiagonalGaussian& p, const DiagonalGaussian& q) {
  const double sigma = std::sqrt(p.variance[0]);
  const double step = sigma / 1000.0;
  double sum = 0.0;
  for (double x = p.mean[0] - 10.0 * sigma; x < p.mean[0] + 10.0 * sigma; x += step) {
    sum += std::exp(log_density(p, x)) * (log_density(p, x) - log_density(q, x));
  }
  return sum * step;
}

TEST(GaussianKl, KnownAnswers) {
  const auto standard = gaussian({0.0}, {1.0});
  EXPECT_NEAR(gaussian_kl_divergence_nats(gaussian({1.0}, {1.0}), standard), 0.5,
              kGaussianTolerance);
  EXPECT_NEAR(gaussian_kl_divergence_nats(gaussian({0.0}, {4.0}), standard),
              0.5 * (3.0 - std::log(4.0)), kGaussianTolerance);
  EXPECT_NEAR(gaussian_kl_divergence_bits(gaussian({1.0}, {1.0}), standard), 0.5 / std::log(2.0),
              kGaussianTolerance);
  EXPECT_NEAR(gaussian_jeffreys_divergence_nats(gaussian({1.0, 0.0}, {1.0, 4.0}),
                                                gaussian({0.0, 0.0}, {1.0, 1.0})),
              1.0 + 0.5 * (4.0 + 0.25 - 2.0), kGaussianTolerance);
}

TEST(GaussianKl, AgreesWithTheIntegral) {
  const auto p = gaussian({0.3}, {0.7});
  const auto q = gaussian({-0.4}, {2.1});
  EXPECT_NEAR(gaussian_kl_divergence_nats(p, q), numeric_kl_nats(p, q), 1e-6);
  EXPECT_NEAR(gaussian_kl_divergence_nats(q, p), numeric_kl_nats(q, p), 1e-6);
}

TEST(GaussianJeffreys, AgreesWithTheIntegral) {
  const auto p = gaussian({0.3}, {0.7});
  const auto q = gaussian({-0.4}, {2.1});
  EXPECT_NEAR(gaussian_jeffreys_divergence_nats(p, q),
              numeric_kl_nats(p, q) + numeric_kl_nats(q, p), 1e-6);
}

TEST(GaussianBhattacharyya, KnownAnswers) {
  const auto standard = gaussian({0.0, 0.0}, {1.0, 1.0});
  EXPECT_NEAR(gaussian_bhattacharyya_distance_nats(gaussian({2.0, 0.0}, {1.0, 1.0}), standard), 0.5,
              kGaussianTolerance);
  EXPECT_NEAR(gaussian_bhattacharyya_distance_nats(gaussian({0.0, 0.0}, {1.0, 4.0}), standard),
              0.5 * std::log(1.25), kGaussianTolerance);
  EXPECT_NEAR(gaussian_bhattacharyya_distance_bits(gaussian({2.0, 0.0}, {1.0, 1.0}), standard),
              0.5 / std::log(2.0), kGaussianTolerance);
}

TEST(GaussianBhattacharyya, AgreesWithTheIntegral) {
  const auto p = gaussian({0.3}, {0.7});
  const auto q = gaussian({-0.4}, {2.1});
  double overlap = 0.0;
  for (double x = -20.0; x < 20.0; x += 1e-3) {
    overlap += 1e-3 * std::exp(0.5 * (log_density(p, x) + log_density(q, x)));
  }
  EXPECT_NEAR(gaussian_bhattacharyya_distance_nats(p, q), -std::log(overlap), 1e-6);
}

TEST(GaussianValidation, NamesTheOffendingValue) {
  const auto good = gaussian({0.0}, {1.0});
  const auto message = [&](const DiagonalGaussian& p, const DiagonalGaussian& q) -> std::string {
    try {
      gaussian_kl_divergence_nats(p, q);
    } catch (const DistributionError& error) {
      return error.what();
    }
    return "nothing thrown";
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(message(good, gaussian({0.0}, {-2.0})), HasSubstr("q.variance[0] = -2"));
  EXPECT_THAT(message(gaussian({0.0}, {0.0}), good), HasSubstr("p.variance[0] = 0"));
  EXPECT_THAT(message(gaussian({nan}, {1.0}), good), HasSubstr("p.mean[0] = nan"));
  EXPECT_THAT(message(gaussian({0.0, 1.0}, {1.0, 1.0}), good), HasSubstr("2 dimensions, q has 1"));
  EXPECT_THAT(message(gaussian({0.0}, {1.0, 2.0}), good), HasSubstr("1 means and 2 variances"));
  EXPECT_THAT(message(gaussian({}, {}), gaussian({}, {})), HasSubstr("0 means"));
}

TEST(GaussianDivergences, AddUpOverDimensions) {
  const auto p = gaussian({0.3, -0.8}, {0.7, 2.5});
  const auto q = gaussian({-0.4, 0.5}, {2.1, 0.9});
  EXPECT_NEAR(gaussian_kl_divergence_nats(p, q), 1.6495916316791757, kGaussianTolerance);
  EXPECT_NEAR(gaussian_bhattacharyya_distance_nats(p, q), 0.30251679547230115, kGaussianTolerance);
}

TEST(GaussianValidation, TakesFiniteNumbersOnly) {
  const auto good = gaussian({0.0, 1.0}, {1.0, 2.0});
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(gaussian_jeffreys_divergence_nats(good, gaussian({0.0, infinity}, {1.0, 2.0})),
               DistributionError);
  EXPECT_THROW(gaussian_bhattacharyya_distance_nats(gaussian({0.0, 1.0}, {1.0, infinity}), good),
               DistributionError);
  EXPECT_THROW(gaussian_kl_divergence_nats(gaussian({0.0, 1.0}, {1.0, 0.0}), good),
               DistributionError);
}

RC_GTEST_PROP(GaussianProperty, JeffreysIsTheSymmetricSumOfKl, ()) {
  const int size = *rc::gen::inRange(1, 6);
  const auto p = random_gaussian(size);
  const auto q = random_gaussian(size);
  const double j = gaussian_jeffreys_divergence_nats(p, q);
  const double sum = gaussian_kl_divergence_nats(p, q) + gaussian_kl_divergence_nats(q, p);
  RC_ASSERT(j >= 0.0);
  RC_ASSERT(same(j, sum));
  RC_ASSERT(same(j, gaussian_jeffreys_divergence_nats(q, p)));
  RC_ASSERT(gaussian_jeffreys_divergence_nats(p, p) == 0.0);
  RC_ASSERT(gaussian_kl_divergence_nats(p, p) == 0.0);
  RC_ASSERT(same(gaussian_jeffreys_divergence_bits(p, q), bits_from_nats(j)));
}

RC_GTEST_PROP(GaussianProperty, BhattacharyyaIsSymmetricAndAtMostAQuarterOfJeffreys, ()) {
  const int size = *rc::gen::inRange(1, 6);
  const auto p = random_gaussian(size);
  const auto q = random_gaussian(size);
  const double d = gaussian_bhattacharyya_distance_nats(p, q);
  RC_ASSERT(d >= 0.0);
  RC_ASSERT(same(d, gaussian_bhattacharyya_distance_nats(q, p)));
  RC_ASSERT(d <= 0.25 * gaussian_jeffreys_divergence_nats(p, q) + kGaussianTolerance);
  RC_ASSERT(gaussian_bhattacharyya_distance_nats(p, p) == 0.0);
}

}  // namespace
}  // namespace vantage
