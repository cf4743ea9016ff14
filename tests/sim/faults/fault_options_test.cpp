// What may go wrong, how much of it, when and where: by numbers.
#include "vantage/sim/faults/fault_options.hpp"

#include <gmock/gmock.h>

#include <set>

#include "tests/sim/test_world.hpp"
#include "tests/support/option_numbers.hpp"
#include "vantage/sim/faults/fault_record.hpp"
#include "vantage/sim/faults/fault_schedule.hpp"
#include "vantage/sim/faults/outside_faults.hpp"
#include "vantage/sim/faults/robot_faults.hpp"

namespace vantage {
namespace {

TEST(FaultOptions, DefaultsAndRanges) {
  constexpr Range kShare = between(0.0, 1.0);
  support::expect_numbers(FaultOptions{}, {{"dropped_frames", 0.0, kShare},
                                           {"frozen_frames", 0.0, kShare},
                                           {"nan_depth", 0.0, kShare},
                                           {"saturated_depth", 0.0, kShare},
                                           {"laser_bias_m", 0.0, between(-0.5, 0.5)},
                                           {"odometry_scale", 0.0, between(-0.5, 0.5)},
                                           {"odometry_slip", 0.0, kShare},
                                           {"late_commands_ticks", 0.0, between(0.0, 1000.0)},
                                           {"weak_rotor", 0.0, between(0.0, 0.9)},
                                           {"gust_N", 0.0, between(0.0, 8.0)},
                                           {"gust_every_s", 3.0, between(0.1, 1000.0)},
                                           {"gust_duration_s", 0.5, between(0.01, 1000.0)},
                                           {"lights_out", 0.0, kShare},
                                           {"stretch_s", 2.0, between(0.01, 1000.0)},
                                           {"moved_object_m", 0.0, kShare},
                                           {"moved_object_at_s", 5.0, at_least(0.0)}});
}

TEST(FaultOptions, AGustMayLastAllOfItsInterval) {
  EXPECT_NO_THROW((FaultOptions{.gust_every_s = 0.5, .gust_duration_s = 0.5}.check()));
  EXPECT_THROW((FaultOptions{.gust_every_s = 0.5, .gust_duration_s = 0.51}.check()), ConfigError);
}

TEST(FaultOptions, EachFaultHasItsNameAndItsAmount) {
  struct Case {
    FaultOptions options;
    double amount;
    std::string_view name;
  };
  const std::vector<Case> cases{{{.dropped_frames = 0.11}, 0.11, "dropped_frames"},
                                {{.frozen_frames = 0.12}, 0.12, "frozen_frames"},
                                {{.nan_depth = 0.13}, 0.13, "nan_depth"},
                                {{.saturated_depth = 0.14}, 0.14, "saturated_depth"},
                                {{.laser_bias_m = -0.15}, -0.15, "laser_bias"},
                                {{.odometry_scale = -0.16}, -0.16, "odometry_scale"},
                                {{.odometry_slip = 0.17}, 0.17, "odometry_slip"},
                                {{.late_commands_ticks = 18}, 18.0, "late_commands"},
                                {{.weak_rotor = 0.19}, 0.19, "weak_rotor"},
                                {{.gust_N = 2.0}, 2.0, "gust"},
                                {{.lights_out = 0.21}, 0.21, "lights_out"},
                                {{.moved_object_m = 0.22}, 0.22, "moved_object"}};
  ASSERT_EQ(cases.size(), kFaults);
  for (std::size_t i = 0; i < kFaults; ++i) {
    EXPECT_EQ(name_of(static_cast<Fault>(i)), cases[i].name);
    EXPECT_TRUE(any_fault(cases[i].options)) << cases[i].name;
    for (std::size_t other = 0; other < kFaults; ++other) {
      EXPECT_EQ(amount_of(cases[i].options, static_cast<Fault>(other)),
                other == i ? cases[i].amount : 0.0)
          << cases[i].name << " " << cases[other].name;
    }
  }
}

TEST(FaultOptions, WhatARobotCannotHaveIsSaid) {
  const auto refused = [](const FaultOptions& options) {
    return test::message_of<ConfigError>([&] { require_possible(options, {}); });
  };
  EXPECT_EQ(refused({.laser_bias_m = -0.1}),
            "faults.laser_bias_m: -0.1 does not befall the robot of this task: it has no laser");
  EXPECT_EQ(refused({.odometry_scale = -0.25}),
            "faults.odometry_scale: -0.25 does not befall the robot of this task: it has no "
            "wheels");
  EXPECT_EQ(refused({.odometry_slip = 0.5}),
            "faults.odometry_slip: 0.5 does not befall the robot of this task: it has no wheels");
  EXPECT_EQ(refused({.weak_rotor = 0.5}),
            "faults.weak_rotor: 0.5 does not befall the robot of this task: it has no rotors");
  EXPECT_EQ(refused({.gust_N = 2.5}),
            "faults.gust_N: 2.5 does not befall the robot of this task: it has wheels on the "
            "floor, which no gust moves");
  EXPECT_EQ(refused({.lights_out = 0.5}),
            "faults.lights_out: 0.5 does not befall the robot of this task: it has no use for "
            "colour");
}

TEST(FaultRecord, APauseOfMoreThanASecondIsAnotherOnset) {
  FaultRecord record;
  record.strike(Fault::gust, 2.0, 3);
  record.strike(Fault::gust, 2.75);
  record.strike(Fault::gust, 3.5, 5);
  record.strike(Fault::gust, 4.5);
  record.strike(Fault::gust, 5.75);
  record.strike(Fault::weak_rotor, 0.25);
  EXPECT_EQ(record.csv(), "time_s,fault\n2.000,gust\n5.750,gust\n0.250,weak_rotor\n");
  EXPECT_EQ(record.struck(Fault::gust), 11);
  EXPECT_EQ(record.struck(Fault::weak_rotor), 1);
}

TEST(Stretches, AreWholeAndDrawnOneByOne) {
  const Stretches stretches(3, "probe", 0.5, 0.5);
  int changes = 0;
  for (int i = 1; i <= 400; ++i) {
    const double start_s = 0.5 * i;
    const bool covered = stretches.cover(start_s + 0.001);
    EXPECT_EQ(stretches.cover(start_s + 0.25), covered) << i;
    EXPECT_EQ(stretches.cover(start_s + 0.499), covered) << i;
    changes += stretches.cover(start_s - 0.25) != covered ? 1 : 0;
  }
  EXPECT_NEAR(changes, 200, 60);
}

TEST(Stretches, HaveEachAStreamOfTheirSeed) {
  const Stretches stretches(5, "probe", 0.4, 3.0);
  std::string drawn;
  for (int i = 0; i < 20; ++i) drawn += stretches.cover(3.0 * i + 1.0) ? '#' : '.';
  EXPECT_EQ(drawn, "..#.##..#..#..##.#..");
}

TEST(Stretches, BeginWhereAClockIsANanosecondShort) {
  const Stretches stretches(3, "probe", 0.5, 0.5);
  for (int i = 1; i <= 60; ++i) {
    const double start_s = 0.5 * i;
    EXPECT_EQ(stretches.cover(start_s - 7e-10), stretches.cover(start_s + 0.1)) << i;
    EXPECT_EQ(stretches.cover(start_s - 1.5e-9), stretches.cover(start_s - 0.1)) << i;
  }
}

TEST(Gusts, BlowFromWhereTheirSeedSays) {
  const Gusts gusts(1, 8.0, 2.0, 0.5);
  EXPECT_TRUE(gusts.force_world_N(0.0).isZero(0.0));
  EXPECT_TRUE(gusts.force_world_N(1.0578).isZero(0.0));
  const Eigen::Vector3d first_N(-5.554864062970131, -4.510635523997183, 0.0);
  EXPECT_LT((gusts.force_world_N(1.0579) - first_N).norm(), 1e-9);
  EXPECT_LT((gusts.force_world_N(1.5578) - first_N).norm(), 1e-9);
  EXPECT_TRUE(gusts.force_world_N(1.5579).isZero(0.0));
  const Eigen::Vector3d fourth_N(3.966561096086438, 0.7752120198881051, 0.0);
  EXPECT_TRUE(gusts.force_world_N(7.0941).isZero(0.0));
  EXPECT_LT((gusts.force_world_N(7.0942) - fourth_N).norm(), 1e-9);
}

std::string ball_with(const std::string& bodies) {
  return "<mujoco><worldbody><geom name='stone' type='sphere' size='.1'/>" + bodies +
         "<body name='ball' pos='5 0 5'><freejoint/><geom type='sphere' size='.1'/></body>"
         "</worldbody></mujoco>";
}

TEST(MovedObject, IsDrawnAmongBodiesThatReachHalfAMetreAtMost) {
  const test::SceneFolder folder(ball_with(
      "<body name='near'><geom type='sphere' size='.15' pos='0 0 .3'/></body>"
      "<body name='far'><geom type='sphere' size='.15' pos='0 -.4 0'/></body>"
      "<body name='couple'><geom type='sphere' size='.1' pos='0 .3 0'/>"
      "<geom type='sphere' size='.15' pos='-.3 0 0'/></body>"
      "<body name='pair'><geom type='sphere' size='.1'/>"
      "<geom type='sphere' size='.15' pos='.4 0 0'/></body>"
      "<body name='ghost' mocap='true'><geom type='sphere' size='.1'/></body>"
      "<body name='stand'><body name='twig'><geom type='sphere' size='.1'/></body></body>"));
  const World world(folder.alone());
  std::set<std::string> drawn;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    drawn.insert(model_name(world.model(), ModelObject::body,
                            moved_object(world, {.moved_object_m = 0.1}, seed)->body_id));
  }
  EXPECT_EQ(drawn, (std::set<std::string>{"near", "couple"}));
}

TEST(MovedObject, GoesThatFarInAnyLevelDirection) {
  const test::SceneFolder folder(
      ball_with("<body name='shelf' pos='1 2 .5'><geom type='box' size='2 .2 .3'/></body>"));
  const World world(folder.alone());
  const Eigen::Vector3d from_m(1.0, 2.0, 0.5);
  std::set<int> quarters;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const auto moved = moved_object(world, {.moved_object_m = 0.25, .moved_object = "shelf"}, seed);
    ASSERT_TRUE(moved);
    EXPECT_EQ(moved->from_m, from_m);
    EXPECT_EQ(moved->to_m.z(), 0.5);
    const Eigen::Vector3d way_m = moved->to_m - moved->from_m;
    EXPECT_NEAR(way_m.norm(), 0.25, 1e-12);
    quarters.insert((way_m.x() > 0.0 ? 1 : 0) + (way_m.y() > 0.0 ? 2 : 0));
  }
  EXPECT_EQ(quarters.size(), 4U);
  EXPECT_FALSE(moved_object(world, {.moved_object = "shelf"}, 1));
}

TEST(MovedObject, IsThereWhereTheClockIsANanosecondShort) {
  const test::SceneFolder folder(
      ball_with("<body name='cup' pos='1 2 .5'><geom type='sphere' size='.1'/></body>"));
  for (const auto& [later_s, is_there] : {std::pair(7e-10, true), std::pair(1.5e-9, false)}) {
    World world(folder.alone());
    RobotFaults faults({.moved_object_m = 0.25, .moved_object_at_s = 3.0 + later_s}, 1);
    faults.attach(world);
    const int cup = model_id(world.model(), ModelObject::body, "cup");
    std::vector<double> state = world.state();
    state[0] = 3.0;
    world.set_state(state);
    const Eigen::Vector3d now_m = body_pose(world, cup).translation();
    EXPECT_NEAR((now_m - Eigen::Vector3d(1.0, 2.0, 0.5)).norm(), is_there ? 0.25 : 0.0, 1e-12);
    world.advance_tick();
    EXPECT_EQ(faults.record().struck(Fault::moved_object), is_there ? 1 : 0);
    for (int i = 0; i < 3; ++i) world.advance_tick();
    EXPECT_EQ(faults.record().struck(Fault::moved_object), 1) << "once";
  }
}

TEST(MovedObject, HasAShapeThatReachesHalfAMetreAtMost) {
  const test::SceneFolder folder(
      ball_with("<body name='edge'><geom type='sphere' size='.25' pos='0 0 .25'/></body>"
                "<body name='sheet'><geom type='plane' size='.2 .2 .1'/></body>"
                "<body name='hook'/>"));
  const World world(folder.alone());
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    EXPECT_EQ(model_name(world.model(), ModelObject::body,
                         moved_object(world, {.moved_object_m = 0.1}, seed)->body_id),
              "edge")
        << seed;
  }
}

}  // namespace
}  // namespace vantage
