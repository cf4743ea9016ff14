// Where a fault begins and where it ends: at its share, its moment, its direction.
#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/control/flight_kit.hpp"
#include "tests/sim/test_world.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/sim/faults/fault_schedule.hpp"
#include "vantage/sim/faults/outside_faults.hpp"
#include "vantage/sim/faults/robot_faults.hpp"

namespace vantage {
namespace {

using testing::ElementsAre;

CameraImages even_image(int width_px, int height_px, float depth_m = 2.0F) {
  CameraImages images;
  images.width_px = width_px;
  images.height_px = height_px;
  images.range_max_m = 3.5;
  images.depth_m.assign(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px),
                        depth_m);
  return images;
}

/// The first number of a stream of random numbers, as a share.
double first_share_of(std::uint64_t seed, const std::string& stream) {
  return Rng::stream(seed, stream).uniform();
}

TEST(FaultShares, WhatIsDrawnAtTheShareItselfIsSpared) {
  EXPECT_FALSE(Stretches(3, "probe", first_share_of(3, "probe 0"), 1.0).cover(0.5));
  RobotFaults dropping({.dropped_frames = first_share_of(1, "fault dropped frames")}, 1);
  EXPECT_TRUE(dropping.arriving(even_image(1, 1), 0.0));
  RobotFaults losing({.nan_depth = first_share_of(1, "fault nan depth")}, 1);
  EXPECT_EQ(losing.arriving(even_image(1, 1), 0.0)->depth_m[0], 2.0F);
  std::vector<float> line{2.0F};
  RobotFaults losing_beams({.nan_depth = first_share_of(1, "fault nan depth")}, 1);
  losing_beams.spoil_line(line, 10.0, 0.0);
  EXPECT_EQ(line[0], 2.0F);
}

TEST(FaultShares, AFrameThatIsDrawnAtTheShareItselfIsNotFrozen) {
  Rng draws = Rng::stream(1, "fault frozen frames");
  draws.uniform();  // of the first frame, before which there is none
  RobotFaults faults({.frozen_frames = draws.uniform()}, 1);
  ASSERT_TRUE(faults.arriving(even_image(1, 1, 1.0F), 0.0));
  EXPECT_EQ(faults.arriving(even_image(1, 1, 3.0F), 0.1)->depth_m[0], 3.0F);
}

/// Block by block in rows, and no number is drawn beside.
TEST(FaultShares, BlocksAreDrawnInTheirOrder) {
  constexpr double kShare = 0.4;
  RobotFaults faults({.nan_depth = kShare}, 1);
  Rng draws = Rng::stream(1, "fault nan depth");
  for (int i = 0; i < 20; ++i) {
    const CameraImages got = *faults.arriving(even_image(16, 24), 0.1 * i);
    for (int top = 0; top < 24; top += 8) {
      for (int left = 0; left < 16; left += 8) {
        EXPECT_EQ(std::isnan(got.depth_at(top, left)), draws.uniform() < kShare) << i;
      }
    }
  }
}

TEST(FaultMoments, FramesAreRecordedWhenTheyWereTaken) {
  RobotFaults dropping({.dropped_frames = 1.0}, 1);
  std::vector<float> line{2.0F};
  dropping.spoil_line(line, 10.0, 2.5);
  EXPECT_EQ(dropping.record().csv(), "time_s,fault\n2.500,dropped_frames\n");
  RobotFaults dropping_images({.dropped_frames = 1.0}, 1);
  EXPECT_FALSE(dropping_images.arriving(even_image(1, 1), 3.25));
  EXPECT_EQ(dropping_images.record().csv(), "time_s,fault\n3.250,dropped_frames\n");
}

TEST(FaultMoments, TheFirstFrameArrivesAsItIsWheneverThatIs) {
  RobotFaults images({.frozen_frames = 1.0}, 1);
  EXPECT_TRUE(images.arriving(even_image(1, 1), 1.5));
  RobotFaults lines({.frozen_frames = 1.0}, 1);
  std::vector<float> line{2.0F};
  lines.spoil_line(line, 10.0, 1.5);
  EXPECT_THAT(line, ElementsAre(2.0F));
}

TEST(FaultMoments, AGustBlowsFromItsFirstMomentToBeforeItsLast) {
  const Gusts gusts(1, 8.0, 2.0, 0.5);
  const double start_s = Rng::stream(1, "fault gust 0").uniform(0.0, 1.5);
  EXPECT_FALSE(gusts.force_world_N(start_s).isZero(0.0));
  EXPECT_TRUE(gusts.force_world_N(start_s + 0.5).isZero(0.0));
}

TEST(FaultMoments, AWeakGustThatBlowsFromTheBeginningIsAGust) {
  test::FlightWorld scene;
  RobotFaults faults({.gust_N = 0.75, .gust_every_s = 0.5, .gust_duration_s = 0.5}, 1);
  faults.attach(scene.world, scene.vehicle.rotor_actuators());
  const mjtNum* force_N = scene.world.data().xfrc_applied + 6 * scene.vehicle.base_body_id();
  scene.world.advance_tick();
  EXPECT_GT(std::hypot(force_N[0], force_N[1]), 0.3);
  EXPECT_EQ(faults.record().csv(), "time_s,fault\n0.000,gust\n");
  scene.world.advance_tick();
  EXPECT_EQ(faults.record().struck(Fault::gust), 1);
}

TEST(FaultMoments, WithoutGustsForcesAreSomebodyElses) {
  test::FlightWorld scene;
  RobotFaults faults({.weak_rotor = 0.25}, 1);
  faults.attach(scene.world, scene.vehicle.rotor_actuators());
  mjtNum* force_N = scene.world.data().xfrc_applied + 6 * scene.vehicle.base_body_id();
  force_N[0] = 1.0;
  scene.world.advance_tick();
  EXPECT_EQ(force_N[0], 1.0);
  EXPECT_EQ(faults.record().csv(), "time_s,fault\n0.000,weak_rotor\n");
}

TEST(FaultMoments, GustsPushNothingButARobot) {
  const test::SceneFolder folder(test::scene_mjcf(
      "<body name='ball' pos='0 0 5'><freejoint/><geom type='sphere' size='.1'/></body>"));
  World world(folder.alone());
  add_outside_faults(world, {.gust_N = 8.0, .gust_every_s = 0.5, .gust_duration_s = 0.5}, 1);
  world.advance_tick();
  const int ball = model_id(world.model(), ModelObject::body, "ball");
  for (int i = 0; i < 6; ++i) EXPECT_EQ(world.data().xfrc_applied[6 * ball + i], 0.0) << i;
}

TEST(MovedObjects, GoWhereTheirSeedSays) {
  const test::SceneFolder folder(
      test::scene_mjcf("<body name='cup' pos='1 2 .5'><geom type='sphere' size='.1'/></body>"));
  const World world(folder.alone());
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const auto moved = moved_object(world, {.moved_object_m = 0.25}, seed);
    ASSERT_TRUE(moved);
    const double heading_rad =
        Rng::stream(seed, "fault moved object").uniform(0.0, 2.0 * std::numbers::pi);
    const Eigen::Vector3d to_m(1.0 + 0.25 * std::cos(heading_rad),
                               2.0 + 0.25 * std::sin(heading_rad), 0.5);
    EXPECT_LT((moved->to_m - to_m).norm(), 1e-12) << seed;
  }
}

TEST(MovedObjects, AreThereAtTheVeryMoment) {
  const test::SceneFolder folder(
      test::scene_mjcf("<body name='cup' pos='1 2 .5'><geom type='sphere' size='.1'/></body>"));
  World world(folder.alone());
  RobotFaults faults({.moved_object_m = 0.25, .moved_object_at_s = 3.0}, 1);
  faults.attach(world);
  std::vector<double> state = world.state();
  state[0] = 3.0 - kSameMoment_s;
  world.set_state(state);
  EXPECT_NEAR(world.moved_m("cup").norm(), 0.25, 1e-12);
  world.advance_tick();
  EXPECT_EQ(faults.record().struck(Fault::moved_object), 1);
}

}  // namespace
}  // namespace vantage
