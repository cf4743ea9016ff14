// Which images become observations, and when.
#include "vantage/recognition/observation_buffer.hpp"

#include <gtest/gtest.h>

namespace vantage {
namespace {

const ObservationOptions kOptions{.near_m = 1.3, .patience_s = 0.5, .left_after_s = 2.0};

BufferedObservation observation_of(int id, int direction, double distance_m, double time_s) {
  BufferedObservation observation;
  observation.id = id;
  observation.direction = direction;
  observation.time_s = time_s;
  observation.seen.detection.distance_m = distance_m;
  return observation;
}

class BufferOfObservations : public testing::Test {
 protected:
  std::vector<BufferedObservation> due(double time_s, int direction) {
    return buffer_.take_due(time_s, [direction](int) { return direction; });
  }
  ObservationBuffer buffer_{kOptions};
};

TEST_F(BufferOfObservations, OnlyANearerPictureReplacesAnother) {
  EXPECT_TRUE(buffer_.improves(1, 0, 1.9));
  buffer_.keep(observation_of(1, 0, 1.9, 0.0));
  EXPECT_FALSE(buffer_.improves(1, 0, 1.85));
  EXPECT_TRUE(buffer_.improves(1, 0, 1.7));
  EXPECT_TRUE(buffer_.improves(1, 1, 1.9)) << "from another direction";
  EXPECT_TRUE(buffer_.improves(2, 0, 1.9)) << "of another object";
  buffer_.keep(observation_of(1, 0, 1.7, 0.1));
  EXPECT_EQ(buffer_.take_all().size(), 1U);
}

TEST_F(BufferOfObservations, ANearOneIsDueOnceNoneWasNearer) {
  buffer_.detected(1, 1.0);
  buffer_.keep(observation_of(1, 0, 1.1, 1.0));
  EXPECT_TRUE(due(1.4, 0).empty());
  EXPECT_EQ(due(1.5, 0).size(), 1U);
  EXPECT_TRUE(due(1.6, 0).empty()) << "it is taken";
  buffer_.keep(observation_of(1, 0, 1.1, 2.0));
  EXPECT_EQ(due(2.1, 1).size(), 1U) << "its direction was left";
}

TEST_F(BufferOfObservations, OneFromAfarWaitsUntilTheObjectWasLeft) {
  buffer_.keep(observation_of(1, 0, 1.8, 0.0));
  buffer_.keep(observation_of(1, 1, 1.5, 1.0));
  buffer_.detected(1, 3.0);
  EXPECT_TRUE(due(4.9, 1).empty());
  const auto taken = due(5.0, 1);
  ASSERT_EQ(taken.size(), 2U);
  EXPECT_EQ(taken[0].direction, 1) << "the nearest first";
}

TEST_F(BufferOfObservations, WhatWasAnotherObjectIsForgotten) {
  buffer_.keep(observation_of(1, 0, 1.8, 0.0));
  buffer_.keep(observation_of(2, 0, 1.7, 0.0));
  buffer_.forget(1);
  ASSERT_EQ(buffer_.take_all().size(), 1U);
}

TEST_F(BufferOfObservations, ATenthOfAMetreNearerIsEnough) {
  buffer_.keep(observation_of(1, 0, 1.9, 0.0));
  EXPECT_FALSE(buffer_.improves(1, 0, 1.83));
  EXPECT_TRUE(buffer_.improves(1, 0, 1.9 - 0.1));
  EXPECT_TRUE(buffer_.improves(1, 0, 1.77));
}

TEST_F(BufferOfObservations, EachDirectionOfEachObjectHasItsOwn) {
  buffer_.keep(observation_of(1, 0, 1.9, 0.0));
  buffer_.keep(observation_of(1, 3, 1.4, 0.0));
  buffer_.keep(observation_of(2, 0, 1.6, 0.0));
  buffer_.keep(observation_of(1, 0, 1.5, 1.0));
  const auto taken = buffer_.take_all();
  ASSERT_EQ(taken.size(), 3U);
  EXPECT_EQ(taken[0].direction, 3) << "the nearest first";
  EXPECT_EQ(taken[1].time_s, 1.0);
  EXPECT_EQ(taken[2].id, 2);
  EXPECT_TRUE(buffer_.take_all().empty());
}

TEST_F(BufferOfObservations, WhatIsNotDueStays) {
  buffer_.detected(1, 1.0);
  buffer_.detected(2, 1.0);
  buffer_.keep(observation_of(1, 0, 1.1, 1.0));
  buffer_.keep(observation_of(2, 0, 1.2, 1.0));
  const auto taken = buffer_.take_due(1.1, [](int id) { return id == 1 ? 0 : 5; });
  ASSERT_EQ(taken.size(), 1U);
  EXPECT_EQ(taken[0].id, 2) << "its direction was left";
  const auto rest = buffer_.take_all();
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(rest[0].id, 1);
}

TEST_F(BufferOfObservations, AtTheNearDistanceOneIsNear) {
  buffer_.detected(1, 1.0);
  buffer_.keep(observation_of(1, 0, 1.3, 1.0));
  EXPECT_EQ(due(1.1, 4).size(), 1U) << "its direction was left";
  buffer_.keep(observation_of(1, 0, 1.301, 1.0));
  EXPECT_TRUE(due(1.1, 4).empty()) << "the object was not";
}

TEST_F(BufferOfObservations, ForgettingForgetsThatObjectAndWhenItWasSeen) {
  buffer_.detected(1, 10.0);
  buffer_.detected(2, 10.0);
  buffer_.keep(observation_of(1, 0, 1.8, 9.0));
  buffer_.keep(observation_of(2, 0, 1.7, 9.0));
  buffer_.forget(1);
  EXPECT_TRUE(due(10.0, 0).empty()) << "the other one is in view";
  buffer_.keep(observation_of(1, 0, 1.8, 10.0));
  const auto taken = due(10.0, 0);
  ASSERT_EQ(taken.size(), 1U);
  EXPECT_EQ(taken[0].id, 1);
  ASSERT_EQ(buffer_.take_all().size(), 1U);
}

}  // namespace
}  // namespace vantage
