#include "vantage/sim/world/world.hpp"

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <thread>

#include "tests/sim/test_world.hpp"
#include "tests/support/option_numbers.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/log.hpp"

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
  EXPECT_NEAR(world.time_s(), 0.1, 1e-12) << "when it diverged";

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

TEST(World, ConstraintsThatDoNotFitAreAnError) {
  const SceneFolder folder(
      "<mujoco><size nconmax='100' njmax='2'/><worldbody><geom type='plane' size='1 1 1'/>"
      "<body pos='0 0 .099'><freejoint/><geom type='box' size='.1 .1 .1'/></body></worldbody>"
      "</mujoco>");
  World world(folder.alone());
  EXPECT_THAT(message_of<DivergedError>([&] {
                for (int i = 0; i < 20; ++i) world.advance_tick();
              }),
              HasSubstr("; raise njmax in the scene's <size>"));
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

TEST(WorldOptions, DefaultsAndRanges) {
  support::expect_numbers(WorldOptions{}, {{"timestep_s", 0.0025, between(1e-5, 0.02)},
                                           {"control_period_s", 0.025, between(1e-5, 1.0)}});
}

TEST(World, TheJointOfANumberThatIsNotFiniteIsNamed) {
  const SceneFolder folder(kBall);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto diverges_by = [&](const std::function<void(mjData&)>& spoil) {
    World world(folder.alone());
    spoil(world.data());
    return message_of<DivergedError>([&] { world.advance_tick(); });
  };
  const std::string ball = "(joint 'flight' of body 'ball')";
  const std::string cart = "(joint 'rail' of body 'cart')";
  EXPECT_THAT(diverges_by([&](mjData& data) { data.qpos[0] = nan; }), HasSubstr(ball));
  EXPECT_THAT(diverges_by([&](mjData& data) { data.qpos[6] = nan; }), HasSubstr(ball));
  EXPECT_THAT(diverges_by([&](mjData& data) { data.qpos[7] = nan; }), HasSubstr(cart));
  EXPECT_THAT(diverges_by([&](mjData& data) { data.qvel[0] = nan; }), HasSubstr(ball));
  EXPECT_THAT(diverges_by([&](mjData& data) { data.qvel[5] = nan; }), HasSubstr(ball));
  EXPECT_THAT(diverges_by([&](mjData& data) { data.qvel[6] = nan; }), HasSubstr(cart));
}

TEST(World, OutsideForcesOfATickAddUp) {
  const SceneFolder folder(kBall);
  World world(folder.alone());
  const int ball = model_id(world.model(), ModelObject::body, "ball");
  world.add_outside_force(
      {ball, [](double time_s) { return Eigen::Vector3d(1.0, 2.0, 3.0 + time_s); }});
  world.add_outside_force({ball, [](double) { return Eigen::Vector3d(0.25, 0.5, 0.75); }});
  const mjtNum* applied = world.data().xfrc_applied + 6 * ball;
  world.data().xfrc_applied[6 * ball + 3] = 0.125;
  for (int i = 0; i < 3; ++i) {
    const double begin_s = world.time_s();
    world.advance_tick();
    EXPECT_EQ(applied[0], 1.25);
    EXPECT_EQ(applied[1], 2.5);
    EXPECT_NEAR(applied[2], 3.75 + begin_s, 1e-12);
    EXPECT_EQ(applied[3], 0.125) << "a torque is somebody else's";
  }
}

TEST(World, TellsOfEveryStepAndOfEveryTick) {
  const SceneFolder folder(kBall);
  World world(folder.alone(), {.timestep_s = 0.005, .control_period_s = 0.02});
  std::string calls;
  world.on_clock = [&](World&) { calls += 'c'; };
  world.on_step = [&](const World&) { calls += 's'; };
  world.on_tick = [&](World&) { calls += 't'; };
  world.advance_tick();
  world.set_state(world.state());
  world.advance_tick();
  EXPECT_EQ(calls, "csssstccsssst");
  EXPECT_EQ(world.ticks(), 2U);
}

const char* const kHands =
    "<mujoco><worldbody><body name='left' mocap='true' pos='1 2 3'><geom size='.1'/></body>"
    "<body name='right' mocap='true' pos='4 5 6'><geom size='.1'/><site name='tip' pos='1 0 0'/>"
    "</body><body pos='9 0 0'><joint name='rail' type='slide' axis='1 0 0'/>"
    "<joint name='lid' type='hinge' axis='0 0 1'/><geom size='.1'/></body></worldbody>"
    "<actuator><motor joint='rail'/></actuator></mujoco>";

TEST(World, SnapshotShowsWhatIsMovedByHand) {
  const SceneFolder folder(kHands);
  World world(folder.alone());
  const std::vector<double> pose{-1.0, 0.5, 2.0};
  std::copy(pose.begin(), pose.end(), world.data().mocap_pos + 3);
  std::fill_n(world.data().mocap_quat + 4, 4, 0.5);  // x to y, y to z, z to x
  const auto at = [&](const char* name) {
    return body_pose(world, model_id(world.model(), ModelObject::body, name));
  };
  EXPECT_TRUE(at("left").translation().isApprox(Eigen::Vector3d(1.0, 2.0, 3.0)));
  EXPECT_TRUE(at("right").translation().isApprox(Eigen::Vector3d(-1.0, 0.5, 2.0)));
  const Pose tip = site_pose(world, model_id(world.model(), ModelObject::site, "tip"));
  EXPECT_TRUE(tip.translation().isApprox(Eigen::Vector3d(-1.0, 1.5, 2.0), 1e-12));
  EXPECT_TRUE(tip.linear().col(0).isApprox(Eigen::Vector3d::UnitY(), 1e-12));
  EXPECT_TRUE(tip.linear().col(1).isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
}

TEST(World, AStatePutsCommandsForcesAndHandsBack) {
  const SceneFolder folder(kHands);
  World world(folder.alone());
  const std::vector<double> start = world.state();
  EXPECT_EQ(start.size(), 1U + 2U + 2U + 2U);
  world.set_controls(std::vector<double>{0.75});
  EXPECT_EQ(world.controls()[0], 0.75);
  world.data().xfrc_applied[6 * 3] = 2.0;
  world.data().mocap_pos[3] = 9.0;
  for (int i = 0; i < 3; ++i) world.advance_tick();
  world.set_state(start);
  EXPECT_EQ(world.state(), start);
  EXPECT_EQ(world.ticks(), 0U);
  EXPECT_EQ(world.controls()[0], 0.0);
  EXPECT_EQ(world.data().xfrc_applied[6 * 3], 0.0);
  EXPECT_EQ(world.data().mocap_pos[3], 4.0);
}

TEST(World, HingesAndTurnedBodiesStartWhereTheyAreTold) {
  const SceneFolder hands(kHands);
  World lidded(hands.alone());
  lidded.set_initial_joint("lid", 0.5);
  EXPECT_EQ(lidded.data().qpos[1], 0.5);
  const SceneFolder folder(kBall);
  World world(folder.alone());
  const Pose turned = Eigen::Translation3d(1.0, 2.0, 3.0) *
                      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1.0, 2.0, 3.0).normalized());
  world.set_initial_pose("flight", turned);
  EXPECT_TRUE(
      body_pose(world, model_id(world.model(), ModelObject::body, "ball")).isApprox(turned, 1e-12));
  Pose nowhere = turned;
  nowhere.translation().y() = std::nan("");
  EXPECT_THROW(world.set_initial_pose("flight", nowhere), InputError);
}

TEST(World, TellsTheWallTimeOfItsStepsAlone) {
  const SceneFolder folder(kBall);
  World world(folder.alone());
  EXPECT_EQ(world.stepping_wall_s(), 0.0);
  world.on_tick = [](World&) { std::this_thread::sleep_for(std::chrono::milliseconds(20)); };
  const double start_s = wall_s();
  for (int i = 0; i < 3; ++i) world.advance_tick();
  const double took_s = wall_s() - start_s;
  EXPECT_GT(world.stepping_wall_s(), 0.0);
  EXPECT_LT(world.stepping_wall_s(), took_s - 0.05);
}

TEST(World, SaysWhatIsWrongWithAStateOrCommands) {
  const SceneFolder folder(kHands);
  World world(folder.alone());
  const std::string file = folder.path().string();
  std::vector<double> state = world.state();
  state[3] = std::nan("");
  EXPECT_EQ(message_of<InputError>([&] { world.set_state(state); }),
            "a state of " + file + " holds a number that is not finite");
  state.pop_back();
  EXPECT_EQ(message_of<InputError>([&] { world.set_state(state); }),
            "a state of " + file + " has 7 numbers, not 6");
  EXPECT_EQ(message_of<InputError>([&] { world.set_controls(state); }),
            file + " has 1 actuators, not 6");
}

TEST(World, SnapshotShowsEveryHandWhereItIs) {
  const SceneFolder folder(
      "<mujoco><worldbody><body name='bare' mocap='true' pos='1 2 3'/>"
      "<body name='left' mocap='true'><geom size='.1'/></body>"
      "<body name='right' mocap='true'><geom size='.1'/></body></worldbody></mujoco>");
  World world(folder.alone());
  for (const char* name : {"bare", "left", "right"}) {
    const int body = model_id(world.model(), ModelObject::body, name);
    const Eigen::Vector3d p_m(7.0 + body, 8.0, 9.0);
    std::copy(p_m.begin(), p_m.end(),
              world.data().mocap_pos + 3 * world.model().body_mocapid[body]);
    EXPECT_EQ(Eigen::Vector3d(body_pose(world, body).translation()), p_m) << name;
  }
}

TEST(World, SnapshotHasCamerasThatFollowAMass) {
  const SceneFolder folder(
      "<mujoco><worldbody><body pos='2 0 0'><joint name='rail' type='slide' axis='0 1 0'/>"
      "<geom size='.1'/><camera name='eye' mode='trackcom' pos='-1 0 0'/></body></worldbody>"
      "</mujoco>");
  World world(folder.alone());
  world.set_initial_joint("rail", 0.75);
  EXPECT_NEAR(world.snapshot().cam_xpos[1], 0.75, 1e-12);
}

TEST(World, WhatIsPutElsewhereTakesItsMarksAlong) {
  const SceneFolder folder(
      "<mujoco><worldbody><body name='shelf' pos='5 0 .5'><geom type='box' size='.4 .4 .1'/>"
      "<site name='mark' pos='0 0 .1'/></body></worldbody></mujoco>");
  World world(folder.alone());
  world.put_fixed_body(model_id(world.model(), ModelObject::body, "shelf"), {0.1, 0.2, 0.3});
  const Pose mark = site_pose(world, model_id(world.model(), ModelObject::site, "mark"));
  EXPECT_LT((mark.translation() - Eigen::Vector3d(0.1, 0.2, 0.4)).norm(), 1e-12);
}

TEST(WorldOptions, APeriodMayBeOneStepAndANanosecondOff) {
  EXPECT_NO_THROW((WorldOptions{0.02, 0.02}.check()));
  EXPECT_NO_THROW((WorldOptions{0.0025, 0.025 + 0.7e-9}.check()));
  EXPECT_THROW((WorldOptions{0.0025, 0.025 + 1.5e-9}.check()), ConfigError);
}

TEST(World, NoJointIsBlamedForALackOfRoom) {
  const SceneFolder folder(
      "<mujoco><size nconmax='100' njmax='2'/><worldbody><geom type='plane' size='1 1 1'/>"
      "<body pos='0 0 .099'><freejoint/><geom type='box' size='.1 .1 .1'/></body></worldbody>"
      "</mujoco>");
  World world(folder.alone());
  const std::string said = message_of<DivergedError>([&] {
    for (int i = 0; i < 20; ++i) world.advance_tick();
  });
  EXPECT_THAT(said, HasSubstr("njmax"));
  EXPECT_THAT(said, ::testing::Not(HasSubstr("(joint")));
}

TEST(World, ThatDivergedIsNotSteppedBeforeItHasAState) {
  const SceneFolder folder(kBall);
  const auto spoilt = [&](const std::function<void(mjData&)>& spoil) {
    auto world = std::make_unique<World>(folder.alone());
    spoil(world->data());
    EXPECT_THROW(world->advance_tick(), DivergedError);
    return world;
  };
  const auto diverged = spoilt([](mjData& data) { data.qpos[7] = std::nan(""); });
  const auto failed = spoilt([](mjData& data) { data.nstack = 1; });
  const auto refused = ::testing::ExitedWithCode(static_cast<int>(ExitCode::internal));
  EXPECT_EXIT(diverged->advance_tick(), refused, "a diverged world");
  EXPECT_EXIT(failed->advance_tick(), refused, "a diverged world");
}

}  // namespace
}  // namespace vantage
