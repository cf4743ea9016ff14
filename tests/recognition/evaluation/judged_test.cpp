// Whether what is believed of a view of a dataset is right.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "vantage/recognition/evaluation/evaluation.hpp"

namespace vantage {
namespace {

using ::testing::ElementsAre;

/// Two cups and a hat of four bins. The views: the second cup in bin 0 and in bin 2, an unknown
/// hat, and a lamp.
class JudgedViews : public ::testing::Test {
 protected:
  JudgedViews() {
    test_.shown = {4, 6, -1, -1};
    test_.category = {0, 0, 1, kNoCategory};
    for (const std::string object : {"cup_2", "cup_2", "hat_7", "lamp_1"}) {
      test_.views.emplace_back().name = {.category = object.substr(0, object.size() - 2),
                                         .object = object};
    }
  }
  [[nodiscard]] static ObjectStates with_unknown_ones(ObjectStates states) {
    states.unknown_category = {0, kNoCategory};
    return states;
  }
  /// Of so many states, all others alike.
  static ObjectBelief belief_of(int states, const std::vector<std::pair<int, double>>& likely) {
    double rest = 1.0;
    for (const auto& [state, p] : likely) rest -= p;
    const auto others = static_cast<double>(states) - static_cast<double>(likely.size());
    ObjectBelief belief{Eigen::VectorXd::Constant(states, std::log(rest / others))};
    for (const auto& [state, p] : likely) belief.log_p[state] = std::log(p);
    return belief;
  }

  ObjectStates states_{.objects = {"cup_1", "cup_2", "hat_1"},
                       .categories = {"cup", "hat"},
                       .category_of = {0, 0, 1},
                       .bins = 4};
  TestViews test_;
};

TEST_F(JudgedViews, AnEstimateIsRightOfTheObjectOrOfItsCategory) {
  const auto of = [&](std::size_t view, int estimate) {
    return judged(states_, test_, view, estimate);
  };
  EXPECT_EQ(of(0, 1).object, 1);
  EXPECT_EQ(of(0, 1).estimate, 1);
  EXPECT_EQ(of(0, 1).name, "cup_2");
  EXPECT_EQ(of(0, 1).category, "cup");
  EXPECT_EQ(of(0, 1).observations, 1);
  EXPECT_TRUE(of(0, 1).correct);
  EXPECT_TRUE(of(0, 1).category_correct);
  EXPECT_FALSE(of(0, 0).correct);
  EXPECT_TRUE(of(0, 0).category_correct) << "the other cup";
  EXPECT_FALSE(of(0, 2).correct);
  EXPECT_FALSE(of(0, 2).category_correct);
  EXPECT_FALSE(of(0, 3).correct) << "held for unknown";
  EXPECT_FALSE(of(0, 3).category_correct);
  EXPECT_EQ(of(2, 2).object, -1);
  EXPECT_FALSE(of(2, 2).correct);
  EXPECT_TRUE(of(2, 2).category_correct) << "a hat";
  EXPECT_FALSE(of(3, 2).category_correct);
  EXPECT_TRUE(is_known(test_, 1));
  EXPECT_FALSE(is_known(test_, 2));
}

TEST_F(JudgedViews, ABeliefIsOfTheMostProbableObjectInItsMeanYaw) {
  // The second cup between its bins 1 and 2, nearer to the latter.
  const ObjectBelief belief = belief_of(12, {{5, 0.3}, {6, 0.5}, {4, 1e-9}, {7, 1e-9}});
  const Trial first = judged(states_, test_, 0, belief);
  EXPECT_TRUE(first.correct);
  EXPECT_EQ(first.bin_error, 2);
  EXPECT_EQ(judged(states_, test_, 1, belief).bin_error, 0);
  EXPECT_NEAR(first.probability, 0.8, 1e-8);
  EXPECT_EQ(first.unknown_probability, 0.0);
  EXPECT_NEAR(first.entropy_bits,
              -0.3 * std::log2(0.3) - 0.5 * std::log2(0.5) - 0.2 * std::log2(0.2 / 8.0), 1e-6);
  EXPECT_EQ(judged(states_, test_, 2, belief).bin_error, 0) << "of what is unknown";
  EXPECT_FALSE(judged(states_, test_, 2, belief).category_correct);
}

TEST_F(JudgedViews, UnknownIsRightOfUnknownOnesOnly) {
  const ObjectStates states = with_unknown_ones(states_);
  const ObjectBelief none = belief_of(14, {{13, 0.55}, {12, 0.05}});
  for (const std::size_t view : {0U, 2U, 3U}) {
    const Trial trial = judged(states, test_, view, none);
    EXPECT_EQ(trial.estimate, 3);
    EXPECT_EQ(trial.correct, view >= 2) << view;
    EXPECT_NEAR(trial.probability, 0.6, 1e-9);
    EXPECT_NEAR(trial.unknown_probability, 0.6, 1e-9);
  }
  EXPECT_TRUE(judged(states, test_, 3, none).category_correct) << "of none";
  const ObjectBelief another_cup = belief_of(14, {{12, 0.55}, {13, 0.05}});
  EXPECT_FALSE(judged(states, test_, 3, another_cup).category_correct);
  EXPECT_TRUE(judged(states, test_, 0, another_cup).category_correct) << "a cup";
  EXPECT_FALSE(judged(states, test_, 2, another_cup).category_correct) << "a hat";
}

/// A hat, but either cup is a cup.
TEST_F(JudgedViews, TheCategoryIsTheMostProbableOneOfAll) {
  const std::vector<std::pair<int, double>> likely{{8, 0.4}, {0, 0.3}, {4, 0.25}};
  const Trial hat = judged(states_, test_, 2, belief_of(12, likely));
  EXPECT_EQ(hat.estimate, 2);
  EXPECT_TRUE(hat.category_correct) << "that of the object, without unknown ones";
  const ObjectStates states = with_unknown_ones(states_);
  EXPECT_FALSE(judged(states, test_, 2, belief_of(14, likely)).category_correct);
  EXPECT_TRUE(judged(states, test_, 0, belief_of(14, likely)).category_correct);
  EXPECT_FALSE(judged(states, test_, 0, belief_of(14, likely)).correct);
}

TEST(PublishedMethods, AreThoseOfTheTables) {
  RecognitionOptions common;
  common.max_views = 5;
  common.features.states = 7;
  std::vector<std::string> names;
  const std::vector<Method> methods = published_methods(common);
  for (const Method& method : methods) {
    names.push_back(method.name);
    const bool single = method.name.starts_with("single view");
    EXPECT_EQ(method.options.max_views, single ? 1 : 5) << method.name;
    EXPECT_EQ(method.options.all_features, method.name.ends_with("all features")) << method.name;
    EXPECT_EQ(method.options.features.states, 7) << method.name;
    const auto choice = strategy_name_of(method.options.views.choice);
    EXPECT_TRUE(single ? choice == "random" : method.name.starts_with(choice)) << method.name;
    if (method.options.all_features) continue;
    EXPECT_EQ(
        strategy_name_of(method.options.features.measure),
        method.name.ends_with("by loss_of_entropy") ? "loss_of_entropy" : "mutual_information")
        << method.name;
  }
  EXPECT_THAT(names,
              ElementsAre("single view, all features", "single view, features by loss_of_entropy",
                          "single view, features by mutual_information", "random, all features",
                          "random", "star, all features", "star", "jeffreys, all features",
                          "jeffreys", "loss_of_entropy, all features", "loss_of_entropy",
                          "mutual_information, all features", "mutual_information"));
}

TEST_F(JudgedViews, TheFirstStateOfAllIsKnownToo) {
  test_.shown[0] = 0;
  EXPECT_TRUE(is_known(test_, 0));
  EXPECT_EQ(judged(states_, test_, 0, 1).object, 0);
  const ObjectBelief from_behind = belief_of(12, {{2, 0.9}});
  EXPECT_EQ(judged(states_, test_, 0, from_behind).bin_error, 2);
  const ObjectBelief none = belief_of(14, {{13, 0.9}});
  EXPECT_FALSE(judged(with_unknown_ones(states_), test_, 0, none).correct);
}

}  // namespace
}  // namespace vantage
