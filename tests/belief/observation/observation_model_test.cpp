#include "vantage/belief/observation/observation_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

ObservationModel random_model(int dimensions, int states, Rng& rng) {
  ObservationModel model;
  model.mean = Eigen::MatrixXf::NullaryExpr(
      dimensions, states, [&] { return static_cast<float>(rng.uniform(-1.0, 1.0)); });
  model.variance = Eigen::MatrixXf::NullaryExpr(
      dimensions, states, [&] { return static_cast<float>(rng.uniform(0.01, 2.0)); });
  return model;
}

Eigen::VectorXf random_feature(int dimensions, Rng& rng) {
  return Eigen::VectorXf::NullaryExpr(dimensions, [&] { return static_cast<float>(rng.normal()); });
}

double log_normal(double x, double mean, double variance) {
  return -0.5 * (std::log(2.0 * std::numbers::pi * variance) + (x - mean) * (x - mean) / variance);
}

double density_by_definition(const ObservationModel& model, const Eigen::VectorXf& x, int state) {
  double sum = 0.0;
  for (int d = 0; d < model.dimensions(); ++d) {
    sum += log_normal(x[d], model.mean(d, state), model.variance(d, state));
  }
  return sum;
}

TEST(LogDensity, IsTheSumOverDimensions) {
  Rng rng(1);
  for (const int dimensions : {1, 3, 128, 129, 1000}) {
    const ObservationModel model = random_model(dimensions, 5, rng);
    const Eigen::VectorXf x = random_feature(dimensions, rng);
    const Eigen::VectorXd density = log_density(model, x);
    ASSERT_EQ(density.size(), 5);
    for (int j = 0; j < 5; ++j) {
      const double expected = density_by_definition(model, x, j);
      EXPECT_NEAR(density[j], expected, 1e-6 * std::abs(expected) + 1e-5) << dimensions;
    }
  }
}

TEST(LogLikelihood, IsTheDensityTimesPsi) {
  Rng rng(2);
  ObservationModel model = random_model(40, 6, rng);
  model.psi = 0.125;
  const Eigen::VectorXf x = random_feature(40, rng);
  EXPECT_TRUE(log_likelihood(model, x).isApprox(0.125 * log_density(model, x), 1e-14));
}

TEST(LogLikelihood, OfASkippedFeatureIsZeroEvenWhereTheDensityIs) {
  ObservationModel model;
  model.mean = Eigen::MatrixXf::Zero(1, 2);
  model.variance = Eigen::MatrixXf::Constant(1, 2, 1e-6F);
  const Eigen::VectorXf far = Eigen::VectorXf::Constant(1, 1e30F);
  EXPECT_EQ(log_likelihood(model, far)[0], -std::numeric_limits<double>::infinity());
  model.psi = 0.0;
  EXPECT_EQ(log_likelihood(model, far), Eigen::VectorXd::Zero(2));
  EXPECT_EQ(log_likelihood(prepare(model), far), Eigen::VectorXd::Zero(2));
}

TEST(PreparedObservationModel, SaysTheSame) {
  Rng rng(3);
  ObservationModel model = random_model(500, 8, rng);
  model.psi = 0.7;
  const Eigen::VectorXf x = random_feature(500, rng);
  const Eigen::VectorXd direct = log_likelihood(model, x);
  EXPECT_TRUE(log_likelihood(prepare(model), x).isApprox(direct, 1e-6));
}

TEST(LogDensityDeathTest, RefusesFeaturesThatAreNone) {
  Rng rng(4);
  const ObservationModel model = random_model(2, 2, rng);
  EXPECT_DEATH(log_density(model, Eigen::VectorXf::Zero(3)), "as many dimensions");
  EXPECT_DEATH(log_density(model, Eigen::VectorXf::Constant(2, NAN)), "finite");
}

/// Dimension by dimension: the density, the mass above, or nothing.
TEST(LogLikelihood, OfBoundsIsTheMassAboveThem) {
  Rng rng(5);
  ObservationModel model = random_model(3, 6, rng);
  model.psi = 0.7;
  const Eigen::VectorXf x = random_feature(3, rng);
  const std::vector<Reading> readings{Reading::at_least, Reading::exact, Reading::none};
  const Eigen::VectorXd got = log_likelihood(prepare(model), x, readings);
  for (int j = 0; j < 6; ++j) {
    const double z = (x[0] - model.mean(0, j)) / std::sqrt(model.variance(0, j));
    const double above = std::log(0.5 * std::erfc(z / std::numbers::sqrt2));
    const double expected =
        0.7 * (above + log_normal(x[1], model.mean(1, j), model.variance(1, j)));
    EXPECT_NEAR(got[j], expected, 1e-5 * std::abs(expected) + 1e-6) << j;
  }
}

TEST(LogLikelihood, OfExactReadingsIsThatWithoutReadings) {
  Rng rng(6);
  ObservationModel model = random_model(3, 6, rng);
  model.psi = 0.7;
  model.log_factor = Eigen::VectorXd::LinSpaced(6, -4.0, 6.0);
  const Eigen::VectorXf x = random_feature(3, rng);
  const PreparedObservationModel prepared = prepare(model);
  EXPECT_EQ(log_likelihood(prepared, x, {}), log_likelihood(prepared, x));
  const std::vector<Reading> exact(3, Reading::exact);
  EXPECT_TRUE(log_likelihood(prepared, x, exact).isApprox(log_likelihood(prepared, x), 1e-5));
}

TEST(LogLikelihood, OfReadingsThatTellNothingIsTheSameOfAllStates) {
  Rng rng(7);
  ObservationModel model = random_model(2, 6, rng);
  model.log_factor = Eigen::VectorXd::LinSpaced(6, -4.0, 6.0);
  const std::vector<Reading> none(2, Reading::none);
  EXPECT_TRUE(log_likelihood(prepare(model), random_feature(2, rng), none).isZero(0.0));
}

/// Factors say what a whole feature tells of the unknown; a bound that all states fulfil tells of
/// none.
TEST(LogLikelihood, OfBoundsHasAsMuchOfTheFactorsAsNumbersAreExact) {
  ObservationModel model{.feature = "height",
                         .mean = Eigen::MatrixXf::Zero(2, 3),
                         .variance = Eigen::MatrixXf::Ones(2, 3),
                         .psi = 0.5,
                         .log_factor = Eigen::Vector3d(0.0, 3.0, kRulesOut)};
  const PreparedObservationModel prepared = prepare(model);
  const auto factors = [&](Reading first, Reading second) {
    const Eigen::VectorXd log_p =
        log_likelihood(prepared, Eigen::Vector2f(-40.0F, -40.0F), std::vector{first, second});
    return Eigen::VectorXd(log_p.array() - log_p[0]);
  };
  EXPECT_NEAR(factors(Reading::at_least, Reading::at_least)[1], 0.0, 1e-9);
  EXPECT_NEAR(factors(Reading::exact, Reading::at_least)[1], 0.75, 1e-9);
  EXPECT_NEAR(factors(Reading::exact, Reading::none)[1], 0.75, 1e-9);
  EXPECT_LT(factors(Reading::at_least, Reading::at_least)[2], -1e8) << "that no view is of";
}

/// Half of a box was seen: it may be the large one, and is not the small one.
TEST(LogLikelihood, ABoundLeavesTheLargerOnesOpen) {
  ObservationModel model{.feature = "height",
                         .mean = Eigen::MatrixXf(1, 3),
                         .variance = Eigen::MatrixXf::Constant(1, 3, 1e-4F)};
  model.mean << 0.05F, 0.10F, 0.30F;
  const Eigen::VectorXf seen = Eigen::VectorXf::Constant(1, 0.10F);
  const PreparedObservationModel prepared = prepare(model);
  const std::vector<Reading> bound{Reading::at_least};
  const Eigen::VectorXd whole = log_likelihood(prepared, seen);
  const Eigen::VectorXd part = log_likelihood(prepared, seen, bound);
  EXPECT_GT(whole[1] - whole[2], 100.0) << "taken for the whole it cannot be the large one";
  EXPECT_NEAR(part[1] - part[2], std::log(0.5), 1e-5) << "half of the mass is above the mean";
  EXPECT_LT(part[0], part[1] - 10.0);
}

TEST(LogDensity, HasTheFactorOfASingleState) {
  ObservationModel model{.feature = "height",
                         .mean = Eigen::MatrixXf::Zero(1, 1),
                         .variance = Eigen::MatrixXf::Ones(1, 1),
                         .log_factor = Eigen::VectorXd::Constant(1, 2.0)};
  const Eigen::VectorXf at_mean = Eigen::VectorXf::Zero(1);
  const double expected = 2.0 + log_normal(0.0, 0.0, 1.0);
  EXPECT_NEAR(log_density(model, at_mean)[0], expected, 1e-6);
  EXPECT_NEAR(log_likelihood(prepare(model), at_mean)[0], expected, 1e-6);
  EXPECT_EQ(prepare(model).log_factor[0], 2.0);
  model.log_factor.resize(0);
  EXPECT_EQ(prepare(model).log_factor[0], 0.0);
}

/// Even where a state's factor is that of none.
TEST(LogLikelihood, OfReadingsOfASkippedFeatureIsZero) {
  ObservationModel model;
  model.mean = Eigen::MatrixXf::Zero(1, 2);
  model.variance = Eigen::MatrixXf::Ones(1, 2);
  model.psi = 0.0;
  model.log_factor = Eigen::Vector2d(0.0, -std::numeric_limits<double>::infinity());
  const std::vector<Reading> bound{Reading::at_least};
  EXPECT_EQ(log_likelihood(prepare(model), Eigen::VectorXf::Ones(1), bound),
            Eigen::VectorXd::Zero(2));
}

TEST(PreparedObservationModelDeathTest, RefusesFeaturesThatAreNone) {
  Rng rng(4);
  const PreparedObservationModel model = prepare(random_model(2, 2, rng));
  const std::vector<Reading> two(2, Reading::exact);
  const std::vector<Reading> three(3, Reading::exact);
  EXPECT_DEATH(log_likelihood(model, Eigen::VectorXf::Zero(3)), "as many dimensions");
  EXPECT_DEATH(log_likelihood(model, Eigen::VectorXf::Constant(2, NAN)), "finite");
  EXPECT_DEATH(log_likelihood(model, Eigen::VectorXf::Zero(3), three), "as many dimensions");
  EXPECT_DEATH(log_likelihood(model, Eigen::VectorXf::Constant(2, NAN), two), "finite");
}

}  // namespace
}  // namespace vantage
