// Which looks at an object count, and which way on is taken.
#include "vantage/recognition/object_observations.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "tests/recognition/made_up.hpp"
#include "vantage/planners/trajectory/flight_planner.hpp"

namespace vantage {
namespace {

constexpr int kColours = 9;

/// All of one colour.
ObjectView view_of_colour(int colour) {
  constexpr std::array<std::array<std::uint8_t, 3>, kColours> kRgb{{{255, 0, 0},
                                                                    {255, 255, 0},
                                                                    {0, 255, 0},
                                                                    {0, 255, 255},
                                                                    {0, 0, 255},
                                                                    {255, 0, 255},
                                                                    {255, 255, 255},
                                                                    {128, 128, 128},
                                                                    {80, 0, 0}}};
  ObjectView view;
  view.width_px = view.height_px = 12;
  view.depth_m.assign(144, 1.0F);
  view.mask.assign(144, 1);
  for (int i = 0; i < 3 * 144; ++i) {
    view.rgb.push_back(kRgb[static_cast<std::size_t>(colour)][static_cast<std::size_t>(i % 3)]);
  }
  return view;
}

/// Two that have the same eight colours, one in each yaw bin, but for a side of the second.
Recogniser near_duplicates(int other_bin) {
  const ObjectStates states{
      .objects = {"mug_1", "mug_2"}, .categories = {"mug"}, .category_of = {0, 0}, .bins = 8};
  const TrainedFeature colour(Colour{}, 0.0);
  ObservationModel model{
      .feature = "colour",
      .mean = Eigen::MatrixXf(colour.dimension(), states.size()),
      .variance = Eigen::MatrixXf::Constant(colour.dimension(), states.size(), 0.01F)};
  for (int state = 0; state < states.size(); ++state) {
    const bool other = state == states.state(1, other_bin);
    model.mean.col(state) =
        colour.extract(view_of_colour(other ? kColours - 1 : states.bin_of(state))).vector;
  }
  return make_recogniser(states, {{colour, std::move(model)}}, 1);
}

class ObservationsOfAnObject : public ::testing::Test {
 protected:
  ObservationsOfAnObject() { observations_.found(7, {1.0, 2.0, 0.9}); }
  /// From a bearing round the object.
  static Pose from(double bearing_rad) {
    return make_pose({1.0 + std::cos(bearing_rad), 2.0 + std::sin(bearing_rad), 1.8}, 0.0);
  }
  [[nodiscard]] bool wants(double bearing_rad, const ObjectDetection& detection) const {
    return observations_.wants(7, detection, from(bearing_rad));
  }
  const ObjectObservation& take(double bearing_rad) {
    return observations_.take(7, kGood, view_, from(bearing_rad), 0.0, rng_);
  }

  const ObjectDetection kGood{
      .p_world_object_m = {1.0, 2.0, 0.9}, .distance_m = 1.4, .whole = true};
  Rng made_{1};
  Recogniser recogniser_ = test::made_up_recogniser(3, {2.0}, {}, made_);
  ObjectObservations observations_{recogniser_, {}, RigidTransition{}};
  ObjectView view_;  // of nothing: looks change little
  Rng rng_{1};
};

TEST_F(ObservationsOfAnObject, CountWholeWithinRangeAndOnceADirection) {
  EXPECT_TRUE(wants(0.0, kGood));
  EXPECT_FALSE(wants(0.0, {.distance_m = 2.01, .whole = true}));
  EXPECT_FALSE(wants(0.0, {.distance_m = 1.4, .whole = false}));
  EXPECT_FALSE(observations_.wants(8, kGood, from(0.0))) << "not found yet";
  EXPECT_EQ(take(0.1).direction, 0);
  EXPECT_FALSE(wants(-0.3, kGood)) << "the same sector";
  EXPECT_TRUE(wants(0.5, kGood)) << "the next one begins at 22.5 deg";
  EXPECT_EQ(take(-std::numbers::pi).direction, 4);
  EXPECT_EQ(observations_.total(), 2);
}

TEST_F(ObservationsOfAnObject, AreTakenFromApart) {
  take(0.35);
  EXPECT_EQ(observations_.direction(7, from(0.45)), 1) << "another direction";
  EXPECT_FALSE(wants(0.45, kGood)) << "but hardly another side";
  EXPECT_TRUE(wants(0.7, kGood));
}

TEST_F(ObservationsOfAnObject, OfAKnownObjectAreNotWanted) {
  ObjectObservations observations(recogniser_, {.known_below_nats = 2.0}, RigidTransition{});
  observations.found(7, {1.0, 2.0, 0.9});
  EXPECT_FALSE(observations.wants(7, kGood, from(0.0))) << "ln 3 is below 2";
  ObjectObservations all(recogniser_, {.known_below_nats = 2.0, .observe_known = true},
                         RigidTransition{});
  all.found(7, {1.0, 2.0, 0.9});
  EXPECT_TRUE(all.wants(7, kGood, from(0.0)));
}

TEST_F(ObservationsOfAnObject, EntropyIsOfTheObjectAloneInNats) {
  EXPECT_NEAR(observations_.entropy_nats(observations_.objects().front()), std::log(3.0), 1e-12);
}

TEST(GainOfALook, IsHighestFromTheSideThatDiffers) {
  const Recogniser recogniser = near_duplicates(2);
  ObjectObservations observations(recogniser, {}, RigidTransition{.slip = 0.0});
  observations.found(7, {1.0, 2.0, 0.9});
  const Pose T_world_camera = make_pose({2.0, 2.0, 1.8}, 0.0);  // bearing 0
  Rng rng(1);
  observations.take(7, {.p_world_object_m = {1.0, 2.0, 0.9}, .distance_m = 1.4, .whole = true},
                    view_of_colour(5), T_world_camera, 0.0, rng);
  const RecognisedObject& object = observations.objects().front();
  ASSERT_NEAR(observations.entropy_nats(object), std::log(2.0), 0.01)
      << "either, from a known side";
  // The yaw that is seen falls as the bearing rises: bin 2 is three to the left of bin 5.
  for (std::size_t d = 0; d < object.gain_nats.size(); ++d) {
    EXPECT_NEAR(object.gain_nats[d], d == 3 ? std::log(2.0) : 0.0, 0.02) << d;
  }
}

TEST_F(ObservationsOfAnObject, WhatTurnsOutToBeAnotherIsForgottenButWasLookedAt) {
  take(0.0);
  observations_.forget(7);
  EXPECT_TRUE(observations_.objects().empty());
  EXPECT_EQ(observations_.total(), 1);
}

TEST_F(ObservationsOfAnObject, AreExpectedToTellThreeQuartersAtFirst) {
  for (const double gain : observations_.objects().front().gain_nats) {
    EXPECT_NEAR(gain, 0.75 * std::log(3.0), 1e-12);
  }
  ObjectObservations modest(recogniser_, {.min_gain_nats = 0.82}, RigidTransition{});
  modest.found(7, {1.0, 2.0, 0.9});
  EXPECT_TRUE(modest.wants(7, kGood, from(0.0)));
  ObjectObservations demanding(recogniser_, {.min_gain_nats = 0.83}, RigidTransition{});
  demanding.found(7, {1.0, 2.0, 0.9});
  EXPECT_FALSE(demanding.wants(7, kGood, from(0.0)));
}

TEST_F(ObservationsOfAnObject, CountUpToTheRangeAndDownToTheEntropyThemselves) {
  EXPECT_TRUE(wants(0.0, {.distance_m = 2.0, .whole = true}));
  const double entropy = observations_.entropy_nats(observations_.objects().front());
  ObjectObservations known(recogniser_, {.known_below_nats = entropy}, RigidTransition{});
  known.found(7, {1.0, 2.0, 0.9});
  EXPECT_FALSE(known.known(known.objects().front()));
  EXPECT_TRUE(known.wants(7, kGood, from(0.0)));
}

TEST_F(ObservationsOfAnObject, AreApartTheShortWayRound) {
  ObjectObservations observations(recogniser_, {.apart_rad = 1.0}, RigidTransition{});
  observations.found(7, {1.0, 2.0, 0.9});
  observations.take(7, kGood, view_, from(3.0), 0.0, rng_);
  EXPECT_FALSE(observations.wants(7, kGood, from(-2.6))) << "0.68 from there, in direction 5";
  EXPECT_TRUE(observations.wants(7, kGood, from(-2.0)));
}

TEST_F(ObservationsOfAnObject, FollowItsPlaceAndItAlone) {
  observations_.found(9, {5.0, 5.0, 1.0});
  observations_.found(7, {1.5, 2.5, 0.8});
  ASSERT_EQ(observations_.objects().size(), 2U);
  EXPECT_EQ(observations_.objects()[0].p_world_m, Eigen::Vector3d(1.5, 2.5, 0.8));
  EXPECT_EQ(observations_.objects()[1].p_world_m, Eigen::Vector3d(5.0, 5.0, 1.0));
  EXPECT_EQ(observations_.direction(7, make_pose({1.5, 4.0, 1.0}, 0.0)), 2);
  observations_.forget(7);
  ASSERT_EQ(observations_.objects().size(), 1U);
  EXPECT_EQ(observations_.objects()[0].id, 9);
}

TEST_F(ObservationsOfAnObject, TellFromWhereTheyWere) {
  const ObjectDetection detection{
      .p_world_object_m = {1.0, 2.0, 0.7}, .distance_m = 1.75, .pixels = 123, .whole = true};
  const Pose T_world_camera = make_pose({4.0, 6.0, 2.7}, 0.0);
  const ObjectObservation& seen =
      observations_.take(7, detection, view_, T_world_camera, 4.5, rng_);
  EXPECT_EQ(seen.time_s, 4.5);
  EXPECT_NEAR(seen.bearing_rad, std::atan2(4.0, 3.0), 1e-12);
  EXPECT_EQ(seen.direction, 1);
  EXPECT_EQ(seen.distance_m, 1.75);
  EXPECT_NEAR(seen.elevation_rad, std::atan2(2.0, 5.0), 1e-12);
  EXPECT_EQ(seen.pixels, 123);
  EXPECT_NEAR(seen.report.view_rad, seen.bearing_rad, 1e-12);
  EXPECT_EQ(seen.unknown_probability, 0.0);
  EXPECT_TRUE(observations_.objects().front().used[1]);
  EXPECT_EQ(seen.entropy_nats, observations_.entropy_nats(observations_.objects().front()));
}

TEST_F(ObservationsOfAnObject, StartFromThePriorOfUnknownOnes) {
  EXPECT_NEAR(observations_.prior_entropy_nats(), std::log(3.0), 1e-12);
  recogniser_.states.unknown_category = {kNoCategory};
  recogniser_.unknown_prior = 0.2;
  ObjectObservations observations(recogniser_, {}, RigidTransition{});
  observations.found(7, {1.0, 2.0, 0.9});
  const double expected = -0.2 * std::log(0.2) - 0.8 * std::log(0.8 / 3.0);
  EXPECT_NEAR(observations.prior_entropy_nats(), expected, 1e-9);
  EXPECT_NEAR(observations.entropy_nats(observations.objects().front()), expected, 1e-9);
  EXPECT_NEAR(observations.unknown_probability(observations.objects().front()), 0.2, 1e-9);
}

/// Seen from a quarter turn, then from the side that differs, then from beside it.
TEST(BeliefOfLooks, IsTurnedFromEachToTheNext) {
  const Recogniser recogniser = near_duplicates(2);
  ObjectObservations observations(recogniser, {}, RigidTransition{.slip = 0.0});
  observations.found(7, {1.0, 2.0, 0.9});
  Rng rng(1);
  const auto take = [&](int eighths, int colour) {
    const double bearing_rad = eighths * std::numbers::pi / 4.0;
    const Pose T_world_camera =
        make_pose({1.0 + std::cos(bearing_rad), 2.0 + std::sin(bearing_rad), 1.8}, 0.0);
    observations.take(7, {.p_world_object_m = {1.0, 2.0, 0.9}, .distance_m = 1.4, .whole = true},
                      view_of_colour(colour), T_world_camera, 0.0, rng);
  };
  const RecognisedObject& object = observations.objects().front();
  take(2, 5);
  for (std::size_t d = 0; d < object.gain_nats.size(); ++d) {
    EXPECT_NEAR(object.gain_nats[d], d == 5 ? std::log(2.0) : 0.0, 0.02) << d;
  }
  take(5, 2);
  EXPECT_EQ(object.observations.back().estimate, "mug_1");
  EXPECT_GT(object.observations.back().map_probability, 0.99);
  take(6, 1);
  EXPECT_EQ(most_probable_state(object.recognition.belief), recogniser.states.state(0, 1));
  EXPECT_EQ(observations.total(), 3);
  EXPECT_EQ(object.observations.back().report.features, std::vector<std::string>{"colour"})
      << "nothing is left out of what is known already";
}

TEST(WaysOn, TheFirstThatIsClearElseTheOneThatKeepsOffFarthest) {
  std::vector<CandidatePlan> candidates(3);
  candidates[0].clear = false;
  candidates[0].clearance_m = 0.1;
  candidates[1].clearance_m = 0.6;
  candidates[2].clearance_m = 0.9;
  EXPECT_EQ(safest_of_best(candidates), 1U);
  candidates[1].clear = candidates[2].clear = false;
  EXPECT_EQ(safest_of_best(candidates), 2U);
}

TEST(TrajectoryMethod, NamesWhatItsCostLeavesOut) {
  FlightCostOptions cost;
  EXPECT_EQ(trajectory_method_name(Stomp{}, cost), "stomp");
  cost.information = false;
  cost.centre_weight = 0.0;
  EXPECT_EQ(trajectory_method_name(Stomp{}, cost), "stomp without c_i without c_v");
}

TEST_F(ObservationsOfAnObject, CountFromJustAsFarApartAndForJustAsMuch) {
  ObservationOptions just_as_much;
  just_as_much.min_gain_nats = observations_.objects().front().gain_nats[0];
  ObjectObservations observations(recogniser_, just_as_much, RigidTransition{});
  observations.found(7, {1.0, 2.0, 0.9});
  EXPECT_TRUE(observations.wants(7, kGood, from(0.0)));
  ObservationOptions just_as_far;
  just_as_far.apart_rad = std::atan2(1.0, 1.0);
  just_as_far.min_gain_nats = 0.0;
  ObjectObservations apart(recogniser_, just_as_far, RigidTransition{});
  apart.found(7, {1.0, 2.0, 0.9});
  apart.take(7, kGood, view_, from(0.0), 0.0, rng_);
  EXPECT_TRUE(apart.wants(7, kGood, make_pose({2.0, 3.0, 1.8}, 0.0)));
}

TEST(PriorEntropy, OfKnownObjectsIsTheLogarithmOfTheirNumber) {
  for (int objects = 2; objects <= 40; ++objects) {
    const Recogniser recogniser{
        .states = test::near_duplicate_families(objects, 1).states, .features = {}, .tables = {}};
    const ObjectObservations observations(recogniser, {}, RigidTransition{});
    EXPECT_EQ(observations.prior_entropy_nats(), std::log(static_cast<double>(objects)));
  }
}

}  // namespace
}  // namespace vantage
