// Which views psi is chosen on.
#include "vantage/recognition/dataset/held_out.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace vantage {
namespace {

constexpr int kStates = 400;

/// `recordings` of the same objects, each with one view of every state, named alike in each.
std::vector<int> states_held_out(int recordings) {
  RecognitionModel model;
  model.states.bins = 8;
  for (int object = 0; object < kStates / 8; ++object) {
    model.states.objects.push_back("cup_" + std::to_string(object));
    model.states.category_of.push_back(0);
  }
  model.states.categories = {"cup"};
  FeatureModel& feature = model.features.emplace_back();
  feature.name = "colour";
  feature.statistics = empty_statistics(2, kStates);
  std::vector<ViewFeatures> views;
  std::vector<int> shown;
  Rng rng(1);
  for (int recording = 0; recording < recordings; ++recording) {
    for (int state = 0; state < kStates; ++state) {
      ViewFeatures& view = views.emplace_back();
      const std::string& object = model.states.objects[static_cast<std::size_t>(state / 8)];
      view.name = {.category = "cup", .object = object, .video = 1, .frame = 1 + state % 8};
      view.folder = "recording " + std::to_string(recording);
      view.yaw_rad = (state % 8) * std::numbers::pi / 4.0;
      view.features.push_back({Eigen::Vector2f(rng.uniform(), rng.uniform()), {}});
      shown.push_back(state);
    }
  }
  HoldOutOptions options;
  options.held_out = HeldOutShare{.share = 0.25};
  return hold_out(views, shown, model, options, {}).held_out.state;
}

TEST(HoldOut, TakesItsShare) {
  EXPECT_NEAR(static_cast<double>(states_held_out(1).size()), 0.25 * kStates, 30.0);
}

// Were the same views held out of each recording, their states would be gaps in the model.
TEST(HoldOut, ViewsOfTheSameNameInOtherRecordingsAreDrawnAnew) {
  const std::vector<int> states = states_held_out(2);
  const std::set<int> different(states.begin(), states.end());
  EXPECT_NEAR(static_cast<double>(states.size()), 0.5 * kStates, 45.0);
  const auto in_both = static_cast<double>(states.size() - different.size());
  EXPECT_NEAR(in_both, 0.25 * 0.25 * kStates, 20.0);
}

/// Five pictures of a burst show the same thing: one held out with the others trained on would be
/// recognised by its copies, and psi learnt from them.
TEST(HoldOut, PicturesOfABurstAreHeldOutTogether) {
  RecognitionModel model;
  model.states = {.objects = {"cup_1"}, .categories = {"cup"}, .category_of = {0}, .bins = 40};
  FeatureModel& feature = model.features.emplace_back();
  feature.name = "colour";
  feature.statistics = empty_statistics(2, 40);
  std::vector<ViewFeatures> views;
  std::vector<int> shown;
  Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    ViewFeatures& view = views.emplace_back();
    view.name = {.category = "cup", .object = "cup_1", .video = 1, .frame = i + 1};
    const int bin = i / 5;
    view.yaw_rad = bin * std::numbers::pi / 20.0 + 1e-3 * (i % 5);
    view.features.push_back({Eigen::Vector2f(rng.uniform(), rng.uniform()), {}});
    shown.push_back(bin);
  }
  HoldOutOptions options;
  options.held_out = HeldOutShare{.share = 0.25};
  std::vector<int> held(40, 0);
  for (const int state : hold_out(views, shown, model, options, {}).held_out.state) {
    ++held[static_cast<std::size_t>(state)];
  }
  EXPECT_THAT(held, testing::Each(testing::AnyOf(0, 5)));
  EXPECT_THAT(held, testing::Contains(5));
}

/// Views of objects of one bin by one number.
struct NumberedViews {
  RecognitionModel model;
  std::vector<ViewFeatures> views;
  std::vector<int> shown;

  explicit NumberedViews(int objects, int features = 1) {
    model.states.bins = 1;
    model.states.categories = {"cup"};
    for (int k = 0; k < objects; ++k) {
      model.states.objects.push_back("cup_" + std::to_string(k));
      model.states.category_of.push_back(0);
    }
    for (int f = 0; f < features; ++f) {
      FeatureModel& feature = model.features.emplace_back();
      feature.name = "feature_" + std::to_string(f);
      feature.statistics = empty_statistics(1, objects);
    }
  }
  ViewFeatures& add(int object, int video, float number, double yaw_rad = 0.0) {
    ViewFeatures& view = views.emplace_back();
    const std::string& name = model.states.objects[static_cast<std::size_t>(object)];
    view.name = {
        .category = "cup", .object = name, .video = video, .frame = static_cast<int>(views.size())};
    view.folder = "/hall/cup/" + name;
    view.yaw_rad = yaw_rad;
    for (std::size_t f = 0; f < model.features.size(); ++f) {
      view.features.push_back({Eigen::VectorXf::Constant(1, number), {}});
    }
    shown.push_back(object);
    return view;
  }
  [[nodiscard]] Calibration hold_out_by(const HeldOut& held_out, bool only_seen = false) const {
    return hold_out(views, shown, model, {held_out, ShrunkVariance{}, 1, only_seen}, {});
  }
};

NumberedViews two_videos() {
  NumberedViews made(2, 2);
  made.add(0, 1, 1.0F);
  made.add(0, 4, 5.0F);
  made.add(1, 1, 10.0F);
  made.add(1, 4, 20.0F);
  made.add(0, 1, 3.0F);
  made.add(0, 4, 9.0F);
  made.add(1, 1, 14.0F);
  made.add(1, 4, 22.0F);
  return made;
}

TEST(HoldOutByVideo, TestsEachByAModelOfTheOthers) {
  const NumberedViews made = two_videos();
  const Calibration by = made.hold_out_by(HeldOutVideos{});
  EXPECT_THAT(by.view, testing::ElementsAre(0U, 2U, 4U, 6U, 1U, 3U, 5U, 7U));
  EXPECT_THAT(by.held_out.state, testing::ElementsAre(0, 1, 0, 1, 0, 1, 0, 1));
  EXPECT_EQ(by.held_out.bins, 1);
  ASSERT_EQ(by.folds.size(), 2U);
  ASSERT_EQ(by.held_out.log_density.size(), 2U);
  for (std::size_t s = 0; s < 2; ++s) {
    const CalibrationFold& fold = by.folds[s];
    EXPECT_EQ(fold.first, s == 0 ? 0 : 4);
    EXPECT_EQ(fold.count, 4);
    ASSERT_EQ(fold.models.size(), 2U);
    EXPECT_NEAR(fold.models[1].mean(0, 0), s == 0 ? 7.0F : 2.0F, 1e-5F);
    EXPECT_NEAR(fold.models[1].mean(0, 1), s == 0 ? 21.0F : 12.0F, 1e-5F);
    for (Eigen::Index i = fold.first; i < fold.first + fold.count; ++i) {
      const auto view = by.view[static_cast<std::size_t>(i)];
      const Eigen::VectorXd expected =
          log_density(fold.models[1], made.views[view].features[1].vector);
      EXPECT_TRUE(by.held_out.log_density[1].col(i).isApprox(expected.cast<float>(), 1e-4F));
    }
  }
}

TEST(HoldOutByVideo, TestsViewsThatHaveAllFeaturesOnly) {
  NumberedViews made = two_videos();
  made.views[6].features[1] = FeatureResult::skip("hidden");
  const Calibration by = made.hold_out_by(HeldOutVideos{});
  EXPECT_THAT(by.view, testing::ElementsAre(0U, 2U, 4U, 1U, 3U, 5U, 7U));
  EXPECT_EQ(by.folds[0].count, 3);
  EXPECT_EQ(by.folds[1].first, 3);
  EXPECT_NEAR(by.folds[1].models[0].mean(0, 1), 12.0F, 1e-5F) << "but it is trained on";
  EXPECT_NEAR(by.folds[1].models[1].mean(0, 1), 10.0F, 1e-5F);
}

TEST(HoldOutByRecording, IsByTheVideosOfEachFolder) {
  NumberedViews made = two_videos();
  for (const std::size_t i : {5U, 7U}) {
    made.views[i].folder = "/attic/cup/" + made.views[i].name.object;
  }
  const Calibration by = made.hold_out_by(HeldOutRecordings{});
  EXPECT_THAT(by.view, testing::ElementsAre(0U, 2U, 4U, 6U, 1U, 3U, 5U, 7U));
  ASSERT_EQ(by.folds.size(), 3U);
  EXPECT_EQ(by.folds[1].first, 4);
  EXPECT_EQ(by.folds[1].count, 2);
  EXPECT_EQ(by.folds[2].first, 6);
}

TEST(HoldOutByVideo, RulesOutWhatItWasNotTrainedOnIfAsked) {
  NumberedViews made(2);
  for (const float number : {1.0F, 3.0F}) {
    made.add(0, 1, number);
    made.add(1, 1, 10.0F + number);
    made.add(0, 4, 4.0F + number);
  }
  for (const bool only_seen : {false, true}) {
    const Eigen::MatrixXf log =
        made.hold_out_by(HeldOutVideos{}, only_seen).held_out.log_density[0];
    ASSERT_EQ(log.cols(), only_seen ? 4 : 6) << "of video 4 there is no object 1 to ask for";
    for (Eigen::Index i = 0; i < log.cols(); ++i) {
      EXPECT_GT(log(0, i), -1e8F);
      EXPECT_EQ(log(1, i) < -1e8F, only_seen && i < 2) << "nor to be found";
    }
  }
}

NumberedViews one_view_each_in_two_videos() {
  NumberedViews made(4);
  for (const auto& [first, second, video] : {std::tuple{1.0F, 30.0F, 1}, {2.0F, 31.0F, 4}}) {
    const float odd = video == 1 ? 0.0F : 1.0F;
    made.add(0, video, first);
    made.add(1, video, 10.0F + 4.0F * odd);
    made.add(2, video, second);
    made.add(3, video, 50.0F + 2.0F * odd);
  }
  return made;
}

/// With one view of each state to train on, how far they scatter is that of the other objects.
TEST(HoldOutByVideo, TakesTheScatterOfTheOtherHalfOfTheObjects) {
  const Calibration by = one_view_each_in_two_videos().hold_out_by(HeldOutVideos{});
  EXPECT_THAT(by.view, testing::ElementsAre(0U, 2U, 1U, 3U, 4U, 6U, 5U, 7U));
  ASSERT_EQ(by.folds.size(), 4U);
  for (std::size_t s = 0; s < 4; ++s) {
    EXPECT_EQ(by.folds[s].first, static_cast<Eigen::Index>(2 * s));
    EXPECT_EQ(by.folds[s].count, 2);
    // (16 / 2 + 4 / 2) / 2 of objects 1 and 3, (1 / 2 + 1 / 2) / 2 of the others.
    const float expected = s % 2 == 0 ? 5.0F : 0.5F;
    for (int state = 0; state < 4; ++state) {
      EXPECT_NEAR(by.folds[s].models[0].variance(0, state), expected, 1e-5F);
    }
  }
}

TEST(HoldOutByVideo, TakesNoScatterBelowTheFloor) {
  NumberedViews made = one_view_each_in_two_videos();
  made.model.features[0].statistics = empty_statistics(2, 4);
  for (ViewFeatures& view : made.views) {
    const float number = view.features[0].vector[0];
    view.features[0].vector = Eigen::Vector2f(number, 7.0F);
  }
  const Calibration by = hold_out(made.views, made.shown, made.model,
                                  {HeldOutVideos{}, ShrunkVariance{.floor = 0.5}, 1, false}, {});
  for (std::size_t s = 0; s < 4; ++s) {
    const Eigen::MatrixXf& variance = by.folds[s].models[0].variance;
    EXPECT_NEAR(variance(0, 0), s % 2 == 0 ? 5.0F : 0.5F, 1e-5F);
    EXPECT_NEAR(variance(1, 0), 0.5F * 0.5F * variance(0, 0), 1e-5F) << "half of the mean of both";
  }
}

TEST(HoldOutByVideo, TakesNoScatterOfObjectsSeenOnce) {
  NumberedViews made(2);
  made.add(0, 1, 1.0F);
  made.add(0, 4, 2.0F);
  made.add(1, 1, 10.0F);
  const Calibration by = made.hold_out_by(HeldOutVideos{});
  ASSERT_EQ(by.folds.size(), 4U);
  FeatureModel own = made.model.features[0];
  add_view(own.statistics, 0, Eigen::VectorXf::Constant(1, 2.0F));
  EXPECT_EQ(by.folds[0].models[0].variance,
            make_observation_model(own, 1, ShrunkVariance{}).variance);
  EXPECT_NEAR(by.folds[1].models[0].variance(0, 0), 0.5F, 1e-5F) << "of the object seen twice";
}

TEST(HoldOutByVideo, LimitsTheViewsOfAllFoldsTogether) {
  NumberedViews made(1);
  for (int i = 0; i < 2500; ++i) {
    made.add(0, 1, 0.01F * static_cast<float>(i % 7));
    made.add(0, 2, 0.01F * static_cast<float>(i % 5));
  }
  const Calibration by = made.hold_out_by(HeldOutVideos{});
  ASSERT_EQ(by.folds.size(), 2U);
  EXPECT_EQ(by.folds[0].count, 2000);
  EXPECT_EQ(by.folds[1].count, 2000);
  EXPECT_EQ(by.view.size(), 4000U);
  EXPECT_EQ(by.held_out.log_density[0].cols(), 4000);
}

/// Pairs of views at these yaws; those of which one is held out and the other is not.
int parted_pairs(NumberedViews& made) {
  const Calibration by = made.hold_out_by(HeldOutShare{.share = 0.5});
  const std::set<std::size_t> held(by.view.begin(), by.view.end());
  int parted = 0;
  for (std::size_t i = 0; i < made.views.size(); i += 2) {
    parted += held.contains(i) == held.contains(i + 1) ? 0 : 1;
  }
  return parted;
}

TEST(HoldOut, ADegreeApartIsTheSameDirection) {
  for (const double apart_rad : {0.016, 0.019}) {
    NumberedViews made(1);
    for (int i = 0; i < 40; ++i) {
      made.add(0, 1, static_cast<float>(i % 3), 0.15 * i);
      made.add(0, 1, static_cast<float>(i % 4), 0.15 * i + apart_rad);
    }
    EXPECT_EQ(parted_pairs(made) > 0, apart_rad > 0.0175) << apart_rad;
  }
}

TEST(HoldOut, TheSameDirectionIsSoAllTheWayRoundButOfOneObjectOnly) {
  NumberedViews round(40);
  NumberedViews two_objects(41);
  for (int k = 0; k < 40; ++k) {
    const auto number = static_cast<float>(k % 3);
    round.add(k, 1, number, 2.0 * std::numbers::pi - 0.004);
    round.add(k, 1, number + 1.0F, 0.004);
    two_objects.add(k, 1, number, 1.0);
    two_objects.add(k + 1, 2, number, 1.0);
  }
  EXPECT_EQ(parted_pairs(round), 0);
  EXPECT_GT(parted_pairs(two_objects), 0);
}

TEST(HoldOut, OppositeSidesAreNotTheSameDirection) {
  for (const double apart_rad : {std::numbers::pi, 2.0 / std::numbers::pi, 1.0}) {
    NumberedViews made(40);
    for (int k = 0; k < 40; ++k) {
      made.add(k, 1, static_cast<float>(k % 3), 0.0);
      made.add(k, 1, static_cast<float>(k % 4), apart_rad);
    }
    EXPECT_GT(parted_pairs(made), 0) << apart_rad;
  }
}

/// A seed holds out the same views for ever.
TEST(HoldOut, IsDrawnByTheNameOfTheViewAndHowOftenItCame) {
  NumberedViews made(1);
  for (int i = 0; i < 120; ++i) {
    ViewFeatures& view = made.add(0, 1, static_cast<float>(i % 3), 0.1 * (i % 60));
    view.name.frame = 1 + i % 60;
    if (i >= 60) view.folder = "/attic/cup/cup_0";
  }
  const Calibration by = made.hold_out_by(HeldOutShare{.share = 0.5});
  const std::set<std::size_t> held(by.view.begin(), by.view.end());
  for (std::size_t i = 0; i < 120; ++i) {
    const std::string stream = "hold out " + to_string(made.views[i].name) + (i < 60 ? "" : "+");
    EXPECT_EQ(held.contains(i), Rng::stream(1, stream).uniform() < 0.5) << i;
  }
}

/// The same numbers, of two objects of two bins: (1 / 2 + 4 / 2) / 2 of the second one's states,
/// (1 / 2 + 16 / 2) / 2 of the first one's.
TEST(HoldOutByVideo, HalvesAreOfObjectsNotOfStates) {
  NumberedViews made = one_view_each_in_two_videos();
  made.model.states.objects = {"cup_0", "cup_1"};
  made.model.states.category_of = {0, 0};
  made.model.states.bins = 2;
  const Calibration by = made.hold_out_by(HeldOutVideos{});
  EXPECT_THAT(by.view, testing::ElementsAre(0U, 1U, 2U, 3U, 4U, 5U, 6U, 7U));
  ASSERT_EQ(by.folds.size(), 4U);
  for (std::size_t s = 0; s < 4; ++s) {
    EXPECT_NEAR(by.folds[s].models[0].variance(0, 0), s % 2 == 0 ? 1.25F : 4.25F, 1e-5F);
  }
}

TEST(HoldOutByVideo, WithoutAnyScatterVariancesAreABillionth) {
  NumberedViews made(2);
  for (const int video : {1, 4}) {
    made.add(0, video, 1.0F);
    made.add(1, video, 5.0F);
  }
  const Calibration by = made.hold_out_by(HeldOutVideos{});
  ASSERT_EQ(by.folds.size(), 4U);
  EXPECT_FLOAT_EQ(by.folds[0].models[0].variance(0, 0), 1e-9F);
}

TEST(HoldOut, LimitsTheViewsOfASingleFoldToo) {
  NumberedViews made(50);
  for (int k = 0; k < 50; ++k) {
    for (int i = 0; i < 100; ++i) made.add(k, 1, static_cast<float>(i % 7), 0.06 * i);
  }
  const Calibration by = made.hold_out_by(HeldOutShare{.share = 0.9});
  ASSERT_EQ(by.folds.size(), 1U);
  EXPECT_EQ(by.folds[0].count, 4000);
}

}  // namespace
}  // namespace vantage
