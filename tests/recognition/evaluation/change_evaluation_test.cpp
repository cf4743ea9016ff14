// How well changes are detected, and which could be.
#include "vantage/recognition/evaluation/change_evaluation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace vantage {
namespace {

ChangeTrials trials_of(Change scenario, const std::vector<std::pair<Change, bool>>& decided) {
  ChangeTrials trials{.method = "star", .scenario = scenario, .trials = {}};
  for (const auto& [decision, detectable] : decided) {
    trials.trials.push_back({.decision = decision, .detectable = detectable});
  }
  return trials;
}

TEST(ChangeScores, OfAChangeCountWhatWasHeldForOne) {
  const ChangeTrials turned = trials_of(Change::pose, {{Change::pose, true},
                                                       {Change::object, false},
                                                       {Change::none, true},
                                                       {Change::removed, true},
                                                       {Change::none, false}});
  EXPECT_DOUBLE_EQ(turned.accuracy(), 0.6);
  EXPECT_DOUBLE_EQ(turned.kind_accuracy(), 0.2);
  EXPECT_DOUBLE_EQ(turned.detectable_share(), 0.6);
  EXPECT_DOUBLE_EQ(turned.detectable_accuracy(), 2.0 / 3.0);
}

TEST(ChangeScores, OfNoChangeCountWhatWasHeldForNone) {
  const ChangeTrials same = trials_of(
      Change::none,
      {{Change::none, false}, {Change::none, true}, {Change::pose, true}, {Change::none, false}});
  EXPECT_DOUBLE_EQ(same.accuracy(), 0.75);
  EXPECT_DOUBLE_EQ(same.detectable_accuracy(), 0.75);
  EXPECT_DOUBLE_EQ(same.kind_accuracy(), 0.75);
}

TEST(ChangeScores, OfNothingDetectableAreNone) {
  const ChangeTrials hidden =
      trials_of(Change::object, {{Change::object, false}, {Change::none, false}});
  EXPECT_DOUBLE_EQ(hidden.accuracy(), 0.5);
  EXPECT_TRUE(std::isnan(hidden.detectable_accuracy()));
  EXPECT_EQ(hidden.detectable_share(), 0.0);
}

/// Three objects of four bins, each bin shown once; what a state measures goes with its object or
/// with its bin alone.
struct PlainWorld {
  Recogniser recogniser;
  TestViews test;

  explicit PlainWorld(bool by_object) {
    const ObjectStates states{.objects = {"a_1", "b_1", "c_1"},
                              .categories = {"a", "b", "c"},
                              .category_of = {0, 1, 2},
                              .bins = 4};
    ObservationModel model{.feature = "colour",
                           .mean = Eigen::MatrixXf(1, 12),
                           .variance = Eigen::MatrixXf::Ones(1, 12)};
    for (int state = 0; state < 12; ++state) {
      const int at = by_object ? states.object_of(state) : states.bin_of(state);
      model.mean(0, state) = 10.0F * static_cast<float>(at);
      if (states.bin_of(state) == 0) test.turntables.emplace_back();
      test.turntables.back().views.push_back(test.views.size());
      ViewFeatures& view = test.views.emplace_back();
      view.yaw_rad = states.bin_of(state) * std::numbers::pi / 2.0;
      view.features.push_back({model.mean.col(state), {}});
      test.shown.push_back(state);
      test.category.push_back(states.object_of(state));
    }
    recogniser = make_recogniser(states, {{TrainedFeature(Colour{}, 0.0), model}}, 1);
  }
  [[nodiscard]] std::vector<ChangeTrials> evaluated() const {
    return evaluate_changes(recogniser, test, log_likelihoods(recogniser, test, {}),
                            draw_starts(test, 40, 1), {}, 1, {});
  }
};

TEST(EvaluatedChanges, ExpectAnotherObjectOrAnotherPose) {
  for (const bool by_object : {true, false}) {
    for (const ChangeTrials& of : PlainWorld(by_object).evaluated()) {
      ASSERT_EQ(of.trials.size(), 40U);
      const double share = of.detectable_share();
      if (of.scenario == Change::none) {
        EXPECT_EQ(share, 0.0) << of.method;
      } else if (of.scenario == Change::pose) {
        EXPECT_EQ(share, by_object ? 0.0 : 1.0) << of.method;
      } else if (by_object) {
        EXPECT_EQ(share, 1.0) << of.method;
      } else {
        EXPECT_GT(share, 0.0) << "expected in any pose";
        EXPECT_LT(share, 1.0) << "the same one too";
      }
    }
  }
}

TEST(EvaluatedChanges, AreOfEachChoiceOfViewsInEachScenario) {
  const std::vector<ChangeTrials> all = PlainWorld(true).evaluated();
  const std::vector<std::string> methods{"random", "star", "jeffreys", "loss_of_entropy",
                                         "mutual_information"};
  ASSERT_EQ(all.size(), 15U);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].method, methods[i % 5]);
    EXPECT_EQ(all[i].scenario, i < 5 ? Change::none : (i < 10 ? Change::object : Change::pose));
    for (const ChangeTrial& trial : all[i].trials) {
      EXPECT_GE(trial.observations, 1);
      EXPECT_LE(trial.observations, 8);
    }
  }
}

TEST(EvaluatedChanges, TakeTheTimeOfFeaturesAndOfChoices) {
  PlainWorld world(true);
  for (const double cost_s : {0.0, 2.0}) {
    world.recogniser.features[0].observation.cost_s = cost_s;
    for (const ChangeTrials& of : world.evaluated()) {
      for (const ChangeTrial& trial : of.trials) {
        EXPECT_GE(trial.time_s, cost_s * trial.observations) << of.method;
      }
    }
  }
}

TEST(LogLikelihoods, AreZeroWhereThereIsNoFeature) {
  PlainWorld world(true);
  world.test.views[3].features[0] = FeatureResult::skip("hidden");
  const std::vector<Eigen::MatrixXf> all = log_likelihoods(world.recogniser, world.test, {});
  ASSERT_EQ(all.size(), 1U);
  EXPECT_TRUE(all[0].col(3).isZero());
  const Eigen::VectorXd expected =
      log_likelihood(world.recogniser.features[0].prepared, world.test.views[5].features[0].vector);
  EXPECT_TRUE(all[0].col(5).isApprox(expected.cast<float>()));
}

TEST(LogLikelihoods, AreOfTheFeaturesBesideThoseThatAreMissing) {
  PlainWorld world(true);
  const ObservationModel model = world.recogniser.features[0].observation;
  const Recogniser recogniser = make_recogniser(
      world.recogniser.states,
      {{TrainedFeature(Colour{}, 0.0), model}, {TrainedFeature(Colour{}, 0.0), model}}, 1);
  for (ViewFeatures& view : world.test.views) {
    view.features.insert(view.features.begin(), FeatureResult::skip("hidden"));
  }
  const std::vector<Eigen::MatrixXf> all = log_likelihoods(recogniser, world.test, {});
  ASSERT_EQ(all.size(), 2U);
  EXPECT_TRUE(all[0].isZero());
  const Eigen::VectorXd expected =
      log_likelihood(recogniser.features[1].prepared, world.test.views[5].features[1].vector);
  EXPECT_TRUE(all[1].col(5).isApprox(expected.cast<float>()));
}

}  // namespace
}  // namespace vantage
