#include "vantage/planners/objects/sampled_information.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

#include "tests/planners/objects/small_models.hpp"
#include "tests/support/near_duplicate_families.hpp"
#include "vantage/information/discrete.hpp"
#include "vantage/planners/objects/information_measure.hpp"

namespace vantage {
namespace {

using test::about;

/// I(state; f) of a feature of one dimension, by the trapezium rule.
double integrated_information_bits(const ObservationModel& model, const std::vector<double>& b) {
  const auto density = [&](int i, double x) {
    const auto v = static_cast<double>(model.variance(0, i));
    const double d = x - static_cast<double>(model.mean(0, i));
    return std::exp(-0.5 * d * d / v) / std::sqrt(2.0 * M_PI * v);
  };
  double bits = 0.0;
  constexpr double kStep = 1e-3;
  for (double x = -30.0; x < 30.0; x += kStep) {
    double mixture = 0.0;
    for (int i = 0; i < model.states(); ++i)
      mixture += b[static_cast<std::size_t>(i)] * density(i, x);
    for (int i = 0; i < model.states(); ++i) {
      const double p = density(i, x);
      if (p > 0.0) bits += kStep * b[static_cast<std::size_t>(i)] * p * std::log2(p / mixture);
    }
  }
  return bits;
}

/// A feature each of whose dimensions is there `times` times over, and says so.
ObservationModel repeated(const ObservationModel& model, int times) {
  ObservationModel many = model;
  many.mean = model.mean.replicate(times, 1);
  many.variance = model.variance.replicate(times, 1);
  many.psi = model.psi / times;
  return many;
}

TEST(SampledInformation, AgreesWithTheIntegral) {
  auto model = test::scalar_model({0.0F, 1.0F, 3.0F});
  model.variance << 1.0F, 0.25F, 4.0F;
  const std::vector<double> b{0.5, 0.2, 0.3};
  const ObservationModel* feature = &model;
  Rng rng(1);
  const auto sampled = sampled_information(about({&feature, 1}, b), 20'000, rng);
  EXPECT_NEAR(sampled.bits, integrated_information_bits(model, b),
              4.0 * sampled.standard_error_bits);
  EXPECT_LT(sampled.standard_error_bits, 0.01);
}

/// The error of the mean of n samples of H(b) - H(b | f), whose variance is an integral too.
TEST(SampledInformation, KnowsItsStandardError) {
  const auto model = test::scalar_model({0.0F, 1.5F});
  const std::vector<double> b{0.5, 0.5};
  double mean = 0.0;
  double square = 0.0;
  constexpr double kStep = 1e-3;
  for (double x = -12.0; x < 13.0; x += kStep) {
    const double p = 0.5 * std::exp(-0.5 * x * x) / std::sqrt(2.0 * M_PI);
    const double q = 0.5 * std::exp(-0.5 * (x - 1.5) * (x - 1.5)) / std::sqrt(2.0 * M_PI);
    const std::vector<double> posterior{p / (p + q), q / (p + q)};
    const double lost_bits = 1.0 - entropy_bits(posterior);
    mean += kStep * (p + q) * lost_bits;
    square += kStep * (p + q) * lost_bits * lost_bits;
  }
  const ObservationModel* feature = &model;
  Rng rng(4);
  const auto sampled = sampled_information(about({&feature, 1}, b), 20'001, rng);
  const double expected = std::sqrt((square - mean * mean) / 20'000.0);
  EXPECT_NEAR(sampled.standard_error_bits, expected, 0.03 * expected);
}

/// Half of the samples tell all of 1.5 bits, the others leave one of them open.
TEST(SampledInformation, ItsStandardErrorIsOfOneSampleLess) {
  const auto model = test::scalar_model({0.0F, 100.0F, 100.0F});
  const ObservationModel* feature = &model;
  for (const int samples : {2, 4}) {
    Rng rng(1);
    const auto sampled = sampled_information(about({&feature, 1}, {0.5, 0.25, 0.25}), samples, rng);
    EXPECT_NEAR(sampled.bits, 1.0, 1e-12);
    EXPECT_NEAR(sampled.standard_error_bits, 0.5 / std::sqrt(samples - 1.0), 1e-12);
  }
}

TEST(SampledInformation, OfARepeatedFeatureIsThatOfItsParts) {
  auto model = test::scalar_model({0.0F, 1.0F, 3.0F});
  model.variance << 1.0F, 0.8F, 1.3F;
  const std::vector<double> b{0.5, 0.2, 0.3};
  const ObservationModel* feature = &model;
  Rng rng(2);
  const double bound_bits = MutualInformation{}(about({&feature, 1}, b), rng).bits;
  const auto many = repeated(model, 40);
  feature = &many;
  const auto sampled = sampled_information(about({&feature, 1}, b), 20'000, rng);
  EXPECT_NEAR(sampled.bits, integrated_information_bits(model, b), 0.02);
  EXPECT_NEAR(MutualInformation{}(about({&feature, 1}, b), rng).bits, bound_bits, 1e-4);
  // The wider Gaussian that psi could also mean would be told by its many variances.
  auto wider = many;
  wider.variance /= static_cast<float>(many.psi);
  wider.psi = 1.0;
  feature = &wider;
  EXPECT_GT(sampled_information(about({&feature, 1}, b), 2000, rng).bits, sampled.bits + 0.1);
}

TEST(SampledInformation, OfEqualVariancesIsThatOfAWiderGaussian) {
  auto model = test::scalar_model({0.0F, 3.0F}, 1.0F);
  model.psi = 0.25;
  const ObservationModel* feature = &model;
  const std::vector<double> b{0.5, 0.5};
  Rng rng(3);
  const auto sampled = sampled_information(about({&feature, 1}, b), 20'000, rng);
  EXPECT_NEAR(sampled.bits, integrated_information_bits(test::scalar_model({0.0F, 3.0F}, 4.0F), b),
              4.0 * sampled.standard_error_bits);
}

TEST(SampledInformation, IsWhatAFilterLosesOnMeasurements) {
  const auto families = test::near_duplicate_families(3, 4, 3);
  Rng rng(5);
  const auto model = test::near_duplicate_model(families, 30, 2.0, {}, rng);
  const int states = families.states.size();
  const Eigen::VectorXd prior = Eigen::VectorXd::Constant(states, 1.0 / states);
  const auto entropy = [](const Eigen::VectorXd& b) {
    return entropy_bits({b.data(), static_cast<std::size_t>(b.size())});
  };
  double lost_bits = 0.0;
  constexpr int kMeasurements = 4800;
  for (int s = 0; s < kMeasurements; ++s) {
    const auto log_p = test::measured_log_likelihoods(model, s % states, rng);
    lost_bits += (entropy(prior) - entropy(test::updated(prior, log_p))) / kMeasurements;
  }
  const ObservationModel* feature = &model;
  const std::vector<double> b(prior.begin(), prior.end());
  const auto sampled = sampled_information(about({&feature, 1}, b), kMeasurements, rng);
  EXPECT_NEAR(sampled.bits, lost_bits, 4.0 * std::sqrt(2.0) * sampled.standard_error_bits);
}

TEST(SampledInformation, IsTheSameForTheSameSeed) {
  const auto model = test::scalar_model({0.0F, 1.0F});
  const ObservationModel* feature = &model;
  const auto query = about({&feature, 1}, {0.5, 0.5});
  Rng first(9);
  Rng second(9);
  Rng other(10);
  const double bits = sampled_information(query, 64, first).bits;
  EXPECT_EQ(sampled_information(query, 64, second).bits, bits);
  EXPECT_NE(sampled_information(query, 64, other).bits, bits);
}

TEST(SampledInformation, AboutGroupsLeavesOutWhatTellsTheirMembersApart) {
  // Poses are far apart; the objects differ in their second poses only.
  const auto model = test::scalar_model({0.0F, 100.0F, 0.0F, 200.0F});
  const ObservationModel* feature = &model;
  Rng rng(1);
  const std::vector<double> b(4, 0.25);
  EXPECT_NEAR(sampled_information(about({&feature, 1}, b, {0, 0, 1, 1}), 64, rng).bits, 0.5, 1e-9);
  EXPECT_NEAR(sampled_information(about({&feature, 1}, b), 64, rng).bits, 1.5, 1e-9);
}

RC_GTEST_PROP(InformationAtMeans, IsTheFormula, ()) {
  auto model = test::random_model(4, false);
  model.psi = *rc::gen::element(0.5, 1.0);
  const auto b = test::random_weights(4);
  double bits = entropy_bits(b);
  for (int i = 0; i < 4; ++i) {
    std::vector<double> posterior;
    double sum = 0.0;
    for (int j = 0; j < 4; ++j) {
      const double relative =
          test::log_likelihood_at_mean(model, i, j) - test::log_likelihood_at_mean(model, i, i);
      sum += posterior.emplace_back(b[static_cast<std::size_t>(j)] * std::exp(relative));
    }
    for (double& p : posterior) p /= sum;
    bits -= b[static_cast<std::size_t>(i)] * entropy_bits(posterior);
  }
  const ObservationModel* feature = &model;
  RC_ASSERT(std::abs(information_at_means_bits(about({&feature, 1}, b)) - bits) < 1e-4);
}

TEST(SampledInformation, DrawsNothingOfAFeatureThatIsIgnored) {
  ObservationModel ignored = test::scalar_model({0.0F, 5.0F, 1.0F});
  ignored.psi = 0.0;
  const ObservationModel model = test::scalar_model({0.0F, 1.0F, 3.0F});
  const std::vector<double> b{0.5, 0.2, 0.3};
  const std::vector<const ObservationModel*> both{&ignored, &model};
  const std::vector<const ObservationModel*> one{&model};
  Rng rng(3);
  Rng again(3);
  EXPECT_EQ(sampled_information(about(both, b), 100, rng).bits,
            sampled_information(about(one, b), 100, again).bits);
}

}  // namespace
}  // namespace vantage
