// Which looks at an object count, and which way on is taken.
#include "src/episode/object_looks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "src/episode/flight_planner.hpp"

namespace vantage {
namespace {

constexpr double kPi = std::numbers::pi;

ObjectStates three_objects() {
  return {.objects = {"mug_1", "mug_2", "bowl_1"},
          .categories = {"mug", "bowl"},
          .category_of = {0, 0, 1},
          .bins = 8};
}

class Looks : public testing::Test {
 protected:
  Looks() {
    recogniser_.states = three_objects();
    looks_.found(7, {1.0, 2.0, 0.9});
  }
  /// From a bearing round the object.
  static Pose from(double bearing_rad) {
    return make_pose({1.0 + std::cos(bearing_rad), 2.0 + std::sin(bearing_rad), 1.8}, 0.0);
  }
  [[nodiscard]] bool wants(double bearing_rad, const ObjectSighting& sighting) const {
    return looks_.wants(7, sighting, from(bearing_rad));
  }
  const ObjectLook& take(double bearing_rad) {
    return looks_.take(7, kGood, view_, from(bearing_rad), 0.0, rng_);
  }

  const ObjectSighting kGood{.p_world_object_m = {1.0, 2.0, 0.9}, .distance_m = 1.4, .whole = true};
  Recogniser recogniser_;  // without features: looks change nothing
  ObjectLooks looks_{recogniser_, {}, RigidTransition{}};
  ObjectView view_;
  Rng rng_{1};
};

TEST_F(Looks, CountWholeWithinRangeAndOnceADirection) {
  EXPECT_TRUE(wants(0.0, kGood));
  EXPECT_FALSE(wants(0.0, {.distance_m = 2.01, .whole = true}));
  EXPECT_FALSE(wants(0.0, {.distance_m = 1.4, .whole = false}));
  EXPECT_FALSE(looks_.wants(8, kGood, from(0.0))) << "not found yet";
  EXPECT_EQ(take(0.1).direction, 0);
  EXPECT_FALSE(wants(-0.3, kGood)) << "the same sector";
  EXPECT_TRUE(wants(0.5, kGood)) << "the next one begins at 22.5 deg";
  EXPECT_EQ(take(-kPi).direction, 4);
  EXPECT_EQ(looks_.total(), 2);
}

TEST_F(Looks, AreTakenFromApart) {
  take(0.35);
  EXPECT_EQ(looks_.direction(7, from(0.45)), 1) << "another direction";
  EXPECT_FALSE(wants(0.45, kGood)) << "but hardly another side";
  EXPECT_TRUE(wants(0.7, kGood));
}

TEST_F(Looks, OfAKnownObjectAreNotWanted) {
  ObjectLooks looks(recogniser_, {.known_below_nats = 2.0}, RigidTransition{});
  looks.found(7, {1.0, 2.0, 0.9});
  EXPECT_FALSE(looks.wants(7, kGood, from(0.0))) << "ln 3 is below 2";
  ObjectLooks all(recogniser_, {.known_below_nats = 2.0, .look_at_known = true}, RigidTransition{});
  all.found(7, {1.0, 2.0, 0.9});
  EXPECT_TRUE(all.wants(7, kGood, from(0.0)));
}

TEST_F(Looks, EntropyIsOfTheObjectAloneInNats) {
  EXPECT_NEAR(looks_.entropy_nats(looks_.objects().front()), std::log(3.0), 1e-12);
}

TEST_F(Looks, WhatTurnsOutToBeAnotherIsForgottenButWasLookedAt) {
  take(0.0);
  looks_.forget(7);
  EXPECT_TRUE(looks_.objects().empty());
  EXPECT_EQ(looks_.total(), 1);
}

TEST(WaysOn, TheFirstThatIsClearElseTheOneThatKeepsOffFarthest) {
  std::vector<WayOn> ways(3);
  ways[0].clear = false;
  ways[0].clearance_m = 0.1;
  ways[1].clearance_m = 0.6;
  ways[2].clearance_m = 0.9;
  EXPECT_EQ(safest_of_best(ways), 1U);
  ways[1].clear = ways[2].clear = false;
  EXPECT_EQ(safest_of_best(ways), 2U);
}

TEST(TrajectoryMethod, NamesWhatItsCostLeavesOut) {
  FlightCostOptions cost;
  EXPECT_EQ(trajectory_method_name(Stomp{}, cost), "stomp");
  cost.information = false;
  cost.centre_weight = 0.0;
  EXPECT_EQ(trajectory_method_name(Stomp{}, cost), "stomp without c_i without c_v");
}

}  // namespace
}  // namespace vantage
