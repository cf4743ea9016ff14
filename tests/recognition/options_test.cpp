// Defaults and ranges of what recognition goes by, by number.
#include <gtest/gtest.h>

#include <string_view>
#include <type_traits>
#include <vector>

#include "tests/support/option_numbers.hpp"
#include "vantage/recognition/calibration/unknown_training.hpp"
#include "vantage/recognition/change_detection.hpp"
#include "vantage/recognition/evaluation/change_evaluation.hpp"
#include "vantage/recognition/evaluation/svm_baseline.hpp"
#include "vantage/recognition/object_observations.hpp"
#include "vantage/recognition/observation_buffer.hpp"
#include "vantage/recognition/training.hpp"

namespace vantage {
namespace {

using support::expect_numbers;

constexpr Range kNotNegativeRecognition = at_least(0.0);
constexpr Range kShareRecognition = between(0.0, 1.0);

/// Those that a change detection has of its own.
struct OwnChangeOptions : ChangeOptions {
  void fields(auto&& f) { decision_fields(f); }
};

/// Each of its videos by itself.
struct OwnTrainingOptions : TrainingOptions {
  void fields(auto&& f) {
    TrainingOptions::fields(
        [&](std::string_view key, auto& value, std::string_view text, const Range& range = {}) {
          if constexpr (std::is_same_v<decltype(value), std::vector<int>&>) {
            for (int& one : value) f(key, one, text, range);
          } else {
            f(key, value, text, range);
          }
        });
  }
};

TEST(RecognitionOptionNumbers, OfObservations) {
  expect_numbers(ObservationOptions{}, {{"range_m", 2.0, {0.0, 20.0, true}},
                                        {"known_below_nats", 0.1, kNotNegativeRecognition},
                                        {"observe_known", 0.0},
                                        {"min_gain_nats", 0.03, kNotNegativeRecognition},
                                        {"apart_rad", 0.3, between(0.0, 3.0)},
                                        {"near_m", 1.3, kNotNegativeRecognition},
                                        {"patience_s", 0.5, between(0.0, 100.0)},
                                        {"left_after_s", 2.0, between(0.0, 100.0)}});
}

TEST(RecognitionOptionNumbers, OfRecognition) {
  expect_numbers(RecognitionOptions{}, {{"features.states", 48, between(1, 100'000)},
                                        {"features.about_object", 1.0},
                                        {"features.per_cost", 0.0},
                                        {"all_features", 0.0},
                                        {"views.states", 48, between(1, 100'000)},
                                        {"views.about_object", 1.0},
                                        {"views.by_visibility", 1.0},
                                        {"views.weight_per_s", 0.0, kNotNegativeRecognition},
                                        {"views.weight_per_m", 0.0, kNotNegativeRecognition},
                                        {"views.weight_per_j", 0.0, kNotNegativeRecognition},
                                        {"views.visited_weight", 0.0, kShareRecognition},
                                        {"enough.object_probability", 0.9, {0.0, 1.0, true}},
                                        {"enough.entropy_bits", 0.1, kNotNegativeRecognition},
                                        {"max_views", 8, between(1, 1000)}});
  EXPECT_TRUE(std::holds_alternative<RigidTransition>(RecognitionOptions{}.transition));
  expect_numbers(RecogniserOptions{},
                 {{"unknown_prior", 0.1, between(0.0, 0.999)}, {"repeated_views", 1.0}});
  EXPECT_TRUE(std::holds_alternative<ShrunkVariance>(RecogniserOptions{}.variance));
}

TEST(RecognitionOptionNumbers, OfChangeDetection) {
  expect_numbers(OwnChangeOptions{}, {{"threshold", 0.6, kShareRecognition},
                                      {"unchanged_below", 0.05, kShareRecognition},
                                      {"changed_above", 0.95, kShareRecognition},
                                      {"prior_pose", 0.45, kShareRecognition},
                                      {"prior_object", 0.05, kShareRecognition},
                                      {"empty_views", 2, between(1, 100)}});
  const RecognitionOptions looking = ChangeOptions{}.recognition;
  EXPECT_TRUE(looking.all_features);
  EXPECT_FALSE(looking.views.about_object);
  RecognitionOptions few;
  few.max_views = 3;
  EXPECT_EQ(for_changes(few).max_views, 3);
}

TEST(RecognitionOptionNumbers, OfTraining) {
  OwnTrainingOptions options;
  EXPECT_TRUE(options.costs_s.empty());
  options.costs_s = {0.5};
  expect_numbers(options, {{"seed", 1.0},
                           {"costs_s[0]", 0.5, above(0.0)},
                           {"videos", 1.0, between(1, 4)},
                           {"videos", 4.0, between(1, 4)},
                           {"bins", 0.0, between(0, 3600)},
                           {"feature_views", 1000.0, at_least(2)},
                           {"transition_prior_moves", 100.0, kNotNegativeRecognition},
                           {"unknown", 1.0}});
  EXPECT_TRUE(std::holds_alternative<HeldOutAuto>(options.held_out));
  EXPECT_TRUE(std::holds_alternative<CalibratedPsi>(options.psi));
  expect_numbers(HeldOutShare{}, {{"share", 0.2, between(0.01, 0.9)}});
  expect_numbers(HeldOutAuto{}, {{"share", 0.2, between(0.01, 0.9)}});
}

TEST(RecognitionOptionNumbers, OfBaselines) {
  expect_numbers(LinearSvm{}, {{"c", 10.0, above(0.0)}});
  expect_numbers(KernelSvm{}, {{"c", 10.0, above(0.0)}, {"gamma", 1.0, above(0.0)}});
}

/// Whether training options that differ from the usual ones by that pass.
bool passes(const auto& change) {
  TrainingOptions options;
  change(options);
  try {
    check_options(options);
  } catch (const ConfigError&) {
    return false;
  }
  return true;
}

TEST(TrainingOptionChecks, LetPassWhatTheySay) {
  EXPECT_TRUE(passes([](TrainingOptions&) {}));
  EXPECT_TRUE(passes([](TrainingOptions& o) { o.bins = 2; }));
  EXPECT_FALSE(passes([](TrainingOptions& o) { o.bins = 1; }));
  EXPECT_TRUE(passes([](TrainingOptions& o) { o.costs_s = {0.1, 0.2, 0.3, 0.4}; }));
  EXPECT_FALSE(passes([](TrainingOptions& o) { o.costs_s = {0.1, 0.2, 0.3}; }));
  EXPECT_TRUE(passes([](TrainingOptions& o) { o.videos = {2}; }));
  EXPECT_FALSE(passes([](TrainingOptions& o) { o.videos = {}; }));
  EXPECT_FALSE(passes([](TrainingOptions& o) { o.videos = {2, 4, 2}; }));
  EXPECT_FALSE(passes([](TrainingOptions& o) {
    o.videos = {2};
    o.held_out = HeldOutVideos{};
  }));
  EXPECT_TRUE(passes([](TrainingOptions& o) {
    o.videos = {1, 2};
    o.held_out = HeldOutVideos{};
  }));
}

TEST(ChangeOptionChecks, LeaveRoomForBothAndKeepTheThresholdBetween) {
  EXPECT_NO_THROW(check_options(ChangeOptions{}));
  EXPECT_THROW(check_options(ChangeOptions{.prior_pose = 0.75, .prior_object = 0.25}), ConfigError);
  EXPECT_NO_THROW(check_options(ChangeOptions{.prior_pose = 0.75, .prior_object = 0.125}));
  EXPECT_THROW(check_options(ChangeOptions{.prior_pose = 0.0, .prior_object = 0.0}), ConfigError);
  EXPECT_NO_THROW(check_options(ChangeOptions{.prior_pose = 0.0, .prior_object = 0.1}));
  EXPECT_NO_THROW(
      check_options(ChangeOptions{.threshold = 0.5, .unchanged_below = 0.5, .changed_above = 0.5}));
  EXPECT_THROW(check_options(ChangeOptions{.threshold = 0.5, .unchanged_below = 0.6}), ConfigError);
  EXPECT_THROW(check_options(ChangeOptions{.threshold = 0.5, .changed_above = 0.4}), ConfigError);
  ChangeOptions options;
  options.empty_views = 0;
  EXPECT_THROW(check_options(options), ConfigError) << "each is within its range, too";
}

TEST(RecognitionDefaults, OfViewsAreOfNothingSeen) {
  EXPECT_EQ(ExtractedFeature{}.time_s, 0.0);
  EXPECT_EQ(NextView{}.time_s, 0.0);
  const ViewReport view;
  EXPECT_EQ(view.view_rad, 0.0);
  EXPECT_EQ(view.entropy_bits, 0.0);
  EXPECT_EQ(view.feature_time_s, 0.0);
  EXPECT_EQ(view.selection_time_s, 0.0);
  EXPECT_EQ(view.view_time_s, 0.0);
  const ObjectObservation seen;
  EXPECT_EQ(seen.time_s + seen.bearing_rad + seen.distance_m + seen.elevation_rad, 0.0);
  EXPECT_EQ(seen.entropy_nats + seen.map_probability + seen.unknown_probability, 0.0);
  EXPECT_EQ(seen.direction, 0);
  EXPECT_EQ(seen.pixels, 0);
  EXPECT_EQ(RecognisedObject{}.id, 0);
  EXPECT_EQ(BufferedObservation{}.id, 0);
  EXPECT_EQ(BufferedObservation{}.direction, 0);
  EXPECT_EQ(BufferedObservation{}.time_s, 0.0);
  EXPECT_EQ(ViewFeatures{}.yaw_rad, 0.0);
}

TEST(RecognitionDefaults, OfChangesAndTrialsAreOfNothingFound) {
  EXPECT_EQ(ChangeReport{}.p_changed, 0.0);
  EXPECT_EQ(ChangeHypotheses{}.log_p_expected, 0.0);
  EXPECT_EQ(ChangeHypotheses{}.log_p_changed, 0.0);
  EXPECT_EQ(ChangeSearch{}.expected_object, 0);
  EXPECT_EQ(ChangeSearch{}.empty_views, 0);
  const ChangeTrial change;
  EXPECT_EQ(change.p_changed + change.time_s, 0.0);
  EXPECT_EQ(change.observations, 0);
  EXPECT_FALSE(change.detectable);
  EXPECT_EQ(Start{}.turntable, 0U);
  EXPECT_EQ(Start{}.view, 0U);
  const Trial trial;
  EXPECT_FALSE(trial.correct || trial.category_correct);
  for (const int count :
       {trial.object, trial.estimate, trial.observations, trial.bin_error, trial.features}) {
    EXPECT_EQ(count, 0);
  }
  EXPECT_EQ(trial.entropy_bits + trial.probability + trial.unknown_probability, 0.0);
  EXPECT_EQ(trial.feature_time_s + trial.selection_time_s + trial.view_time_s, 0.0);
}

TEST(RecognitionDefaults, OfTrainingAreOfOneThread) {
  EXPECT_EQ(LongWork{}.threads, 1);
  EXPECT_EQ(HoldOutOptions{}.seed, 1U);
  EXPECT_FALSE(HoldOutOptions{}.only_seen);
  EXPECT_EQ(CalibrationFold{}.first, 0);
  EXPECT_EQ(CalibrationFold{}.count, 0);
  EXPECT_EQ(ShownView{}.known, 0.0);
  EXPECT_EQ(ShownView{}.instance, 0.0);
  EXPECT_EQ(ShownView{}.category, 0.0);
}

}  // namespace
}  // namespace vantage
