// What each combination of features is worth in a single view.
#include "vantage/recognition/evaluation/feature_combinations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/recognition/made_up.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

using ::testing::ElementsAre;

TEST(FeatureCombinations, AreAllOfAFewSmallerOnesFirst) {
  EXPECT_THAT(feature_combinations(1), ElementsAre(ElementsAre(0U)));
  const std::vector<FeatureCombination> expected{{0}, {1}, {2}, {0, 1}, {0, 2}, {1, 2}, {0, 1, 2}};
  EXPECT_EQ(feature_combinations(3), expected);
  EXPECT_EQ(feature_combinations(5).size(), 31U);
}

TEST(FeatureCombinations, OfManyAreEachAloneAndAll) {
  const std::vector<FeatureCombination> expected{{0}, {1}, {2}, {3}, {4}, {5}, {0, 1, 2, 3, 4, 5}};
  EXPECT_EQ(feature_combinations(6), expected);
}

/// Two cups of two bins, three features of 0.01, 0.02 and 0.03 s, two views: the first lacks the
/// second feature, and the third feature of the second view fits no state.
class CombinedFeatures : public ::testing::Test {
 protected:
  CombinedFeatures() {
    Rng rng(1);
    recogniser_ = test::made_up_recogniser(2, {1.0, 2.0, 3.0}, {}, rng, 2);
    for (int i = 0; i < 2; ++i) {
      ViewFeatures& view = test_.views.emplace_back();
      view.name = {.category = "cup", .object = "cup_" + std::to_string(i)};
      view.yaw_rad = i * std::numbers::pi;
      view.features.assign(3, {Eigen::VectorXf::Zero(1), {}});
      test_.turntables.push_back({{static_cast<std::size_t>(i)}});
    }
    test_.views[0].features[1] = FeatureResult::skip("hidden");
    test_.shown = {2, 1};
    test_.category = {0, 0};
    likelihoods_.assign(3, Eigen::MatrixXf::Zero(4, 2));
    likelihoods_[0] << 0.0F, 1.0F,  //
        0.0F, 0.5F,                 //
        2.0F, 0.0F,                 //
        0.0F, 0.0F;
    likelihoods_[1] << 9.0F, 0.0F,  //
        0.0F, 0.7F,                 //
        0.0F, 0.0F,                 //
        0.0F, 0.2F;
    likelihoods_[2] << 1.0F, 0.0F,  //
        0.0F, 0.0F,                 //
        0.0F, 0.0F,                 //
        0.5F, 0.0F;
    likelihoods_[2].col(1).setConstant(-std::numeric_limits<float>::infinity());
  }
  [[nodiscard]] std::vector<Trial> trials(const FeatureCombination& features) const {
    return combination_trials(recogniser_, test_, likelihoods_, starts_, features);
  }

  Recogniser recogniser_;
  TestViews test_;
  std::vector<Eigen::MatrixXf> likelihoods_;
  std::vector<Start> starts_{{.turntable = 0, .view = 0}, {.turntable = 1, .view = 1}};
};

TEST_F(CombinedFeatures, CostWhatTheyCostAndTellWhatTheyTell) {
  const std::vector<Trial> all = trials({0, 1, 2});
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].features, 2) << "one is hidden";
  EXPECT_EQ(all[1].features, 2) << "one fits nothing";
  EXPECT_NEAR(all[0].feature_time_s, 0.06, 1e-12);
  const double e = std::exp(1.0);
  const double of_second = e * e + std::exp(0.5);
  EXPECT_EQ(all[0].object, 1);
  EXPECT_EQ(all[0].estimate, 1);
  EXPECT_TRUE(all[0].correct);
  EXPECT_NEAR(all[0].probability, of_second / (of_second + e + 1.0), 1e-6);
  const double of_first = e + std::exp(1.2);
  EXPECT_EQ(all[1].estimate, 0);
  EXPECT_NEAR(all[1].probability, of_first / (of_first + 1.0 + std::exp(0.2)), 1e-6);
}

TEST_F(CombinedFeatures, LeaveTheOthersOut) {
  const std::vector<Trial> one = trials({1});
  EXPECT_EQ(one[0].features, 0);
  EXPECT_NEAR(one[0].feature_time_s, 0.02, 1e-12);
  EXPECT_NEAR(one[0].probability, 0.5, 1e-9);
  EXPECT_NEAR(one[0].entropy_bits, 2.0, 1e-9);
  EXPECT_EQ(one[1].features, 1);
  const double of_first = 1.0 + std::exp(0.7);
  EXPECT_NEAR(one[1].probability, of_first / (of_first + 1.0 + std::exp(0.2)), 1e-6);
}

/// As a recognition that ends after one view has it.
TEST_F(CombinedFeatures, AreWhatARecognitionOfOneViewHas) {
  RecognitionOptions options;
  options.all_features = true;
  options.max_views = 1;
  const std::vector<Trial> whole =
      run_trials(recogniser_, test_, likelihoods_, starts_, {"one view", options}, 1, {});
  const std::vector<Trial> all = trials({0, 1, 2});
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(whole[i].observations, 1);
    EXPECT_EQ(whole[i].object, all[i].object);
    EXPECT_EQ(whole[i].estimate, all[i].estimate);
    EXPECT_EQ(whole[i].features, all[i].features);
    EXPECT_EQ(whole[i].bin_error, all[i].bin_error);
    EXPECT_NEAR(whole[i].probability, all[i].probability, 1e-12);
    EXPECT_NEAR(whole[i].entropy_bits, all[i].entropy_bits, 1e-12);
    EXPECT_NEAR(whole[i].feature_time_s, all[i].feature_time_s, 1e-12);
    EXPECT_EQ(whole[i].view_time_s, 0.0);
  }
}

TEST_F(CombinedFeatures, AreTakenByTheCameraWhereItIs) {
  DatasetCamera camera(recogniser_, test_, likelihoods_, starts_[1]);
  const ObjectCamera as_camera = camera.as_object_camera();
  EXPECT_EQ(camera.view(), 1U);
  EXPECT_EQ(as_camera.bearing_rad(), 0.0);
  const ExtractedFeature second = as_camera.extract(1);
  EXPECT_TRUE(second.result.extracted());
  EXPECT_NEAR(second.time_s, 0.02, 1e-12);
  EXPECT_NEAR(second.log_likelihood[1], 0.7, 1e-6);
  EXPECT_NEAR(second.log_likelihood[3], 0.2, 1e-6);
  const DatasetCamera other(recogniser_, test_, likelihoods_, starts_[0]);
  EXPECT_EQ(other.view(), 0U);
}

TEST_F(CombinedFeatures, BeginWithTheSidesThatTheModelHasViewsOf) {
  recogniser_.unseen = {0};
  const Trial hidden = trials({1})[0];
  EXPECT_EQ(hidden.features, 0);
  EXPECT_NEAR(hidden.entropy_bits, 1.5, 1e-9) << "of 0, 1/2, 1/4 and 1/4";
  EXPECT_NEAR(hidden.probability, 0.5, 1e-9);
}

TEST_F(CombinedFeatures, AreTriedByMethodsWhoseOptionsAreInRange) {
  RecognitionOptions options;
  options.max_views = 0;
  EXPECT_THROW(run_trials(recogniser_, test_, likelihoods_, {}, {"none", options}, 1, {}),
               ConfigError);
}

}  // namespace
}  // namespace vantage
