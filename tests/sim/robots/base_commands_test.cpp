// What a command to a base becomes at its actuators, and what it costs.
#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "tests/sim/test_world.hpp"
#include "tests/support/option_numbers.hpp"
#include "vantage/sim/robots/drive.hpp"

namespace vantage {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// The command that the actuator of that name has now.
double commanded(const World& world, const char* actuator) {
  const int id = model_id(world.model(), ModelObject::actuator, actuator);
  return world.controls()[static_cast<std::size_t>(id)];
}

TEST(BaseCommands, SlidesMoveInTheWorldWhatTheBaseIsTold) {
  test::RobotWorld scene("", {1.0, 2.0, 0.5});
  const double c = std::cos(0.5);
  const double s = std::sin(0.5);
  scene.robot.command_twist(scene.world, {0.3, 0.4, -0.2});
  EXPECT_NEAR(commanded(scene.world, "robot/base_x"), 0.3 * c - 0.4 * s, 1e-12);
  EXPECT_NEAR(commanded(scene.world, "robot/base_y"), 0.3 * s + 0.4 * c, 1e-12);
  EXPECT_NEAR(commanded(scene.world, "robot/base_yaw"), -0.2, 1e-12);
  scene.robot.command_twist(scene.world, {3.0, 4.0, 9.0});
  EXPECT_NEAR(commanded(scene.world, "robot/base_x"), 0.6 * c - 0.8 * s, 1e-12);
  EXPECT_NEAR(commanded(scene.world, "robot/base_y"), 0.6 * s + 0.8 * c, 1e-12);
  EXPECT_NEAR(commanded(scene.world, "robot/base_yaw"), 1.5, 1e-12);
}

TEST(BaseCommands, WheelsTurnAsTheirTrackAndRadiusSay) {
  test::RoverWorld scene;
  const auto wheels = [&](const Twist2& twist) {
    scene.robot.command_twist(scene.world, twist);
    return std::vector<double>{commanded(scene.world, "robot/left_wheel"),
                               commanded(scene.world, "robot/right_wheel")};
  };
  const auto are = [](double left, double right) {
    return ElementsAre(testing::DoubleNear(left, 1e-9), testing::DoubleNear(right, 1e-9));
  };
  EXPECT_THAT(wheels({0.3, 0.7, 0.4}), are(4.92, 7.08));
  EXPECT_THAT(wheels({-9.0, 0.0, 0.0}), are(-12.0, -12.0));
  EXPECT_THAT(wheels({9.0, 0.0, 0.0}), are(12.0, 12.0));
  EXPECT_THAT(wheels({0.0, 0.0, 9.0}), are(-4.05, 4.05));
  EXPECT_THAT(wheels({0.0, 0.0, -9.0}), are(4.05, -4.05));
}

TEST(BaseCommands, AreClippedToWhatActuatorsTake) {
  test::RobotWorld scene;
  EXPECT_EQ(scene.robot.lift_max_m(), 0.33);
  scene.robot.command_lift(scene.world, 9.0);
  EXPECT_EQ(commanded(scene.world, "robot/torso_lift"), 0.33);
  scene.robot.command_lift(scene.world, -1.0);
  EXPECT_EQ(commanded(scene.world, "robot/torso_lift"), 0.0);
  scene.robot.command_head(scene.world, 9.0, -9.0);
  EXPECT_EQ(commanded(scene.world, "robot/head_pan"), 2.86);
  EXPECT_EQ(commanded(scene.world, "robot/head_tilt"), -0.47);
  const AngleRange tilts = scene.robot.laser_tilt_range();
  EXPECT_EQ(tilts.min_rad, -0.785);
  EXPECT_EQ(tilts.max_rad, 1.484);
  scene.robot.command_laser_tilt(scene.world, 9.0);
  EXPECT_EQ(commanded(scene.world, "robot/laser_tilt"), 1.484);
}

TEST(BaseCommands, ARobotIsPlacedWithinItsLift) {
  const test::RobotWorld scene("", {1.0, -2.0, 4.0}, 9.0);
  EXPECT_EQ(scene.robot.lift_m(scene.world), 0.33);
  EXPECT_EQ(commanded(scene.world, "robot/torso_lift"), 0.33);
  const Pose2 pose = scene.robot.T_world_base(scene.world);
  EXPECT_NEAR(pose.x_m, 1.0, 1e-12);
  EXPECT_NEAR(pose.y_m, -2.0, 1e-12);
  EXPECT_NEAR(pose.yaw_rad, 4.0 - 2.0 * std::numbers::pi, 1e-12);
}

TEST(BaseCommands, PowerIsThatOfItsOwnActuatorsAndOfRest) {
  const test::SceneFolder folder(
      "<mujoco><worldbody><geom type='plane' size='9 9 .1'/><body pos='5 0 1'>"
      "<joint name='rail' type='slide'/><geom size='.1'/></body></worldbody>"
      "<actuator><motor name='rail' joint='rail'/></actuator></mujoco>");
  World world(folder.with_pr2());
  const MobileBase robot = test::pr2(world);
  EXPECT_EQ(robot.power_w(world), 300.0);
  const auto work = [&](const char* actuator, double force, double velocity) {
    const int id = model_id(world.model(), ModelObject::actuator, actuator);
    world.data().actuator_force[id] = force;
    world.data().actuator_velocity[id] = velocity;
  };
  work("rail", 100.0, 100.0);
  work("robot/base_x", 2.0, 3.0);
  work("robot/head_pan", -2.0, -5.0);
  work("robot/torso_lift", -1.0, 4.0);
  EXPECT_NEAR(robot.power_w(world), 316.0, 1e-12);
}

TEST(BaseCommands, TurningTouchesWhatItsCornersReach) {
  for (const auto& [wall_x_m, touches] : {std::pair(0.5, true), std::pair(0.6, false)}) {
    test::RobotWorld scene("<geom name='wall' type='box' size='.1 3 1' pos='" +
                           std::to_string(wall_x_m) + " 0 1'/>");
    scene.world.advance_tick();
    EXPECT_EQ(scene.robot.contacts(scene.world), 0);
    const std::vector<double> before = scene.world.state();
    const std::vector<int> touched = scene.robot.touched_by_turning(scene.world);
    if (touches) {
      EXPECT_THAT(touched, ElementsAre(model_id(scene.world.model(), ModelObject::geom, "wall")));
    } else {
      EXPECT_THAT(touched, IsEmpty());
    }
    EXPECT_EQ(scene.world.state(), before);
  }
}

Odometry exact_odometry() { return {OdometryOptions::perfect(), Rng(1), {}}; }

TEST(DriveTimes, ADriveMayTakeAMultipleOfWhatItShouldAndTenSeconds) {
  test::RobotWorld scene;
  Odometry odometry = exact_odometry();
  odometry.on_increment = [](const Pose2& step) {  // ten times slower than it is
    return Pose2{0.1 * step.x_m, 0.1 * step.y_m, 0.1 * step.yaw_rad};
  };
  const DriveResult result = drive(scene.world, scene.robot, odometry,
                                   std::vector<Pose2>{{1.2, 0.0, -2.4}}, {.timeout_factor = 1.5});
  EXPECT_EQ(result.status, DriveStatus::timeout);
  // 2 s along the path at 0.6 m/s and 3 s of turning at 0.8 rad/s; then it brakes.
  EXPECT_GE(result.duration_s, 17.5 - 1e-9);
  EXPECT_LT(result.duration_s, 19.0);
}

/// Stuck is by what the wheels measure: slipping they turn, and blocked they do not, touched or
/// not.
TEST(DriveTimes, StuckIsWhatTheWheelsSay) {
  test::RobotWorld free;
  Odometry blocked = exact_odometry();
  blocked.on_increment = [](const Pose2&) { return Pose2{}; };
  const std::vector<Pose2> ahead{{3.0, 0.0, 0.0}};
  const DriveResult stuck = drive(free.world, free.robot, blocked, ahead);
  EXPECT_EQ(stuck.status, DriveStatus::stuck);
  EXPECT_LT(stuck.duration_s, 3.0);
  test::RobotWorld walled("<geom name='wall' type='box' size='0.1 3 1' pos='1.1 0 1'/>");
  Odometry slipping = exact_odometry();
  slipping.on_increment = [](const Pose2&) { return Pose2{0.004, 0.0, 0.0}; };
  EXPECT_EQ(drive(walled.world, walled.robot, slipping, ahead).status, DriveStatus::arrived)
      << "so it believes";
}

TEST(DriveTimes, BrakingIsGivenUpAfterThreeSeconds) {
  test::RobotWorld scene;
  scene.world.add_outside_force(
      {scene.robot.base_body_id(), [](double) { return Eigen::Vector3d(1000.0, 0.0, 0.0); }});
  Odometry odometry = exact_odometry();
  const DriveResult result =
      drive(scene.world, scene.robot, odometry, std::vector<Pose2>{{4.0, 0.0, 0.0}}, {},
            [](World&, const Pose2&) { return false; });
  EXPECT_EQ(result.status, DriveStatus::stopped);
  EXPECT_GT(result.duration_s, 3.02);
  EXPECT_LT(result.duration_s, 3.06);
}

/// Speeds of the footprint's edge in a drive that is stopped after a second, tick by tick.
std::vector<double> speeds_until_rest(double rest_speed_m_s) {
  test::RobotWorld scene;
  Odometry odometry = exact_odometry();
  std::vector<double> speeds_m_s;
  scene.world.on_tick = [&](World& world) {
    const Twist2 twist = scene.robot.twist(world);
    speeds_m_s.push_back(std::hypot(twist.vx_m_s, twist.vy_m_s) +
                         scene.robot.footprint().circumscribed_radius_m * std::abs(twist.wz_rad_s));
  };
  drive(scene.world, scene.robot, odometry, std::vector<Pose2>{{4.0, 0.0, 0.0}},
        {.rest_speed_m_s = rest_speed_m_s},
        [](World& world, const Pose2&) { return world.time_s() < 1.0; });
  return speeds_m_s;
}

TEST(DriveTimes, RestIsBelowItsSpeedNotAtIt) {
  const std::vector<double> speeds_m_s = speeds_until_rest(0.002);
  ASSERT_GT(speeds_m_s.size(), 41U);
  EXPECT_LT(speeds_m_s.back(), 0.002);
  const double least_m_s = *std::min_element(speeds_m_s.begin() + 39, speeds_m_s.end() - 1);
  EXPECT_GE(least_m_s, 0.002);
  ASSERT_LE(least_m_s, 0.1);
  EXPECT_EQ(speeds_until_rest(least_m_s), speeds_m_s) << "so fast it is not at rest yet";
}

TEST(DriveTimes, StandingStillTakesAsLongAsAsked) {
  test::RobotWorld scene;
  Odometry odometry = exact_odometry();
  hold_still(scene.world, scene.robot, odometry, 0.5);
  EXPECT_GT(scene.world.time_s(), 0.499);
  EXPECT_LT(scene.world.time_s(), 0.53);
}

TEST(DriveTimes, StatusesHaveNames) {
  EXPECT_EQ(to_string(DriveStatus::arrived), "arrived");
  EXPECT_EQ(to_string(DriveStatus::stuck), "stuck");
  EXPECT_EQ(to_string(DriveStatus::stopped), "stopped");
  EXPECT_EQ(to_string(DriveStatus::timeout), "timeout");
}

TEST(RobotOptions, DefaultsAndRanges) {
  support::expect_numbers(OdometryOptions{}, {{"sigma_translation_m", 0.01, at_least(0.0)},
                                              {"sigma_yaw_rad", 0.01, at_least(0.0)},
                                              {"sigma_turn_rad", 0.02, at_least(0.0)},
                                              {"bias_translation_m_per_m", 0.01, at_least(0.0)},
                                              {"bias_yaw_rad_per_m", 0.005, at_least(0.0)},
                                              {"bias_length_m", 5.0, above(0.0)}});
  support::expect_numbers(Footprint{}, {{"inscribed_radius_m", 0.0, Range{0.0, 5.0, true}},
                                        {"circumscribed_radius_m", 0.0, Range{0.0, 5.0, true}}});
  support::expect_numbers(OmnidirectionalDrive{}, {{"speed_max_m_s", 1.0, Range{0.0, 10.0, true}}});
  support::expect_numbers(DifferentialDrive{},
                          {{"wheel_radius_m", 0.0, Range{0.0, 1.0, true}},
                           {"track_m", 0.0, Range{0.0, 5.0, true}},
                           {"speed_max_m_s", 0.5, Range{0.0, 10.0, true}},
                           {"turn_rate_max_rad_s", 1.5, Range{0.0, 10.0, true}}});
  support::expect_numbers(QuadrotorDescription{}, {{"rotor_radius_m", 0.0, Range{0.0, 5.0, true}}});
  support::expect_numbers(MobileBaseDescription{},
                          {{"footprint.inscribed_radius_m", 0.0, Range{0.0, 5.0, true}},
                           {"footprint.circumscribed_radius_m", 0.0, Range{0.0, 5.0, true}},
                           {"idle_power_w", 0.0, at_least(0.0)},
                           {"head", support::kNull},
                           {"tilting_laser", support::kNull}});
}

TEST(RobotOptions, AFootprintMayBeACircle) {
  Footprint footprint{.inscribed_radius_m = 0.2, .circumscribed_radius_m = 0.2, .outline_m = {}};
  EXPECT_NO_THROW(footprint.check());
  footprint.outline_m = {{0.0, 0.0}, {0.2, 0.0}, {0.0, 0.1}};
  EXPECT_NO_THROW(footprint.check());
  footprint.inscribed_radius_m = 0.21;
  EXPECT_THROW(footprint.check(), ConfigError);
}

TEST(RobotOptions, AQuadrotorNamesFourRotors) {
  QuadrotorDescription description{.base = "b",
                                   .free_joint = "f",
                                   .rotors = {"0", "1", "2"},
                                   .rotor_radius_m = 0.1,
                                   .camera = "c",
                                   .camera_tilt = "t"};
  EXPECT_EQ(test::message_of<ConfigError>([&] { description.check(); }),
            "rotors: 3 actuators, a quadrotor has 4");
  description.rotors.emplace_back("3");
  EXPECT_NO_THROW(description.check());
  for (auto* name : {&description.base, &description.free_joint, &description.camera,
                     &description.camera_tilt}) {
    const std::string before = std::exchange(*name, "");
    EXPECT_THROW(description.check(), ConfigError) << before;
    *name = before;
  }
  description.rotors.emplace_back("4");
  EXPECT_THROW(description.check(), ConfigError);
}

/// Driving at so many m/s while the wheels measure so many.
TEST(DriveTimes, StuckIsToPushAndToMoveByLessThanAFifthOrTwoCentimetresASecond) {
  const auto status = [](double pushed_m_s, double measured_m_s) {
    test::RobotWorld scene;
    Odometry odometry = exact_odometry();
    const double step_m = scene.world.options().control_period_s * measured_m_s;
    odometry.on_increment = [step_m](const Pose2&) { return Pose2{step_m, 0.0, 0.0}; };
    DriveOptions options;
    options.controller.speed_m_s = pushed_m_s;
    return drive(scene.world, scene.robot, odometry, std::vector<Pose2>{{3.0, 0.0, 0.0}}, options,
                 [](World& world, const Pose2&) { return world.time_s() < 4.0; })
        .status;
  };
  EXPECT_EQ(status(0.3, 0.018), DriveStatus::stuck);
  EXPECT_EQ(status(0.3, 0.022), DriveStatus::stopped);
  EXPECT_EQ(status(0.12, 0.0), DriveStatus::stuck);
  EXPECT_EQ(status(0.05, 0.009), DriveStatus::stuck);
  EXPECT_EQ(status(0.05, 0.011), DriveStatus::stopped);
  EXPECT_EQ(status(0.011, 0.0), DriveStatus::stuck);
  EXPECT_EQ(status(0.009, 0.0), DriveStatus::stopped);
}

TEST(BaseCommands, TheHeadTurnsAsFastAsTheFasterOfItsJoints) {
  test::RobotWorld scene;
  const auto rate_rad_s = [&](double pan_rad_s, double tilt_rad_s) {
    const mjModel& model = scene.world.model();
    const auto dof = [&](const char* joint) {
      return model.jnt_dofadr[model_id(model, ModelObject::joint, joint)];
    };
    scene.world.data().qvel[dof("robot/head_pan")] = pan_rad_s;
    scene.world.data().qvel[dof("robot/head_tilt")] = tilt_rad_s;
    return scene.robot.head_rate_rad_s(scene.world);
  };
  EXPECT_EQ(rate_rad_s(-0.5, 0.25), 0.5);
  EXPECT_EQ(rate_rad_s(-0.5, -0.75), 0.75);
}

TEST(DriveTimes, StuckIsToPushForSoLongWithoutABreak) {
  DriveOptions options;
  options.stuck_time_s = 1.5;
  const auto driven = [&](int ticks_to_a_step) {
    test::RobotWorld scene;
    Odometry odometry = exact_odometry();
    int ticks = 0;
    odometry.on_increment = [&ticks, ticks_to_a_step](const Pose2&) {
      return ++ticks % ticks_to_a_step == 0 ? Pose2{0.004, 0.0, 0.0} : Pose2{};
    };
    return drive(scene.world, scene.robot, odometry, std::vector<Pose2>{{3.0, 0.0, 0.0}}, options,
                 [](World& world, const Pose2&) { return world.time_s() < 4.0; });
  };
  const DriveResult stuck = driven(1000);
  EXPECT_EQ(stuck.status, DriveStatus::stuck);
  EXPECT_GE(stuck.duration_s, 1.5 - 1e-9);
  EXPECT_LT(stuck.duration_s, 3.5);
  EXPECT_EQ(driven(40).status, DriveStatus::stopped) << "its wheels turn once a second";
}

TEST(BaseCommands, ARobotIsPlacedWithItsLiftDownUnlessTold) {
  test::RobotWorld scene("", {}, 0.2);
  scene.robot.place(scene.world, {1.0, 0.0, 0.0});
  EXPECT_EQ(scene.robot.lift_m(scene.world), 0.0);
  EXPECT_EQ(commanded(scene.world, "robot/torso_lift"), 0.0);
}

/// Whose ticks are binary fractions of a second, so that times are met exactly.
TEST(DriveTimes, EndOnTheTickThatTheyAreDue) {
  constexpr double kTick_s = 1.0 / 32.0;
  const test::SceneFolder folder(test::scene_mjcf(""));
  World world(folder.with_pr2(), {.timestep_s = kTick_s / 8.0, .control_period_s = kTick_s});
  const MobileBase robot = test::pr2(world);
  robot.place(world, {});
  Odometry slow = exact_odometry();
  slow.on_increment = [](const Pose2& step) { return Pose2{0.1 * step.x_m, 0.0, 0.0}; };
  DriveOptions options;
  options.controller.speed_m_s = 0.5;
  options.timeout_factor = 1.5;
  int ticks = 0;
  EXPECT_EQ(drive(world, robot, slow, std::vector<Pose2>{{2.0, 0.0, 0.0}}, options,
                  [&](World&, const Pose2&) { return ++ticks > 0; })
                .status,
            DriveStatus::timeout);
  EXPECT_EQ(ticks, 32 * 16) << "10 s and one and a half times 4 s";
  world.add_outside_force(
      {robot.base_body_id(), [](double) { return Eigen::Vector3d(1000.0, 0.0, 0.0); }});
  const DriveResult stopped = drive(world, robot, slow, std::vector<Pose2>{{9.0, 0.0, 0.0}}, {},
                                    [](World&, const Pose2&) { return false; });
  EXPECT_EQ(stopped.duration_s, kTick_s + 3.0);
  const double start_s = world.time_s();
  hold_still(world, robot, slow, 0.5);
  EXPECT_EQ(world.time_s(), start_s + 0.5);
}

TEST(DriveTimes, ABaseBrakesWithinHalfItsTolerancesWhereverThatIs) {
  const auto status = [](const Pose2& T_start_goal) {
    const Pose2 start{10.0, -5.0, 0.3};
    test::RobotWorld scene("", start);
    Odometry blocked(OdometryOptions::perfect(), Rng(1), start);
    blocked.on_increment = [](const Pose2&) { return Pose2{}; };
    DriveOptions options;
    options.goal_tolerance_m = 0.1;
    options.goal_tolerance_rad = 0.2;
    return drive(scene.world, scene.robot, blocked,
                 std::vector<Pose2>{compose(start, T_start_goal)}, options,
                 [](World& world, const Pose2&) { return world.time_s() < 0.5; })
        .status;
  };
  for (const Pose2& near :
       {Pose2{0.049, 0.0, 0.0}, Pose2{-0.03, -0.03, 0.0}, Pose2{0.0, 0.0, 0.099},
        Pose2{0.0, 0.0, -0.099}, Pose2{0.0, 0.049, 0.099}}) {
    EXPECT_EQ(status(near), DriveStatus::arrived) << near.x_m << " " << near.yaw_rad;
  }
  for (const Pose2& far : {Pose2{0.051, 0.0, 0.0}, Pose2{-0.04, -0.04, 0.0}, Pose2{0.0, 0.0, 0.101},
                           Pose2{0.0, 0.0, -0.101}, Pose2{0.0, 0.051, 0.099}}) {
    EXPECT_EQ(status(far), DriveStatus::stopped) << far.x_m << " " << far.yaw_rad;
  }
}

TEST(BaseCommands, PowerIsThatOfTheFirstActuatorToo) {
  test::RobotWorld scene;
  for (int i = 0; i < scene.world.model().nu; ++i) {
    scene.world.data().actuator_force[i] = 2.0;
    scene.world.data().actuator_velocity[i] = 3.0;
  }
  EXPECT_NEAR(scene.robot.power_w(scene.world), 300.0 + 6.0 * scene.world.model().nu, 1e-9);
}

}  // namespace
}  // namespace vantage
