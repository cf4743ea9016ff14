#include "vantage/belief/objects/unknown_objects.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "tests/belief/objects/recognition_world.hpp"

namespace vantage {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Of one dimension and two bins: each object's means, half a step to either side of `middle`.
ObservationModel model_of(const std::vector<float>& middle, float half_step, float variance) {
  const auto states = static_cast<Eigen::Index>(2 * middle.size());
  ObservationModel model{.feature = "made up",
                         .mean = Eigen::MatrixXf(1, states),
                         .variance = Eigen::MatrixXf::Constant(1, states, variance)};
  for (std::size_t k = 0; k < middle.size(); ++k) {
    model.mean(0, static_cast<Eigen::Index>(2 * k)) = middle[k] - half_step;
    model.mean(0, static_cast<Eigen::Index>(2 * k) + 1) = middle[k] + half_step;
  }
  return model;
}

std::vector<int> all(int objects) {
  std::vector<int> all(static_cast<std::size_t>(objects));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

TEST(UnknownHypotheses, AreEachCategoryAndNone) {
  EXPECT_THAT(unknown_hypotheses(test::make_states({0, 0, 1}, 2)), ElementsAre(0, 1, kNoCategory));
  EXPECT_THAT(unknown_hypotheses(test::make_states({0, 1, 2}, 2)), ElementsAre(kNoCategory));
  EXPECT_THAT(unknown_hypotheses(test::make_states({0}, 2)), IsEmpty());
}

/// The variance is the mean of those within bins plus that between the bins' means.
TEST(ObjectMoments, AreOfAnObjectsOwnBins) {
  ObservationModel model = model_of({2.0F, 7.0F, 2.0F}, 1.0F, 1.0F);
  model.mean << 1.0F, 3.0F, 5.0F, 9.0F, 2.0F, 2.0F;
  model.variance << 1.0F, 2.0F, 4.0F, 6.0F, 0.5F, 1.5F;
  const ObjectMoments moments = object_moments(model, test::make_states({0, 0, 1}, 2));
  EXPECT_TRUE(moments.mean.isApprox(Eigen::RowVector3d(2.0, 7.0, 2.0), 1e-12)) << moments.mean;
  const Eigen::RowVector3d variance(1.5 + 1.0, 5.0 + 4.0, 1.0 + 0.0);
  EXPECT_TRUE(moments.variance.isApprox(variance, 1e-12)) << moments.variance;
}

TEST(BackgroundDensities, AreOfTheMomentsOfWhatIsKnown) {
  const ObjectStates states = test::make_states({0, 0, 1}, 2);
  const ObservationModel model = model_of({1.0F, 3.0F, 8.0F}, 0.5F, 0.25F);
  const BackgroundDensities background =
      background_densities(object_moments(model, states), states, all(3));
  EXPECT_THAT(background.category, ElementsAre(0, 1, kNoCategory));
  // Of an object: 0.25 within a bin and 0.25 between them. W is (1 + 1) / 1 of the one pair.
  const auto& of = background.gaussians;
  EXPECT_FLOAT_EQ(of.mean(0, 0), 2.0F);
  EXPECT_FLOAT_EQ(of.variance(0, 0), 0.5F + 1.5F * (2.0F * 2.0F + 2.0F) / 3.0F);
  EXPECT_FLOAT_EQ(of.mean(0, 1), 8.0F);
  EXPECT_FLOAT_EQ(of.variance(0, 1), 0.5F + 2.0F * (2.0F * 2.0F) / 2.0F);
  EXPECT_FLOAT_EQ(of.mean(0, 2), 4.0F);
  EXPECT_FLOAT_EQ(of.variance(0, 2), 0.5F + (1.0F + 1.0F / 3.0F) * (9.0F + 1.0F + 16.0F) / 2.0F);
}

TEST(BackgroundDensities, AreOfTheObjectsKeptAlone) {
  const ObjectStates states = test::make_states({0, 0, 1, 0}, 2);
  const ObservationModel model = model_of({1.0F, 3.0F, 8.0F, 50.0F}, 0.5F, 0.25F);
  const ObservationModel of_three = model_of({1.0F, 3.0F, 8.0F}, 0.5F, 0.25F);
  const ObjectStates three = test::make_states({0, 0, 1}, 2);
  const auto kept = background_densities(object_moments(model, states), states, all(3));
  const auto without = background_densities(object_moments(of_three, three), three, all(3));
  EXPECT_EQ(kept.gaussians.mean, without.gaussians.mean);
  EXPECT_EQ(kept.gaussians.variance, without.gaussians.variance);
}

// What an object that was drawn like the known ones measures has the variance that is foretold.
TEST(BackgroundDensities, ForetellOneMoreObject) {
  const ObjectStates states = test::make_states({0, 0, 0, 0}, 1);
  Rng rng(7);
  double foretold = 0.0;
  double found = 0.0;
  constexpr int kWorlds = 20000;
  for (int world = 0; world < kWorlds; ++world) {
    ObservationModel model{.feature = "made up",
                           .mean = Eigen::MatrixXf(1, 4),
                           .variance = Eigen::MatrixXf::Constant(1, 4, 0.5F)};
    for (float& mean : model.mean.reshaped()) mean = static_cast<float>(rng.normal(0.0, 2.0));
    const auto background = background_densities(object_moments(model, states), states, all(4));
    const double measured = rng.normal(0.0, 2.0) + rng.normal(0.0, std::sqrt(0.5));
    const double error = measured - static_cast<double>(background.gaussians.mean(0, 1));
    foretold += static_cast<double>(background.gaussians.variance(0, 1)) / kWorlds;
    found += error * error / kWorlds;
  }
  EXPECT_NEAR(found / foretold, 1.0, 0.03);
}

TEST(BackgroundDensities, IntegrateToOne) {
  const ObjectStates states = test::make_states({0, 0, 1}, 2);
  const ObservationModel model =
      with_unknown(model_of({1.0F, 3.0F, 8.0F}, 0.5F, 0.25F), states, {});
  Eigen::VectorXd integral = Eigen::VectorXd::Zero(model.states());
  constexpr double kStep = 0.01;
  for (double x = -60.0; x < 60.0; x += kStep) {
    const Eigen::VectorXf feature = Eigen::VectorXf::Constant(1, static_cast<float>(x));
    integral += kStep * test::exp_of(log_density(model, feature));
  }
  EXPECT_TRUE(integral.isApprox(Eigen::VectorXd::Ones(9), 1e-4)) << integral;
}

TEST(WithUnknown, LeavesKnownStatesAndTempersTheFactors) {
  const ObjectStates states = test::make_states({0, 0, 1}, 2);
  ObservationModel known = model_of({1.0F, 3.0F, 8.0F}, 0.5F, 0.25F);
  known.psi = 0.5;
  const ObservationModel plain = with_unknown(known, states, {});
  const ObservationModel model = with_unknown(known, states, {.instance = 3.0, .category = -2.0});
  ASSERT_EQ(model.states(), 9);
  const Eigen::VectorXf feature = Eigen::VectorXf::Constant(1, 2.5F);
  const Eigen::VectorXd likelihood = log_likelihood(model, feature);
  EXPECT_EQ(likelihood.head(6), log_likelihood(known, feature));
  const Eigen::VectorXd by_factor = likelihood - log_likelihood(plain, feature);
  EXPECT_TRUE(by_factor.tail(3).isApprox(Eigen::Vector3d(1.5, 1.5, -1.0), 1e-12)) << by_factor;
  EXPECT_TRUE(log_likelihood(prepare(model), feature).isApprox(likelihood, 1e-6));
}

TEST(UnknownHypotheses, AreThereOfTwoObjects) {
  EXPECT_THAT(unknown_hypotheses(test::make_states({0, 0}, 2)), ElementsAre(0, kNoCategory));
  EXPECT_THAT(unknown_hypotheses(test::make_states({0, 1}, 2)), ElementsAre(kNoCategory));
}

TEST(BackgroundDensities, OfTwoDimensionsAreThoseOfEach) {
  const ObjectStates states = test::make_states({0, 0, 1}, 2);
  const ObservationModel first = model_of({1.0F, 3.0F, 8.0F}, 0.5F, 0.25F);
  const ObservationModel second = model_of({-2.0F, 4.0F, 0.0F}, 1.0F, 3.0F);
  ObservationModel both = first;
  both.mean.resize(2, 6);
  both.mean << first.mean, second.mean;
  both.variance.resize(2, 6);
  both.variance << first.variance, second.variance;
  const ObjectMoments moments = object_moments(both, states);
  ASSERT_EQ(moments.mean.rows(), 2);
  ASSERT_EQ(moments.mean.cols(), 3);
  ASSERT_EQ(moments.variance.rows(), 2);
  ASSERT_EQ(moments.variance.cols(), 3);
  const auto background_of = [&](const ObservationModel& model) {
    return background_densities(object_moments(model, states), states, all(3)).gaussians;
  };
  const ObservationModel found = background_of(both);
  EXPECT_TRUE(found.mean.row(0).isApprox(background_of(first).mean, 1e-6F));
  EXPECT_TRUE(found.mean.row(1).isApprox(background_of(second).mean, 1e-6F));
  EXPECT_TRUE(found.variance.row(0).isApprox(background_of(first).variance, 1e-6F));
  EXPECT_TRUE(found.variance.row(1).isApprox(background_of(second).variance, 1e-6F));
}

/// The category of one object may be the first, and one that no object is kept of is none.
TEST(BackgroundDensities, DoNotDependOnTheOrderOfCategories) {
  const ObjectStates states = test::make_states({0, 1, 1}, 2);
  const ObjectMoments moments = object_moments(model_of({8.0F, 1.0F, 3.0F}, 0.5F, 0.25F), states);
  const float of_pair = 0.5F + 1.5F * (2.0F * 2.0F + 2.0F) / 3.0F;
  const BackgroundDensities of_all = background_densities(moments, states, all(3));
  EXPECT_THAT(of_all.category, ElementsAre(0, 1, kNoCategory));
  EXPECT_FLOAT_EQ(of_all.gaussians.variance(0, 0), 0.5F + 2.0F * (2.0F * 2.0F) / 2.0F);
  EXPECT_FLOAT_EQ(of_all.gaussians.variance(0, 1), of_pair);
  const BackgroundDensities of_two = background_densities(moments, states, std::vector<int>{1, 2});
  EXPECT_THAT(of_two.category, ElementsAre(1, kNoCategory));
  EXPECT_FLOAT_EQ(of_two.gaussians.mean(0, 0), 2.0F);
  EXPECT_FLOAT_EQ(of_two.gaussians.variance(0, 0), of_pair);
  EXPECT_FLOAT_EQ(of_two.gaussians.mean(0, 1), 2.0F);
  EXPECT_FLOAT_EQ(of_two.gaussians.variance(0, 1), 0.5F + 1.5F * 2.0F);
}

}  // namespace
}  // namespace vantage
