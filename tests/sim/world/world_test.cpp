#include "vantage/sim/world/world.hpp"

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <limits>

#include "tests/sim/test_world.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

using test::message_of;
using test::SceneFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kBall = test::scene_mjcf(
    "<body name='ball' pos='0 0 1'><freejoint name='flight'/><geom size='.1'/></body>"
    "<body name='cart' pos='2 0 1'><joint name='rail' type='slide' axis='1 0 0'/>"
    "<geom size='.1'/></body>");

TEST(WorldOptions, PeriodIsAWholeMultipleOfTheStep) {
  EXPECT_EQ(WorldOptions{}.steps_per_tick(), 10);
  EXPECT_NO_THROW((WorldOptions{0.005, 0.025}.check()));
  EXPECT_THROW((WorldOptions{0.004, 0.025}.check()), ConfigError);
  EXPECT_THROW((WorldOptions{0.02, 0.005}.check()), ConfigError);
}

TEST(World, RejectsTimeStepsThatMujocoAccepts) {
  const SceneFolder folder(kBall);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double timestep_s : {0.0, -1.0, 1e10, nan}) {
    EXPECT_THROW(World(folder.alone(), {timestep_s, 0.025}), ConfigError) << timestep_s;
    EXPECT_THROW(World(folder.alone(), {0.0025, timestep_s}), ConfigError) << timestep_s;
  }
}

TEST(World, OurTimeStepReplacesTheScenes) {
  const SceneFolder folder(
      "<mujoco><option timestep='0.007'/><worldbody><body><freejoint/><geom size='.1'/></body>"
      "</worldbody></mujoco>");
  World world(folder.alone());
  EXPECT_EQ(world.model().opt.timestep, 0.0025);
  int calls = 0;
  world.on_tick = [&](World& same) { calls += &same == &world ? 1 : 0; };
  world.advance_tick();
  world.advance_tick();
  EXPECT_NEAR(world.time_s(), 0.05, 1e-12);
  EXPECT_EQ(world.ticks(), 2U);
  EXPECT_EQ(calls, 2);
}

TEST(World, DivergenceIsAnErrorNotARestart) {
  const SceneFolder folder(kBall);
  World world(folder.alone());
  for (int i = 0; i < 4; ++i) world.advance_tick();
  const std::vector<double> before = world.state();
  const int cart = model_id(world.model(), ModelObject::body, "cart");
  world.data().xfrc_applied[6 * cart] = 1e14;
  EXPECT_THAT(message_of<DivergedError>([&] { world.advance_tick(); }),
              AllOf(HasSubstr("diverged at 0.1000 s"), HasSubstr("QACC"),
                    HasSubstr("joint 'rail' of body 'cart'")));

  world.set_state(before);
  EXPECT_NO_THROW(world.advance_tick());
  EXPECT_NEAR(world.time_s(), 0.125, 1e-12);
}

TEST(World, PositionThatIsNotFiniteDiverges) {
  const SceneFolder folder(kBall);
  World world(folder.alone());
  world.data().qpos[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(message_of<DivergedError>([&] { world.advance_tick(); }),
              AllOf(HasSubstr("QPOS"), HasSubstr("body 'cart'")));
}

TEST(World, ContactsThatDoNotFitAreAnError) {
  const SceneFolder folder(
      "<mujoco><size nconmax='2' njmax='100'/><worldbody><geom type='plane' size='1 1 1'/>"
      "<body pos='0 0 .1'><freejoint/><geom type='box' size='.1 .1 .1'/></body></worldbody>"
      "</mujoco>");
  World world(folder.alone());
  EXPECT_THAT(message_of<DivergedError>([&] {
                for (int i = 0; i < 20; ++i) world.advance_tick();
              }),
              HasSubstr("raise nconmax"));
}

TEST(World, AnErrorInsideAStepIsReportedAndRecoverable) {
  const SceneFolder folder(kBall);
  World world(folder.alone());
  const std::vector<double> start = world.state();
  const int stack = world.data().nstack;
  world.data().nstack = 1;
  EXPECT_THAT(message_of<DivergedError>([&] { world.advance_tick(); }), HasSubstr("failed at 0.0"));
  world.data().nstack = stack;
  world.set_state(start);
  EXPECT_NO_THROW(world.advance_tick());
}

TEST(World, SnapshotShowsThePresent) {
  const SceneFolder folder(kBall);
  World world(folder.alone());
  for (int i = 0; i < 4; ++i) world.advance_tick();
  const int ball = model_id(world.model(), ModelObject::body, "ball");
  EXPECT_EQ(body_pose(world, ball).translation().z(), world.data().qpos[2]);
  EXPECT_GT(world.data().xpos[3 * ball + 2], world.data().qpos[2])
      << "one step late while it falls";
  EXPECT_EQ(world.snapshot().time, world.time_s());
}

TEST(World, InitialPositions) {
  const SceneFolder folder(kBall);
  World world(folder.alone());
  world.set_initial_joint("rail", 0.75);
  world.set_initial_pose("flight", make_pose({1.0, 2.0, 3.0}, 0.5));
  const int ball = model_id(world.model(), ModelObject::body, "ball");
  const int cart = model_id(world.model(), ModelObject::body, "cart");
  EXPECT_TRUE(body_pose(world, ball).isApprox(make_pose({1.0, 2.0, 3.0}, 0.5), 1e-12));
  EXPECT_NEAR(body_pose(world, cart).translation().x(), 2.75, 1e-12);
  EXPECT_THROW(world.set_initial_joint("flight", 1.0), InputError);
  EXPECT_THROW(world.set_initial_joint("rail", std::nan("")), InputError);
  EXPECT_THROW(world.set_initial_pose("rail", Pose::Identity()), InputError);
  EXPECT_EQ(message_of<InputError>([&] { world.set_initial_joint("road", 1.0); }),
            "the model has no joint called 'road'");
}

TEST(World, StateAndControlsOfTheWrongShapeAreRejected) {
  const SceneFolder folder(kBall);
  World world(folder.alone());
  std::vector<double> state = world.state();
  EXPECT_EQ(state.size(), 1U + 8U + 7U + 7U);
  state.back() = std::nan("");
  EXPECT_THROW(world.set_state(state), InputError);
  state.pop_back();
  EXPECT_THROW(world.set_state(state), InputError);
  EXPECT_THROW(world.set_controls(state), InputError);
}

}  // namespace
}  // namespace vantage
