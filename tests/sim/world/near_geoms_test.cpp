// Leaving out what is far changes no bit: bodies of every shape fall and roll about in a room,
// beside the same model stepped by MuJoCo alone.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/sim/test_world.hpp"
#include "vantage/sim/world/near_pairs.hpp"

namespace vantage {
namespace {

const std::string kRoom =
    "<mujoco><asset><mesh name='wedge' vertex='0 0 0  .3 0 0  0 .3 0  0 0 .3  .3 .3 .1'/></asset>"
    "<worldbody><geom name='floor' type='plane' size='9 9 .1'/>"
    "<geom type='box' size='.05 4 1' pos='1.4 0 1'/><geom type='box' size='4 .05 1' pos='0 1.4 1'/>"
    "<geom type='box' size='.05 4 1' pos='-1.4 0 1' euler='0 5 0'/>"
    "<geom type='box' size='4 .05 1' pos='0 -1.4 1'/>"
    "<body pos='.4 .3 0'><geom type='cylinder' size='.1 .5'/></body>"
    "<body pos='-.5 -.4 .2' euler='40 0 70'><geom type='capsule' size='.08 .6'/></body>"
    "<body pos='-.4 .6 .1'><geom type='mesh' mesh='wedge'/></body>"
    "<body pos='.6 -.6 .1' euler='20 10 0'><geom type='ellipsoid' size='.4 .2 .1'/></body>"
    "<body pos='6 6 0'><geom type='cylinder' size='.3 2'/><geom type='box' size='.1 .1 3'/></body>";

std::string falling(const std::string& name, const std::string& geom, double x_m, double z_m) {
  return fmt::format(
      "<body name='{}' pos='{} {} {}' euler='30 {} 10'><freejoint name='{}'/><geom {} mass='1'/>"
      "</body>",
      name, x_m, 0.3 - x_m, z_m, 90.0 * x_m, name, geom);
}

std::string room_with_falling_bodies() {
  const std::vector<std::string> geoms{
      "type='box' size='.1 .2 .05'",       "type='sphere' size='.12'",
      "type='capsule' size='.06 .2'",      "type='cylinder' size='.1 .15'",
      "type='ellipsoid' size='.2 .1 .07'", "type='mesh' mesh='wedge'"};
  std::string text = kRoom;
  for (int i = 0; i < 12; ++i) {
    text += falling("body_" + std::to_string(i), geoms[static_cast<std::size_t>(i) % geoms.size()],
                    -0.9 + 0.15 * i, 0.5 + 0.2 * i);
  }
  return text + "</worldbody></mujoco>";
}

/// One step of MuJoCo as it comes.
void step_alone(const mjModel& model, mjData& data) {
  mjcb_contactfilter = nullptr;
  mj_step(&model, &data);
  mjcb_contactfilter = discard_far_pair;
}

TEST(NearGeoms, ContactsAreThoseOfMuJoCoAlone) {
  const test::SceneFolder folder(room_with_falling_bodies());
  World world(folder.alone());
  const DataPtr alone = world.copy_data();
  int most_contacts = 0;
  for (int tick = 0; tick < 120; ++tick) {
    world.advance_tick();
    for (int i = 0; i < world.options().steps_per_tick(); ++i) step_alone(world.model(), *alone);
    ASSERT_EQ(world.data().ncon, alone->ncon) << "tick " << tick;
    for (int i = 0; i < world.model().nq; ++i) {
      ASSERT_EQ(world.data().qpos[i], alone->qpos[i]) << "tick " << tick;
    }
    most_contacts = std::max(most_contacts, alone->ncon);
  }
  EXPECT_GT(most_contacts, 25);
}

TEST(NearGeoms, WhatIsFarIsLeftOutUntilSomethingComesNear) {
  const test::SceneFolder folder(
      "<mujoco><worldbody><geom type='plane' size='9 9 .1'/>"
      "<geom type='box' size='.1 1 .5' pos='3 0 .5'/><geom type='box' size='.1 1 .5' pos='-3 0 "
      ".5'/>"
      "<body pos='0 0 .2'><freejoint name='ball'/><geom size='.2'/></body></worldbody></mujoco>");
  World world(folder.alone());
  const ModelPtr copy(mj_copyModel(nullptr, &world.model()));
  mjModel& stepping = *copy;
  NearGeoms near(world.model());
  near.start(stepping, world.snapshot());
  EXPECT_EQ(stepping.geom_contype[1], 0);
  EXPECT_EQ(stepping.geom_contype[2], 0);
  EXPECT_EQ(stepping.geom_contype[3], 1) << "the ball lies on the floor";
  EXPECT_EQ(stepping.geom_contype[0], 1);
  world.set_initial_pose("ball", Pose(Eigen::Translation3d(2.6, 0.0, 0.2)));
  near.follow(stepping, world.snapshot());
  EXPECT_TRUE(near.is_near(1));
  EXPECT_EQ(stepping.geom_contype[1], 1);
  EXPECT_EQ(stepping.geom_contype[2], 0);
  world.set_initial_pose("ball", Pose(Eigen::Translation3d(0.0, 0.0, 0.9)));
  near.follow(stepping, world.snapshot());
  EXPECT_EQ(stepping.geom_contype[3], 0) << "nothing is near in the air";
  EXPECT_EQ(stepping.geom_contype[0], 0);
}

TEST(NearGeoms, WhatMovesWithoutAJointIsAlwaysNear) {
  const test::SceneFolder folder(
      "<mujoco><option gravity='0 0 0'/><worldbody>"
      "<body name='hand' mocap='true' pos='0 0 5'><geom type='box' size='.3 .3 .1'/></body>"
      "<body pos='0 0 1'><freejoint name='ball'/><geom size='.2'/></body></worldbody></mujoco>");
  World world(folder.alone());
  world.advance_tick();
  world.data().mocap_pos[2] = 1.25;
  world.advance_tick();
  EXPECT_GT(world.data().ncon, 0);
}

TEST(NearGeoms, AJumpIsNoticed) {
  const test::SceneFolder folder(
      "<mujoco><worldbody><geom type='box' size='1 1 .5' pos='30 0 .5'/>"
      "<body pos='0 0 2'><freejoint name='ball'/><geom size='.2'/></body></worldbody></mujoco>");
  World world(folder.alone());
  world.advance_tick();
  std::vector<double> state = world.state();
  state[1] = 30.0;  // x, above the box
  world.set_state(state);
  while (world.time_s() < 2.0) world.advance_tick();
  EXPECT_NEAR(world.data().qpos[2], 1.2, 0.02);

  state[3] = 1.19;  // in contact at once
  world.set_state(state);
  int contacts = -1;
  world.on_step = [&](const World& stepped) {
    if (contacts < 0) contacts = stepped.data().ncon;
  };
  world.advance_tick();
  EXPECT_GT(contacts, 0) << "in the first step";
}

}  // namespace
}  // namespace vantage
