// The true clearance against distances worked out by hand.
#include "vantage/tasks/trajectory/true_clearance.hpp"

#include <gtest/gtest.h>

#include "tests/control/flight_kit.hpp"

namespace vantage {
namespace {

using test::FlightWorld;

constexpr double kSkid_m = 0.116;   // below the body's origin
constexpr double kRotor_m = 0.222;  // beside it, the tip of the swept disc

double min_m(const FlightWorld& scene) {
  TrueClearance clearance(scene.world);
  clearance.update(scene.world);
  return clearance.min_m();
}

TEST(TrueClearance, OfTheFloorIsFromTheSkids) {
  const FlightWorld scene(test::exact_tracking(), test::at_height(1.0));
  EXPECT_NEAR(min_m(scene), 1.0 - kSkid_m, 2e-3);
}

TEST(TrueClearance, OfAWallIsFromTheRotorTips) {
  const FlightWorld scene(test::exact_tracking(), test::at_height(3.0),
                          R"(<geom type="box" pos="0 0.7 3" size="1 0.1 1"/>)");
  EXPECT_NEAR(min_m(scene), 0.6 - kRotor_m, 2e-3);
}

TEST(TrueClearance, WhatCannotBeTouchedIsNotInTheWay) {
  const FlightWorld scene(
      test::exact_tracking(), test::at_height(3.0),
      R"(<geom type="box" pos="0 0.7 3" size="1 0.1 1" contype="0" conaffinity="0"/>)");
  EXPECT_NEAR(min_m(scene), 3.0 - kSkid_m, 2e-3);
}

TEST(TrueClearance, IsTheLeastOfAllMoments) {
  FlightWorld scene(test::exact_tracking(), test::at_height(1.0));
  TrueClearance clearance(scene.world);
  clearance.update(scene.world);
  scene.tracking.fly_to(std::vector<FlightWaypoint>{{.p_world_m = {0.0, 0.0, 0.6}}});
  clearance.update(scene.world);
  scene.tracking.fly_to(std::vector<FlightWaypoint>{{.p_world_m = {0.0, 0.0, 1.2}}});
  clearance.update(scene.world);
  EXPECT_NEAR(clearance.min_m(), 0.6 - kSkid_m, 0.01);
}

TEST(TrueClearance, IsThreeMetresAtMost) {
  EXPECT_EQ(min_m(FlightWorld(test::exact_tracking(), test::at_height(5.0))), 3.0);
}

TEST(TrueClearance, OfAPlaneIsFromWhereverItIs) {
  const FlightWorld raised(test::exact_tracking(), test::at_height(1.0),
                           R"(<geom type="plane" pos="0 0 0.4" size="1 1 0.1"/>)");
  EXPECT_NEAR(min_m(raised), 0.6 - kSkid_m, 2e-3);
  const FlightWorld upright(test::exact_tracking(), test::at_height(3.0),
                            R"(<geom type="plane" pos="0 0.7 3" zaxis="0 -1 0" size="1 1 0.1"/>)");
  EXPECT_NEAR(min_m(upright), 0.7 - kRotor_m, 2e-3);
}

TEST(TrueClearance, IsNothingOfWhatIsBelowTheFloorOrHasTouched) {
  EXPECT_EQ(min_m(FlightWorld(test::exact_tracking(), test::at_height(0.05))), 0.0);
  const FlightWorld scene(test::exact_tracking(), test::at_height(1.0));
  TrueClearance clearance(scene.world);
  clearance.touched();
  clearance.update(scene.world);
  EXPECT_EQ(clearance.min_m(), 0.0);
}

TEST(TrueClearance, OfNoRobotStaysAtThreeMetres) {
  const test::SceneFolder folder(test::scene_mjcf(""));
  const World world(folder.alone());
  TrueClearance clearance(world);
  clearance.update(world);
  EXPECT_EQ(clearance.min_m(), 3.0);
}

}  // namespace
}  // namespace vantage
