// What features say of an object that something stands in front of.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/object_views.hpp"
#include "vantage/perception/features/feature.hpp"

namespace vantage {
namespace {

ObjectView ball() {
  Rng rng(3);
  return ball_view(160, {.radius_m = 0.08}, rng);
}

/// Takes the columns from `first` to `last` out of the mask and marks the edge beside them.
ObjectView hidden_columns(ObjectView view, int first, int last) {
  view.cut_off.assign(view.mask.size(), 0);
  for (int row = 0; row < view.height_px; ++row) {
    for (int column = first; column < last; ++column) view.mask[view.index(row, column)] = 0;
    for (const int beside : {first - 1, last}) {
      if (beside < 0 || beside >= view.width_px) continue;
      const std::size_t i = view.index(row, beside);
      view.cut_off[i] = view.mask[i];
    }
  }
  return view;
}

std::vector<Reading> readings(const ObjectView& view) {
  Rng rng(1);
  const FeatureResult result = train_feature(StandingBox{}, {&view, 1}, rng).extract(view);
  EXPECT_TRUE(result.extracted()) << result.skipped;
  return result.readings;
}

TEST(CutOffExtents, AWholeObjectIsReadExactly) { EXPECT_TRUE(readings(ball()).empty()); }

TEST(CutOffExtents, AHalfHasLowerBounds) {
  const std::vector<Reading> half = readings(hidden_columns(ball(), 80, 160));
  ASSERT_EQ(half.size(), 3U);
  EXPECT_EQ(half[0], Reading::at_least) << "its top is at the edge that hides it";
  EXPECT_EQ(half[1], Reading::at_least);
}

/// The outermost eighth is hidden: the top is seen.
TEST(CutOffExtents, WhatIsSeenWholeIsExact) {
  const std::vector<Reading> most = readings(hidden_columns(ball(), 118, 160));
  ASSERT_EQ(most.size(), 3U);
  EXPECT_EQ(most[0], Reading::exact);
  EXPECT_EQ(most[1], Reading::at_least);
}

TEST(CutOffExtents, OtherFeaturesWeighLess) {
  ObjectView view = ball();
  Rng rng(1);
  const TrainedFeature colour = train_feature(SoftColour{}, {&view, 1}, rng);
  EXPECT_EQ(colour.extract(view).weight, 1.0);
  view.seen_share = 0.4;
  EXPECT_EQ(colour.extract(view).weight, 0.4);
}

TEST(StandingBox, TakesTheSupportThatIsKnown) {
  ObjectView view = ball();
  Rng rng(1);
  const TrainedFeature box = train_feature(StandingBox{}, {&view, 1}, rng);
  const float seen_m = box.extract(view).vector[0];
  view.support_m = -0.2;  // along `up` from the camera
  const float known_m = box.extract(view).vector[0];
  view.support_m = -0.3;
  EXPECT_NEAR(box.extract(view).vector[0], known_m + 0.1F, 1e-5F);
  EXPECT_NE(seen_m, known_m);
}

/// What its readings leave open needs no weight beside.
TEST(CutOffExtents, ReadingsWeighInFull) {
  ObjectView view = hidden_columns(ball(), 80, 160);
  view.seen_share = 0.4;
  Rng rng(1);
  const FeatureResult result = train_feature(StandingBox{}, {&view, 1}, rng).extract(view);
  ASSERT_FALSE(result.readings.empty());
  EXPECT_EQ(result.weight, 1.0);
}

}  // namespace
}  // namespace vantage
