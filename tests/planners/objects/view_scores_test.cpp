// What views of an object score, by number.
#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "tests/planners/objects/small_models.hpp"
#include "vantage/planners/objects/object_view_choice.hpp"

namespace vantage {
namespace {

/// One of two objects in either of two poses, looked at from two places.
class ViewScores : public testing::Test {
 protected:
  ViewScores() {
    states_.bins = 2;
    states_.objects = {"cup", "mug"};
  }
  ObjectViewDecision choose(const ObjectViewOptions& options) {
    Rng rng(1);
    const std::vector<Eigen::VectorXd> beliefs(actions_.size(), Eigen::VectorXd::Constant(4, 0.25));
    return choose_object_view(options,
                              {.database = states_,
                               .features = {&feature_, 1},
                               .tables = tables_,
                               .actions = actions_,
                               .predicted_belief = beliefs,
                               .weight = weight_},
                              rng);
  }

  ObjectStates states_;
  ObservationModel model_ = test::scalar_model({0.0F, 1.0F, 2.5F, 4.0F});
  const ObservationModel* feature_ = &model_;
  const DivergenceTables* tables_ = nullptr;
  std::vector<ObjectViewAction> actions_{{.yaw_rad = 1.0}, {.yaw_rad = -2.5}};
  double weight_ = 1.0;
};

TEST_F(ViewScores, OfAViewThatCountsForAQuarterAreAsOfAQuarterOfPsi) {
  const double whole = choose({}).scores[0].gain.bits;
  weight_ = 0.25;
  const double quarter = choose({}).scores[0].gain.bits;
  weight_ = 1.0;
  model_.psi = 0.25;
  EXPECT_NEAR(quarter, choose({}).scores[0].gain.bits, 1e-6);
  EXPECT_LT(quarter, 0.9 * whole);
}

TEST_F(ViewScores, AreWhatTablesSay) {
  const DivergenceTables nothing{.bhattacharyya_nats = Eigen::MatrixXf::Zero(4, 4),
                                 .kullback_leibler_nats = Eigen::MatrixXf::Zero(4, 4)};
  EXPECT_GT(choose({}).scores[0].gain.bits, 0.1);
  tables_ = &nothing;
  EXPECT_NEAR(choose({}).scores[0].gain.bits, 0.0, 1e-6);
}

TEST_F(ViewScores, OfAStarAreTheTurns) {
  actions_.push_back({.yaw_rad = 4.0});
  const ObjectViewDecision decision = choose({.choice = StarView{}});
  EXPECT_NEAR(decision.scores[0].score, 1.0, 1e-12);
  EXPECT_NEAR(decision.scores[1].score, 2.5, 1e-12);
  EXPECT_NEAR(decision.scores[2].score, 2.0 * std::numbers::pi - 4.0, 1e-12);
  EXPECT_EQ(decision.scores[2].cost, 1.0);
  EXPECT_EQ(decision.action, 1U);
}

TEST_F(ViewScores, OfFreeViewsFallWithTimeAndOfTheOthersAreBelowNothing) {
  actions_ = {{.time_s = 3.0, .visible = 0.5}, {.time_s = 1.0, .visible = 0.375}};
  const ObjectViewDecision decision = choose({.choice = NearestFreeView{.min_visible = 0.5}});
  EXPECT_DOUBLE_EQ(decision.scores[0].score, 0.25) << "just free";
  EXPECT_DOUBLE_EQ(decision.scores[1].score, -0.625);
  EXPECT_EQ(decision.action, 0U);
}

TEST_F(ViewScores, OfWhatDoesNotAskForInformationHaveNoGain) {
  for (const ObjectViewChoice& choice :
       {ObjectViewChoice(RandomObjectView{}), ObjectViewChoice(StarView{}),
        ObjectViewChoice(NearestFreeView{})}) {
    const ObjectViewDecision decision = choose({.choice = choice});
    ASSERT_EQ(decision.scores.size(), 2U);
    for (const ObjectViewScore& score : decision.scores) {
      EXPECT_EQ(score.gain.bits, 0.0) << strategy_name_of(choice);
      EXPECT_EQ(score.gain.standard_error_bits, 0.0) << strategy_name_of(choice);
      EXPECT_EQ(score.cost, 1.0) << strategy_name_of(choice);
    }
  }
  EXPECT_GT(choose({}).scores[0].gain.bits, 0.1);
  EXPECT_EQ(choose({}).scores[0].gain.standard_error_bits, 0.0) << "without sampling";
}

TEST_F(ViewScores, CountWholeAndCostNothingUnlessToldOtherwise) {
  const ObjectViewSituation situation{
      .database = states_, .features = {}, .actions = {}, .predicted_belief = {}};
  EXPECT_EQ(situation.weight, 1.0);
  EXPECT_EQ(ObjectViewAction{}.time_s, 0.0);
  EXPECT_EQ(ObjectViewAction{}.path_m, 0.0);
  EXPECT_EQ(ObjectViewAction{}.energy_j, 0.0);
  EXPECT_FALSE(ObjectViewAction{}.visited);
  EXPECT_EQ(ObjectViewScore{}.score, 0.0);
  EXPECT_EQ(ObjectViewDecision{}.action, 0U);
}

/// What is below nothing goes down too.
TEST_F(ViewScores, OfVisitedViewsAreLessWhateverTheirSign) {
  actions_ = {{.time_s = 3.0, .visited = true, .visible = 0.8},
              {.time_s = 1.0, .visited = true, .visible = 0.2},
              {.time_s = 9.0, .visible = 0.8}};
  ObjectViewOptions options{.choice = NearestFreeView{}, .visited_weight = 0.25};
  const ObjectViewDecision decision = choose(options);
  EXPECT_DOUBLE_EQ(decision.scores[0].score, 0.25 * 0.25);
  EXPECT_DOUBLE_EQ(decision.scores[1].score, -0.8 - 0.75 * 0.8);
  EXPECT_DOUBLE_EQ(decision.scores[2].score, 0.1);
  EXPECT_EQ(decision.action, 2U);
  options.visited_weight = 0.0;
  EXPECT_EQ(choose(options).scores[0].score, -std::numeric_limits<double>::infinity());
  actions_[2].visited = true;
  EXPECT_DOUBLE_EQ(choose(options).scores[0].score, 0.25) << "all were";
}

TEST_F(ViewScores, EnoughIsAboveAProbabilityAndBelowAnEntropy) {
  const auto enough = [&](const EnoughViews& options, double a, double b, double c, double d) {
    return seen_enough(options, states_, Eigen::Vector4d(a, b, c, d));
  };
  const EnoughViews at_three_quarters{.object_probability = 0.75, .entropy_bits = 0.0};
  EXPECT_EQ(enough(at_three_quarters, 0.5, 0.25, 0.125, 0.125), std::nullopt);
  EXPECT_EQ(enough(at_three_quarters, 0.5, 0.3125, 0.125, 0.0625), EnoughReason::probability);
  EXPECT_EQ(enough({.entropy_bits = 1.0}, 0.5, 0.0, 0.5, 0.0), std::nullopt);
  EXPECT_EQ(enough({.entropy_bits = 1.001}, 0.5, 0.0, 0.5, 0.0), EnoughReason::entropy);
}

/// Two objects of three bins: what is sure of an object may be open of its yaw.
TEST(SeenEnough, AddsUpTheBinsOfAnObject) {
  ObjectStates states;
  states.objects = {"a", "b"};
  states.bins = 3;
  Eigen::VectorXd belief(6);
  belief << 0.31, 0.31, 0.31, 0.03, 0.02, 0.02;
  const EnoughViews enough{.object_probability = 0.9, .entropy_bits = 0.0};
  EXPECT_EQ(seen_enough(enough, states, belief), EnoughReason::probability);
  belief << 0.31, 0.31, 0.03, 0.31, 0.02, 0.02;
  EXPECT_EQ(seen_enough(enough, states, belief), std::nullopt);
}

TEST(ObjectViewOptions, NameTheWeightThatMustBeNothing) {
  try {
    require_no_weights({.weight_per_m = 2.5}, "views");
    FAIL() << "no error";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "views.weight_per_m: 2.5 weighs what motions cost, and here they cost nothing; "
                 "must be 0");
  }
}

}  // namespace
}  // namespace vantage
