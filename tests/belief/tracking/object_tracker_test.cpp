#include "vantage/belief/tracking/object_tracker.hpp"

#include <gtest/gtest.h>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

ObjectDetection at(double x_m, double y_m, double distance_m = 1.3, bool whole = true) {
  return {.p_world_object_m = {x_m, y_m, 0.85},
          .support_z_m = 0.8,
          .radius_m = 0.05,
          .height_m = 0.1,
          .distance_m = distance_m,
          .pixels = 500,
          .whole = whole};
}

TEST(ObjectTracker, TellsNeighboursApartAndKnowsThemAgain) {
  ObjectTracker found;
  const std::vector<ObjectDetection> first{at(1.0, 0.0), at(2.0, 0.5)};
  EXPECT_EQ(found.update(first), (std::vector<int>{0, 1}));
  const std::vector<ObjectDetection> second{at(2.05, 0.48), at(4.0, 0.0), at(0.96, 0.02)};
  EXPECT_EQ(found.update(second), (std::vector<int>{1, 2, 0}));
  ASSERT_EQ(found.objects().size(), 3U);
  EXPECT_EQ(found.objects()[0].detections, 2);
  EXPECT_NEAR(found.objects()[0].p_world_object_m.x(), 0.98, 1e-12);
  EXPECT_NEAR(found.objects()[0].support_z_m, 0.8, 1e-12);
  EXPECT_NEAR(found.objects()[0].radius_m, 0.05, 1e-12);
}

TEST(ObjectTracker, OneSightingMayBeNoise) {
  ObjectTracker found;
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(found.confirmed().empty());
    found.update(std::vector{at(1.0, 0.0)});
  }
  ASSERT_EQ(found.confirmed().size(), 1U);
  EXPECT_EQ(found.confirmed()[0].id, 0);
}

TEST(ObjectTracker, TheMeanGetsBetterWithSightings) {
  ObjectTracker found;
  Rng rng(3);
  for (int i = 0; i < 100; ++i) {
    found.update(std::vector{at(rng.normal(1.0, 0.03), rng.normal(-2.0, 0.03))});
  }
  ASSERT_EQ(found.objects().size(), 1U);
  const Eigen::Vector2d mean = found.objects()[0].p_world_object_m.head<2>();
  EXPECT_LT((mean - Eigen::Vector2d(1.0, -2.0)).norm(), 0.01);
  EXPECT_EQ(found.objects()[0].whole_detections, 100);
}

TEST(ObjectTracker, NearAndWholeSightingsCountForMore) {
  ObjectTracker found;
  found.update(std::vector{at(1.2, 0.0, 2.6, false)});
  found.update(std::vector{at(1.0, 0.0, 1.3, true)});
  // Weights 0.1 / 2.6^4 and 1 / 1.3^4: 1 to 160.
  EXPECT_NEAR(found.objects()[0].p_world_object_m.x(), 1.0 + 0.2 / 161.0, 1e-9);
  EXPECT_EQ(found.objects()[0].whole_detections, 1);
}

TEST(ObjectTracker, ThatDriftTogetherWereOne) {
  ObjectTracker found({.gate_m = 0.3});
  const std::vector<ObjectDetection> cut{at(1.0, 0.0, 2.5, false), at(1.35, 0.0, 2.5, false)};
  EXPECT_EQ(found.update(cut), (std::vector<int>{0, 1}));
  EXPECT_EQ(found.update(std::vector{at(1.16, 0.0)}), std::vector<int>{0});
  ASSERT_EQ(found.objects().size(), 2U) << "0.19 m apart";
  EXPECT_EQ(found.update(std::vector{at(1.27, 0.0)}), std::vector<int>{0}) << "it was 1";
  ASSERT_EQ(found.objects().size(), 1U);
  EXPECT_EQ(found.objects()[0].detections, 4);
  EXPECT_EQ(found.confirmed().size(), 1U) << "as all of its detections together";
}

TEST(ObjectTracker, WhatIsConfirmedStaysWhatItIs) {
  ObjectTracker found({.gate_m = 0.3, .min_detections = 4});
  found.update(std::vector{at(1.0, 0.0, 2.5, false), at(1.35, 0.0)});
  for (int i = 0; i < 3; ++i) found.update(std::vector{at(1.35, 0.0)});
  ASSERT_EQ(found.confirmed().size(), 1U);
  EXPECT_EQ(found.update(std::vector{at(1.17, 0.0)}), std::vector<int>{0});
  EXPECT_EQ(found.update(std::vector{at(1.25, 0.0)}), std::vector<int>{1}) << "it was 0";
  ASSERT_EQ(found.objects().size(), 1U);
  EXPECT_EQ(found.objects()[0].id, 1) << "which was confirmed, though 0 came first";
}

TEST(ObjectTracker, IdsAreNotUsedAgain) {
  ObjectTracker found({.gate_m = 0.3, .min_detections = 1});
  found.update(std::vector{at(0.0, 0.0, 2.5, false), at(0.31, 0.0, 1.0)});
  found.update(std::vector{at(0.14, 0.0, 1.0)});
  ASSERT_EQ(found.objects().size(), 2U) << "0.17 m apart";
  found.update(std::vector{at(0.2, 0.0, 1.0), at(0.2, 0.0, 1.0)});
  ASSERT_EQ(found.objects().size(), 1U);
  EXPECT_EQ(found.find(1), nullptr);
  EXPECT_EQ(found.update(std::vector{at(3.0, 0.0)}), std::vector<int>{2});
}

TEST(ObjectTracker, RejectsOptionsOutOfRange) {
  EXPECT_THROW(ObjectTracker({.gate_m = 0.0}), ConfigError);
  EXPECT_THROW(ObjectTracker({.min_detections = 0}), ConfigError);
}

/// Weights 1 and 1 / 2^4: what is nearer than a metre counts as if it were a metre away.
TEST(ObjectTracker, EverySizeIsAWeightedMean) {
  ObjectTracker found;
  ObjectDetection near = at(1.0, 0.0, 0.5);
  ObjectDetection far = at(1.17, 0.17, 2.0);
  far.p_world_object_m.z() = 1.02;
  far.support_z_m = 0.97;
  far.radius_m = 0.22;
  far.height_m = 0.27;
  found.update(std::vector{near});
  EXPECT_NEAR(found.objects()[0].weight, 1.0, 1e-12);
  found.update(std::vector{far});
  ASSERT_EQ(found.objects().size(), 1U);
  const TrackedObject& object = found.objects()[0];
  EXPECT_NEAR(object.weight, 1.0 + 1.0 / 16.0, 1e-12);
  EXPECT_NEAR(object.p_world_object_m.x(), 1.0 + 0.17 / 17.0, 1e-12);
  EXPECT_NEAR(object.p_world_object_m.y(), 0.17 / 17.0, 1e-12);
  EXPECT_NEAR(object.p_world_object_m.z(), 0.85 + 0.17 / 17.0, 1e-12);
  EXPECT_NEAR(object.support_z_m, 0.8 + 0.17 / 17.0, 1e-12);
  EXPECT_NEAR(object.radius_m, 0.05 + 0.17 / 17.0, 1e-12);
  EXPECT_NEAR(object.height_m, 0.1 + 0.17 / 17.0, 1e-12);
  EXPECT_FALSE(object.confirmed);
}

/// Heights do not part objects, and just at the gate they are two.
TEST(ObjectTracker, TakesTheNearestWithinTheGateLevel) {
  ObjectTracker found({.gate_m = 0.5});
  ObjectDetection above = at(0.2, 0.0);
  above.p_world_object_m.z() = 3.0;
  found.update(std::vector{at(0.0, 0.0), at(1.0, 0.0)});
  EXPECT_EQ(found.update(std::vector{above}), std::vector<int>{0});
  EXPECT_EQ(found.update(std::vector{at(0.0, 0.75)}), std::vector<int>{2});
  EXPECT_EQ(found.update(std::vector{at(1.0, 0.5)}), std::vector<int>{3}) << "0.5 m from 1";
}

TEST(ObjectTracker, OneSightingIsEnoughWhereOneIsAskedFor) {
  for (const int enough : {1, 2}) {
    ObjectTracker found({.min_detections = enough});
    found.update(std::vector{at(1.0, 0.0)});
    EXPECT_EQ(found.confirmed().size(), enough == 1 ? 1U : 0U);
    found.update(std::vector{at(1.0, 0.0)});
    EXPECT_EQ(found.confirmed().size(), 1U);
  }
}

/// Detections that hardly count go where the next one is.
TEST(ObjectTracker, JustHalfTheGateApartTheyWereOne) {
  ObjectTracker found({.gate_m = 0.5, .partial_weight = 1e-20});
  const std::vector<ObjectDetection> two{at(0.0, 0.0, 1.0, false), at(0.5, 0.0, 1.0)};
  ASSERT_EQ(found.update(two), (std::vector<int>{0, 1}));
  EXPECT_EQ(found.update(std::vector{at(0.25, 0.0, 1.0)}), std::vector<int>{0});
  ASSERT_EQ(found.objects().size(), 1U);
  EXPECT_EQ(found.objects()[0].detections, 3);
}

}  // namespace
}  // namespace vantage
