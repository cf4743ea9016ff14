#include "vantage/planners/objects/object_view_choice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <vector>

#include "tests/planners/objects/small_models.hpp"
#include "tests/support/near_duplicate_families.hpp"
#include "vantage/core/fields.hpp"

namespace vantage {
namespace {

/// Near-duplicates in eight poses that differ where a decal is: in bin 3. The pose shows in every
/// view. The one at hand is either, seen in bin 0.
class ObjectViewChoiceTest : public ::testing::Test {
 protected:
  ObjectViewChoiceTest() {
    states_.objects = {"plain", "decal"};
    model_ = ObservationModel{.feature = "look",
                              .mean = Eigen::MatrixXf::Zero(2, 16),
                              .variance = Eigen::MatrixXf::Ones(2, 16)};
    for (int s = 0; s < 16; ++s) model_.mean(0, s) = static_cast<float>(4 * states_.bin_of(s));
    model_.mean(1, states_.state(1, 3)) = 4.0F;
    Eigen::VectorXd belief = Eigen::VectorXd::Zero(16);
    belief[states_.state(0, 0)] = belief[states_.state(1, 0)] = 0.5;
    for (int turn = 1; turn < 8; ++turn) {
      actions_.push_back({.yaw_rad = turn * states_.bin_rad(), .time_s = 1.0});
      beliefs_.push_back(test::turned(states_, belief, turn));
    }
  }

  ObjectViewDecision choose(const ObjectViewOptions& options, std::uint64_t seed = 1) {
    Rng rng(seed);
    return choose_object_view(options,
                              {.database = states_,
                               .features = {&feature_, 1},
                               .actions = actions_,
                               .predicted_belief = beliefs_},
                              rng);
  }

  ObjectStates states_;
  ObservationModel model_;
  const ObservationModel* feature_ = &model_;
  std::vector<ObjectViewAction> actions_;
  std::vector<Eigen::VectorXd> beliefs_;
};

std::vector<ObjectViewChoice> every_strategy() {
  std::vector<ObjectViewChoice> choices;
  for (const auto name : strategy_names<ObjectViewChoice>()) {
    choices.push_back(make_strategy<ObjectViewChoice>(name));
  }
  return choices;
}

TEST_F(ObjectViewChoiceTest, EveryMeasureOfInformationLooksAtTheDecal) {
  for (const auto& choice : every_strategy()) {
    const auto name = strategy_name_of(choice);
    if (name == "random" || name == "star" || name == "nearest_free" || name == "jeffreys")
      continue;
    EXPECT_EQ(choose({.choice = choice}).action, 2U) << name;
  }
}

TEST_F(ObjectViewChoiceTest, JeffreysDivergenceLooksAtTheDecalIfThePoseIsSure) {
  for (int turn = 1; turn < 8; ++turn) {
    Eigen::VectorXd& belief = beliefs_[static_cast<std::size_t>(turn - 1)];
    belief.setZero();
    belief[states_.state(0, turn)] = belief[states_.state(1, turn)] = 0.5;
  }
  EXPECT_EQ(choose({.choice = JeffreysDivergence{}}).action, 2U);
}

TEST_F(ObjectViewChoiceTest, OnlyThePoseIsToldWhereThereIsNoDecal) {
  const auto of_objects = choose({});
  EXPECT_NEAR(of_objects.scores[5].gain.bits, 0.0, 1e-6);
  const auto of_states = choose({.about_object = false});
  EXPECT_GT(of_states.scores[5].gain.bits, 0.3);
}

TEST_F(ObjectViewChoiceTest, EveryChoiceIsTheSameForTheSameSeed) {
  for (const auto& choice : every_strategy()) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const auto first = choose({.choice = choice}, seed);
      const auto second = choose({.choice = choice}, seed);
      EXPECT_EQ(first.action, second.action);
      for (std::size_t i = 0; i < actions_.size(); ++i) {
        EXPECT_EQ(first.scores[i].score, second.scores[i].score);
      }
    }
  }
}

TEST_F(ObjectViewChoiceTest, RandomTakesEveryActionAboutAsOften) {
  std::vector<int> taken(actions_.size(), 0);
  for (std::uint64_t seed = 0; seed < 7000; ++seed) {
    ++taken[choose({.choice = RandomObjectView{}}, seed).action];
  }
  for (const int count : taken) EXPECT_NEAR(count, 1000, 5.0 * std::sqrt(1000.0));
}

TEST(ObjectChoiceStream, EveryDrawIsASequenceOfItsOwn) {
  const auto first = [](Rng rng) { return rng.next(); };
  const std::uint64_t common = first(Rng::stream(7, "recognition"));
  EXPECT_EQ(first(choice_stream(RandomObjectView{}, 7)), common);
  EXPECT_EQ(first(choice_stream(MutualInformation{}, 7)), common);
  EXPECT_EQ(first(choice_stream(RandomObjectView{3}, 7)), first(Rng::stream(7, "recognition 3")));
}

TEST_F(ObjectViewChoiceTest, StarGoesToTheOppositeSide) {
  EXPECT_EQ(choose({.choice = StarView{}}).action, 3U);
  for (auto& action : actions_) action.yaw_rad -= 4.0 * std::numbers::pi;
  EXPECT_EQ(choose({.choice = StarView{}}).action, 3U);
}

TEST_F(ObjectViewChoiceTest, StarVisitsEveryViewOnce) {
  std::set<int> visited{0};
  int at = 0;
  for (int step = 0; step < 7; ++step) {
    for (int turn = 1; turn < 8; ++turn) {
      actions_[static_cast<std::size_t>(turn - 1)].visited = visited.contains((at + turn) % 8);
    }
    at = (at + static_cast<int>(choose({.choice = StarView{}}).action) + 1) % 8;
    visited.insert(at);
  }
  EXPECT_EQ(visited.size(), 8U);
}

TEST_F(ObjectViewChoiceTest, EveryChoiceLeavesVisitedViewsOut) {
  for (auto& action : actions_) action.visited = true;
  actions_[6].visited = false;
  for (const auto& choice : every_strategy()) {
    const auto decision = choose({.choice = choice});
    EXPECT_EQ(decision.action, 6U);
    EXPECT_EQ(decision.scores[2].score, -std::numeric_limits<double>::infinity());
  }
}

TEST_F(ObjectViewChoiceTest, WhereAllAreVisitedTheBestIsTakenAgain) {
  for (auto& action : actions_) action.visited = true;
  EXPECT_EQ(choose({}).action, 2U);
}

TEST_F(ObjectViewChoiceTest, VisitedViewsCanBeWorthLess) {
  actions_[2].visited = true;
  const double fresh = choose({.visited_weight = 1.0}).scores[2].score;
  const auto discounted = choose({.visited_weight = 0.9});
  EXPECT_EQ(discounted.action, 2U);
  EXPECT_DOUBLE_EQ(discounted.scores[2].score, 0.9 * fresh);
  EXPECT_NE(choose({.visited_weight = 0.01}).action, 2U);
}

TEST_F(ObjectViewChoiceTest, GainPerCostWeighsTimePathAndEnergy) {
  actions_[2] = {.yaw_rad = 0.0, .time_s = 2.0, .path_m = 3.0, .energy_j = 50.0};
  const ObjectViewOptions options{.weight_per_s = 1.0, .weight_per_m = 2.0, .weight_per_j = 0.1};
  const auto decision = choose(options);
  EXPECT_DOUBLE_EQ(decision.scores[2].cost, 2.0 + 6.0 + 5.0);
  EXPECT_DOUBLE_EQ(decision.scores[2].score, decision.scores[2].gain.bits / 13.0);
  EXPECT_DOUBLE_EQ(decision.scores[1].cost, 1.0);
  EXPECT_NE(decision.action, 2U);
  EXPECT_EQ(choose({}).scores[2].cost, 1.0);
}

TEST_F(ObjectViewChoiceTest, ConsidersTheMostProbableStatesOnly) {
  const auto decision = choose({.states = 1});
  for (const auto& score : decision.scores) EXPECT_EQ(score.gain.bits, 0.0);
  EXPECT_EQ(decision.action, 0U);
}

TEST_F(ObjectViewChoiceTest, ACertainBeliefHasNothingToGain) {
  for (auto& belief : beliefs_) belief = Eigen::VectorXd::Unit(16, 5);
  for (const auto& score : choose({}).scores) EXPECT_EQ(score.gain.bits, 0.0);
}

TEST_F(ObjectViewChoiceTest, NeedsABeliefForEachAction) {
  beliefs_.pop_back();
  EXPECT_DEATH(choose({}), "a predicted belief for each action");
  actions_.clear();
  EXPECT_DEATH(choose({}), "needs an action");
}

TEST_F(ObjectViewChoiceTest, GainPerCostNeedsCosts) {
  actions_[0].time_s = 0.0;
  EXPECT_DEATH(choose({.weight_per_s = 1.0}), "the cost of every action");
}

TEST(ObjectViewOptions, HaveNoWeightsWhereMotionsCostNothing) {
  EXPECT_NO_THROW(require_no_weights({}, "views"));
  EXPECT_THROW(require_no_weights({.weight_per_s = 1.0}, "views"), ConfigError);
  EXPECT_THROW(require_no_weights({.weight_per_m = 1.0}, "views"), ConfigError);
  EXPECT_THROW(require_no_weights({.weight_per_j = 1.0}, "views"), ConfigError);
}

TEST(ObjectViewOptions, AreChecked) {
  EXPECT_THROW(check_options(ObjectViewOptions{.states = 0}), ConfigError);
  EXPECT_THROW(check_options(ObjectViewOptions{.visited_weight = 1.5}), ConfigError);
  EXPECT_THROW(check_options(ObjectViewOptions{.choice = LossOfEntropy{.samples = 1}}),
               ConfigError);
  EXPECT_THROW(check_options(EnoughViews{.object_probability = 0.0}), ConfigError);
}

class EnoughViewsTest : public ::testing::Test {
 protected:
  EnoughViewsTest() {
    states_.bins = 2;
    states_.objects = {"cup", "mug"};
  }
  std::optional<EnoughReason> enough(const EnoughViews& options, double a, double b, double c,
                                     double d) {
    return seen_enough(options, states_, Eigen::Vector4d(a, b, c, d));
  }
  ObjectStates states_;
};

TEST_F(EnoughViewsTest, SumsAnObjectOverItsPoses) {
  EXPECT_EQ(enough({}, 0.5, 0.45, 0.05, 0.0), EnoughReason::probability);
  EXPECT_EQ(enough({}, 0.45, 0.05, 0.45, 0.05), std::nullopt);
  EXPECT_EQ(enough({}, 0.4, 0.3, 0.15, 0.15), std::nullopt);
  EXPECT_EQ(enough({.object_probability = 0.6}, 0.4, 0.3, 0.15, 0.15), EnoughReason::probability);
}

TEST_F(EnoughViewsTest, OrLooksAtTheEntropyOfTheState) {
  const EnoughViews never{.object_probability = 1.0};
  EXPECT_EQ(enough(never, 0.995, 0.005, 0.0, 0.0), EnoughReason::entropy);
  EXPECT_EQ(enough(never, 0.5, 0.4, 0.1, 0.0), std::nullopt);
  EXPECT_EQ(enough(never, 0.0, 0.0, 1.0, 0.0), EnoughReason::entropy);
  EXPECT_EQ(enough(never, 1.0, 2.3e-16, 0.0, 0.0), EnoughReason::entropy) << "a sum just above 1";
}

TEST_F(EnoughViewsTest, TakesUnknownForAnAnswer) {
  states_.bins = 1;
  states_.categories = {"vessel"};
  states_.unknown_category = {0, kNoCategory};
  EXPECT_EQ(enough({}, 0.03, 0.02, 0.5, 0.45), EnoughReason::probability);
  EXPECT_EQ(enough({}, 0.3, 0.3, 0.2, 0.2), std::nullopt);
}

TEST_F(ObjectViewChoiceTest, InformationCountsByWhatIsVisible) {
  actions_[2].visible = 0.25;
  const ObjectViewDecision by_visibility = choose({});
  const ObjectViewDecision without = choose({.by_visibility = false});
  EXPECT_EQ(without.action, 2U);
  EXPECT_NEAR(by_visibility.scores[2].gain.bits, 0.25 * without.scores[2].gain.bits, 1e-12);
  EXPECT_NEAR(by_visibility.scores[2].score, 0.25 * without.scores[2].score, 1e-12);
  EXPECT_EQ(by_visibility.scores[0].gain.bits, without.scores[0].gain.bits) << "all of it is seen";
}

TEST_F(ObjectViewChoiceTest, AHiddenViewIsNotTakenHoweverMuchItWouldTell) {
  actions_[2].visible = 0.0;
  EXPECT_NE(choose({}).action, 2U);
}

TEST_F(ObjectViewChoiceTest, TheNearestFreeViewIsTheSoonestThatSeesEnough) {
  for (std::size_t i = 0; i < actions_.size(); ++i) {
    actions_[i].time_s = 1.0 + static_cast<double>(i);
    actions_[i].visible = i < 3 ? 0.1 * static_cast<double>(i) : 0.9;
  }
  EXPECT_EQ(choose({.choice = NearestFreeView{}}).action, 3U);
  actions_[3].visited = true;
  EXPECT_EQ(choose({.choice = NearestFreeView{}}).action, 4U);
  EXPECT_EQ(choose({.choice = NearestFreeView{.min_visible = 0.2}}).action, 2U);
  for (ObjectViewAction& action : actions_) action.visible *= 0.5;  // none is free
  actions_[3].visited = false;
  EXPECT_EQ(choose({.choice = NearestFreeView{}}).action, 3U) << "the one that sees most";
}

TEST_F(ObjectViewChoiceTest, EqualWeightsDoNotCancel) {
  for (ObjectViewAction& action : actions_) {
    action = {.time_s = 2.0, .path_m = 3.0, .energy_j = 50.0};
  }
  EXPECT_DOUBLE_EQ(choose({.weight_per_s = 1.0, .weight_per_m = 1.0}).scores[2].cost, 5.0);
  EXPECT_DOUBLE_EQ(choose({.weight_per_m = 1.0, .weight_per_j = 1.0}).scores[2].cost, 53.0);
}

}  // namespace
}  // namespace vantage
