#include "vantage/sim/world/settle.hpp"

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "tests/sim/test_world.hpp"
#include "vantage/core/error.hpp"
#include "vantage/geometry/pose.hpp"

namespace vantage {
namespace {

using test::message_of;
using test::SceneFolder;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A cube of 10 cm over a table whose top is at 0.72 m.
std::string cube_at(double z_m) {
  return test::scene_mjcf(
      "<geom type='box' size='.5 .5 .02' pos='3 0 .7'/><body name='cube' pos='3.1 .2 " +
      std::to_string(z_m) + "'><freejoint/><geom type='box' size='.05 .05 .05'/></body>");
}

double height_m(const World& world) {
  return body_pose(world, model_id(world.model(), ModelObject::body, "cube")).translation().z();
}

TEST(Settle, ABodyInTheAirComesToRestOnTheTable) {
  const SceneFolder folder(cube_at(0.85));
  World world(folder.with_pr2());
  const std::vector<double> before = world.state();
  EXPECT_THAT(settle_free_bodies(world), ElementsAre("'cube'"));
  EXPECT_NEAR(height_m(world), 0.77, 1e-3);
  EXPECT_EQ(world.ticks(), 0U);
  EXPECT_EQ(world.time_s(), 0.0);
  const std::vector<double> after = world.state();
  std::size_t changed = 0;
  for (std::size_t i = 0; i < after.size(); ++i) changed += before[i] != after[i] ? 1 : 0;
  EXPECT_LE(changed, 7U) << "no other position, no velocity";
  for (int i = 0; i < 80; ++i) world.advance_tick();
  EXPECT_NEAR(height_m(world), 0.77, 1e-3) << "and stays there";
}

TEST(Settle, WhatStandsAlreadyKeepsItsBits) {
  for (const std::string& mjcf : {cube_at(0.77), test::scene_mjcf("")}) {
    const SceneFolder folder(mjcf);
    World world(folder.with_pr2());
    World untouched(folder.with_pr2());
    EXPECT_THAT(settle_free_bodies(world), IsEmpty());
    EXPECT_EQ(world.state(), untouched.state());
    for (int i = 0; i < 4; ++i) {
      world.advance_tick();
      untouched.advance_tick();
    }
    EXPECT_EQ(world.state(), untouched.state());
  }
}

TEST(Settle, WhatNeverRestsIsRefusedByName) {
  const SceneFolder rolls(
      "<mujoco><worldbody><geom type='plane' size='9 9 .1' euler='0 10 0'/>"
      "<body name='cube' pos='0 0 .5'><freejoint/><geom type='box' size='.05 .05 .05'/></body>"
      "<body name='marble' pos='1 0 .2'><freejoint/><geom size='.05'/></body>"
      "</worldbody></mujoco>");
  World world(rolls.alone());
  EXPECT_THAT(message_of<InputError>([&] { settle_free_bodies(world, {.max_s = 3.0}); }),
              AllOf(HasSubstr("body 'marble'"), HasSubstr("within 3 s"), HasSubstr("m/s")));
}

TEST(Settle, ABodyWithoutANameGoesByItsNumber) {
  const SceneFolder folder(test::scene_mjcf(
      "<body pos='0 0 .2'><freejoint/><geom type='box' size='.05 .05 .05'/></body>"));
  World world(folder.alone());
  EXPECT_THAT(settle_free_bodies(world), ElementsAre("number 1"));
}

TEST(Settle, HowFarIsAMotionIsForTheCallerToSay) {
  for (const auto& [moved_m, moves] : {std::pair(0.2, false), std::pair(0.05, true)}) {
    const SceneFolder folder(cube_at(0.85));  // 8 cm over its place
    World world(folder.alone());
    const std::vector<double> before = world.state();
    EXPECT_EQ(settle_free_bodies(world, {.moved_m = moved_m}).size(), moves ? 1U : 0U);
    EXPECT_EQ(world.state() != before, moves);
  }
}

TEST(Settle, GivesABodyTenSecondsAndSaysHowFastItIsThen) {
  const SceneFolder rolls(
      "<mujoco><worldbody><geom type='plane' size='9 9 .1' euler='0 10 0'/>"
      "<body name='marble' pos='1 0 .2'><freejoint/><geom size='.05'/></body>"
      "</worldbody></mujoco>");
  World world(rolls.alone());
  const std::string message = message_of<InputError>([&] { settle_free_bodies(world); });
  EXPECT_THAT(message, HasSubstr("body 'marble' does not come to rest within 10 s"));
  const std::string before = "moves at ";
  ASSERT_NE(message.find(before), std::string::npos) << message;
  const double speed_m_s = std::stod(message.substr(message.find(before) + before.size()));
  EXPECT_GT(speed_m_s, 9.0) << "5/7 of the slope's part of gravity, for 10 s";
  EXPECT_LT(speed_m_s, 20.0);
}

TEST(Settle, LimitsAreThoseThatMapsAreJudgedWith) {
  const SettleLimits limits;
  EXPECT_EQ(limits.max_s, 10.0);
  EXPECT_EQ(limits.window_s, 0.25);
  EXPECT_EQ(limits.at_rest_m, 3e-4);
  EXPECT_EQ(limits.moved_m, 1e-3);
  EXPECT_EQ(limits.arm_m, 0.1);
}

/// What is said of a ball at the origin, without gravity, that moves at 1 m/s or rad/s that way.
std::string said_of_motion(int dof, const SettleLimits& limits) {
  const SceneFolder folder(
      "<mujoco><option gravity='0 0 0'/><worldbody><body name='ball'><freejoint/>"
      "<geom size='.1'/></body></worldbody></mujoco>");
  World world(folder.alone());
  world.data().qvel[dof] = 1.0;
  return message_of<InputError>([&] { settle_free_bodies(world, limits); });
}

TEST(Settle, EveryWayOfMovingAndTurningIsAMotion) {
  for (int dof = 0; dof < 6; ++dof) {
    EXPECT_THAT(said_of_motion(dof, {.max_s = 0.5}), HasSubstr("body 'ball'")) << dof;
  }
}

TEST(Settle, AWindowMayBeAsLongAsAStep) {
  EXPECT_THAT(said_of_motion(0, {.max_s = 0.01, .window_s = 0.0025}),
              HasSubstr("still moves at 1 m/s"));
}

/// It is back where it was after a quarter of a second, which alone is no rest.
TEST(Settle, WhatIsThrownUpIsNotAtRestAtTheTop) {
  const SceneFolder folder(
      "<mujoco><worldbody><body name='ball'><freejoint/><geom size='.1'/></body></worldbody>"
      "</mujoco>");
  World world(folder.alone());
  world.data().qvel[2] = 9.81 * 0.0025 * 101.0 / 2.0;
  EXPECT_THAT(message_of<InputError>([&] { settle_free_bodies(world, {.max_s = 1.0}); }),
              HasSubstr("body 'ball'"));
}

TEST(Settle, TwoQuietWindowsAreRestWhateverComesThen) {
  const SceneFolder folder(
      "<mujoco><option gravity='0 0 0'/><worldbody>"
      "<body pos='-.8 0 0'><joint type='slide' axis='1 0 0'/><geom size='.1'/></body>"
      "<body name='ball'><freejoint/><geom size='.1'/></body></worldbody></mujoco>");
  World world(folder.alone());
  world.data().qvel[0] = 1.0;  // which meets the ball after 0.6 s
  EXPECT_THAT(settle_free_bodies(world), IsEmpty());
}

TEST(Settle, OnlyFreeBodiesOfTheSceneHaveToRest) {
  const SceneFolder folder(test::scene_mjcf(
      "<body pos='5 0 3'><joint axis='0 1 0'/><geom size='.1' pos='.5 0 0'/></body>"
      "<body name='robot/base' pos='0 5 50'><freejoint/><geom size='.1'/></body>"
      "<body name='cube' pos='0 0 .05'><freejoint/><geom type='box' size='.05 .05 .05'/></body>"));
  World world(folder.alone());
  EXPECT_THAT(settle_free_bodies(world), IsEmpty());
}

TEST(Settle, WhatRestsKeepsItsPlaceBesideWhatFalls) {
  const std::string shape = "<freejoint/><geom type='box' size='.05 .05 .05'/></body>";
  const SceneFolder folder(test::scene_mjcf("<body name='first' pos='0 0 .05'>" + shape +
                                            "<body name='falls' pos='1 0 .2'>" + shape +
                                            "<body name='last' pos='2 0 .05'>" + shape));
  World world(folder.alone());
  world.data().qvel[12] = 1e-3;  // hardly slides
  const std::vector<double> before(world.data().qpos, world.data().qpos + 21);
  EXPECT_THAT(settle_free_bodies(world), ElementsAre("'falls'"));
  for (std::size_t i = 0; i < 21; ++i) {
    if (i < 7 || i >= 14) {
      EXPECT_EQ(world.data().qpos[i], before[i]) << i;
    }
  }
  EXPECT_NEAR(world.data().qpos[9], 0.05, 1e-3);
}

TEST(Settle, WhatTurnsStartsAsItCameToRest) {
  const SceneFolder folder(test::scene_mjcf(
      "<body name='cube' pos='0 0 .05'><freejoint/><geom type='box' size='.05 .05 .05'/></body>"));
  World world(folder.alone());
  world.data().qvel[5] = 6.0;
  EXPECT_THAT(settle_free_bodies(world), ElementsAre("'cube'"));
  EXPECT_GT(project_to_se2(body_pose(world, 1)).yaw_rad, 0.02);
}

}  // namespace
}  // namespace vantage
