#include "vantage/planners/objects/state_divergence.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numeric>
#include <vector>

#include "tests/planners/objects/small_models.hpp"
#include "tests/support/near_duplicate_families.hpp"

namespace vantage {
namespace {

using test::gaussian_of;

constexpr double kRelative = 1e-4;  // single precision

std::vector<int> all_states(const ObservationModel& model) {
  std::vector<int> states(static_cast<std::size_t>(model.states()));
  std::iota(states.begin(), states.end(), 0);
  return states;
}

double divergence_nats(Divergence divergence, const ObservationModel& model, int i, int j) {
  const auto p = gaussian_of(model, i);
  const auto q = gaussian_of(model, j);
  return model.psi * (divergence == Divergence::bhattacharyya
                          ? gaussian_bhattacharyya_distance_nats(p, q)
                          : gaussian_kl_divergence_nats(p, q));
}

void expect_formula(Divergence divergence, const ObservationModel& model,
                    const Eigen::MatrixXf& nats) {
  for (int i = 0; i < model.states(); ++i) {
    for (int j = 0; j < model.states(); ++j) {
      const double expected = divergence_nats(divergence, model, i, j);
      ASSERT_NEAR(nats(i, j), expected, kRelative * (1.0 + expected)) << i << " " << j;
    }
  }
}

/// More states than a block, and dimensions that fill none.
ObservationModel near_duplicates(int dimensions, double psi) {
  Rng rng(4);
  auto model =
      test::near_duplicate_model(test::near_duplicate_families(5), dimensions, 1.0, {}, rng);
  model.psi = psi;
  return model;
}

TEST(StateDivergences, AreTheFormulasOfGaussians) {
  for (const int dimensions : {1, 3, 64, 150}) {
    const auto model = near_duplicates(dimensions, 0.3);
    for (const auto divergence : {Divergence::bhattacharyya, Divergence::kullback_leibler}) {
      const Eigen::MatrixXf table = divergence_table(divergence, model, 1);
      expect_formula(divergence, model, table);
      EXPECT_TRUE(table.diagonal().isZero(0.0F)) << dimensions;
    }
  }
}

TEST(StateDivergences, HoldOfVariancesFarApart) {
  auto model = test::scalar_model({0.0F, 1.0F, 2.0F});
  model.variance << 1e-4F, 1.0F, 1e4F;
  for (const auto divergence : {Divergence::bhattacharyya, Divergence::kullback_leibler}) {
    expect_formula(divergence, model, divergence_table(divergence, model, 1));
  }
}

TEST(StateDivergences, OfSomeStatesArePartOfTheTable) {
  const auto model = near_duplicates(70, 0.5);
  const ObservationModel* feature = &model;
  const std::vector<int> states{30, 2, 17};
  for (const auto divergence : {Divergence::bhattacharyya, Divergence::kullback_leibler}) {
    const Eigen::MatrixXf table = divergence_table(divergence, model, 1);
    EXPECT_TRUE(rows_and_columns(table, states)
                    .isApprox(state_divergences(divergence, {&feature, 1}, states), 1e-5F));
  }
}

TEST(StateDivergences, DoNotDependOnThreads) {
  const auto model = near_duplicates(70, 0.5);
  for (const auto divergence : {Divergence::bhattacharyya, Divergence::kullback_leibler}) {
    EXPECT_EQ(divergence_table(divergence, model, 1), divergence_table(divergence, model, 3));
  }
}

TEST(StateDivergences, AddOverFeatures) {
  const auto first = near_duplicates(20, 0.5);
  const auto second = near_duplicates(9, 0.25);
  const std::vector<const ObservationModel*> both{&first, &second};
  for (const auto divergence : {Divergence::bhattacharyya, Divergence::kullback_leibler}) {
    const Eigen::MatrixXf sum =
        divergence_table(divergence, first, 1) + divergence_table(divergence, second, 1);
    EXPECT_TRUE(state_divergences(divergence, both, all_states(first)).isApprox(sum, 1e-5F));
  }
}

TEST(StateDivergences, OfAFeatureThatIsIgnoredAreZero) {
  const auto model = near_duplicates(20, 0.0);
  for (const auto divergence : {Divergence::bhattacharyya, Divergence::kullback_leibler}) {
    EXPECT_TRUE((divergence_table(divergence, model, 1).array() == 0.0F).all());
  }
}

TEST(StateDivergences, AreNeverNegativeOfStatesThatAreAlike) {
  auto model = near_duplicates(150, 1.0);
  model.mean.colwise() = Eigen::VectorXf(model.mean.col(0));
  model.variance.colwise() = Eigen::VectorXf(model.variance.col(0));
  model.variance.rightCols(8) *= 1.0001F;
  for (const auto divergence : {Divergence::bhattacharyya, Divergence::kullback_leibler}) {
    const Eigen::MatrixXf table = divergence_table(divergence, model, 1);
    EXPECT_GE(table.minCoeff(), 0.0F);
    EXPECT_LE(table.maxCoeff(), 1e-3F);
    EXPECT_EQ(table(0, 1), 0.0F);
  }
}

RC_GTEST_PROP(LogLikelihoodsAtMeans, AreTheFormulaUpToAConstantOfEachRow, ()) {
  auto model = test::random_model(4, false);
  model.psi = *rc::gen::inRange(0, 20) / 10.0;
  const ObservationModel* feature = &model;
  const Eigen::MatrixXf log_p = log_likelihoods_at_means({&feature, 1}, all_states(model));
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      const double expected =
          test::log_likelihood_at_mean(model, i, j) - test::log_likelihood_at_mean(model, i, i);
      const auto actual = static_cast<double>(log_p(i, j) - log_p(i, i));
      RC_ASSERT(std::abs(actual - expected) < kRelative * (1.0 + std::abs(expected)));
    }
  }
}

TEST(LogLikelihoodsAtMeans, AddTheFactorsOfEveryFeatureThatHasThem) {
  const auto plain = test::scalar_model({0.0F, 1.0F});
  auto ignored = test::scalar_model({0.0F, 1.0F});
  ignored.psi = 0.0;
  ignored.log_factor = Eigen::Vector2d(9.0, 7.0);
  auto factored = test::scalar_model({0.0F, 2.0F});
  factored.psi = 0.5;
  const std::vector<const ObservationModel*> features{&plain, &ignored, &factored};
  const Eigen::MatrixXf without = log_likelihoods_at_means(features, all_states(plain));
  factored.log_factor = Eigen::Vector2d(-2.0, 3.0);
  const Eigen::MatrixXf with = log_likelihoods_at_means(features, all_states(plain));
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(with(i, 0) - without(i, 0), -1.0, 1e-6);
    EXPECT_NEAR(with(i, 1) - without(i, 1), 1.5, 1e-6);
  }
}

TEST(StateDivergencesDeathTest, StatesMustBeOnesTheModelHas) {
  const auto model = test::scalar_model({0.0F, 1.0F});
  const ObservationModel* feature = &model;
  EXPECT_DEATH(state_divergences(Divergence::bhattacharyya, {&feature, 1}, std::vector{0, 2}),
               "a state the observation model has not");
}

}  // namespace
}  // namespace vantage
