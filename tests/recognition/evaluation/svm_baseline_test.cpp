// Baselines on the features of single views.
#include "vantage/recognition/evaluation/svm_baseline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace vantage {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

ViewFeatures view_of(float wide, float narrow) {
  ViewFeatures view;
  view.features.push_back({Eigen::VectorXf::Constant(1, wide), {}});
  view.features.push_back({Eigen::VectorXf::Constant(1, narrow), {}});
  return view;
}

/// A feature that spreads over a hundred, and one that spreads over one, far from zero.
const std::vector<ViewFeatures> kSpreadViews{view_of(0.0F, 1000.0F), view_of(100.0F, 1001.0F),
                                             view_of(20.0F, 1001.0F), view_of(100.0F, 1000.0F)};
const std::vector<int> kSpreadLabels{5, 9, 2, 4};

std::string error_of(const auto& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST(NearestBaseline, CountsEachFeatureByItsSpread) {
  const std::vector<ViewFeatures> asked{view_of(8.0F, 1000.9F), view_of(60.0F, 1000.3F),
                                        view_of(70.0F, 1000.9F), view_of(5.0F, 1000.1F)};
  EXPECT_THAT(nearest_predictions({kSpreadViews, kSpreadLabels}, asked), ElementsAre(2, 4, 9, 5));
}

TEST(NearestBaseline, TakesTheMeanForWhatIsMissing) {
  std::vector<ViewFeatures> asked{view_of(0.0F, 1000.9F), view_of(0.0F, 1001.0F)};
  asked[0].features[0] = FeatureResult::skip("hidden");
  asked[1].features[1] = FeatureResult::skip("hidden");
  EXPECT_THAT(nearest_predictions({kSpreadViews, kSpreadLabels}, asked), ElementsAre(2, 5));
}

TEST(NearestBaseline, OfEqualOnesTakesTheFirst) {
  const std::vector<ViewFeatures> known{view_of(1.0F, 2.0F), view_of(3.0F, 1.0F),
                                        view_of(3.0F, 1.0F)};
  EXPECT_THAT(nearest_predictions({known, std::vector{4, 7, 8}}, std::vector{view_of(3.0F, 1.0F)}),
              ElementsAre(7));
}

TEST(Baselines, NeedEachFeatureInSomeTrainingView) {
  std::vector<ViewFeatures> known = kSpreadViews;
  for (ViewFeatures& view : known) view.features[1] = FeatureResult::skip("hidden");
  EXPECT_THAT(error_of([&] {
                nearest_predictions({known, kSpreadLabels}, kSpreadViews);
              }),
              HasSubstr("none of 4 views to train on has feature 1"));
  known[3] = kSpreadViews[3];
  EXPECT_EQ(nearest_predictions({known, kSpreadLabels}, kSpreadViews).size(), 4U);
}

TEST(SvmBaseline, NeedsTwoLabelsAndOptionsInRange) {
  EXPECT_THAT(error_of([&] {
                svm_predictions(LinearSvm{}, {kSpreadViews, std::vector{3, 3, 3, 3}}, kSpreadViews);
              }),
              HasSubstr("need two objects or more"));
  EXPECT_THAT(error_of([&] {
                svm_predictions(LinearSvm{.c = 0.0}, {kSpreadViews, kSpreadLabels}, kSpreadViews);
              }),
              HasSubstr("linear_svm"));
  EXPECT_THAT(
      error_of([&] {
        svm_predictions(KernelSvm{.gamma = 0.0}, {kSpreadViews, kSpreadLabels}, kSpreadViews);
      }),
      HasSubstr("gamma"));
}

/// Four views of one object at 0, three of the other at 1 and a fourth that strayed to 0.2.
TEST(SvmBaseline, FitsAStrayViewWhereErrorsWeighMuch) {
  std::vector<ViewFeatures> known;
  for (const float x : {0.0F, 0.0F, 0.0F, 0.0F, 0.2F, 1.0F, 1.0F, 1.0F}) {
    known.push_back(view_of(x, 0.0F));
  }
  const std::vector<int> label{5, 5, 5, 5, 9, 9, 9, 9};
  const std::vector<ViewFeatures> asked{view_of(0.0F, 0.0F), view_of(0.2F, 0.0F),
                                        view_of(1.0F, 0.0F)};
  for (const Svm& svm : {Svm(LinearSvm{.c = 0.01}), Svm(KernelSvm{.c = 0.01})}) {
    EXPECT_THAT(svm_predictions(svm, {known, label}, asked), ElementsAre(5, 5, 9));
  }
  for (const Svm& svm : {Svm(LinearSvm{.c = 1000.0}), Svm(KernelSvm{.c = 1000.0})}) {
    EXPECT_THAT(svm_predictions(svm, {known, label}, asked), ElementsAre(5, 9, 9));
  }
}

/// The other object lies between two sides of one. Over a wide kernel all is linear.
TEST(SvmBaseline, TellsWhatLiesBetweenByItsKernelOnly) {
  std::vector<ViewFeatures> known;
  for (const float x : {0.0F, 0.0F, 1.0F, 1.0F, 2.0F, 2.0F}) known.push_back(view_of(x, 0.0F));
  const std::vector<int> label{5, 5, 9, 9, 5, 5};
  const std::vector<ViewFeatures> asked{view_of(0.0F, 0.0F), view_of(1.0F, 0.0F),
                                        view_of(2.0F, 0.0F)};
  const auto told = [&](const Svm& svm) { return svm_predictions(svm, {known, label}, asked); };
  EXPECT_THAT(told(KernelSvm{}), ElementsAre(5, 9, 5));
  EXPECT_THAT(told(KernelSvm{.gamma = 1e-6}), testing::Not(ElementsAre(5, 9, 5)));
  EXPECT_THAT(told(LinearSvm{}), testing::Not(ElementsAre(5, 9, 5)));
}

/// The border is where a (k(x) + k(x - 2)) - 2 a k(x - 1) + c is 0, k(x) = exp(-3 x^2): 0.507. 3 is
/// half of gamma, of two features, over the mean square distance of 4/3.
TEST(SvmBaseline, MeasuresGammaByTheMeanSquareDistance) {
  std::vector<ViewFeatures> known;
  for (const float x : {0.0F, 0.0F, 1.0F, 1.0F, 2.0F, 2.0F}) known.push_back(view_of(x, 0.0F));
  const std::vector<int> label{5, 5, 9, 9, 5, 5};
  const std::vector<ViewFeatures> asked{view_of(0.48F, 0.0F), view_of(0.53F, 0.0F)};
  EXPECT_THAT(svm_predictions(KernelSvm{.gamma = 8.0}, {known, label}, asked), ElementsAre(5, 9));
}

}  // namespace
}  // namespace vantage
