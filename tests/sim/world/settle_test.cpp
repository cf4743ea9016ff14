#include "vantage/sim/world/settle.hpp"

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "tests/sim/test_world.hpp"
#include "vantage/core/error.hpp"

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

}  // namespace
}  // namespace vantage
