#include "vantage/belief/observation/gaussian_statistics.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/belief/objects/recognition_world.hpp"

namespace vantage {
namespace {

constexpr int kDimensions = 7;

struct View {
  int state = 0;
  Eigen::VectorXf feature;
};

std::vector<View> random_views(int count, int states, Rng& rng) {
  std::vector<View> views;
  for (int i = 0; i < count; ++i) {
    const auto state = static_cast<int>(rng.uniform_index(static_cast<std::size_t>(states)));
    views.push_back({state, Eigen::VectorXf::NullaryExpr(kDimensions, [&] {
                       return static_cast<float>(rng.normal(state, 0.5));
                     })});
  }
  return views;
}

GaussianStatistics train(const std::vector<View>& views, int states) {
  GaussianStatistics statistics = empty_statistics(kDimensions, states);
  for (const View& view : views) add_view(statistics, view.state, view.feature);
  return statistics;
}

/// Two passes in double precision.
void expect_batch(const GaussianStatistics& statistics, const std::vector<View>& views) {
  for (int j = 0; j < statistics.states(); ++j) {
    double count = 0.0;
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(kDimensions);
    for (const View& view : views) {
      if (view.state != j) continue;
      count += 1.0;
      mean += view.feature.cast<double>();
    }
    if (count > 0.0) mean /= count;
    Eigen::VectorXd deviation = Eigen::VectorXd::Zero(kDimensions);
    for (const View& view : views) {
      if (view.state == j) deviation += (view.feature.cast<double>() - mean).cwiseAbs2();
    }
    ASSERT_EQ(statistics.count[static_cast<std::size_t>(j)], count);
    const Eigen::VectorXd mean_error = statistics.mean.col(j).cast<double>() - mean;
    const Eigen::VectorXd error = statistics.squared_deviation.col(j).cast<double>() - deviation;
    ASSERT_LT(mean_error.cwiseAbs().maxCoeff(), 1e-6 * (1.0 + mean.cwiseAbs().maxCoeff()));
    ASSERT_LT(error.cwiseAbs().maxCoeff(), 2e-6 * (1.0 + deviation.maxCoeff()));
  }
}

RC_GTEST_PROP(GaussianStatistics, OneViewAtATimeIsAllAtOnce, ()) {
  Rng rng = test::random_generator();
  std::vector<View> views = random_views(*rc::gen::inRange(0, 40), 3, rng);
  expect_batch(train(views, 3), views);
  std::ranges::reverse(views);
  expect_batch(train(views, 3), views);
}

RC_GTEST_PROP(GaussianStatistics, MergedPartsAreTheWhole, ()) {
  Rng rng = test::random_generator();
  const std::vector<View> views = random_views(*rc::gen::inRange(0, 40), 3, rng);
  const auto cut = views.begin() + *rc::gen::inRange<std::ptrdiff_t>(0, std::ssize(views) + 1);
  GaussianStatistics merged = train({views.begin(), cut}, 3);
  merge(merged, train({cut, views.end()}, 3));
  expect_batch(merged, views);
}

TEST(GaussianStatistics, AnotherObjectLeavesTheOthersAsTheyAreToTheBit) {
  Rng rng(5);
  const std::vector<View> views = random_views(60, 6, rng);
  GaussianStatistics grown = empty_statistics(kDimensions, 4);
  for (const View& view : views) {
    if (view.state < 4) add_view(grown, view.state, view.feature);
  }
  add_states(grown, 2);
  for (const View& view : views) {
    if (view.state >= 4) add_view(grown, view.state, view.feature);
  }
  const GaussianStatistics batch = train(views, 6);
  EXPECT_EQ(grown.count, batch.count);
  EXPECT_EQ(grown.mean, batch.mean);
  EXPECT_EQ(grown.squared_deviation, batch.squared_deviation);
}

/// Two states of two dimensions: three views of the first and two of the second.
GaussianStatistics textbook() {
  GaussianStatistics statistics = empty_statistics(2, 2);
  for (const float x : {1.0F, 2.0F, 3.0F}) add_view(statistics, 0, Eigen::Vector2f(x, 10.0F * x));
  for (const float x : {5.0F, 7.0F}) add_view(statistics, 1, Eigen::Vector2f(x, 4.0F));
  return statistics;  // squared deviations 2, 200 and 2, 0; s_pool^2 = 4/3, 200/3
}

TEST(ShrunkVariance, IsBetweenTheStateAndThePool) {
  const ObservationModel model = make_observation_model(textbook(), 1, ShrunkVariance{.nu0 = 5.0});
  EXPECT_FLOAT_EQ(model.mean(0, 0), 2.0F);
  EXPECT_FLOAT_EQ(model.mean(1, 1), 4.0F);
  EXPECT_FLOAT_EQ(model.variance(0, 0), (5.0F * 4.0F / 3.0F + 2.0F) / 7.0F);
  EXPECT_FLOAT_EQ(model.variance(1, 0), (5.0F * 200.0F / 3.0F + 200.0F) / 7.0F);
  EXPECT_FLOAT_EQ(model.variance(1, 1), (5.0F * 200.0F / 3.0F) / 6.0F);
  EXPECT_EQ(model.psi, 1.0);
}

TEST(LiteralVariance, IsMaximumLikelihoodDownToTheFloor) {
  const ObservationModel model = make_observation_model(textbook(), 1, LiteralVariance{});
  EXPECT_FLOAT_EQ(model.variance(0, 0), 2.0F / 3.0F);
  EXPECT_FLOAT_EQ(model.variance(1, 0), 200.0F / 3.0F);
  EXPECT_FLOAT_EQ(model.variance(0, 1), 1.0F);
  EXPECT_FLOAT_EQ(model.variance(1, 1), 0.01F * (4.0F / 3.0F + 200.0F / 3.0F) / 2.0F);
}

TEST(MakeObservationModel, GivesAStateOfOneViewThePooledVariance) {
  GaussianStatistics statistics = textbook();
  add_states(statistics, 1);
  add_view(statistics, 2, Eigen::Vector2f(8.0F, 9.0F));
  for (const VarianceEstimate& estimate :
       {VarianceEstimate{ShrunkVariance{}}, VarianceEstimate{LiteralVariance{}}}) {
    const ObservationModel model = make_observation_model(statistics, 1, estimate);
    EXPECT_EQ(model.mean.col(2), Eigen::Vector2f(8.0F, 9.0F));
    EXPECT_FLOAT_EQ(model.variance(0, 2), 4.0F / 3.0F);
    EXPECT_FLOAT_EQ(model.variance(1, 2), 200.0F / 3.0F);
  }
}

TEST(MakeObservationModel, GuessesAStateWithoutViewsFromItsObject) {
  GaussianStatistics statistics = textbook();
  add_states(statistics, 4);  // the first object's third bin, then an object without any view
  const ObservationModel model = make_observation_model(statistics, 3, ShrunkVariance{});
  for (int j = 2; j < 6; ++j) {  // means 2 and 6 of the first dimension, 20 and 4 of the second
    EXPECT_FLOAT_EQ(model.mean(0, j), 4.0F);
    EXPECT_FLOAT_EQ(model.mean(1, j), 12.0F);
    EXPECT_FLOAT_EQ(model.variance(0, j), 4.0F / 3.0F + 4.0F);
    EXPECT_FLOAT_EQ(model.variance(1, j), 200.0F / 3.0F + 64.0F);
  }
}

/// Three objects of three bins: without views are the first's last bin, two of the second, and all
/// of the third.
TEST(MakeObservationModel, GuessesFromOtherObjectsOnlyWhereAnObjectHasNoViews) {
  GaussianStatistics statistics = textbook();
  add_states(statistics, 7);
  add_view(statistics, 4, Eigen::Vector2f(10.0F, 30.0F));
  const ObservationModel model = make_observation_model(statistics, 3, ShrunkVariance{});
  const auto expect_state = [&](int j, const Eigen::Vector2f& mean,
                                const Eigen::Vector2f& between) {
    EXPECT_FLOAT_EQ(model.mean(0, j), mean[0]) << j;
    EXPECT_FLOAT_EQ(model.mean(1, j), mean[1]) << j;
    EXPECT_FLOAT_EQ(model.variance(0, j), 4.0F / 3.0F + between[0]) << j;
    EXPECT_FLOAT_EQ(model.variance(1, j), 200.0F / 3.0F + between[1]) << j;
  };
  expect_state(2, {4.0F, 12.0F}, {4.0F, 64.0F});  // of the means 2 and 6, and 20 and 4
  expect_state(3, {10.0F, 30.0F}, {0.0F, 0.0F});
  expect_state(5, {10.0F, 30.0F}, {0.0F, 0.0F});
  for (const int j : {6, 7, 8}) {  // of 2, 6 and 10, and of 20, 4 and 30
    expect_state(j, {6.0F, 18.0F}, {32.0F / 3.0F, 344.0F / 3.0F});
  }
}

TEST(MakeObservationModel, TakesTheVarianceBetweenStatesWhereNoneHasTwoViews) {
  GaussianStatistics statistics = empty_statistics(1, 2);
  add_view(statistics, 0, Eigen::VectorXf::Constant(1, 1.0F));
  add_view(statistics, 1, Eigen::VectorXf::Constant(1, 3.0F));
  const ObservationModel model = make_observation_model(statistics, 1, ShrunkVariance{});
  EXPECT_FLOAT_EQ(model.variance(0, 0), 1.0F);
  EXPECT_FLOAT_EQ(model.variance(0, 1), 1.0F);
}

TEST(MakeObservationModel, StaysFiniteWhereAllViewsAreTheSame) {
  GaussianStatistics statistics = empty_statistics(2, 2);
  for (int i = 0; i < 4; ++i) add_view(statistics, i / 2, Eigen::Vector2f(1.0F, 2.0F));
  const ObservationModel model = make_observation_model(statistics, 1, LiteralVariance{});
  EXPECT_TRUE(log_density(model, Eigen::Vector2f(1.0F, 2.5F)).allFinite());
}

TEST(MakeObservationModel, SaysWhatIsMissing) {
  EXPECT_THROW(make_observation_model(empty_statistics(2, 4), 2, ShrunkVariance{}), InputError);
  EXPECT_THROW(make_observation_model(textbook(), 1, ShrunkVariance{.nu0 = 0.0}), ConfigError);
  EXPECT_THROW(make_observation_model(textbook(), 1, LiteralVariance{.floor = -1.0}), ConfigError);
}

TEST(MakeObservationModel, GuessesFromMeansOfZero) {
  GaussianStatistics statistics = empty_statistics(1, 3);
  for (const float x : {-1.0F, 1.0F}) add_view(statistics, 0, Eigen::VectorXf::Constant(1, x));
  for (const float x : {1.0F, 3.0F}) add_view(statistics, 1, Eigen::VectorXf::Constant(1, x));
  const ObservationModel model = make_observation_model(statistics, 3, ShrunkVariance{});
  EXPECT_FLOAT_EQ(model.mean(0, 2), 1.0F);
  EXPECT_FLOAT_EQ(model.variance(0, 2), 2.0F + 1.0F);  // s_pool^2 is (2 + 2) / 2
}

TEST(MakeObservationModel, TakesTheVarianceWithinStatesWhereASingleOneHasTwoViews) {
  GaussianStatistics statistics = empty_statistics(1, 2);
  for (const float x : {1.0F, 3.0F}) add_view(statistics, 0, Eigen::VectorXf::Constant(1, x));
  add_view(statistics, 1, Eigen::VectorXf::Constant(1, 10.0F));
  const ObservationModel model = make_observation_model(statistics, 1, LiteralVariance{});
  EXPECT_FLOAT_EQ(model.variance(0, 1), 2.0F);
}

TEST(MakeObservationModel, HasALeastVarianceWhereAllViewsAreTheSame) {
  GaussianStatistics statistics = empty_statistics(1, 2);
  for (int i = 0; i < 4; ++i) add_view(statistics, i / 2, Eigen::VectorXf::Constant(1, 3.0F));
  for (const VarianceEstimate& estimate :
       {VarianceEstimate{ShrunkVariance{}}, VarianceEstimate{LiteralVariance{}}}) {
    const ObservationModel model = make_observation_model(statistics, 1, estimate);
    EXPECT_EQ(model.variance(0, 0), 1e-12F);
    EXPECT_EQ(model.variance(0, 1), 1e-12F);
  }
}

TEST(MakeObservationModel, GuessesAFirstStateFromThoseBehindIt) {
  GaussianStatistics statistics = empty_statistics(1, 3);
  for (const float x : {-1.0F, 1.0F}) add_view(statistics, 1, Eigen::VectorXf::Constant(1, x));
  for (const float x : {1.0F, 3.0F}) add_view(statistics, 2, Eigen::VectorXf::Constant(1, x));
  const ObservationModel model = make_observation_model(statistics, 3, ShrunkVariance{});
  EXPECT_FLOAT_EQ(model.mean(0, 0), 1.0F);
  EXPECT_FLOAT_EQ(model.variance(0, 0), 2.0F + 1.0F);  // s_pool^2 is (2 + 2) / 2
}

}  // namespace
}  // namespace vantage
