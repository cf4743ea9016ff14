#include "vantage/information/log_space.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/information/distributions.hpp"
#include "vantage/information/discrete.hpp"

namespace vantage {
namespace {

using test::random_distribution;
using test::random_joint;
using ::testing::HasSubstr;
using Vector = std::vector<double>;

constexpr double kLogTolerance = 1e-9;
constexpr double kLogInfinity = std::numeric_limits<double>::infinity();
constexpr double kLogNan = std::numeric_limits<double>::quiet_NaN();

Vector log_of(const Vector& p) {
  Vector logs;
  for (const double mass : p) logs.push_back(std::log(mass));
  return logs;
}

bool nearly(double a, double b) { return a == b || std::abs(a - b) < kLogTolerance; }

TEST(LogSumExp, SurvivesWhereTheLinearSumWouldNot) {
  EXPECT_NEAR(log_sum_exp(Vector{3200.0, 3200.0}), 3200.0 + std::numbers::ln2, 1e-9);
  EXPECT_NEAR(log_sum_exp(Vector{-5000.0, -5000.0}), -5000.0 + std::numbers::ln2, 1e-9);
  EXPECT_DOUBLE_EQ(log_sum_exp(Vector{-kLogInfinity, 2.5}), 2.5);
  EXPECT_EQ(log_sum_exp(Vector{-kLogInfinity, -kLogInfinity}), -kLogInfinity);
}

TEST(NormaliseLog, MakesADistributionAndReturnsTheNormaliser) {
  Vector logs{3200.0, 3200.0 + std::log(3.0), -kLogInfinity};
  EXPECT_NEAR(normalise_log(logs), 3200.0 + std::log(4.0), 1e-9);
  EXPECT_NEAR(std::exp(logs[0]), 0.25, 1e-9);
  EXPECT_NEAR(std::exp(logs[1]), 0.75, 1e-9);
  EXPECT_EQ(logs[2], -kLogInfinity);
}

TEST(LogSpaceEntropy, CountsOutcomesTooRareForTheLinearSpace) {
  Vector logs{0.0, -800.0};  // exp(-800) underflows
  EXPECT_EQ(entropy_bits_from_log(logs), 0.0);
  EXPECT_DOUBLE_EQ(entropy_bits_from_log(log_of({0.25, 0.25, 0.5, 0.0})), 1.5);
}

TEST(LogSpaceDivergence, StaysFiniteWhereTheLinearQWouldUnderflow) {
  const Vector log_p{-std::numbers::ln2, -std::numbers::ln2};
  const Vector log_q{0.0, -1000.0};
  const double expected = -1.0 + 500.0 * std::numbers::log2e;
  EXPECT_NEAR(kl_divergence_bits_from_log(log_p, log_q), expected, 1e-9);
  EXPECT_EQ(kl_divergence_bits_from_log(log_p, Vector{0.0, -kLogInfinity}), kLogInfinity);
}

TEST(LogSpaceDivergence, IsInfiniteHoweverRareTheOutcomeThatQRulesOut) {
  const Vector log_p{0.0, -800.0};  // exp(-800) underflows
  const Vector log_q{0.0, -kLogInfinity};
  EXPECT_EQ(kl_divergence_bits_from_log(log_p, log_q), kLogInfinity);
  EXPECT_EQ(kl_divergence_bits_from_log(log_q, log_p), 0.0);
  EXPECT_EQ(jeffreys_divergence_bits_from_log(log_p, log_q), kLogInfinity);
  EXPECT_EQ(jeffreys_divergence_bits_from_log(log_q, log_p), kLogInfinity);
}

TEST(LogSpaceValidation, NamesTheOffendingValue) {
  const auto expect_message = [](auto call, const std::string& part) {
    try {
      call();
      ADD_FAILURE() << "nothing thrown, expected: " << part;
    } catch (const DistributionError& error) {
      EXPECT_THAT(error.what(), HasSubstr(part));
    }
  };
  expect_message([] { log_sum_exp(Vector{}); }, "empty");
  expect_message([] { log_sum_exp(Vector{0.0, kLogNan}); }, "entry 1 = nan");
  expect_message([] { log_sum_exp(Vector{kLogInfinity}); }, "entry 0 = inf");
  expect_message([] { entropy_bits_from_log(Vector{0.0, 0.0}); }, "sum to 2");
  expect_message([] { entropy_bits_from_log(Vector{-kLogInfinity}); }, "sum to 0");
  expect_message(
      [] {
        kl_divergence_bits_from_log(Vector{0.0}, Vector{0.0, -kLogInfinity});
      },
      "p has 1 entries, q has 2");
  expect_message([] { mutual_information_bits_from_log(Eigen::MatrixXd::Zero(2, 2)); }, "sum to 4");
  Vector nothing{-kLogInfinity, -kLogInfinity};
  expect_message([&] { normalise_log(nothing); }, "every entry is -inf");
}

TEST(LogSpaceValidation, SumsMayBeOffByAMillionth) {
  for (const double off : {-0.9e-6, 0.9e-6}) {
    EXPECT_NO_THROW(entropy_bits_from_log(log_of({0.25, 0.75 + off})));
  }
  for (const double off : {-1.5e-6, 1.5e-6}) {
    EXPECT_THROW(entropy_bits_from_log(log_of({0.25, 0.75 + off})), DistributionError);
  }
}

TEST(LogSumExp, CountsEachEntry) {
  EXPECT_NEAR(log_sum_exp(Vector{-1.0, 0.5, 2.0}), 2.241311296657157, 1e-9);
}

RC_GTEST_PROP(LogSpaceProperty, VectorMeasuresEqualTheLinearOnes, ()) {
  const Vector p = random_distribution();
  const Vector q = random_distribution(p.size());
  const Vector log_p = log_of(p);
  const Vector log_q = log_of(q);
  RC_ASSERT(nearly(entropy_bits_from_log(log_p), entropy_bits(p)));
  RC_ASSERT(nearly(kl_divergence_bits_from_log(log_p, log_q), kl_divergence_bits(p, q)));
  RC_ASSERT(
      nearly(jeffreys_divergence_bits_from_log(log_p, log_q), jeffreys_divergence_bits(p, q)));
}

RC_GTEST_PROP(LogSpaceProperty, JointMeasuresEqualTheLinearOnes, ()) {
  const Eigen::MatrixXd p = random_joint();
  const Eigen::MatrixXd logs = p.array().log();
  RC_ASSERT(nearly(joint_entropy_bits_from_log(logs), joint_entropy_bits(p)));
  RC_ASSERT(nearly(conditional_entropy_bits_from_log(logs), conditional_entropy_bits(p)));
  RC_ASSERT(nearly(mutual_information_bits_from_log(logs), mutual_information_bits(p)));
}

RC_GTEST_PROP(LogSpaceProperty, NormalisingTakesAwayAnyOffset, (int offset)) {
  Vector logs = log_of(random_distribution());
  const Vector expected = logs;
  for (double& entry : logs) entry += offset % 5000;
  normalise_log(logs);
  for (std::size_t i = 0; i < logs.size(); ++i) RC_ASSERT(nearly(logs[i], expected[i]));
}

}  // namespace
}  // namespace vantage
