#include "vantage/planners/objects/feature_choice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/planners/objects/small_models.hpp"
#include "vantage/core/names.hpp"

namespace vantage {
namespace {

using ::testing::HasSubstr;

/// Two objects in two poses: one feature tells the objects, one the poses, one a little of both.
class FeatureChoiceTest : public ::testing::Test {
 protected:
  FeatureChoiceTest() {
    states_.bins = 2;
    states_.objects = {"cup", "mug"};
    weak_ = test::scalar_model({0.0F, 0.5F, 1.0F, 1.5F});
    object_ = test::scalar_model({0.0F, 0.0F, 3.0F, 3.0F});
    pose_ = test::scalar_model({0.0F, 9.0F, 0.0F, 9.0F});
    weak_.feature = "weak";
    object_.feature = "object";
    pose_.feature = "pose";
    weak_.cost_s = 0.001;
    object_.cost_s = 0.1;
    pose_.cost_s = 0.2;
    features_ = {{.model = &weak_}, {.model = &object_}, {.model = &pose_}};
  }

  FeatureDecision choose(const FeatureChoice& choice, std::optional<double> last_score = {}) {
    Rng rng(1);
    return choose_feature(
        choice,
        {.database = states_, .belief = belief_, .features = features_, .last_score = last_score},
        rng);
  }

  ObjectStates states_;
  ObservationModel weak_;
  ObservationModel object_;
  ObservationModel pose_;
  std::vector<FeatureOption> features_;
  Eigen::VectorXd belief_ = Eigen::VectorXd::Constant(4, 0.25);
};

TEST_F(FeatureChoiceTest, TakesTheFeatureThatTellsMost) {
  const auto decision = choose({.about_object = false});
  EXPECT_EQ(decision.feature, 2U);
  EXPECT_EQ(decision.reason, FeatureReason::best);
  ASSERT_EQ(decision.scores.size(), 3U);
  EXPECT_NEAR(decision.scores[2].gain.bits, 1.0, 1e-3);
  EXPECT_EQ(decision.score, decision.scores[2].score);
}

TEST_F(FeatureChoiceTest, AboutObjectsThePoseIsWorthNothing) {
  const auto decision = choose({.about_object = true});
  EXPECT_EQ(decision.feature, 1U);
  EXPECT_NEAR(decision.scores[2].gain.bits, 0.0, 1e-9);
}

TEST_F(FeatureChoiceTest, PerCostTheCheapOneWins) {
  const auto decision = choose({.about_object = false, .per_cost = true});
  EXPECT_EQ(decision.feature, 0U);
  EXPECT_DOUBLE_EQ(decision.scores[0].score, decision.scores[0].gain.bits / 0.001);
}

TEST_F(FeatureChoiceTest, OfEqualOnesTheCheaper) {
  auto same = pose_;
  same.cost_s = 0.15;
  features_.push_back({.model = &same});
  EXPECT_EQ(choose({.about_object = false}).feature, 3U);
  same.cost_s = pose_.cost_s;
  EXPECT_EQ(choose({.about_object = false}).feature, 2U);
}

TEST_F(FeatureChoiceTest, DoesNotRepeatAFeature) {
  features_[2].extracted = true;
  const auto decision = choose({.about_object = false});
  EXPECT_EQ(decision.feature, 1U);
  EXPECT_EQ(decision.scores.size(), 2U);
}

TEST_F(FeatureChoiceTest, StartsWithTheFirstByName) {
  const FeatureChoice choice{.first = "weak", .about_object = false};
  const auto decision = choose(choice);
  EXPECT_EQ(decision.feature, 0U);
  EXPECT_EQ(decision.reason, FeatureReason::first);
  EXPECT_TRUE(decision.scores.empty());
  features_[0].extracted = true;
  EXPECT_EQ(choose(choice).feature, 2U);
}

TEST_F(FeatureChoiceTest, NamesTheFeaturesThereAreIfTheFirstIsUnknown) {
  try {
    choose({.first = "colour"});
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("first: unknown feature 'colour'"));
    EXPECT_THAT(error.what(), HasSubstr("weak, object, pose"));
  }
}

TEST_F(FeatureChoiceTest, StopsBelowTheThreshold) {
  belief_ << 0.99, 0.004, 0.003, 0.003;
  const auto decision = choose({.about_object = false, .stop = GainBelow{.threshold = 0.1}});
  EXPECT_FALSE(decision.feature.has_value());
  EXPECT_FALSE(decision.score.has_value());
  EXPECT_EQ(decision.reason, FeatureReason::not_worth_while);
  EXPECT_EQ(choose({.about_object = false, .stop = GainBelow{.threshold = 0.001}}).feature, 2U);
}

TEST_F(FeatureChoiceTest, StopsWhenTheGainDecreases) {
  const FeatureChoice choice{.about_object = false, .stop = GainDecreasing{}};
  EXPECT_EQ(choose(choice).feature, 2U);
  EXPECT_EQ(choose(choice, 0.5).feature, 2U);
  EXPECT_EQ(choose(choice, 1.5).reason, FeatureReason::not_worth_while);
}

TEST_F(FeatureChoiceTest, StopsWhenNoneIsLeft) {
  for (auto& option : features_) option.extracted = true;
  const auto decision = choose({.about_object = false, .stop = GainBelow{.threshold = 0.0}});
  EXPECT_FALSE(decision.feature.has_value());
  EXPECT_EQ(decision.reason, FeatureReason::none_left);
}

TEST_F(FeatureChoiceTest, OfTheOnlyFeatureTakesItWhateverItTells) {
  features_.resize(1);
  weak_.psi = 0.0;
  EXPECT_EQ(choose({.about_object = false, .stop = GainBelow{.threshold = 0.0}}).feature, 0U);
  EXPECT_EQ(choose({.about_object = false}).reason, FeatureReason::not_worth_while);
}

TEST_F(FeatureChoiceTest, SamplesEveryFeatureAlike) {
  const auto copy = object_;
  features_ = {{.model = &object_}, {.model = &copy}};
  const auto decision = choose({.measure = LossOfEntropy{}, .about_object = false});
  EXPECT_EQ(decision.scores[0].gain.bits, decision.scores[1].gain.bits);
  EXPECT_GT(decision.scores[0].gain.standard_error_bits, 0.0);
}

TEST_F(FeatureChoiceTest, IsConfiguredByName) {
  FeatureChoice choice;
  choice.measure = make_strategy<InformationMeasure>("jeffreys");
  choice.stop = make_strategy<FeatureStop>("gain_decreasing");
  EXPECT_EQ(choose(choice).feature, 2U);
  choice.states = 0;
  EXPECT_THROW(check_options(choice), ConfigError);
}

TEST(FeatureChoice, IsCheckedWithItsParts) {
  EXPECT_NO_THROW(check_options(FeatureChoice{}));
  EXPECT_THROW(check_options(FeatureChoice{.measure = LossOfEntropy{.samples = 1}}), ConfigError);
  EXPECT_THROW(check_options(FeatureChoice{.stop = GainBelow{.threshold = -0.1}}), ConfigError);
}

TEST(FeatureChoice, HasFoundAndTakenNothingAtFirst) {
  EXPECT_EQ(FeatureOption{}.model, nullptr);
  EXPECT_EQ(FeatureOption{}.tables, nullptr);
  EXPECT_FALSE(FeatureOption{}.extracted);
  EXPECT_EQ(FeatureScore{}.feature, 0U);
  EXPECT_EQ(FeatureScore{}.score, 0.0);
  EXPECT_EQ(FeatureDecision{}.reason, FeatureReason::none_left);
  EXPECT_EQ(InformationEstimate{}.bits, 0.0);
  EXPECT_EQ(InformationEstimate{}.standard_error_bits, 0.0);
  EXPECT_EQ(InformationQuery{}.weight, 1.0);
}

TEST_F(FeatureChoiceTest, GainPerCostNeedsCosts) {
  weak_.cost_s = 0.0;
  EXPECT_DEATH(choose({.per_cost = true}), "the cost of every feature");
}

// Each of them is more probable than any known state, and nothing tells them apart.
TEST(FeatureChoice, IsNotBlindedByManyKindsOfUnknownObjects) {
  constexpr int kKnown = 400;
  constexpr int kUnknown = 60;
  ObjectStates states;
  states.bins = 1;
  states.objects.resize(kKnown);
  states.unknown_category.assign(kUnknown, kNoCategory);
  ObservationModel model{.feature = "hue",
                         .mean = Eigen::MatrixXf::Zero(1, kKnown + kUnknown),
                         .variance = Eigen::MatrixXf::Ones(1, kKnown + kUnknown)};
  for (int k = 0; k < kKnown; ++k) model.mean(0, k) = static_cast<float>(10 * k);
  model.variance.rightCols(kUnknown).setConstant(1e6F);
  const std::vector<FeatureOption> features{{.model = &model, .tables = nullptr}};
  Eigen::VectorXd belief = Eigen::VectorXd::Constant(kKnown + kUnknown, 0.7 / kKnown);
  belief.tail(kUnknown).setConstant(0.3 / kUnknown);
  Rng rng(1);
  const FeatureDecision decision =
      choose_feature({}, {.database = states, .belief = belief, .features = features}, rng);
  EXPECT_EQ(decision.feature, 0U);
}

TEST_F(FeatureChoiceTest, AViewThatCountsForAQuarterIsAsOfAQuarterOfPsi) {
  const auto gains = [&](double weight) {
    Rng rng(1);
    return choose_feature(
               {.about_object = false},
               {.database = states_, .belief = belief_, .features = features_, .weight = weight},
               rng)
        .scores;
  };
  const auto whole = gains(1.0);
  const auto quarter = gains(0.25);
  for (ObservationModel* model : {&weak_, &object_, &pose_}) model->psi = 0.25;
  const auto of_quarter_psi = gains(1.0);
  const auto of_no_weight = choose({.about_object = false}).scores;
  ASSERT_EQ(quarter.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(quarter[i].gain.bits, whole[i].gain.bits) << i;
    EXPECT_NEAR(quarter[i].gain.bits, of_quarter_psi[i].gain.bits, 1e-6) << i;
    EXPECT_EQ(of_no_weight[i].gain.bits, of_quarter_psi[i].gain.bits) << i << ", which is whole";
  }
}

TEST_F(FeatureChoiceTest, LooksUpWhatTablesSay) {
  const DivergenceTables nothing{.bhattacharyya_nats = Eigen::MatrixXf::Zero(4, 4),
                                 .kullback_leibler_nats = Eigen::MatrixXf::Zero(4, 4)};
  const double of_object = choose({.about_object = false}).scores[1].gain.bits;
  features_[2].tables = &nothing;
  const auto decision = choose({.about_object = false});
  EXPECT_EQ(decision.feature, 1U);
  EXPECT_NEAR(decision.scores[2].gain.bits, 0.0, 1e-6);
  EXPECT_EQ(decision.scores[1].gain.bits, of_object);
}

TEST(FeatureStop, IsBelowAndNotAt) {
  EXPECT_FALSE(GainBelow{.threshold = 0.25}(0.25, std::nullopt));
  EXPECT_TRUE(GainBelow{.threshold = 0.25}(0.2499, std::nullopt));
  EXPECT_FALSE(GainDecreasing{}(0.25, 0.25));
  EXPECT_TRUE(GainDecreasing{}(0.2499, 0.25));
}

}  // namespace
}  // namespace vantage
