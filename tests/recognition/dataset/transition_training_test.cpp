// What turning does to the yaw, learnt from walks round training views.
#include "vantage/recognition/dataset/transition_training.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <numbers>
#include <vector>

namespace vantage {
namespace {

constexpr int kWalkBins = 4;

/// Two objects whose bins no view takes for each other, seen from each once in one recording.
struct PlainTurntables {
  RecognitionModel model;
  std::vector<ViewFeatures> views;

  PlainTurntables() {
    model.states = {.objects = {"cup_1", "cup_2"},
                    .categories = {"cup"},
                    .category_of = {0, 0},
                    .bins = kWalkBins};
    FeatureModel& feature = model.features.emplace_back();
    feature.name = "colour";
    feature.statistics = empty_statistics(1, model.states.size());
    for (int state = 0; state < model.states.size(); ++state) {
      const auto at = 10.0F * static_cast<float>(state);
      for (const float off : {-0.5F, 0.5F}) {
        add_view(feature.statistics, state, Eigen::VectorXf::Constant(1, at + off));
      }
      ViewFeatures& view = views.emplace_back();
      view.folder = "/data/cup/" +
                    model.states.objects[static_cast<std::size_t>(model.states.object_of(state))];
      view.name.video = 1;
      view.yaw_rad = model.states.bin_of(state) * std::numbers::pi / 2.0;
      view.features.push_back({Eigen::VectorXf::Constant(1, at), {}});
    }
  }
};

TEST(LearnTransition, CountsThreeMovesOfEachTurntable) {
  const PlainTurntables made;
  const TransitionCounts counts =
      learn_transition(made.views, made.model, ShrunkVariance{}, 5.0, 1);
  EXPECT_NEAR(counts.same_object, 5.0 + 2.0 * 3.0, 1e-6);
  EXPECT_NEAR(counts.other_instance, 0.0, 1e-9);
  EXPECT_NEAR(counts.other_category, 0.0, 1e-9);
  EXPECT_NEAR(counts.slip.sum(), kWalkBins * 5.0 + 2.0 * 3.0, 1e-6);
  EXPECT_NEAR(counts.slip.col(0).sum(), 5.0, 1e-6) << "each move is a move";
  // Of those before nine in ten were right, of those seen all.
  EXPECT_NEAR(counts.slip.row(0).sum(), kWalkBins * 4.5 + 2.0 * 3.0, 1e-6);
}

TEST(LearnTransition, DoesWithoutFeaturesThatAreMissing) {
  PlainTurntables made;
  made.model.features.push_back(made.model.features.front());
  for (ViewFeatures& view : made.views) {
    view.features.insert(view.features.begin(), FeatureResult::skip("hidden"));
  }
  const TransitionCounts counts =
      learn_transition(made.views, made.model, ShrunkVariance{}, 5.0, 1);
  EXPECT_NEAR(counts.slip.row(0).sum(), kWalkBins * 4.5 + 2.0 * 3.0, 1e-6);
}

TEST(TransitionOfAModel, IsRigidOrWhatItCounted) {
  RecognitionModel model;
  model.states.bins = kWalkBins;
  const LearnedTransition rigid = transition_of(model);
  EXPECT_EQ(rigid.same_object, 1.0);
  ASSERT_EQ(rigid.slip.size(), 16U);
  EXPECT_NEAR(rigid.slip[0], 0.9, 1e-12);
  EXPECT_NEAR(rigid.slip[1], 0.05, 1e-12);
  EXPECT_NEAR(rigid.slip[3], 0.05, 1e-12);
  model.transitions = prior_counts(RigidTransition{.slip = 0.4}, kWalkBins, 10.0);
  const LearnedTransition learnt = transition_of(model);
  EXPECT_NEAR(learnt.slip[0], 0.6, 1e-12);
  EXPECT_NEAR(learnt.slip[1], 0.2, 1e-12);
  EXPECT_NEAR(learnt.slip[2], 0.0, 1e-12);
}

TEST(LearnTransition, TurnsByAnyNumberOfBinsButNone) {
  const PlainTurntables made;
  Eigen::VectorXd moves = Eigen::VectorXd::Zero(kWalkBins);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const TransitionCounts counts =
        learn_transition(made.views, made.model, ShrunkVariance{}, 5.0, seed);
    for (int bins = 0; bins < kWalkBins; ++bins) moves[bins] += counts.slip.col(bins).sum() - 5.0;
  }
  EXPECT_NEAR(moves[0], 0.0, 1e-6);
  for (int bins = 1; bins < kWalkBins; ++bins) EXPECT_GT(moves[bins], 10.0) << bins;
  EXPECT_NEAR(moves.sum(), 20.0 * 2.0 * 3.0, 1e-4);
}

}  // namespace
}  // namespace vantage
