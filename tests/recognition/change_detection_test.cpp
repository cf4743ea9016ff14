#include "vantage/recognition/change_detection.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "tests/recognition/made_up.hpp"

namespace vantage {
namespace {

using test::MadeUpCamera;
using ::testing::HasSubstr;

constexpr int kObjects = 12;

class ChangeDetection : public ::testing::Test {
 protected:
  ChangeDetection() : recogniser_(make()) {}

  static Recogniser make() {
    Rng rng(2);
    return test::made_up_recogniser(kObjects, {6.0, 10.0}, {.near_duplicate = 0.8}, rng);
  }

  ChangeReport detect(int object, int bin, int expected_object, int expected_bin,
                      std::uint64_t seed) {
    Rng rng(seed);
    MadeUpCamera camera{.recogniser = recogniser_, .object = object, .bin = bin, .rng = rng};
    return detect_change(recogniser_, options_,
                         recogniser_.states.state(expected_object, expected_bin),
                         object_camera(camera), rng);
  }

  Recogniser recogniser_;
  ChangeOptions options_;
};

TEST_F(ChangeDetection, TellsWhatChanged) {
  int unchanged = 0;
  int object = 0;
  int pose = 0;
  constexpr int kTrials = 60;
  for (int i = 0; i < kTrials; ++i) {
    const int k = i % kObjects;
    const int q = i % 8;
    const auto seed = static_cast<std::uint64_t>(i);
    unchanged += detect(k, q, k, q, seed).change == Change::none;
    object += detect(k, q, (k + 5) % kObjects, (q + 2) % 8, seed).change == Change::object;
    pose += detect(k, q, k, (q + 3) % 8, seed).change == Change::pose;
  }
  EXPECT_GE(unchanged, 57);
  EXPECT_GE(object, 54);
  EXPECT_GE(pose, 54);
}

TEST_F(ChangeDetection, NothingWhereSomethingWasExpectedIsRemoved) {
  int turns = 0;
  const ObjectCamera nothing{
      .extract =
          [](std::size_t) { return ExtractedFeature{.result = FeatureResult::skip("no object")}; },
      .bearing_rad = [] { return 0.0; },
      .actions = [] { return std::vector<ObjectViewAction>{{.yaw_rad = 1.0}}; },
      .turn = [&](const ObjectViewAction&) { ++turns; }};
  Rng rng(1);
  options_.empty_views = 3;
  const ChangeReport report = detect_change(recogniser_, options_, 0, nothing, rng);
  EXPECT_EQ(report.change, Change::removed);
  EXPECT_EQ(report.p_changed, 1.0);
  EXPECT_EQ(turns, 2);
  ASSERT_EQ(report.recognition.views.size(), 3U);
  EXPECT_EQ(report.recognition.views[0].view_time_s, 0.0) << "it was not chosen";
  EXPECT_GT(report.recognition.views[1].view_time_s, 0.0);
  EXPECT_GT(report.recognition.views[2].view_time_s, 0.0);
}

/// Hidden, seen, hidden: it is there.
TEST_F(ChangeDetection, WhatIsSeenBetweenEmptyViewsIsNotRemoved) {
  ChangeSearch search = begin_change_search(recogniser_, options_, 0);
  Rng rng(1);
  const auto hidden = [](std::size_t) {
    return ExtractedFeature{.result = FeatureResult::skip("hidden")};
  };
  const auto seen = [&](std::size_t feature) {
    return ExtractedFeature{.result = {recogniser_.features[feature].observation.mean.col(0), {}}};
  };
  update_with_view(recogniser_, options_, hidden, 0.0, search, rng);
  EXPECT_EQ(verdict(recogniser_, options_, search), Change::removed);
  update_with_view(recogniser_, options_, seen, 0.0, search, rng);
  update_with_view(recogniser_, options_, hidden, 0.0, search, rng);
  EXPECT_NE(verdict(recogniser_, options_, search), Change::removed);
  EXPECT_NE(change_end(options_, search), ChangeEnd::nothing_seen);
  update_with_view(recogniser_, options_, hidden, 0.0, search, rng);
  EXPECT_EQ(change_end(options_, search), ChangeEnd::nothing_seen);
}

/// Two states and one feature: P(u) in closed form.
TEST(ChangeDetectionInClosedForm, WeighsTheHypothesesByBayesRule) {
  ObjectStates states;
  states.objects = {"a_1", "b_1"};
  states.categories = {"a", "b"};
  states.category_of = {0, 1};
  states.bins = 1;
  ObservationModel model{
      .feature = "colour", .mean = Eigen::MatrixXf(1, 2), .variance = Eigen::MatrixXf::Ones(1, 2)};
  model.mean << 0.0F, 1.0F;
  const Recogniser recogniser =
      make_recogniser(states, {{TrainedFeature(Colour{}, 0.0), model}}, 1);
  ChangeOptions options;
  options.recognition.all_features = true;
  options.recognition.max_views = 1;
  options.prior_pose = 0.0;
  options.prior_object = 0.2;
  const float x = 0.9F;
  const ObjectCamera camera{
      .extract =
          [&](std::size_t) {
            return ExtractedFeature{.result = {Eigen::VectorXf::Constant(1, x), {}}};
          },
      .bearing_rad = [] { return 0.0; },
      .actions = [] { return std::vector<ObjectViewAction>{}; },
      .turn = [](const ObjectViewAction&) {}};
  Rng rng(1);
  const ChangeReport report = detect_change(recogniser, options, 0, camera, rng);
  const double a = 0.8 * std::exp(-0.5 * 0.9 * 0.9);
  const double b = 0.2 * std::exp(-0.5 * 0.1 * 0.1);
  EXPECT_NEAR(report.p_changed, b / (a + b), 1e-6);
  EXPECT_EQ(report.change, Change::none);
  EXPECT_NEAR(p_state(report.recognition.belief)[1], b / (a + b), 1e-6);
}

/// Three objects of three bins: the priors are shared out evenly among the other bins of the
/// object, and among all bins of the others.
TEST(ChangeDetectionInClosedForm, SharesThePriorsOutEvenly) {
  ObjectStates states;
  states.objects = {"a_1", "b_1", "c_1"};
  states.categories = {"a", "b", "c"};
  states.category_of = {0, 1, 2};
  states.bins = 3;
  ObservationModel model{
      .feature = "colour", .mean = Eigen::MatrixXf(1, 9), .variance = Eigen::MatrixXf::Ones(1, 9)};
  model.mean << 0.0F, 0.7F, 1.1F, 0.4F, 1.6F, 0.9F, 0.2F, 1.3F, 0.5F;
  const Recogniser recogniser =
      make_recogniser(states, {{TrainedFeature(Colour{}, 0.0), model}}, 1);
  ChangeOptions options;
  options.recognition.all_features = true;
  options.recognition.max_views = 1;
  options.prior_pose = 0.1;
  options.prior_object = 0.3;
  const float x = 0.8F;
  const ObjectCamera camera{
      .extract =
          [&](std::size_t) {
            return ExtractedFeature{.result = {Eigen::VectorXf::Constant(1, x), {}}};
          },
      .bearing_rad = [] { return 0.0; },
      .actions = [] { return std::vector<ObjectViewAction>{}; },
      .turn = [](const ObjectViewAction&) {}};
  Rng rng(1);
  const ChangeReport report = detect_change(recogniser, options, 0, camera, rng);
  const auto likelihood = [&](int state) {
    const double d = x - static_cast<double>(model.mean(0, state));
    return std::exp(-0.5 * d * d);
  };
  double changed = 0.1 / 2.0 * (likelihood(1) + likelihood(2));
  for (int state = 3; state < 9; ++state) changed += 0.3 / 6.0 * likelihood(state);
  const double same = 0.6 * likelihood(0);
  EXPECT_NEAR(report.p_changed, changed / (changed + same), 1e-6);
}

TEST_F(ChangeDetection, LooksAgainWhileItIsUncertain) {
  double bold = 0.0;
  double careful = 0.0;
  for (std::uint64_t i = 0; i < 40; ++i) {
    options_.unchanged_below = 0.4;
    bold += static_cast<double>(detect(3, 1, 3, 2, i).recognition.views.size());
    options_.unchanged_below = 0.001;
    careful += static_cast<double>(detect(3, 1, 3, 2, i).recognition.views.size());
  }
  EXPECT_GT(careful, bold);
}

/// Two objects a and b of two bins, means as given, variance 1: D = (difference)^2 / 8 a bearing.
TEST(TellsApart, IsAQuestionOfAllBearings) {
  ObjectStates states;
  states.objects = {"a_1", "b_1"};
  states.categories = {"a", "b"};
  states.category_of = {0, 1};
  states.bins = 2;
  ObservationModel model{
      .feature = "colour", .mean = Eigen::MatrixXf(1, 4), .variance = Eigen::MatrixXf::Ones(1, 4)};
  model.mean << 0.0F, 4.0F, 4.0F, 4.0F;  // b looks the same from both sides
  const Recogniser recogniser =
      make_recogniser(states, {{TrainedFeature(Colour{}, 0.0), model}}, 1);
  EXPECT_FALSE(distinguishable(recogniser, 0, 0));
  EXPECT_FALSE(distinguishable(recogniser, 2, 3));
  EXPECT_TRUE(distinguishable(recogniser, 0, 1));  // 1/2 exp(-4) from the two bearings
  EXPECT_FALSE(distinguishable(recogniser, 0, 1, 0.009));
  EXPECT_FALSE(distinguishable(recogniser, 0, 2));  // 1/2 exp(-2): from one of them
  EXPECT_TRUE(distinguishable(recogniser, 0, 2, 0.07));
  EXPECT_FALSE(distinguishable(recogniser, 1, 3, 0.06));
}

TEST(StateSeen, IsTheObjectInTheBinOfItsYaw) {
  ObjectStates states;
  states.objects = {"a_1", "b_1"};
  states.bins = 8;
  constexpr double kBin_rad = std::numbers::pi / 4.0;
  EXPECT_EQ(state_seen(states, "a_1", 0.0), 0);
  EXPECT_EQ(state_seen(states, "b_1", 0.49 * kBin_rad), 8);
  EXPECT_EQ(state_seen(states, "b_1", 0.51 * kBin_rad), 9);
  EXPECT_EQ(state_seen(states, "b_1", -0.49 * kBin_rad), 8);
  EXPECT_EQ(state_seen(states, "b_1", -0.51 * kBin_rad), 15);
  EXPECT_EQ(state_seen(states, "b_1", 7.6 * kBin_rad), 8) << "a whole turn is none";
}

TEST_F(ChangeDetection, TheThresholdLiesBetweenTheBounds) {
  options_.changed_above = 0.5;
  EXPECT_THROW(detect(0, 0, 0, 0, 1), ConfigError);
}

TEST_F(ChangeDetection, PriorsMustLeaveRoomForNoChange) {
  options_.prior_object = 0.8;
  try {
    detect(0, 0, 0, 0, 1);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("less than 1"));
  }
}

TEST_F(ChangeDetection, WithoutAnotherViewItIsDecidedWhereItStands) {
  int turns = 0;
  const ObjectCamera cornered{
      .extract =
          [](std::size_t) { return ExtractedFeature{.result = FeatureResult::skip("no object")}; },
      .bearing_rad = [] { return 0.5; },
      .actions = [] { return std::vector<ObjectViewAction>{}; },
      .turn = [&](const ObjectViewAction&) { ++turns; }};
  Rng rng(1);
  options_.empty_views = 5;
  const ChangeReport report = detect_change(recogniser_, options_, 0, cornered, rng);
  EXPECT_EQ(report.change, Change::removed);
  ASSERT_EQ(report.recognition.views.size(), 1U);
  EXPECT_EQ(report.recognition.views[0].view_rad, 0.5);
  EXPECT_EQ(turns, 0);
}

/// The first view tells nothing; the second is from behind.
TEST(ChangeDetectionInClosedForm, FollowsTheTurnOfTheCamera) {
  Rng rng(1);
  const Recogniser recogniser = test::made_up_recogniser(2, {1.0}, {}, rng, 2);
  ChangeOptions options;
  options.recognition.max_views = 2;
  options.recognition.transition = RigidTransition{.slip = 0.0};
  options.prior_pose = 0.2;
  options.prior_object = 0.3;
  int turns = 0;
  const ObjectCamera camera{
      .extract =
          [&](std::size_t) {
            Eigen::VectorXd log_likelihood = Eigen::VectorXd::Zero(4);
            if (turns > 0) log_likelihood << -2.0, 0.0, -1.0, -3.0;
            return ExtractedFeature{.result = {Eigen::VectorXf::Zero(10), {}},
                                    .log_likelihood = log_likelihood};
          },
      .bearing_rad = [&] { return turns * std::numbers::pi; },
      .actions = [] { return std::vector<ObjectViewAction>{{.yaw_rad = std::numbers::pi}}; },
      .turn = [&](const ObjectViewAction&) { ++turns; }};
  const ChangeReport report = detect_change(recogniser, options, 0, camera, rng);
  EXPECT_EQ(turns, 1);
  const double changed = 0.2 * std::exp(-2.0) + 0.15 * std::exp(-1.0) + 0.15 * std::exp(-3.0);
  EXPECT_NEAR(report.p_changed, changed / (changed + 0.5), 1e-9);
}

/// Each state measures its number, with a variance of 1.
Recogniser measuring_numbers(int objects, int bins, const std::vector<float>& numbers) {
  ObjectStates states{.objects = {}, .categories = {"a"}, .category_of = {}, .bins = bins};
  for (int k = 0; k < objects; ++k) {
    states.objects.push_back("a_" + std::to_string(k + 1));
    states.category_of.push_back(0);
  }
  const auto count = std::ssize(numbers);
  ObservationModel model{.feature = "colour",
                         .mean = Eigen::MatrixXf(1, count),
                         .variance = Eigen::MatrixXf::Ones(1, count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    model.mean(0, i) = numbers[static_cast<std::size_t>(i)];
  }
  return make_recogniser(states, {{TrainedFeature(Colour{}, 0.0), model}}, 1);
}

TEST(TellsApart, GoesRoundEachObjectAlone) {
  const Recogniser recogniser =
      measuring_numbers(4, 2, {20.0F, 20.0F, 0.0F, 0.0F, 20.0F, 20.0F, 20.0F, 20.0F});
  EXPECT_FALSE(distinguishable(recogniser, 2, 3)) << "two sides that are alike";
  EXPECT_TRUE(distinguishable(recogniser, 2, 4));
  EXPECT_TRUE(distinguishable(recogniser, 2, 3, 0.5)) << "half of all guesses are wrong";
}

TEST(TellsApart, IsUpToFiveErrorsOfAHundred) {
  const auto apart = [](double nats) {
    const auto number = static_cast<float>(std::sqrt(8.0 * nats));
    return distinguishable(measuring_numbers(2, 1, {0.0F, number}), 0, 1);
  };
  EXPECT_TRUE(apart(2.4));  // 1/2 exp(-2.4) = 0.045
  EXPECT_FALSE(apart(2.2));
  EXPECT_TRUE(apart(2.9));
}

}  // namespace
}  // namespace vantage
