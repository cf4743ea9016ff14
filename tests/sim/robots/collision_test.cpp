#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "tests/sim/test_world.hpp"
#include "vantage/sim/robots/mobile_base.hpp"

namespace vantage {
namespace {

using test::RobotWorld;

const std::string kWall = "<geom name='wall' type='box' size='0.1 3 1' pos='2.1 0 1'/>";

TEST(CollisionCounter, CountsOnsets) {
  RobotWorld scene(kWall, {1.5, 0.0, 0.0});
  CollisionCounter counter;
  scene.world.on_step = [&](const World& world) { counter.update(scene.robot, world); };
  const auto drive = [&](double vx_m_s, int ticks) {
    for (int tick = 0; tick < ticks; ++tick) {
      scene.robot.command_twist(scene.world, {vx_m_s, 0.0, 0.0});
      scene.world.advance_tick();
    }
  };
  drive(0.3, 20);
  EXPECT_EQ(counter.count(), 0);
  drive(0.3, 80);
  EXPECT_EQ(counter.count(), 1) << "one long push";
  drive(-0.3, 40);
  EXPECT_EQ(counter.count(), 1);
  drive(0.3, 80);
  EXPECT_EQ(counter.count(), 2);
}

TEST(CollisionCounter, NoticesATouchWithinATick) {
  const test::SceneFolder folder(test::scene_mjcf(
      "<body name='ball' pos='1 0 .2'><joint name='rail' type='slide' axis='-1 0 0'/>"
      "<geom size='.1' mass='.1'/></body>"));
  World world(folder.with_pr2(), {.timestep_s = 0.0025, .control_period_s = 1.0});
  const MobileBase robot = test::pr2(world);
  robot.place(world, {});
  const int rail = model_id(world.model(), ModelObject::joint, "rail");
  const auto speed_m_s = [&]() -> double& {
    return world.data().qvel[world.model().jnt_dofadr[rail]];
  };
  speed_m_s() = 2.0;
  CollisionCounter counter;
  world.on_step = [&](const World& now) { counter.update(robot, now); };
  world.advance_tick();
  EXPECT_LT(speed_m_s(), 0.0) << "it bounced off";
  EXPECT_EQ(robot.contacts(world), 0);
  EXPECT_EQ(counter.count(), 1);
}

}  // namespace
}  // namespace vantage
