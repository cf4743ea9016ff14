#include "vantage/belief/objects/object_belief.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numbers>

#include "tests/belief/objects/recognition_world.hpp"

namespace vantage {
namespace {

using test::exp_of;
using test::make_states;
using ::testing::HasSubstr;

constexpr double kTolerance = 1e-9;
constexpr double kBoundless = std::numeric_limits<double>::infinity();
constexpr double kTurn = 2.0 * std::numbers::pi;

ObjectBelief belief_of(std::initializer_list<double> p) {
  ObjectBelief belief{Eigen::VectorXd(static_cast<Eigen::Index>(p.size()))};
  std::ranges::transform(p, belief.log_p.begin(), [](double mass) { return std::log(mass); });
  return belief;
}

ObjectBelief random_belief(const ObjectStates& states, Rng& rng) {
  ObjectBelief belief = uniform_belief(states);
  Eigen::VectorXd likelihood = test::random_logs(states.size(), rng);
  likelihood[0] = 0.0;
  update(belief, likelihood);
  return belief;
}

TEST(Update, IsBayes) {
  ObjectBelief belief = belief_of({0.5, 0.25, 0.25, 0.0});
  const EvidenceResult result = update(belief, belief_of({0.1, 0.2, 0.0, 0.9}).log_p);
  EXPECT_TRUE(result.used());
  EXPECT_NEAR(result.log_evidence, std::log(0.1), kTolerance);
  EXPECT_TRUE(exp_of(belief.log_p).isApprox(Eigen::Vector4d(0.5, 0.5, 0.0, 0.0), kTolerance));
}

TEST(Update, SurvivesDensitiesOfAnySize) {
  ObjectBelief belief = uniform_belief(make_states({0, 0}, 2));
  update(belief, Eigen::Vector4d(3200.0, 3201.0, -1e6, -kBoundless));
  EXPECT_NEAR(std::exp(belief.log_p[1]), 1.0 / (1.0 + std::exp(-1.0)), kTolerance);
  update(belief, Eigen::Vector4d(-1e7, -1e7, 0.0, 0.0));
  EXPECT_NEAR(belief.log_p[2], 0.0, kTolerance);  // written off, and yet it comes back
}

TEST(Update, LeavesTheBeliefWhereEvidenceIsImpossible) {
  const ObjectBelief before = belief_of({0.5, 0.5, 0.0, 0.0});
  for (const Eigen::Vector4d& impossible :
       {Eigen::Vector4d(-kBoundless, -kBoundless, 0.0, 0.0),
        Eigen::Vector4d(Eigen::Vector4d::Constant(-kBoundless))}) {
    ObjectBelief belief = before;
    const EvidenceResult result = update(belief, impossible);
    EXPECT_FALSE(result.used());
    EXPECT_THAT(result.reason, HasSubstr("no state"));
    EXPECT_EQ(belief.log_p, before.log_p);
  }
}

TEST(Update, NamesTheStateWhoseLikelihoodIsNone) {
  for (const double bad : {kBoundless, std::nan("")}) {
    ObjectBelief belief = belief_of({0.5, 0.5});
    const EvidenceResult result = update(belief, Eigen::Vector2d(0.0, bad));
    EXPECT_THAT(result.reason, HasSubstr("state 1"));
    EXPECT_EQ(result.log_evidence, 0.0);
    EXPECT_EQ(belief.log_p, belief_of({0.5, 0.5}).log_p);
  }
}

RC_GTEST_PROP(ObjectBelief, SumsToOneWhateverHappens, ()) {
  const ObjectStates states = test::random_states();
  Rng rng = test::random_generator();
  ObjectBelief belief = uniform_belief(states);
  for (int step = 0; step < 6; ++step) {
    for (const std::string_view name : strategy_names<TransitionModel>()) {
      predict(belief, states, make_strategy<TransitionModel>(name), rng.uniform(-7.0, 7.0));
      RC_ASSERT(std::abs(p_state(belief).sum() - 1.0) < kTolerance);
      update(belief, 100.0 * test::random_logs(states.size(), rng));
      RC_ASSERT(std::abs(p_state(belief).sum() - 1.0) < kTolerance);
    }
  }
}

RC_GTEST_PROP(ObjectBelief, DoesNotCareForTheOrderOfFeatures, ()) {
  const ObjectStates states = test::random_states();
  Rng rng = test::random_generator();
  std::vector<Eigen::VectorXd> features;
  for (int f = 0; f < 4; ++f) {
    features.push_back(test::random_logs(states.size(), rng));
    features.back()[0] = 0.0;
  }
  ObjectBelief forth = uniform_belief(states);
  ObjectBelief back = forth;
  double evidence = 0.0;
  for (const Eigen::VectorXd& feature : features) {
    predict(forth, states, TableTransition{}, 0.0);
    evidence += update(forth, feature).log_evidence;
  }
  std::ranges::reverse(features);
  for (const Eigen::VectorXd& feature : features) evidence -= update(back, feature).log_evidence;
  RC_ASSERT(p_state(forth).isApprox(p_state(back), kTolerance));
  RC_ASSERT(std::abs(evidence) < kTolerance);
}

RC_GTEST_PROP(Predict, LeaksNothingWithoutMotion, ()) {
  const ObjectStates states = test::random_states();
  Rng rng = test::random_generator();
  const ObjectBelief before = random_belief(states, rng);
  for (const std::string_view name : strategy_names<TransitionModel>()) {
    ObjectBelief belief = before;
    predict(belief, states, make_strategy<TransitionModel>(name), 0.0);
    RC_ASSERT(belief.log_p == before.log_p);
  }
}

RC_GTEST_PROP(Predict, RigidlyRoundAFullTurnComesBack, ()) {
  const ObjectStates states = test::random_states();
  Rng rng = test::random_generator();
  const ObjectBelief before = random_belief(states, rng);
  ObjectBelief belief = before;
  for (int step = 0; step < states.bins; ++step) {
    predict(belief, states, RigidTransition{.slip = 0.0}, states.bin_rad());
  }
  RC_ASSERT(p_state(belief).isApprox(p_state(before), kTolerance));
}

RC_GTEST_PROP(Predict, RigidlyKeepsWhatIsBelievedOfObjects, ()) {
  const ObjectStates states = test::random_states();
  Rng rng = test::random_generator();
  ObjectBelief belief = random_belief(states, rng);
  const Eigen::VectorXd before = p_object(states, belief);
  predict(belief, states, RigidTransition{.slip = 0.3}, rng.uniform(0.1, 6.0));
  RC_ASSERT(p_object(states, belief).isApprox(before, kTolerance));
}

TEST(Predict, LeavesProbabilitiesWhateverItIsGiven) {
  const ObjectStates states = test::make_states({0, 0, 1}, 4);
  ObjectBelief belief{Eigen::VectorXd::Constant(states.size(), 3.0)};
  predict(belief, states, TableTransition{}, 0.5);
  EXPECT_NEAR(belief.log_p.array().exp().sum(), 1.0, 1e-12);
}

TEST(Predict, IsTheTableForTheTable) {
  const ObjectStates states = make_states({0, 0, 1}, 4);
  ObjectBelief belief = belief_of({1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  predict(belief, states, TableTransition{}, kTurn / 4.0);
  Eigen::VectorXd expected(12);
  expected << 0.1, 0.4, 0.1, 0.1, 0.025, 0.025, 0.025, 0.025, 0.05, 0.05, 0.05, 0.05;
  EXPECT_TRUE(p_state(belief).isApprox(expected, kTolerance));
}

class Marginals : public ::testing::Test {
 protected:
  ObjectStates states_ = make_states({0, 0, 1}, 2);
  ObjectBelief belief_ = belief_of({0.25, 0.25, 0.375, 0.0, 0.125, 0.0});
};

TEST_F(Marginals, SumOverPosesAndInstances) {
  EXPECT_TRUE(p_object(states_, belief_).isApprox(Eigen::Vector3d(0.5, 0.375, 0.125), kTolerance));
  EXPECT_TRUE(p_category(states_, belief_).isApprox(Eigen::Vector2d(0.875, 0.125), kTolerance));
}

TEST_F(Marginals, EntropiesInBits) {
  EXPECT_NEAR(state_entropy_bits(belief_), 1.0 + 0.125 * 3.0 - 0.375 * std::log2(0.375),
              kTolerance);
  EXPECT_NEAR(object_entropy_bits(states_, belief_), 0.5 + 0.125 * 3.0 - 0.375 * std::log2(0.375),
              kTolerance);
}

TEST_F(Marginals, TheMostProbableObjectNeedNotHaveTheMostProbableState) {
  EXPECT_EQ(most_probable_state(belief_), 2);
  EXPECT_EQ(most_probable_object(states_, belief_), 0);
}

TEST(MeanYaw, GoesTheShortWayRoundZero) {
  const ObjectStates states = make_states({0}, 8);
  const ObjectBelief belief = belief_of({0.5, 0, 0, 0, 0, 0, 0, 0.5});
  EXPECT_NEAR(mean_yaw_rad(states, belief, 0), kTurn - kTurn / 16.0, kTolerance);
}

TEST(MeanYaw, OfNoPreferenceIsZero) {
  const ObjectStates states = make_states({0, 0}, 4);
  const ObjectBelief belief = belief_of({0.25, 0.25, 0.25, 0.25, 0, 0, 0, 0});
  EXPECT_EQ(mean_yaw_rad(states, belief, 0), 0.0);
  EXPECT_EQ(mean_yaw_rad(states, belief, 1), 0.0);
}

TEST(ExpectedState, IsNearestToTheMeanYaw) {
  const ObjectStates states = make_states({0, 0}, 8);
  ObjectBelief belief = uniform_belief(states);
  Eigen::VectorXd likelihood = Eigen::VectorXd::Constant(16, -kBoundless);
  likelihood.segment(8, 8) << std::log(0.3), std::log(0.25), -kBoundless, -kBoundless, -kBoundless,
      -kBoundless, -kBoundless, std::log(0.25);
  update(belief, likelihood);
  EXPECT_EQ(expected_state(states, belief), states.state(1, 0));
  likelihood.segment(8, 8) << std::log(0.3), std::log(0.29), std::log(0.29), -kBoundless,
      -kBoundless, -kBoundless, -kBoundless, -kBoundless;
  belief = uniform_belief(states);
  update(belief, likelihood);
  EXPECT_EQ(most_probable_state(belief), states.state(1, 0));
  EXPECT_EQ(expected_state(states, belief), states.state(1, 1));
}

TEST(ExpectedState, OfAMeanJustBelowAFullTurnIsBinZero) {
  const ObjectStates states = make_states({0}, 8);
  EXPECT_EQ(expected_state(states, belief_of({0.6, 0, 0, 0, 0, 0, 0, 0.4})), 0);
}

TEST(BinOfYaw, IsTheNearestHowOftenItGoesRound) {
  const ObjectStates states = make_states({0, 0}, 5);
  const double bin_rad = states.bin_rad();
  for (const int turns : {-2, -1, 0, 1, 2}) {
    for (int bin = 0; bin < 5; ++bin) {
      const double yaw_rad = (bin + 5 * turns) * bin_rad;
      EXPECT_EQ(states.bin_of_yaw(yaw_rad - 0.49 * bin_rad), bin) << turns;
      EXPECT_EQ(states.bin_of_yaw(yaw_rad + 0.49 * bin_rad), bin) << turns;
    }
  }
  EXPECT_EQ(state_seen(states, states.objects[1], -bin_rad), 9);
}

TEST(BinError, IsTheShortWayRound) {
  const ObjectStates states = make_states({0, 1}, 8);
  EXPECT_EQ(bin_error(states, states.state(0, 1), states.state(1, 7)), 2);
  EXPECT_EQ(bin_error(states, states.state(0, 0), states.state(0, 4)), 4);
  EXPECT_EQ(bin_error(states, states.state(0, 3), states.state(0, 3)), 0);
}

/// Two objects of a category, one of another, and unknown ones of the first, or of none.
ObjectStates states_with_unknown(int bins) {
  ObjectStates states = make_states({0, 0, 1}, bins);
  states.unknown_category = {0, kNoCategory};
  return states;
}

TEST(PriorBelief, SharesWhatIsUnknown) {
  const ObjectStates states = states_with_unknown(2);
  const ObjectBelief prior = prior_belief(states, 0.2);
  EXPECT_NEAR(p_state(prior).sum(), 1.0, kTolerance);
  EXPECT_NEAR(p_unknown(states, prior), 0.2, kTolerance);
  EXPECT_TRUE(p_object(states, prior).isApprox(Eigen::Vector3d::Constant(0.8 / 3.0), kTolerance));
  EXPECT_TRUE(p_category(states, prior)
                  .isApprox(Eigen::Vector2d(2.0 * 0.8 / 3.0 + 0.1, 0.8 / 3.0), kTolerance));
  const ObjectStates known = make_states({0, 0, 1}, 2);
  EXPECT_EQ(prior_belief(known, 0.2).log_p, uniform_belief(known).log_p);
}

TEST(SpreadOverSeen, LeavesEachObjectWhatItHas) {
  const ObjectStates states = make_states({0, 0, 1}, 2);
  const auto spread = [&](std::initializer_list<double> p, const std::vector<int>& unseen) {
    ObjectBelief belief = belief_of(p);
    spread_over_seen(states, unseen, belief);
    return p_state(belief);
  };
  const auto is = [](const Eigen::VectorXd& p, std::initializer_list<double> wanted) {
    return p.isApprox(Eigen::Map<const Eigen::VectorXd>(wanted.begin(), 6), kTolerance);
  };
  EXPECT_TRUE(is(spread({0.1, 0.2, 0.3, 0.1, 0.1, 0.2}, {}), {0.1, 0.2, 0.3, 0.1, 0.1, 0.2}));
  EXPECT_TRUE(is(spread({0.1, 0.2, 0.3, 0.1, 0.1, 0.2}, {0, 3}), {0.0, 0.3, 0.4, 0.0, 0.1, 0.2}));
  EXPECT_TRUE(is(spread({0.1, 0.2, 0.3, 0.1, 0.1, 0.2}, {4, 5}), {0.1, 0.2, 0.3, 0.1, 0.1, 0.2}))
      << "an object that no view is of";
  EXPECT_TRUE(is(spread({0.0, 0.3, 0.0, 0.0, 0.1, 0.6}, {0, 2}), {0.0, 0.3, 0.0, 0.0, 0.1, 0.6}));
}

TEST(ForgetYaw, KeepsTheObjectAndWhatIsUnknown) {
  const ObjectStates states = states_with_unknown(2);
  ObjectBelief belief = belief_of({0.1, 0.3, 0.0, 0.2, 0.0, 0.1, 0.1, 0.2});
  forget_yaw(states, std::vector<int>{3}, belief);
  Eigen::VectorXd wanted(8);
  wanted << 0.2, 0.2, 0.2, 0.0, 0.05, 0.05, 0.1, 0.2;
  EXPECT_TRUE(p_state(belief).isApprox(wanted, kTolerance));
}

// Over all paths of states, by the definition.
TEST(ObjectBelief, WithUnknownObjectsIsBayesOverAllPaths) {
  const ObjectStates states = states_with_unknown(3);
  const ObjectStates known = make_states({0, 0, 1}, 3);
  const TransitionModel transition = TableTransition{};
  Rng rng(5);
  ObjectBelief belief = prior_belief(states, 0.3);
  Eigen::VectorXd p = p_state(belief);
  for (const double motion_rad : {0.0, 1.3, 4.0}) {
    if (motion_rad != 0.0) {
      Eigen::MatrixXd a = Eigen::MatrixXd::Identity(states.size(), states.size());
      a.topLeftCorner(known.size(), known.size()) =
          test::dense(known, kernel_of(transition, motion_rad, 3));
      p = a.transpose() * p;
    }
    const Eigen::VectorXd likelihood =
        Eigen::VectorXd::NullaryExpr(states.size(), [&] { return rng.uniform(0.1, 2.0); });
    p = p.cwiseProduct(likelihood) / p.dot(likelihood);
    predict(belief, states, transition, motion_rad);
    EXPECT_TRUE(update(belief, likelihood.array().log().matrix()).used());
    EXPECT_TRUE(p_state(belief).isApprox(p, 1e-12));
  }
  EXPECT_NEAR(p_unknown(states, belief), p.tail(2).sum(), 1e-12);
}

TEST(EstimateOf, IsUnknownWhenThatIsMoreProbableThanNot) {
  const ObjectStates states = states_with_unknown(1);
  const auto estimate = [&](std::initializer_list<double> p) {
    return estimate_of(states, belief_of(p));
  };
  EXPECT_EQ(estimate({0.2, 0.3, 0.1, 0.3, 0.1}).object, "object_1");
  EXPECT_NEAR(estimate({0.2, 0.3, 0.1, 0.3, 0.1}).probability, 0.3, 1e-12);
  const ObjectEstimate instance = estimate({0.2, 0.1, 0.1, 0.5, 0.1});
  EXPECT_EQ(instance.object, kUnknown);
  EXPECT_EQ(instance.category, "category_0");
  EXPECT_NEAR(instance.probability, 0.6, 1e-12);
  EXPECT_EQ(estimate({0.2, 0.1, 0.1, 0.1, 0.5}).category, kUnknown);
}

TEST(ObjectEntropy, CountsWhatIsUnknownAsOneObject) {
  const ObjectStates states = states_with_unknown(1);
  EXPECT_NEAR(object_entropy_bits(states, belief_of({0.25, 0.25, 0.25, 0.125, 0.125})), 2.0, 1e-12);
}

TEST(PriorBelief, GivesCategoriesTogetherAsMuchAsNone) {
  ObjectStates states = make_states({0, 0, 1}, 2);
  states.unknown_category = {0, 1, kNoCategory};
  const Eigen::VectorXd p = p_state(prior_belief(states, 0.2));
  EXPECT_TRUE(p.head(6).isApprox(Eigen::VectorXd::Constant(6, 0.8 / 6.0), kTolerance));
  EXPECT_TRUE(p.tail(3).isApprox(Eigen::Vector3d(0.05, 0.05, 0.1), kTolerance));
  states.unknown_category = {kNoCategory};
  EXPECT_NEAR(p_state(prior_belief(states, 0.2))[6], 0.2, kTolerance);
}

TEST(EstimateOf, IsAsProbableAsItsObjectAndNoMoreThanCertain) {
  const ObjectStates states = states_with_unknown(1);
  EXPECT_NEAR(estimate_of(states, belief_of({0.1, 0.8, 0.05, 0.03, 0.02})).probability, 0.8, 1e-12);
  ObjectBelief known = belief_of({0.0, 1.0, 0.0, 0.0, 0.0});
  known.log_p[1] = 1e-12;  // as a sum that was rounded
  EXPECT_EQ(estimate_of(states, known).probability, 1.0);
  ObjectBelief unknown = belief_of({0.0, 0.0, 0.0, 0.0, 1.0});
  unknown.log_p[4] = 1e-12;
  EXPECT_EQ(estimate_of(states, unknown).object, kUnknown);
  EXPECT_EQ(estimate_of(states, unknown).probability, 1.0);
}

TEST(MeanYaw, IsWithinAFullTurn) {
  const ObjectStates states = make_states({0}, 8);
  for (int bin = 0; bin < 8; ++bin) {
    ObjectBelief belief{Eigen::VectorXd::Constant(8, -kBoundless)};
    belief.log_p[bin] = 0.0;
    EXPECT_NEAR(mean_yaw_rad(states, belief, 0), bin * kTurn / 8.0, kTolerance) << bin;
  }
}

TEST(PriorBelief, SumsToOneWithoutAnObjectOfNoCategory) {
  ObjectStates states = make_states({0, 0, 1}, 2);
  states.unknown_category = {0, 1};
  const Eigen::VectorXd p = p_state(prior_belief(states, 0.2));
  EXPECT_NEAR(p.sum(), 1.0, kTolerance);
  EXPECT_TRUE(p.tail(2).isApprox(Eigen::Vector2d(0.1, 0.1), kTolerance));
}

TEST(ObjectStates, UnknownOnesAreBehindTheKnownAndHaveNoYaw) {
  const ObjectStates states = states_with_unknown(2);  // six known ones
  EXPECT_FALSE(states.is_unknown(5));
  EXPECT_EQ(states.object_of(5), 2);
  EXPECT_EQ(states.bin_of(5), 1);
  for (const int unknown : {6, 7}) {
    EXPECT_TRUE(states.is_unknown(unknown));
    EXPECT_EQ(states.object_of(unknown), 3);
    EXPECT_EQ(states.bin_of(unknown), 0);
  }
}

TEST(EstimateOf, IsOfTheDatabaseWhereUnknownIsJustAsProbable) {
  ObjectStates states = make_states({0, 0}, 1);
  states.unknown_category = {kNoCategory};
  const ObjectBelief belief = belief_of({0.3, 0.2, 0.5});
  EXPECT_FALSE(is_unknown(states, belief));
  EXPECT_EQ(estimate_of(states, belief).object, states.objects[0]);
  EXPECT_EQ(p_unknown(states, prior_belief(states, 0.0)), 0.0);
}

TEST(ObjectEntropy, CountsTheOnlyHypothesisOfUnknownObjects) {
  ObjectStates states = make_states({0}, 1);
  states.unknown_category = {kNoCategory};
  EXPECT_NEAR(object_entropy_bits(states, belief_of({0.75, 0.25})), 2.0 - 0.75 * std::log2(3.0),
              1e-12);
}

/// Of three bins. The first object keeps what it has: nothing would be left of it.
TEST(SpreadOverSeen, GoesOnBehindAnObjectThatNothingIsLeftOf) {
  const ObjectStates states = make_states({0, 0, 0}, 3);
  ObjectBelief belief = belief_of({0.1, 0.1, 0.0, 0.1, 0.2, 0.1, 0.1, 0.1, 0.2});
  spread_over_seen(states, std::vector<int>{0, 1, 4, 6, 8}, belief);
  Eigen::VectorXd wanted(9);
  wanted << 0.1, 0.1, 0.0, 0.2, 0.0, 0.2, 0.0, 0.4, 0.0;
  EXPECT_TRUE(p_state(belief).isApprox(wanted, kTolerance)) << p_state(belief);
  EXPECT_EQ(belief.log_p[4], -kBoundless);
  forget_yaw(states, {}, belief);
  wanted << 0.2, 0.2, 0.2, 0.4, 0.4, 0.4, 0.4, 0.4, 0.4;
  EXPECT_TRUE(p_state(belief).isApprox(wanted / 3.0, kTolerance)) << p_state(belief);
}

/// Nearly as much to the left as to the right.
TEST(MeanYaw, OfAPreferenceBelowABillionthIsZero) {
  const ObjectStates states = make_states({0}, 4);
  const auto mean_rad = [&](double preference) {
    return mean_yaw_rad(
        states, belief_of({0.0, 0.5 * (1.0 + preference), 0.0, 0.5 * (1.0 - preference)}), 0);
  };
  EXPECT_EQ(mean_rad(7e-10), 0.0);
  EXPECT_NEAR(mean_rad(1.5e-9), kTurn / 4.0, 1e-3);
}

/// Its probability is less than any number but zero.
TEST(MeanYaw, OfAnObjectThatIsHardlyPossibleIsThatOfItsPoses) {
  const ObjectStates states = make_states({0, 0}, 8);
  ObjectBelief belief{Eigen::VectorXd::Constant(16, -kBoundless)};
  belief.log_p[0] = 0.0;
  belief.log_p[states.state(1, 2)] = -1000.0;
  EXPECT_NEAR(mean_yaw_rad(states, belief, 1), kTurn / 4.0, kTolerance);
  EXPECT_EQ(mean_yaw_rad(states, belief, 0), 0.0);
}

TEST(EstimateOf, IsOfTheDatabaseWhereNothingCanBeUnknown) {
  const ObjectStates states = make_states({0, 1}, 2);
  const ObjectBelief belief = belief_of({0.1, 0.1, 0.3, 0.5});
  EXPECT_EQ(p_unknown(states, belief), 0.0);
  EXPECT_FALSE(is_unknown(states, belief));
  EXPECT_EQ(estimate_of(states, belief).object, "object_1");
  EXPECT_EQ(estimate_of(states, belief).category, "category_1");
  EXPECT_NEAR(estimate_of(states, belief).probability, 0.8, 1e-12);
}

}  // namespace
}  // namespace vantage
