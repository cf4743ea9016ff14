// Faults of one robot that meet, each at its seam.
#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <set>

#include "tests/control/flight_kit.hpp"
#include "vantage/sim/faults/robot_faults.hpp"

namespace vantage {
namespace {

using testing::ElementsAre;

CameraImages plain_image(int width_px, int height_px) {
  CameraImages images;
  images.width_px = width_px;
  images.height_px = height_px;
  images.range_max_m = 3.5;
  images.depth_m.assign(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px),
                        2.0F);
  return images;
}

bool all_nan(const std::vector<float>& values) {
  return std::ranges::all_of(values, [](float value) { return std::isnan(value); });
}

TEST(FaultSeams, BlocksEndWhereTheImageEnds) {
  RobotFaults faults({.nan_depth = 1.0}, 1);
  const CameraImages got = *faults.arriving(plain_image(21, 13), 0.0);
  ASSERT_EQ(got.depth_m.size(), 273U);
  EXPECT_TRUE(all_nan(got.depth_m));
  EXPECT_EQ(faults.record().struck(Fault::nan_depth), 273);
}

TEST(FaultSeams, WhatIsSaturatedMayStillBeLost) {
  RobotFaults faults({.nan_depth = 1.0, .saturated_depth = 1.0}, 1);
  EXPECT_TRUE(all_nan(faults.arriving(plain_image(5, 3), 0.0)->depth_m));
  EXPECT_EQ(faults.record().struck(Fault::saturated_depth), 15);
  EXPECT_EQ(faults.record().struck(Fault::nan_depth), 15);
  std::vector<float> line{2.0F, 3.0F};
  faults.spoil_line(line, 10.0, 0.0);
  EXPECT_TRUE(all_nan(line));
  EXPECT_EQ(faults.record().struck(Fault::saturated_depth), 17);
  EXPECT_EQ(faults.record().struck(Fault::nan_depth), 17);
}

TEST(FaultSeams, ABiasDoesNotMoveWhatIsSaturated) {
  RobotFaults both({.saturated_depth = 1.0, .laser_bias_m = 0.25}, 1);
  std::vector<float> line{2.0F, 3.0F};
  both.spoil_line(line, 10.0, 0.0);
  EXPECT_THAT(line, ElementsAre(10.0F, 10.0F));
  EXPECT_EQ(both.record().struck(Fault::laser_bias), 1);

  RobotFaults nearer({.laser_bias_m = -0.25}, 1);
  line = {2.0F, 3.0F};
  nearer.spoil_line(line, 10.0, 0.0);
  nearer.spoil_line(line, 10.0, 0.1);
  EXPECT_THAT(line, ElementsAre(1.5F, 2.5F));
  EXPECT_EQ(nearer.record().struck(Fault::laser_bias), 2);
}

TEST(FaultSeams, LasersAreSpoiltBeamByBeam) {
  constexpr int kBeams = 4000;
  RobotFaults faults({.saturated_depth = 0.25}, 1);
  std::vector<float> line(kBeams, 2.0F);
  faults.spoil_line(line, 10.0, 0.0);
  const auto spoilt = std::ranges::count(line, 10.0F);
  EXPECT_EQ(std::ranges::count(line, 2.0F), kBeams - spoilt);
  EXPECT_NEAR(static_cast<double>(spoilt), 0.25 * kBeams, 110.0);
  EXPECT_EQ(faults.record().struck(Fault::saturated_depth), spoilt);
}

TEST(FaultSeams, AFrozenLineIsTheOneBeforeAsItArrived) {
  RobotFaults faults({.frozen_frames = 1.0, .nan_depth = 0.5}, 1);
  std::vector<float> first(61, 2.0F);
  faults.spoil_line(first, 10.0, 0.0);
  const auto lost = faults.record().struck(Fault::nan_depth);
  EXPECT_GT(lost, 0);
  EXPECT_LT(lost, 61);
  for (int i = 1; i < 3; ++i) {
    std::vector<float> next(61, 3.0F);
    faults.spoil_line(next, 10.0, 0.1 * i);
    EXPECT_TRUE(std::ranges::equal(first, next, [](float a, float b) {
      return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
    }));
    EXPECT_EQ(faults.record().struck(Fault::frozen_frames), i);
  }
  EXPECT_EQ(faults.record().struck(Fault::nan_depth), lost);
}

TEST(FaultSeams, WhatIsDroppedIsNotFrozen) {
  RobotFaults faults({.dropped_frames = 1.0, .frozen_frames = 1.0}, 1);
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(faults.arriving(plain_image(2, 1), 0.1 * i));
  EXPECT_EQ(faults.record().struck(Fault::dropped_frames), 3);
  EXPECT_EQ(faults.record().struck(Fault::frozen_frames), 0);
}

TEST(FaultSeams, ScansOfThePlanarScannerAllArrive) {
  RobotFaults faults({.dropped_frames = 1.0, .frozen_frames = 1.0}, 1);
  PlanarScan scan;
  scan.range_max_m = 10.0;
  for (const float range : {1.0F, 2.0F}) {
    scan.range_m = {range};
    faults.spoil_planar(scan, 0.0);
    EXPECT_THAT(scan.range_m, ElementsAre(range));
  }
  EXPECT_EQ(faults.record().csv(), "time_s,fault\n");
}

TEST(FaultSeams, EveryPartOfAnIncrementIsOutOfScale) {
  RobotFaults faults({.odometry_scale = -0.25}, 1);
  for (int i = 1; i < 3; ++i) {
    const Pose2 reported = faults.reported({0.4, 0.8, -1.2}, 0.1 * i);
    EXPECT_DOUBLE_EQ(reported.x_m, 0.3);
    EXPECT_DOUBLE_EQ(reported.y_m, 0.6);
    EXPECT_DOUBLE_EQ(reported.yaw_rad, -0.9);
    EXPECT_EQ(faults.record().struck(Fault::odometry_scale), i);
  }
}

TEST(FaultSeams, SlipReportsNothingAndCountsOnce) {
  RobotFaults faults({.odometry_scale = 0.5, .odometry_slip = 1.0}, 1);
  for (int i = 0; i < 3; ++i) {
    const Pose2 reported = faults.reported({0.4, 0.8, -1.2}, 0.1 * i);
    EXPECT_EQ(reported.x_m, 0.0);
    EXPECT_EQ(reported.y_m, 0.0);
    EXPECT_EQ(reported.yaw_rad, 0.0);
  }
  EXPECT_EQ(faults.record().struck(Fault::odometry_slip), 1);
  EXPECT_EQ(faults.record().struck(Fault::odometry_scale), 0);
}

TEST(FaultSeams, DarknessHasItsShareOfTheStretches) {
  RobotFaults faults({.lights_out = 0.4, .stretch_s = 0.5}, 2);
  int dark = 0;
  for (int stretch = 0; stretch < 1000; ++stretch) {
    const bool first = faults.in_the_dark(0.5 * stretch + 0.0625);
    EXPECT_EQ(faults.in_the_dark(0.5 * stretch + 0.4375), first) << stretch;
    dark += first ? 1 : 0;
  }
  EXPECT_NEAR(dark, 400, 62);
  EXPECT_EQ(faults.record().struck(Fault::lights_out), 2 * dark);
}

TEST(FaultSeams, AnyRotorMayBeTheWeakOne) {
  std::set<int> weak;
  for (const std::uint64_t seed : {1U, 2U, 5U, 8U}) {
    test::FlightWorld scene;
    RobotFaults faults({.weak_rotor = 0.25}, seed);
    faults.attach(scene.world, scene.vehicle.rotor_actuators());
    scene.world.on_tick = [&](World& world) {
      for (const int rotor : scene.vehicle.rotor_actuators()) {
        if (world.controls()[static_cast<std::size_t>(rotor)] == 1.5) weak.insert(rotor);
      }
    };
    scene.vehicle.command_thrusts(scene.world, Eigen::Vector4d::Constant(2.0));
    scene.world.advance_tick();
    EXPECT_EQ(faults.record().struck(Fault::weak_rotor), 1);
  }
  EXPECT_EQ(weak.size(), 4U);
}

TEST(FaultSeams, LateCommandsAloneAreNothingElse) {
  test::FlightWorld scene;
  RobotFaults faults({.late_commands_ticks = 1}, 1);
  faults.attach(scene.world, scene.vehicle.rotor_actuators());
  std::vector<double> state = scene.world.state();
  state[0] = 6.0;
  scene.world.set_state(state);
  scene.world.advance_tick();
  EXPECT_EQ(faults.record().csv(), "time_s,fault\n6.000,late_commands\n");
}

TEST(FaultSeams, SwitchedOffTheyListenToNothing) {
  test::FlightWorld scene;
  RobotFaults faults({}, 1);
  faults.attach(scene.world, scene.vehicle.rotor_actuators());
  EXPECT_FALSE(scene.world.on_command);
  EXPECT_FALSE(scene.world.on_clock);
}

}  // namespace
}  // namespace vantage
