// What each fault of a robot comes to, against what its amount says.
#include "vantage/sim/faults/robot_faults.hpp"

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include <bit>
#include <cmath>

#include "tests/control/flight_kit.hpp"
#include "tests/sim/test_world.hpp"
#include "vantage/sim/faults/outside_faults.hpp"
#include "vantage/sim/robots/odometry.hpp"
#include "vantage/sim/sensors/ray_scene.hpp"

namespace vantage {
namespace {

using test::message_of;
using testing::Each;
using testing::Eq;
using testing::HasSubstr;

/// Each pixel's depth is its number, and tells the image by its front part.
CameraImages image(int number, int width_px = 64, int height_px = 48) {
  CameraImages images;
  images.width_px = width_px;
  images.height_px = height_px;
  images.range_max_m = 3.5;
  const auto pixels = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  images.depth_m.assign(pixels, 1.0F + 1e-3F * static_cast<float>(number));
  return images;
}

/// NaN equals NaN.
bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return std::ranges::equal(a, b, [](float x, float y) {
    return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
  });
}

TEST(RobotFaults, NoFaultChangesNothing) {
  RobotFaults faults({}, 1);
  std::vector<float> line{1.0F, 2.0F, 3.0F};
  faults.spoil_line(line, 10.0, 0.0);
  EXPECT_THAT(line, testing::ElementsAre(1.0F, 2.0F, 3.0F));
  EXPECT_TRUE(same_bits(faults.arriving(image(1), 0.0)->depth_m, image(1).depth_m));
  const Pose2 increment{0.01, 0.02, 0.003};
  const Pose2 reported = faults.reported(increment, 0.0);
  EXPECT_EQ(reported.x_m, increment.x_m);
  EXPECT_EQ(reported.yaw_rad, increment.yaw_rad);
  EXPECT_FALSE(faults.in_the_dark(0.0));
  EXPECT_EQ(faults.record().csv(), "time_s,fault\n");
}

TEST(RobotFaults, DropsThatShareOfFrames) {
  constexpr int kImages = 4000;
  constexpr double kShare = 0.3;
  RobotFaults faults({.dropped_frames = kShare}, 1);
  int arrived = 0;
  for (int i = 0; i < kImages; ++i) arrived += faults.arriving(image(i, 1, 1), 0.1 * i) ? 1 : 0;
  const double sigma = std::sqrt(kImages * kShare * (1.0 - kShare));
  EXPECT_NEAR(arrived, kImages * (1.0 - kShare), 4.0 * sigma);
  EXPECT_EQ(faults.record().struck(Fault::dropped_frames), kImages - arrived);
}

TEST(RobotFaults, AFrozenFrameIsTheOneThatArrivedBefore) {
  constexpr int kImages = 1000;
  RobotFaults faults({.frozen_frames = 0.4}, 1);
  float last = 0.0F;
  int frozen = 0;
  for (int i = 0; i < kImages; ++i) {
    const float got = faults.arriving(image(i, 1, 1), 0.1 * i)->depth_m.front();
    const float own = image(i, 1, 1).depth_m.front();
    if (got != own) {
      EXPECT_EQ(got, last);
      ++frozen;
    }
    last = got;
  }
  EXPECT_NEAR(frozen, 0.4 * kImages, 65.0);
  EXPECT_EQ(faults.record().struck(Fault::frozen_frames), frozen);
}

TEST(RobotFaults, SpoilsDepthInBlocks) {
  RobotFaults faults({.nan_depth = 0.25}, 1);
  std::int64_t spoilt = 0;
  for (int i = 0; i < 50; ++i) {
    const CameraImages got = *faults.arriving(image(i), 0.1 * i);
    for (int row = 0; row < got.height_px; ++row) {
      for (int column = 0; column < got.width_px; ++column) {
        const bool is_nan = std::isnan(got.depth_at(row, column));
        EXPECT_EQ(is_nan, std::isnan(got.depth_at(row / 8 * 8, column / 8 * 8)));
        if (!is_nan) {
          EXPECT_EQ(got.depth_at(row, column), image(i).depth_m.front());
        }
        spoilt += is_nan ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(faults.record().struck(Fault::nan_depth), spoilt);
  EXPECT_NEAR(static_cast<double>(spoilt) / (50 * 64 * 48), 0.25, 0.04);
}

TEST(RobotFaults, SaturatedReadingsSayTheGreatestRange) {
  RobotFaults all({.saturated_depth = 1.0}, 1);
  EXPECT_THAT(all.arriving(image(1), 0.0)->depth_m, Each(Eq(3.5F)));
  std::vector<float> line(61, 2.0F);
  all.spoil_line(line, 10.0, 0.0);
  EXPECT_THAT(line, Each(Eq(10.0F)));
}

TEST(RobotFaults, ALostLineIsUnknownAndAFrozenOneIsTheOneBefore) {
  std::vector<float> line(61, 2.0F);
  RobotFaults dropping({.dropped_frames = 1.0}, 1);
  dropping.spoil_line(line, 10.0, 0.0);
  EXPECT_TRUE(std::ranges::all_of(line, [](float range) { return std::isnan(range); }));
  RobotFaults freezing({.frozen_frames = 1.0}, 1);
  line.assign(61, 2.0F);
  freezing.spoil_line(line, 10.0, 0.0);
  EXPECT_THAT(line, Each(Eq(2.0F))) << "there is none before the first";
  line.assign(61, 3.0F);
  freezing.spoil_line(line, 10.0, 0.1);
  EXPECT_THAT(line, Each(Eq(2.0F)));
}

TEST(RobotFaults, ABiasIsThatBiasOfBothLasers) {
  RobotFaults faults({.laser_bias_m = 0.125}, 1);
  std::vector<float> line{2.0F, 3.5F, std::numeric_limits<float>::infinity()};
  faults.spoil_line(line, 10.0, 0.0);
  EXPECT_EQ(line[0], 2.125F);
  EXPECT_EQ(line[1], 3.625F);
  EXPECT_TRUE(std::isinf(line[2]));
  PlanarScan scan;
  scan.range_m = {1.0F};
  scan.range_max_m = 10.0;
  faults.spoil_planar(scan, 0.0);
  EXPECT_EQ(scan.range_m[0], 1.125F);
}

TEST(RobotFaults, OdometryIsOutOfScale) {
  RobotFaults faults({.odometry_scale = 0.1}, 1);
  Odometry odometry(OdometryOptions::perfect(), Rng(1), {});
  odometry.on_increment = [&](const Pose2& increment) { return faults.reported(increment, 0.0); };
  for (int i = 1; i <= 100; ++i) odometry.update({0.01 * i, 0.0, 0.0});
  EXPECT_NEAR(odometry.estimate().x_m, 1.1, 1e-9);
  odometry.update({1.0, 0.0, 0.5});
  EXPECT_NEAR(odometry.estimate().yaw_rad, 0.55, 1e-9);
}

TEST(RobotFaults, SlipLosesTheWayOfItsStretches) {
  constexpr double kTick_s = 0.025;
  RobotFaults faults({.odometry_slip = 0.4, .stretch_s = 0.5}, 1);
  double reported_m = 0.0;
  for (int i = 0; i < 40000; ++i) {
    const double time_s = kTick_s * i;
    const double step_m = faults.reported({0.01, 0.0, 0.0}, time_s).x_m;
    EXPECT_TRUE(step_m == 0.0 || step_m == 0.01);
    // A stretch is whole: its first tick says what its others do.
    const double first_s = 0.5 * std::floor((time_s + 1e-9) / 0.5);
    RobotFaults same({.odometry_slip = 0.4, .stretch_s = 0.5}, 1);
    if (i % 97 == 0) {
      EXPECT_EQ(same.reported({0.01, 0.0, 0.0}, first_s).x_m, step_m);
    }
    reported_m += step_m;
  }
  EXPECT_NEAR(reported_m / (40000 * 0.01), 0.6, 0.05);
}

TEST(RobotFaults, TheSameSeedTheSameBits) {
  const FaultOptions options{
      .dropped_frames = 0.2, .frozen_frames = 0.2, .nan_depth = 0.2, .saturated_depth = 0.2};
  RobotFaults first(options, 7);
  RobotFaults second(options, 7);
  RobotFaults other(options, 8);
  int unlike = 0;
  for (int i = 0; i < 100; ++i) {
    const auto a = first.arriving(image(i), i);
    const auto b = second.arriving(image(i), i);
    const auto c = other.arriving(image(i), i);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (a) {
      EXPECT_TRUE(same_bits(a->depth_m, b->depth_m));
    }
    unlike += a.has_value() != c.has_value() || (a && !same_bits(a->depth_m, c->depth_m)) ? 1 : 0;
  }
  EXPECT_GT(unlike, 50);
}

/// One fault more draws nothing from the streams of the others.
TEST(RobotFaults, EachHasAStreamOfItsOwn) {
  RobotFaults alone({.dropped_frames = 0.3}, 7);
  RobotFaults with_more({.dropped_frames = 0.3, .frozen_frames = 0.5, .nan_depth = 0.5}, 7);
  for (int i = 0; i < 200; ++i) {
    EXPECT_EQ(alone.arriving(image(i), i).has_value(), with_more.arriving(image(i), i).has_value());
  }
}

TEST(RobotFaults, CommandsComeLateByThatManyTicks) {
  constexpr int kTicks = 7;
  test::RobotWorld scene;
  const std::vector<double> at_rest(scene.world.controls().begin(), scene.world.controls().end());
  RobotFaults faults({.late_commands_ticks = kTicks}, 1);
  faults.attach(scene.world);
  std::vector<double> applied;
  scene.world.on_tick = [&](World& world) { applied.push_back(world.controls()[0]); };
  for (int i = 0; i < 30; ++i) {
    scene.world.data().ctrl[0] = 0.01 * (i + 1);
    scene.world.advance_tick();
    EXPECT_EQ(scene.world.controls()[0], 0.01 * (i + 1)) << "a command holds until the next one";
  }
  for (int i = 0; i < 30; ++i) {
    EXPECT_EQ(applied[static_cast<std::size_t>(i)],
              i < kTicks ? at_rest[0] : 0.01 * (i - kTicks + 1));
  }
  EXPECT_EQ(faults.record().struck(Fault::late_commands), 30);
}

TEST(RobotFaults, OneRotorIsWeak) {
  test::FlightWorld scene;
  RobotFaults faults({.weak_rotor = 0.3}, 1);
  faults.attach(scene.world, scene.vehicle.rotor_actuators());
  std::vector<double> applied;
  scene.world.on_tick = [&](World& world) {
    applied.assign(world.controls().begin(), world.controls().end());
  };
  scene.vehicle.command_thrusts(scene.world, Eigen::Vector4d(3.0, 3.0, 3.0, 3.0));
  scene.world.advance_tick();
  int weak = 0;
  for (const int rotor : scene.vehicle.rotor_actuators()) {
    const double thrust_N = applied[static_cast<std::size_t>(rotor)];
    weak += thrust_N != 3.0 ? 1 : 0;
    EXPECT_TRUE(thrust_N == 3.0 || std::abs(thrust_N - 2.1) < 1e-12) << thrust_N;
  }
  EXPECT_EQ(weak, 1);
}

TEST(RobotFaults, GustsPushTheVehicleAndAreCounted) {
  test::FlightWorld scene;
  RobotFaults faults({.gust_N = 8.0, .gust_every_s = 1.0}, 1);
  faults.attach(scene.world, scene.vehicle.rotor_actuators());
  const Eigen::Map<const Eigen::Vector3d> force_N(scene.world.data().xfrc_applied +
                                                  6 * scene.vehicle.base_body_id());
  double pushed_s = 0.0;
  for (int i = 0; i < 2000; ++i) {
    scene.tracking.tick(scene.tracking.reference());
    EXPECT_LE(force_N.norm(), 8.0);
    EXPECT_EQ(force_N.z(), 0.0);
    if (force_N.isZero(0.0)) continue;
    EXPECT_GE(force_N.norm(), 4.0 - 1e-9);
    pushed_s += 0.002;
  }
  EXPECT_NEAR(pushed_s, 4 * 0.5, 0.02);
  EXPECT_EQ(faults.record().struck(Fault::gust), 4);
}

TEST(Gusts, AreOneInEveryIntervalAndNoStrongerThanTheyMayBe) {
  const Gusts gusts(1, 8.0, 2.0, 0.5);
  double strongest_N = 0.0;
  double weakest_N = 8.0;
  Eigen::Vector3d sum_N = Eigen::Vector3d::Zero();
  for (int interval = 0; interval < 500; ++interval) {
    int blowing = 0;
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector3d force_N = gusts.force_world_N(2.0 * interval + 0.02 * i);
      if (force_N.isZero(0.0)) continue;
      ++blowing;
      strongest_N = std::max(strongest_N, force_N.norm());
      weakest_N = std::min(weakest_N, force_N.norm());
      sum_N += force_N;
    }
    EXPECT_NEAR(blowing, 25, 1) << interval;
  }
  EXPECT_LE(strongest_N, 8.0 + 1e-12);
  EXPECT_GT(strongest_N, 7.9);
  EXPECT_GE(weakest_N, 4.0 - 1e-12);
  EXPECT_LT(weakest_N, 4.1);
  EXPECT_LT(sum_N.norm() / (500 * 25), 1.0) << "from all sides";
  EXPECT_TRUE(Gusts(1, 0.0, 2.0, 0.5).force_world_N(1.0).isZero(0.0));
}

TEST(RobotFaults, SwitchedOffTheyLeaveTheStateAsItIs) {
  test::FlightWorld with;
  test::FlightWorld without;
  RobotFaults faults({}, 1);
  faults.attach(with.world, with.vehicle.rotor_actuators());
  for (int i = 0; i < 200; ++i) {
    for (test::FlightWorld* scene : {&with, &without}) {
      FlightReference reference = scene->tracking.reference();
      reference.p_world_m.x() += 0.001;
      scene->tracking.tick(reference);
    }
  }
  EXPECT_EQ(with.world.state(), without.world.state());
}

const char* const kThings =
    "<body name='cup' pos='1 0 .1'><geom name='cup' type='box' size='.1 .1 .1'/></body>"
    "<body name='wall' pos='4 0 1'><geom type='box' size='.1 4 1'/></body>"
    "<body name='ball' pos='0 2 1'><freejoint/><geom type='sphere' size='.1'/></body>";

TEST(MovedObject, IsMovedByThatMuchAtThatTimeAndBack) {
  const FaultOptions options{.moved_object_m = 0.25, .moved_object_at_s = 0.1};
  const test::SceneFolder folder(test::scene_mjcf(kThings));
  World world(folder.with_pr2());
  RobotFaults faults(options, 1);
  faults.attach(world);
  RayScene geometry(world.model(), world.snapshot());
  const int cup = model_id(world.model(), ModelObject::body, "cup");
  const auto distance_m = [&] {
    return (body_pose(world, cup).translation() - Eigen::Vector3d(1.0, 0.0, 0.1)).norm();
  };
  const auto start = world.state();
  while (world.time_s() < 0.1 - 1e-9) {
    EXPECT_EQ(distance_m(), 0.0);
    world.advance_tick();
  }
  world.advance_tick();
  EXPECT_NEAR(distance_m(), 0.25, 1e-12);
  EXPECT_NEAR(world.moved_m("cup").norm(), 0.25, 1e-12);
  EXPECT_EQ(world.moved_m("wall").norm(), 0.0);
  EXPECT_EQ(world.moved_m("saucer").norm(), 0.0) << "there is none";
  EXPECT_EQ(body_pose(world, cup).translation().z(), 0.1) << "it stays on what it stands on";
  EXPECT_EQ(faults.record().struck(Fault::moved_object), 1);
  const Eigen::Vector3d top = body_pose(world, cup).translation() + Eigen::Vector3d(0.0, 0.0, 1.0);
  geometry.update(world.snapshot());
  EXPECT_NEAR(geometry.cast(top, -Eigen::Vector3d::UnitZ(), 3.0).distance_m, 0.9, 1e-9)
      << "sensors see it where it is";
  world.set_state(start);
  EXPECT_EQ(distance_m(), 0.0) << "as it was then";
  EXPECT_EQ(world.moved_m("cup").norm(), 0.0);
}

TEST(MovedObject, IsSomethingSmallThatStandsFixed) {
  const test::SceneFolder folder(test::scene_mjcf(kThings));
  const World world(folder.with_pr2());
  for (std::uint64_t seed = 1; seed < 9; ++seed) {
    EXPECT_EQ(model_name(world.model(), ModelObject::body,
                         moved_object(world, {.moved_object_m = 0.1}, seed)->body_id),
              "cup");
  }
  const auto refused = [&](const std::string& name) {
    return message_of<ConfigError>(
        [&] { moved_object(world, {.moved_object_m = 0.1, .moved_object = name}, 1); });
  };
  EXPECT_THAT(refused("ball"), HasSubstr("faults.moved_object: 'ball' hangs on joints"));
  EXPECT_THAT(refused("mug"), HasSubstr("faults.moved_object: the scene has no body 'mug'"));
  EXPECT_THAT(refused("robot/base"), HasSubstr("no body 'robot/base'"));
  EXPECT_EQ(refused("wall"), "");
  const test::SceneFolder empty(test::scene_mjcf(""));
  const World bare(empty.with_pr2());
  EXPECT_THAT(message_of<ConfigError>([&] { moved_object(bare, {.moved_object_m = 0.1}, 1); }),
              HasSubstr("faults.moved_object"));
}

/// Contacts are with what is there now.
TEST(MovedObject, MayBePutInTheRobotsWay) {
  test::RobotWorld scene(
      "<body name='cup' pos='5 0 .15'><geom type='box' size='.1 .1 .1'/></body>");
  scene.run(0.1);
  EXPECT_EQ(scene.robot.contacts(scene.world), 0);
  const int cup = model_id(scene.world.model(), ModelObject::body, "cup");
  scene.world.put_fixed_body(cup, {0.36, 0.0, 0.15});
  scene.run(0.05);
  EXPECT_GT(scene.robot.contacts(scene.world), 0);
}

TEST(FaultOptions, OnlyWhatTheRobotHasCanFail) {
  const auto refused = [](const FaultOptions& options, const FaultyParts& parts) {
    return message_of<ConfigError>([&] { require_possible(options, parts); });
  };
  const FaultyParts base{.laser = true, .wheels = true};
  const FaultyParts flying{.colour = true, .rotors = true};
  EXPECT_THAT(refused({.weak_rotor = 0.3}, base), HasSubstr("faults.weak_rotor: 0.3"));
  EXPECT_THAT(refused({.gust_N = 4.0}, base), HasSubstr("faults.gust_N: 4"));
  EXPECT_THAT(refused({.lights_out = 0.5}, base), HasSubstr("faults.lights_out: 0.5"));
  EXPECT_THAT(refused({.laser_bias_m = 0.1}, flying), HasSubstr("faults.laser_bias_m: 0.1"));
  EXPECT_THAT(refused({.odometry_slip = 0.1}, flying), HasSubstr("faults.odometry_slip: 0.1"));
  EXPECT_THAT(refused({.odometry_scale = 0.1}, flying), HasSubstr("faults.odometry_scale: 0.1"));
  EXPECT_EQ(refused({.dropped_frames = 0.1,
                     .frozen_frames = 0.1,
                     .nan_depth = 0.1,
                     .saturated_depth = 0.1,
                     .late_commands_ticks = 2,
                     .moved_object_m = 0.1},
                    {}),
            "");
  EXPECT_EQ(refused({.weak_rotor = 0.3, .gust_N = 8.0, .lights_out = 0.5}, flying), "");
  EXPECT_FALSE(any_fault({}));
  EXPECT_TRUE(any_fault({.late_commands_ticks = 1}));
}

TEST(FaultOptions, AreChecked) {
  EXPECT_THAT(message_of<ConfigError>([] { RobotFaults({.gust_N = 9.0}, 1); }),
              HasSubstr("faults.gust_N"));
  EXPECT_THAT(message_of<ConfigError>(
                  [] { RobotFaults({.gust_every_s = 0.2, .gust_duration_s = 0.5}, 1); }),
              HasSubstr("gust_duration_s: 0.5 is longer"));
}

TEST(FaultRecord, TellsWhenAFaultBeginsToStrike) {
  FaultRecord record;
  record.strike(Fault::dropped_frames, 0.5);
  record.strike(Fault::dropped_frames, 1.0);
  record.strike(Fault::gust, 1.5);
  record.strike(Fault::dropped_frames, 2.25);
  record.strike(Fault::nan_depth, 2.25, 0);
  EXPECT_EQ(record.csv(), "time_s,fault\n0.500,dropped_frames\n1.500,gust\n2.250,dropped_frames\n");
  EXPECT_EQ(record.struck(Fault::dropped_frames), 3);
  EXPECT_EQ(record.struck(Fault::nan_depth), 0);
}

}  // namespace
}  // namespace vantage
