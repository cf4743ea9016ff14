// Which pictures become observations, and when.
#include "vantage/recognition/kept_looks.hpp"

#include <gtest/gtest.h>

namespace vantage {
namespace {

const LookOptions kOptions{.near_m = 1.3, .patience_s = 0.5, .left_after_s = 2.0};

KeptLook look_at(int id, int direction, double distance_m, double time_s) {
  KeptLook look;
  look.id = id;
  look.direction = direction;
  look.time_s = time_s;
  look.seen.sighting.distance_m = distance_m;
  return look;
}

class Kept : public testing::Test {
 protected:
  std::vector<KeptLook> due(double time_s, int direction) {
    return kept_.take_due(time_s, [direction](int) { return direction; });
  }
  KeptLooks kept_{kOptions};
};

TEST_F(Kept, OnlyANearerPictureReplacesAnother) {
  EXPECT_TRUE(kept_.improves(1, 0, 1.9));
  kept_.keep(look_at(1, 0, 1.9, 0.0));
  EXPECT_FALSE(kept_.improves(1, 0, 1.85));
  EXPECT_TRUE(kept_.improves(1, 0, 1.7));
  EXPECT_TRUE(kept_.improves(1, 1, 1.9)) << "from another direction";
  EXPECT_TRUE(kept_.improves(2, 0, 1.9)) << "of another object";
  kept_.keep(look_at(1, 0, 1.7, 0.1));
  EXPECT_EQ(kept_.take_all().size(), 1U);
}

TEST_F(Kept, ANearOneIsDueOnceNoneWasNearer) {
  kept_.sighted(1, 1.0);
  kept_.keep(look_at(1, 0, 1.1, 1.0));
  EXPECT_TRUE(due(1.4, 0).empty());
  EXPECT_EQ(due(1.5, 0).size(), 1U);
  EXPECT_TRUE(due(1.6, 0).empty()) << "it is taken";
  kept_.keep(look_at(1, 0, 1.1, 2.0));
  EXPECT_EQ(due(2.1, 1).size(), 1U) << "its direction was left";
}

TEST_F(Kept, OneFromAfarWaitsUntilTheObjectWasLeft) {
  kept_.keep(look_at(1, 0, 1.8, 0.0));
  kept_.keep(look_at(1, 1, 1.5, 1.0));
  kept_.sighted(1, 3.0);
  EXPECT_TRUE(due(4.9, 1).empty());
  const auto taken = due(5.0, 1);
  ASSERT_EQ(taken.size(), 2U);
  EXPECT_EQ(taken[0].direction, 1) << "the nearest first";
}

TEST_F(Kept, WhatWasAnotherObjectIsForgotten) {
  kept_.keep(look_at(1, 0, 1.8, 0.0));
  kept_.keep(look_at(2, 0, 1.7, 0.0));
  kept_.forget(1);
  ASSERT_EQ(kept_.take_all().size(), 1U);
}

}  // namespace
}  // namespace vantage
