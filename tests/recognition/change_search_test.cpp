// The two hypotheses of a change, and when which of them is decided for.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/recognition/made_up.hpp"
#include "vantage/recognition/change_detection.hpp"

namespace vantage {
namespace {

constexpr double kRuledOut = -std::numeric_limits<double>::infinity();

/// Two objects of two categories, without features.
Recogniser two_of_bins(int bins) {
  return {.states = {.objects = {"a_1", "b_1"},
                     .categories = {"a", "b"},
                     .category_of = {0, 1},
                     .bins = bins},
          .features = {},
          .tables = {}};
}

void expect_belief(const ObjectBelief& belief, const std::vector<double>& expected) {
  const Eigen::VectorXd p = p_state(belief);
  ASSERT_EQ(p.size(), std::ssize(expected));
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(p[static_cast<Eigen::Index>(i)], expected[i], 1e-12) << i;
  }
}

/// As if so many views had been taken, the last of them empty, and a change were so probable.
ChangeSearch search_after(int views, int empty_views, double p_changed) {
  ChangeSearch search;
  search.recognition.views.resize(static_cast<std::size_t>(views));
  search.empty_views = empty_views;
  search.hypotheses.log_p_expected = std::log(1.0 - p_changed);
  search.hypotheses.log_p_changed = std::log(p_changed);
  return search;
}

TEST(ChangeNames, AreReadAsTheyAreWritten) {
  EXPECT_EQ(to_string(Change::none), "none");
  EXPECT_EQ(to_string(Change::object), "object");
  EXPECT_EQ(to_string(Change::pose), "pose");
  EXPECT_EQ(to_string(Change::removed), "removed");
  for (const Change change : kChanges) EXPECT_EQ(change_named(to_string(change)), change);
  EXPECT_EQ(change_named("posed"), std::nullopt);
  EXPECT_EQ(change_named(""), std::nullopt);
}

TEST(ChangeHypothesesOf, AreMixedByHowProbableTheyAre) {
  ChangeHypotheses h;
  h.expected.log_p = Eigen::Vector3d(0.0, kRuledOut, kRuledOut);
  h.changed.log_p = Eigen::Vector3d(std::log(0.1), std::log(0.3), std::log(0.6));
  h.log_p_expected = std::log(0.06);
  h.log_p_changed = std::log(0.24);
  EXPECT_NEAR(h.p_changed(), 0.8, 1e-12);
  expect_belief(h.mixture(), {0.2 + 0.08, 0.24, 0.48});
}

TEST(ChangeSearchBegins, WithThePriorsSharedOutAmongStatesAndWhatIsUnknown) {
  Recogniser recogniser = two_of_bins(2);
  recogniser.states.unknown_category = {kNoCategory};
  recogniser.unknown_prior = 0.25;
  const ChangeOptions options{.prior_pose = 0.3, .prior_object = 0.2};
  const ChangeSearch search = begin_change_search(recogniser, options, 2);
  EXPECT_EQ(search.expected_object, 1);
  EXPECT_EQ(search.empty_views, 0);
  EXPECT_NEAR(search.hypotheses.p_changed(), 0.5, 1e-12);
  EXPECT_NEAR(search.hypotheses.log_p_expected, std::log(0.5), 1e-12);
  expect_belief(search.hypotheses.expected, {0.0, 0.0, 1.0, 0.0, 0.0});
  expect_belief(search.hypotheses.changed, {0.15, 0.15, 0.0, 0.6, 0.1});
  expect_belief(search.recognition.belief, {0.075, 0.075, 0.5, 0.3, 0.05});
}

TEST(ChangeSearchFollows, MotionsWithBothHypotheses) {
  const Recogniser recogniser = two_of_bins(4);
  ChangeOptions options{.prior_pose = 0.3, .prior_object = 0.2};
  options.recognition.transition = RigidTransition{.slip = 0.0};
  ChangeSearch search = begin_change_search(recogniser, options, 1);
  predict_motion(recogniser, options, std::numbers::pi / 2.0, search);
  expect_belief(search.hypotheses.expected, {1, 0, 0, 0, 0, 0, 0, 0});
  expect_belief(search.hypotheses.changed, {0, 0.2, 0.2, 0.2, 0.1, 0.1, 0.1, 0.1});
  expect_belief(search.recognition.belief, {0.5, 0.1, 0.1, 0.1, 0.05, 0.05, 0.05, 0.05});
}

TEST(ChangeSearchEnds, WhereNothingWasSeenSoManyTimes) {
  ChangeOptions options;
  options.empty_views = 3;
  EXPECT_EQ(change_end(options, search_after(3, 3, 0.5)), ChangeEnd::nothing_seen);
  EXPECT_EQ(change_end(options, search_after(5, 3, 0.99)), ChangeEnd::nothing_seen);
  EXPECT_EQ(change_end(options, search_after(3, 2, 0.5)), std::nullopt);
}

TEST(ChangeSearchEnds, WhereItIsSureEitherWay) {
  const ChangeOptions options;
  EXPECT_EQ(change_end(options, search_after(1, 0, 0.96)), ChangeEnd::changed);
  EXPECT_EQ(change_end(options, search_after(1, 0, 0.94)), std::nullopt);
  EXPECT_EQ(change_end(options, search_after(1, 0, 0.06)), std::nullopt);
  EXPECT_EQ(change_end(options, search_after(1, 0, 0.04)), ChangeEnd::unchanged);
  EXPECT_TRUE(in_doubt(options, search_after(1, 0, 0.94)));
  EXPECT_FALSE(in_doubt(options, search_after(1, 0, 0.96)));
}

TEST(ChangeSearchEnds, NotOnTheBoundsThemselves) {
  ChangeOptions options;
  const ChangeSearch search = search_after(1, 0, 0.7);
  options.changed_above = search.hypotheses.p_changed();
  EXPECT_EQ(change_end(options, search), std::nullopt);
  options.changed_above = 0.95;
  options.unchanged_below = search.hypotheses.p_changed();
  EXPECT_EQ(change_end(options, search), std::nullopt);
}

TEST(ChangeSearchEnds, NotWithoutAnyViewThatToldSomething) {
  const ChangeOptions options;
  EXPECT_EQ(change_end(options, search_after(1, 1, 0.99)), std::nullopt);
  EXPECT_EQ(change_end(options, search_after(1, 1, 0.01)), std::nullopt);
  EXPECT_EQ(change_end(options, search_after(2, 1, 0.99)), ChangeEnd::changed);
  EXPECT_EQ(change_end(options, search_after(2, 1, 0.01)), ChangeEnd::unchanged);
}

TEST(ChangeSearchEnds, AfterTheMostViews) {
  ChangeOptions options;
  options.recognition.max_views = 4;
  EXPECT_EQ(change_end(options, search_after(3, 0, 0.5)), std::nullopt);
  EXPECT_EQ(change_end(options, search_after(4, 0, 0.5)), ChangeEnd::max_views);
  EXPECT_EQ(change_end(options, search_after(4, 0, 0.99)), ChangeEnd::changed);
}

TEST(ChangeVerdict, IsRemovedOfWhatNoViewShowed) {
  const Recogniser recogniser = two_of_bins(1);
  ChangeOptions options;
  options.empty_views = 3;
  const auto of = [&](int views, int empty_views) {
    return verdict(recogniser, options, search_after(views, empty_views, 0.1));
  };
  EXPECT_EQ(of(1, 1), Change::removed);
  EXPECT_EQ(of(2, 2), Change::removed);
  EXPECT_EQ(of(3, 2), Change::none);
  EXPECT_EQ(of(4, 3), Change::removed);
  EXPECT_EQ(of(0, 0), Change::none);
}

TEST(ChangeVerdict, IsAChangeAboveTheThresholdAndOfWhatIsMoreProbable) {
  const Recogniser recogniser = two_of_bins(2);
  ChangeOptions options;
  ChangeSearch search = search_after(2, 0, 0.7);
  search.expected_object = 1;
  search.hypotheses.changed.log_p =
      Eigen::Vector4d(std::log(0.15), std::log(0.25), kRuledOut, std::log(0.6));
  options.threshold = 0.71;
  EXPECT_EQ(verdict(recogniser, options, search), Change::none);
  options.threshold = search.hypotheses.p_changed();
  EXPECT_EQ(verdict(recogniser, options, search), Change::none);
  options.threshold = 0.69;
  EXPECT_EQ(verdict(recogniser, options, search), Change::pose);
  search.expected_object = 0;
  EXPECT_EQ(verdict(recogniser, options, search), Change::object);
}

/// One object in either of two poses, measured by numbers given.
class ChangeOfOnePose : public ::testing::Test {
 protected:
  ChangeOfOnePose() {
    Rng rng(1);
    recogniser_ = test::made_up_recogniser(2, {1.0}, {}, rng, 1);
    options_.prior_pose = 0.0;
    options_.prior_object = 0.5;
    search_ = begin_change_search(recogniser_, options_, 0);
  }
  void see(double of_expected, double of_other) {
    const auto extract = [&](std::size_t) {
      return ExtractedFeature{.result = {Eigen::VectorXf::Zero(10), {}},
                              .log_likelihood = Eigen::Vector2d(of_expected, of_other)};
    };
    update_with_view(recogniser_, options_, extract, 0.0, search_, rng_);
  }
  [[nodiscard]] double log_odds() const {
    return search_.hypotheses.log_p_changed - search_.hypotheses.log_p_expected;
  }

  Recogniser recogniser_;
  ChangeOptions options_;
  ChangeSearch search_;
  Rng rng_{1};
};

TEST_F(ChangeOfOnePose, LikelihoodsAddUp) {
  see(-1.0, 0.5);
  EXPECT_NEAR(log_odds(), 1.5, 1e-12);
  see(-1.0, -3.0);
  EXPECT_NEAR(log_odds(), -0.5, 1e-12);
  EXPECT_EQ(search_.recognition.views.size(), 2U);
  EXPECT_NEAR(p_state(search_.recognition.belief)[1], 1.0 / (1.0 + std::exp(0.5)), 1e-12);
}

TEST_F(ChangeOfOnePose, ViewsThatRepeatEachOtherCountForLess) {
  recogniser_.view_correlation = 0.5;
  see(0.0, 0.9);
  see(0.0, 0.9);
  EXPECT_NEAR(log_odds(), 0.9 * 2.0 / 1.5, 1e-12);
}

TEST_F(ChangeOfOnePose, AFeatureThatFitsNothingTellsNothing) {
  see(kRuledOut, kRuledOut);
  EXPECT_EQ(search_.empty_views, 1);
  EXPECT_NEAR(log_odds(), 0.0, 1e-12);
  see(kRuledOut, kRuledOut);
  EXPECT_EQ(search_.empty_views, 2);
  see(-0.2, -0.1);
  EXPECT_EQ(search_.empty_views, 0);
}

TEST_F(ChangeOfOnePose, AViewThatDoesNotShowThePlaceIsNotEmpty) {
  const auto look = [&](bool place_seen) {
    const auto extract = [&](std::size_t) {
      ExtractedFeature nothing{.result = FeatureResult::skip("nothing")};
      nothing.place_seen = place_seen;
      return nothing;
    };
    update_with_view(recogniser_, options_, extract, 0.0, search_, rng_);
    return search_.empty_views;
  };
  EXPECT_EQ(look(false), 0);
  EXPECT_EQ(verdict(recogniser_, options_, search_), Change::none);
  EXPECT_EQ(look(true), 1);
  EXPECT_EQ(look(false), 1) << "the others are still in a row";
  EXPECT_EQ(look(true), 2);
}

TEST_F(ChangeOfOnePose, AViewThatNoFeatureIsAskedOfIsNotEmpty) {
  options_.recognition.all_features = false;
  options_.recognition.features.stop = GainBelow{.threshold = 1e9};
  see(-0.2, -0.1);
  EXPECT_TRUE(search_.recognition.views[0].features.empty());
  EXPECT_EQ(search_.empty_views, 0);
}

TEST_F(ChangeOfOnePose, SomethingMustBeAbleToBeThereInstead) {
  Rng rng(1);
  recogniser_ = test::made_up_recogniser(1, {1.0}, {}, rng, 2);
  EXPECT_THROW(begin_change_search(recogniser_, options_, 0), ConfigError)
      << "one object, which was not turned";
}

TEST(ChangeSearchBegins, WithoutTheSidesThatNoViewIsOf) {
  Recogniser recogniser = two_of_bins(4);
  recogniser.unseen = {2, 3, 7};
  const ChangeOptions options{.prior_pose = 0.3, .prior_object = 0.2};
  const ChangeSearch search = begin_change_search(recogniser, options, 0);
  expect_belief(search.hypotheses.changed, {0, 0.6, 0, 0, 0.4 / 3.0, 0.4 / 3.0, 0.4 / 3.0, 0});
}

TEST_F(ChangeOfOnePose, WhatRulesOutAHypothesisDecidesForTheOther) {
  see(kRuledOut, -2.0);
  EXPECT_EQ(search_.hypotheses.p_changed(), 1.0);
}

/// Even where one of them is beyond the least number.
TEST_F(ChangeOfOnePose, WhatIsBelievedIsTheMixtureOfBoth) {
  see(-900.0, 0.2);
  EXPECT_EQ(search_.recognition.belief.log_p, Eigen::Vector2d(kRuledOut, 0.0));
  EXPECT_EQ(search_.recognition.belief.log_p, search_.hypotheses.mixture().log_p);
}

TEST(ChangeVerdict, IsATurnWhereAnotherObjectIsNoMoreProbable) {
  const Recogniser recogniser = two_of_bins(1);
  ChangeSearch search = search_after(1, 0, 0.9);
  search.hypotheses.changed.log_p = Eigen::Vector2d::Zero();
  EXPECT_EQ(verdict(recogniser, ChangeOptions{}, search), Change::pose);
}

}  // namespace
}  // namespace vantage
