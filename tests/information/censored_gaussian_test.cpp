// Gaussians of which a lower bound was read, against closed forms and integrals.
#include "vantage/information/censored_gaussian.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vantage {
namespace {

TEST(LogUpperTail, IsThatOfTheTables) {
  EXPECT_NEAR(log_upper_tail(0.0), std::log(0.5), 1e-15);
  EXPECT_NEAR(std::exp(log_upper_tail(1.959963984540054)), 0.025, 1e-15);
  EXPECT_NEAR(std::exp(log_upper_tail(-1.0)), 0.841344746068543, 1e-14);
  EXPECT_NEAR(log_upper_tail(-40.0), 0.0, 1e-300);
}

/// Far out by the asymptotic series, which there is as good as exact.
TEST(LogUpperTail, IsANumberWhereTheProbabilityIsNone) {
  for (const double z : {30.0, 40.0, 1000.0}) {
    const double z2 = z * z;
    const double series = std::log1p(-1.0 / z2 + 3.0 / (z2 * z2) - 15.0 / (z2 * z2 * z2));
    EXPECT_NEAR(log_upper_tail(z),
                -0.5 * z2 - std::log(z * std::sqrt(2.0 * std::numbers::pi)) + series, 1e-9 * z2);
  }
  EXPECT_TRUE(std::isfinite(log_upper_tail(1e6)));
}

TEST(LogUpperTail, ItsTwoFormulasMeet) {
  EXPECT_NEAR(log_upper_tail(std::nextafter(12.0, 0.0)), log_upper_tail(12.0), 1e-12);
}

/// The mass above the reading, by Simpson's rule.
TEST(CensoredGaussian, ALowerBoundHasTheMassAboveIt) {
  constexpr double kMean = 0.2;
  constexpr double kVariance = 0.0009;
  for (const double value : {0.1, 0.19, 0.2, 0.23, 0.29}) {
    constexpr int kSteps = 20'000;
    const double far = kMean + 12.0 * std::sqrt(kVariance);
    const double step = (far - value) / kSteps;
    double mass = 0.0;
    for (int i = 0; i <= kSteps; ++i) {
      const double weight = i == 0 || i == kSteps ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
      mass += weight * step / 3.0 *
              std::exp(log_likelihood(Reading::exact, value + i * step, kMean, kVariance));
    }
    EXPECT_NEAR(std::exp(log_likelihood(Reading::at_least, value, kMean, kVariance)), mass, 1e-9);
  }
}

TEST(CensoredGaussian, IsTheDensityOrTheMassAboveIt) {
  EXPECT_NEAR(log_likelihood(Reading::exact, 1.9, 1.5, 0.25), -0.5457913526447274, 1e-9);
  EXPECT_NEAR(log_likelihood(Reading::at_least, 1.9, 1.5, 0.25), -1.5518513191877765, 1e-9);
}

TEST(CensoredGaussian, ABoundRulesOutWhatIsSmallerAndNothingElse) {
  constexpr double kVariance = 0.01 * 0.01;
  const auto of = [&](double mean) {
    return log_likelihood(Reading::at_least, 0.10, mean, kVariance);
  };
  EXPECT_LT(of(0.05), -10.0);
  EXPECT_NEAR(of(0.20), 0.0, 1e-12) << "anything larger agrees with it";
  EXPECT_NEAR(of(0.30), of(0.20), 1e-12);
  EXPECT_EQ(log_likelihood(Reading::none, 0.10, 5.0, kVariance), 0.0);
}

}  // namespace
}  // namespace vantage
