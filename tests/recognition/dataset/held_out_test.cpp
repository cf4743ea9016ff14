// Which views psi is chosen on.
#include "vantage/recognition/dataset/held_out.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>
#include <string>

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
    view.yaw_rad = (i / 5) * std::numbers::pi / 20.0 + 1e-3 * (i % 5);
    view.features.push_back({Eigen::Vector2f(rng.uniform(), rng.uniform()), {}});
    shown.push_back(i / 5);
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

}  // namespace
}  // namespace vantage
