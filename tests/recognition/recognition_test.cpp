#include "vantage/recognition/recognition.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/recognition/made_up.hpp"
#include "vantage/core/log.hpp"

namespace vantage {
namespace {

using test::MadeUpCamera;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kTurn_rad = std::numbers::pi / 4.0;

/// Two objects of two poses, alike but in pose 1; a feature without noise to speak of.
class NearDuplicateMugs : public ::testing::Test {
 protected:
  NearDuplicateMugs() {
    states_.objects = {"mug_1", "mug_2"};
    states_.categories = {"mug"};
    states_.category_of = {0, 0};
    states_.bins = 2;
    ObservationModel model{.feature = "colour",
                           .mean = Eigen::MatrixXf(1, 4),
                           .variance = Eigen::MatrixXf::Constant(1, 4, 0.01F),
                           .cost_s = 0.5};
    model.mean << 0.0F, 1.0F, 0.0F, 2.0F;
    ObservationModel useless = model;
    useless.feature = "useless";
    useless.mean.setZero();
    recogniser_ = make_recogniser(
        states_, {{TrainedFeature(Colour{}, 0.5), model}, {TrainedFeature(Colour{}, 0.5), useless}},
        1);
    options_.transition = RigidTransition{.slip = 0.0};
  }

  /// Measures the mean of `state` with any feature.
  ExtractFeature measuring(int state) {
    return [this, state](std::size_t feature) {
      return ExtractedFeature{
          .result = {recogniser_.features[feature].observation.mean.col(state), {}},
          .time_s = 0.25};
    };
  }

  ObjectStates states_;
  Recogniser recogniser_;
  RecognitionOptions options_;
  Rng rng_{1};
};

TEST_F(NearDuplicateMugs, AViewIsBayesRuleWithTheFeaturesChosen) {
  Recognition recognition = begin_recognition(recogniser_);
  update_with_view(recogniser_, options_, measuring(0), 0.0, recognition, rng_);
  const Eigen::VectorXd p = p_state(recognition.belief);
  EXPECT_NEAR(p[0], 0.5, 1e-9);
  EXPECT_NEAR(p[2], 0.5, 1e-9);
  ASSERT_THAT(recognition.views, SizeIs(1));
  EXPECT_THAT(recognition.views[0].features, ElementsAre("colour"));
  EXPECT_NEAR(recognition.views[0].entropy_bits, 1.0, 1e-9);
  EXPECT_EQ(recognition.views[0].feature_time_s, 0.25);
}

TEST_F(NearDuplicateMugs, AllFeaturesAreExtractedInOrderIfAsked) {
  options_.all_features = true;
  Recognition recognition = begin_recognition(recogniser_);
  update_with_view(recogniser_, options_, measuring(0), 0.0, recognition, rng_);
  EXPECT_THAT(recognition.views[0].features, ElementsAre("colour", "useless"));
  EXPECT_EQ(recognition.views[0].feature_time_s, 0.5);
}

TEST_F(NearDuplicateMugs, ASkippedFeatureIsReportedAndNotTriedAgain) {
  int calls = 0;
  const ExtractFeature failing = [&](std::size_t) {
    ++calls;
    return ExtractedFeature{.result = FeatureResult::skip("too few pixels"), .time_s = 0.1};
  };
  options_.all_features = true;
  Recognition recognition = begin_recognition(recogniser_);
  update_with_view(recogniser_, options_, failing, 0.0, recognition, rng_);
  EXPECT_EQ(calls, 2);
  EXPECT_THAT(recognition.views[0].features, IsEmpty());
  ASSERT_THAT(recognition.views[0].skipped, SizeIs(2));
  EXPECT_EQ(recognition.views[0].skipped[0].feature, "colour");
  EXPECT_EQ(recognition.views[0].skipped[0].reason, "too few pixels");
  EXPECT_NEAR(recognition.views[0].entropy_bits, 2.0, 1e-9);
}

TEST_F(NearDuplicateMugs, AViewThatToldNothingTakesNothingFromTheNext) {
  recogniser_.view_correlation = 0.5;
  Recognition recognition = begin_recognition(recogniser_);
  const auto hidden = [](std::size_t) {
    return ExtractedFeature{.result = FeatureResult::skip("hidden")};
  };
  update_with_view(recogniser_, options_, hidden, 0.0, recognition, rng_);
  EXPECT_EQ(next_view_weight(recogniser_, recognition), 1.0);
  update_with_view(recogniser_, options_, measuring(0), 0.0, recognition, rng_);
  EXPECT_LT(next_view_weight(recogniser_, recognition), 1.0);
}

TEST_F(NearDuplicateMugs, AFeatureThatFitsNoStateIsSkippedWithTheReason) {
  const ExtractFeature impossible = [&](std::size_t) {
    return ExtractedFeature{
        .result = {Eigen::VectorXf::Zero(1), {}},
        .log_likelihood = Eigen::VectorXd::Constant(4, -std::numeric_limits<double>::infinity())};
  };
  Recognition recognition = begin_recognition(recogniser_);
  update_with_view(recogniser_, options_, impossible, 0.0, recognition, rng_);
  ASSERT_FALSE(recognition.views[0].skipped.empty());
  EXPECT_THAT(recognition.views[0].skipped[0].reason, HasSubstr("no state"));
}

/// Measures 0.51 of what is 0, 1, 0 and 2: ln odds of 1 for the second, none for the last.
TEST_F(NearDuplicateMugs, APartThatWasSeenTellsAsMuchLess) {
  options_.all_features = true;
  for (const double weight : {1.0, 0.5}) {
    const ExtractFeature extract = [&](std::size_t) {
      return ExtractedFeature{.result = {.vector = Eigen::VectorXf::Constant(1, 0.51F),
                                         .skipped = {},
                                         .readings = {},
                                         .weight = weight}};
    };
    Recognition recognition = begin_recognition(recogniser_);
    update_with_view(recogniser_, options_, extract, 0.0, recognition, rng_);
    const Eigen::VectorXd p = p_state(recognition.belief);
    EXPECT_NEAR(p[1] / p[0], std::exp(weight), 1e-3);
    EXPECT_NEAR(p[1], std::exp(weight) / (2.0 + std::exp(weight)), 1e-3);
  }
}

TEST_F(NearDuplicateMugs, LikelihoodsThatAreKnownCountAsTheyAre) {
  const ExtractFeature extract = [&](std::size_t) {
    return ExtractedFeature{.result = {.vector = Eigen::VectorXf::Zero(1),
                                       .skipped = {},
                                       .readings = {},
                                       .weight = 0.5},
                            .log_likelihood = Eigen::Vector4d(0.0, 0.5, 1.0, 0.25)};
  };
  options_.all_features = true;
  Recognition recognition = begin_recognition(recogniser_);
  update_with_view(recogniser_, options_, extract, 0.0, recognition, rng_);
  const Eigen::VectorXd p = p_state(recognition.belief);
  EXPECT_NEAR(std::log(p[1] / p[0]), 1.0, 1e-9) << "two features";
  EXPECT_NEAR(std::log(p[2] / p[0]), 2.0, 1e-9);
  EXPECT_NEAR(std::log(p[3] / p[0]), 0.5, 1e-9);
}

TEST(Weighted, IsToThePowerOfTheWeight) {
  EXPECT_EQ(weighted(Eigen::Vector2d(-3.0, 2.0), 1.0), Eigen::VectorXd(Eigen::Vector2d(-3.0, 2.0)));
  EXPECT_EQ(weighted(Eigen::Vector2d(-3.0, 2.0), 0.5), Eigen::VectorXd(Eigen::Vector2d(-1.5, 1.0)));
  EXPECT_EQ(weighted(Eigen::Vector2d(-3.0, 2.0), 2.0), Eigen::VectorXd(Eigen::Vector2d(-6.0, 4.0)));
}

TEST_F(NearDuplicateMugs, ALearnedTransitionWithoutSlipsIsTheModels) {
  recogniser_.transition = as_learned(RigidTransition{.slip = 0.4}, 2);
  const auto p_turned = [&] {
    Recognition recognition = begin_recognition(recogniser_);
    recognition.belief.log_p.setConstant(-std::numeric_limits<double>::infinity());
    recognition.belief.log_p[2] = 0.0;
    predict_motion(recogniser_, options_, std::numbers::pi, recognition);
    return p_state(recognition.belief)[3];
  };
  options_.transition = LearnedTransition{};
  EXPECT_NEAR(p_turned(), 0.6, 1e-9);
  options_.transition = as_learned(RigidTransition{.slip = 0.3}, 2);
  EXPECT_NEAR(p_turned(), 0.7, 1e-9);
  options_.transition = RigidTransition{.slip = 0.2};
  EXPECT_NEAR(p_turned(), 0.8, 1e-9);
}

TEST_F(NearDuplicateMugs, WhereThereIsNoOtherViewItEnds) {
  int turns = 0;
  const ObjectCamera camera{.extract = measuring(0),
                            .bearing_rad = [] { return 0.75; },
                            .actions = [] { return std::vector<ObjectViewAction>{}; },
                            .turn = [&](const ObjectViewAction&) { ++turns; }};
  const Recognition known = recognise(recogniser_, options_, camera, rng_);
  ASSERT_THAT(known.views, SizeIs(1));
  EXPECT_EQ(known.views[0].view_rad, 0.75);
  EXPECT_EQ(known.views[0].view_time_s, 0.0);
  EXPECT_EQ(turns, 0);
}

TEST_F(NearDuplicateMugs, TheNextViewIsWhereTheyDiffer) {
  Recognition recognition = begin_recognition(recogniser_);
  update_with_view(recogniser_, options_, measuring(0), 0.0, recognition, rng_);
  const std::vector<ObjectViewAction> actions{{.yaw_rad = 2.0 * std::numbers::pi},
                                              {.yaw_rad = std::numbers::pi}};
  const NextView next = next_view(recogniser_, options_, recognition, actions, rng_);
  EXPECT_EQ(next.decision.action, 1U);
  EXPECT_NEAR(next.decision.scores[1].gain.bits, 1.0, 1e-4);
  EXPECT_NEAR(next.decision.scores[0].gain.bits, 0.0, 1e-6);
}

TEST_F(NearDuplicateMugs, ItEndsWhenSureOrAfterSoManyViews) {
  Recognition recognition = begin_recognition(recogniser_);
  EXPECT_EQ(recognition_end(recogniser_, options_, recognition), std::nullopt);
  update_with_view(recogniser_, options_, measuring(0), 0.0, recognition, rng_);
  EXPECT_EQ(recognition_end(recogniser_, options_, recognition), std::nullopt);
  options_.max_views = 1;
  EXPECT_EQ(recognition_end(recogniser_, options_, recognition), RecognitionEnd::max_views);
  update_with_view(recogniser_, options_, measuring(3), 0.0, recognition, rng_);
  recognition.belief = uniform_belief(states_);
  update_with_view(recogniser_, options_, measuring(3), 0.0, recognition, rng_);
  EXPECT_EQ(recognition_end(recogniser_, options_, recognition), RecognitionEnd::sure);
}

TEST(Recognition, BeginsWithSidesThatTheModelHasViewsOf) {
  Rng rng(3);
  Recogniser recogniser = test::made_up_recogniser(2, {2.0}, {}, rng, 4);
  recogniser.states.unknown_category = {kNoCategory};
  recogniser.unknown_prior = 0.2;
  recogniser.unseen = {1, 2, 3, 6};
  RecognitionOptions options;
  options.transition = RigidTransition{.slip = 0.0};
  const Recognition recognition = begin_recognition(recogniser);
  const Eigen::VectorXd p = p_state(recognition.belief);
  const double third = 0.4 / 3.0;
  EXPECT_TRUE(p.head(8).isApprox(
      Eigen::Vector<double, 8>(0.4, 0.0, 0.0, 0.0, third, third, 0.0, third), 1e-12));
  EXPECT_NEAR(p[8], 0.2, 1e-12);
  const auto unseen_after = [&](double quarters) {
    return p_unseen_side(recogniser, options, recognition, quarters * std::numbers::pi / 2.0);
  };
  EXPECT_NEAR(unseen_after(0.0), 0.0, 1e-12);
  EXPECT_NEAR(unseen_after(1.0), 0.5 + 0.5 / 3.0, 1e-12) << "bin 0 becomes 3";
  EXPECT_NEAR(unseen_after(2.0), 0.5 + 0.5 / 3.0, 1e-12);
}

TEST(Recognition, TheYawThatACameraSeesFallsAsItsBearingRises) {
  Rng rng(3);
  const Recogniser recogniser = test::made_up_recogniser(2, {2.0}, {}, rng);
  RecognitionOptions options;
  options.transition = RigidTransition{.slip = 0.0};
  Recognition recognition = begin_recognition(recogniser);
  const int before = recogniser.states.state(1, 2);
  recognition.belief.log_p.setConstant(-std::numeric_limits<double>::infinity());
  recognition.belief.log_p[before] = 0.0;
  predict_motion(recogniser, options, kTurn_rad, recognition);
  EXPECT_EQ(most_probable_state(recognition.belief), recogniser.states.state(1, 1));
}

TEST(Recognition, TheLoopFindsTheObjectAndKnowsItsPose) {
  Rng rng(7);
  const Recogniser recogniser = test::made_up_recogniser(12, {6.0, 12.0}, {}, rng);
  RecognitionOptions options;
  options.enough = {.object_probability = 0.99, .entropy_bits = 0.05};
  int right = 0;
  int close = 0;
  constexpr int kTrials = 60;
  for (int i = 0; i < kTrials; ++i) {
    MadeUpCamera camera{.recogniser = recogniser, .object = i % 12, .bin = i % 8, .rng = rng};
    const Recognition known = recognise(recogniser, options, object_camera(camera), rng);
    right += most_probable_object(recogniser.states, known.belief) == camera.object;
    const int truth = recogniser.states.state(camera.object, camera.bin);
    close += bin_error(recogniser.states, most_probable_state(known.belief), truth) <= 1;
    EXPECT_LE(known.views.size(), 8U);
    EXPECT_NEAR(known.views.back().view_rad, camera.bearing_rad, 1e-12);
  }
  EXPECT_GE(right, 58);
  EXPECT_GE(close, 54);
}

TEST(Recognition, ChosenViewsNeedFewerThanRandomOnes) {
  Rng made(11);
  const Recogniser recogniser = test::made_up_recogniser(16, {4.0}, {.decal = 2.5}, made);
  const auto mean_views = [&](const ObjectViewChoice& choice) {
    RecognitionOptions options;
    options.views.choice = choice;
    options.enough = {.object_probability = 0.95, .entropy_bits = 0.0};
    double views = 0.0;
    constexpr int kTrials = 200;
    for (int i = 0; i < kTrials; ++i) {
      Rng rng = Rng::stream(5, std::to_string(i));
      MadeUpCamera camera{.recogniser = recogniser, .object = i % 16, .bin = i % 8, .rng = rng};
      const Recognition known = recognise(recogniser, options, object_camera(camera), rng);
      views += static_cast<double>(known.views.size()) / kTrials;
    }
    return views;
  };
  EXPECT_LT(mean_views(MutualInformation{}), 0.95 * mean_views(RandomObjectView{}));
}

TEST(Recognition, OptionsOutOfRangeAreNamed) {
  Rng rng(1);
  const Recogniser recogniser = test::made_up_recogniser(2, {2.0}, {}, rng);
  MadeUpCamera camera{.recogniser = recogniser, .rng = rng};
  RecognitionOptions options;
  options.max_views = 0;
  try {
    recognise(recogniser, options, object_camera(camera), rng);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("max_views"));
  }
}

TEST(Recognition, WhatIsNoneOfTheModelsShowsNoUnseenSide) {
  Rng rng(3);
  Recogniser recogniser = test::made_up_recogniser(2, {2.0}, {}, rng, 4);
  recogniser.states.unknown_category = {kNoCategory};
  recogniser.unseen = {1, 2, 3};
  RecognitionOptions options;
  options.transition = RigidTransition{.slip = 0.0};
  Recognition recognition = begin_recognition(recogniser);
  recognition.belief.log_p.setConstant(-std::numeric_limits<double>::infinity());
  recognition.belief.log_p[8] = 0.0;
  EXPECT_EQ(p_unseen_side(recogniser, options, recognition, 0.0), 0.0);
}

TEST(Recognition, TellsTheTimeThatItsChoicesTook) {
  Rng rng(7);
  const Recogniser recogniser = test::made_up_recogniser(12, {1.0, 1.0}, {}, rng);
  RecognitionOptions options;
  options.enough = {.object_probability = 1.0, .entropy_bits = 0.0};
  options.max_views = 3;
  MadeUpCamera camera{.recogniser = recogniser, .object = 3, .bin = 2, .rng = rng};
  const double start_s = wall_s();
  const Recognition known = recognise(recogniser, options, object_camera(camera), rng);
  const double took_s = wall_s() - start_s;
  ASSERT_THAT(known.views, SizeIs(3));
  double chosen_s = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_GT(known.views[i].selection_time_s, 0.0) << i;
    EXPECT_EQ(known.views[i].view_time_s > 0.0, i > 0) << i << ": the first was not chosen";
    chosen_s += known.views[i].selection_time_s + known.views[i].view_time_s;
  }
  EXPECT_LE(chosen_s, took_s);
}

TEST_F(NearDuplicateMugs, ExtractingFromAViewTakesItsTimeOfTheWhole) {
  const ObjectView nothing;
  const ExtractFeature extract = extract_from(recogniser_, nothing);
  const double start_s = wall_s();
  const ExtractedFeature extracted = extract(0);
  EXPECT_GE(extracted.time_s, 0.0);
  EXPECT_LE(extracted.time_s, wall_s() - start_s);
}

TEST_F(NearDuplicateMugs, AFeatureIsComparedWithTheOneBeforeIt) {
  options_.features.stop = GainDecreasing{};
  Recognition recognition = begin_recognition(recogniser_);
  update_with_view(recogniser_, options_, measuring(0), 0.0, recognition, rng_);
  EXPECT_THAT(recognition.views[0].features, ElementsAre("colour")) << "the other tells less";
}

/// From the front they look alike, from behind they differ.
TEST_F(NearDuplicateMugs, TheLoopTurnsTheCameraAndWhatIsBelieved) {
  int turns = 0;
  const ObjectCamera camera{
      .extract = [&](std::size_t feature) { return measuring(turns > 0 ? 3 : 2)(feature); },
      .bearing_rad = [&] { return turns * std::numbers::pi; },
      .actions = [] { return std::vector<ObjectViewAction>{{.yaw_rad = std::numbers::pi}}; },
      .turn = [&](const ObjectViewAction&) { ++turns; }};
  const Recognition known = recognise(recogniser_, options_, camera, rng_);
  EXPECT_EQ(turns, 1);
  ASSERT_THAT(known.views, SizeIs(2));
  EXPECT_EQ(known.views[1].view_rad, std::numbers::pi);
  EXPECT_NEAR(p_state(known.belief)[3], 1.0, 1e-6);
}

TEST(Recognition, GoesByWhatIsKnownOfASingleStateToo) {
  Rng rng(1);
  const Recogniser recogniser = test::made_up_recogniser(1, {1.0}, {}, rng, 1);
  RecognitionOptions options;
  options.all_features = true;
  const ExtractFeature impossible = [&](std::size_t) {
    return ExtractedFeature{
        .result = {Eigen::VectorXf::Zero(10), {}},
        .log_likelihood = Eigen::VectorXd::Constant(1, -std::numeric_limits<double>::infinity())};
  };
  Recognition recognition = begin_recognition(recogniser);
  update_with_view(recogniser, options, impossible, 0.0, recognition, rng);
  EXPECT_THAT(recognition.views[0].features, IsEmpty());
  EXPECT_THAT(recognition.views[0].skipped, SizeIs(1));
}

}  // namespace
}  // namespace vantage
