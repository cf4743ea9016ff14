#include "vantage/sim/robots/quadrotor.hpp"

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <numbers>
#include <span>

#include "tests/control/flight_kit.hpp"
#include "vantage/core/error.hpp"
#include "vantage/sim/sensors/camera.hpp"
#include "vantage/sim/sensors/ground_truth.hpp"

namespace vantage {
namespace {

using test::FlightWorld;

TEST(Quadrotor, NeedsARobotInTheModel) {
  const test::SceneFolder folder(test::scene_mjcf(""));
  const World world(folder.alone());
  EXPECT_THROW(test::quadrotor(world), InputError);
}

TEST(Quadrotor, NeedsGravityDown) {
  const test::SceneFolder folder("<mujoco><option gravity='0 1 -9.81'/><worldbody/></mujoco>");
  const World world({folder.path(), test::quadrotor_file()}, kFlightWorld);
  EXPECT_THAT(test::message_of<InputError>([&] { test::quadrotor(world); }),
              testing::StartsWith(folder.path().string() + ": option gravity: "));
}

void expect_airframe(const Airframe& got) {
  const Airframe meant = test::airframe();
  EXPECT_NEAR(got.mass_kg, meant.mass_kg, 1e-6);
  EXPECT_LT((got.p_body_com_m - meant.p_body_com_m).norm(), 1e-4);
  EXPECT_LT((got.inertia_kg_m2 - meant.inertia_kg_m2).diagonal().norm(), 5e-5);
  EXPECT_EQ(got.thrust_max_N, 8.0);
  EXPECT_EQ(got.gravity_m_s2, 9.81);
  for (std::size_t i = 0; i < kRotors; ++i) {
    EXPECT_LT((got.rotors[i].p_body_m - meant.rotors[i].p_body_m).norm(), 1e-9);
    EXPECT_EQ(got.rotors[i].torque_per_thrust_m, meant.rotors[i].torque_per_thrust_m);
  }
}

TEST(Quadrotor, IsWhatItIsMeantToBe) { expect_airframe(FlightWorld().vehicle.airframe()); }

TEST(Quadrotor, WhateverTheScene) {
  const test::SceneFolder folder(R"(
    <mujoco>
      <compiler angle="degree" inertiafromgeom="true" coordinate="local"/>
      <default>
        <geom density="5000" contype="0" conaffinity="0"/>
        <general gainprm="7" biastype="affine" biasprm="1 2 3"/>
      </default>
      <worldbody>
        <body><joint name="rail" type="slide"/><geom size="0.1"/></body>
      </worldbody>
      <actuator><motor joint="rail"/><cylinder joint="rail"/></actuator>
    </mujoco>)");
  World world({folder.path(), test::quadrotor_file()}, kFlightWorld);
  const Quadrotor vehicle = test::quadrotor(world);
  expect_airframe(vehicle.airframe());
  vehicle.place(world, test::at_height(2.0));
  for (int i = 0; i < 50; ++i) world.advance_tick();
  const FlightState state = vehicle.state(world);
  EXPECT_NEAR(state.T_world_body.translation().z(), 2.0, 1e-4) << "rotors carry it from the start";
  EXPECT_NEAR(vehicle.camera_pitch_rad(world), Quadrotor::kDefaultCameraPitch_rad, 1e-3);
}

TEST(Quadrotor, InertiaIsMuJoCos) {
  FlightWorld scene;
  scene.vehicle.place(scene.world, Pose::Identity(), 0.0);
  const mjModel& model = scene.world.model();
  const DataPtr data = scene.world.copy_data();
  mj_forward(&model, data.get());
  std::vector<mjtNum> full(static_cast<std::size_t>(model.nv * model.nv));
  mj_fullM(&model, full.data(), data->qM);
  // About the body's origin, where the free joint turns; ours is about the centre of mass.
  const Airframe& frame = scene.vehicle.airframe();
  const Eigen::Vector3d& c = frame.p_body_com_m;
  const Eigen::Matrix3d about_origin =
      frame.inertia_kg_m2 +
      frame.mass_kg * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose());
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      EXPECT_NEAR(full[static_cast<std::size_t>((row + 3) * model.nv + column + 3)],
                  about_origin(row, column), 1e-5);
    }
  }
}

/// The camera's mass on a body that is turned, off its origin, on a boom that is turned.
TEST(Quadrotor, MassesAreWhereTurnedBodiesHaveThem) {
  std::string mjcf = read_file(test::quadrotor_file());
  const auto replace = [&](const std::string& what, const std::string& instead) {
    const auto at = mjcf.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    mjcf.replace(at, what.size(), instead);
  };
  replace("<body name=\"robot/camera\"",
          "<body name=\"robot/boom\" pos=\"-0.02 0.01 -0.05\" euler=\"0.3 0.2 0.9\">"
          "<inertial pos=\"0.03 0 0\" mass=\"0.1\" diaginertia=\"0.0001 0.0002 0.00025\"/>"
          "<body name=\"robot/ballast\" pos=\"0.04 0.02 0\" euler=\"0.5 -0.4 1.2\">"
          "<inertial pos=\"0.02 -0.03 0.01\" mass=\"0.2\" euler=\"0.1 0.7 0\" "
          "diaginertia=\"0.0001 0.0002 0.00025\"/></body></body>"
          "<body name=\"robot/camera\"");
  const test::SceneFolder folder(mjcf);
  const World world(folder.alone(), kFlightWorld);
  const Airframe frame = test::quadrotor(world).airframe();
  const mjModel& model = world.model();
  const DataPtr data = world.copy_data();
  mj_forward(&model, data.get());
  EXPECT_NEAR(frame.mass_kg, 1.54, 1e-9);
  const Eigen::Map<const Eigen::Vector3d> com_m(data->subtree_com + 3);  // of the base, at 0
  EXPECT_LT((frame.p_body_com_m - com_m).norm(), 1e-9);
  std::vector<mjtNum> full(static_cast<std::size_t>(model.nv * model.nv));
  mj_fullM(&model, full.data(), data->qM);
  const Eigen::Matrix3d about_origin =
      frame.inertia_kg_m2 + frame.mass_kg * (com_m.squaredNorm() * Eigen::Matrix3d::Identity() -
                                             com_m * com_m.transpose());
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      EXPECT_NEAR(full[static_cast<std::size_t>((row + 3) * model.nv + column + 3)],
                  about_origin(row, column), 1e-8);
    }
  }
}

TEST(Quadrotor, ThrustsAreWhatMuJoCoApplies) {
  FlightWorld scene;
  const Eigen::Vector4d thrust_N(4.0, 2.0, 3.0, 3.5);
  scene.vehicle.command_thrusts(scene.world, thrust_N);
  for (int i = 0; i < 4; ++i) {
    scene.world.data().act[scene.world.model().na - 5 + i] = thrust_N[i];  // no lag
  }
  const DataPtr data = scene.world.copy_data();
  mj_forward(&scene.world.model(), data.get());
  const Wrench wrench = wrench_of(scene.vehicle.airframe(), thrust_N);
  const Eigen::Map<const Eigen::VectorXd> force(data->qfrc_actuator, 6);
  EXPECT_NEAR(force[2], wrench.collective_N, 1e-9);
  const Eigen::Vector3d about_origin =
      wrench.torque_Nm +
      scene.vehicle.airframe().p_body_com_m.cross(Eigen::Vector3d(0.0, 0.0, wrench.collective_N));
  EXPECT_LT((force.segment<3>(3) - about_origin).norm(), 1e-9);
}

TEST(Quadrotor, MotorsLag) {
  FlightWorld scene;
  const double before_N = scene.vehicle.thrusts_N(scene.world)[0];
  scene.vehicle.command_thrusts(scene.world, Eigen::Vector4d::Constant(before_N + 1.0));
  for (int i = 0; i < 15; ++i) scene.world.advance_tick();  // 30 ms
  EXPECT_NEAR(scene.vehicle.thrusts_N(scene.world)[0] - before_N, 1.0 - std::exp(-1.0), 0.03);
}

TEST(Quadrotor, StateIsThatOfTheBody) {
  FlightWorld scene(test::exact_tracking(), make_pose({1.0, 2.0, 3.0}, 0.7));
  scene.vehicle.command_thrusts(scene.world, {5.0, 2.0, 3.0, 4.0});
  for (int i = 0; i < 40; ++i) scene.world.advance_tick();
  const FlightState a = scene.vehicle.state(scene.world);
  const Pose T_world_body = body_pose(scene.world, scene.vehicle.base_body_id());
  EXPECT_TRUE(a.T_world_body.isApprox(T_world_body, 1e-9));
  scene.world.advance_tick();
  const FlightState b = scene.vehicle.state(scene.world);
  const Eigen::Vector3d moved = b.T_world_body.translation() - a.T_world_body.translation();
  EXPECT_LT((moved / 0.002 - b.v_world_m_s).norm(), 1e-6);
  const Eigen::Vector3d turned = attitude_error(b.T_world_body.linear(), a.T_world_body.linear());
  EXPECT_LT((turned / 0.002 - b.w_body_rad_s).norm(), 1e-3 * b.w_body_rad_s.norm());
  EXPECT_GT(b.w_body_rad_s.norm(), 0.5);
}

TEST(Quadrotor, CameraIsWhereItSays) {
  for (const double pitch : {0.0, 0.5, std::numbers::pi / 3.0}) {
    FlightWorld scene;
    scene.vehicle.place(scene.world, make_pose({1.0, 2.0, 3.0}, 0.7), pitch);
    const Pose T_world_camera = vantage::T_world_camera(scene.world.model(), scene.world.snapshot(),
                                                        scene.vehicle.camera_id());
    const Pose T_world_body = scene.vehicle.state(scene.world).T_world_body;
    EXPECT_TRUE(T_world_camera.isApprox(T_world_body * scene.vehicle.T_body_camera(pitch), 1e-6));
    const Pose body = scene.vehicle.body_for_camera(T_world_camera.translation(), 0.7, pitch);
    EXPECT_TRUE(body.isApprox(T_world_body, 1e-6));
    EXPECT_NEAR(std::asin(-T_world_camera.linear()(2, 2)), pitch, 1e-6);
  }
}

TEST(Quadrotor, CameraTiltsOnCommandWithoutMovingTheVehicle) {
  FlightWorld scene;
  scene.tracking.hold(0.5);
  scene.vehicle.command_camera_pitch(scene.world, 0.2);
  const FlightResult result = scene.tracking.hold(1.0);
  EXPECT_NEAR(scene.vehicle.camera_pitch_rad(scene.world), 0.2, 2e-3);
  EXPECT_LT(result.greatest_error_m, 2e-3);
  scene.vehicle.command_camera_pitch(scene.world, 9.0);
  scene.tracking.hold(1.0);
  EXPECT_NEAR(scene.vehicle.camera_pitch_rad(scene.world), 1.0472, 5e-3) << "clipped";
}

TEST(Quadrotor, TouchesWithItsRotors) {
  // A pole that only the disc of the front left rotor reaches into.
  FlightWorld scene(test::exact_tracking(), test::at_height(1.0),
                    "<geom name='pole' type='cylinder' size='0.01 1' pos='0.19 0.17 1'/>");
  scene.world.advance_tick();
  const int pole = mj_name2id(&scene.world.model(), mjOBJ_GEOM, "pole");
  EXPECT_EQ(scene.vehicle.touched_geoms(scene.world), std::vector<int>{pole});
  EXPECT_GT(scene.vehicle.contacts(scene.world), 0);
}

TEST(Quadrotor, DoesNotSeeItself) {
  FlightWorld scene;
  const RgbdOptions options{.width_px = 160, .height_px = 120};
  const auto renderer = make_offscreen_renderer(scene.world.model(), 160, 120);
  for (const double pitch : {0.0, 0.4, 0.785, 1.047}) {
    scene.vehicle.place(scene.world, test::at_height(1.5), pitch);
    const std::vector<int> ids = body_ids(*renderer, scene.world.model(), scene.world.snapshot(),
                                          scene.vehicle.camera_id(), options.fovy_rad);
    ASSERT_EQ(ids.size(), 160U * 120U);
    for (const int body : ids) ASSERT_LE(body, 0) << pitch;
  }
}

TEST(Quadrotor, CommandsAreClippedToWhatItTakes) {
  FlightWorld scene;
  scene.vehicle.command_thrusts(scene.world, {9.0, -1.0, 3.5, 8.0});
  const std::span<const int> rotors = scene.vehicle.rotor_actuators();
  const auto control = [&](int actuator) {
    return scene.world.controls()[static_cast<std::size_t>(actuator)];
  };
  EXPECT_EQ(control(rotors[0]), 8.0);
  EXPECT_EQ(control(rotors[1]), 0.0);
  EXPECT_EQ(control(rotors[2]), 3.5);
  EXPECT_EQ(control(rotors[3]), 8.0);
  const int tilt = model_id(scene.world.model(), ModelObject::actuator, "robot/camera_tilt");
  scene.vehicle.command_camera_pitch(scene.world, -0.3);
  EXPECT_EQ(control(tilt), 0.0);
  scene.vehicle.command_camera_pitch(scene.world, 0.4);
  EXPECT_EQ(control(tilt), 0.4);
  scene.vehicle.command_camera_pitch(scene.world, 9.0);
  EXPECT_EQ(control(tilt), scene.vehicle.camera_pitch_max_rad());
}

TEST(Quadrotor, ItsCameraTiltsAsFarAsItsServo) {
  FlightWorld scene;
  const double most_rad = scene.vehicle.camera_pitch_max_rad();
  EXPECT_NEAR(most_rad, 1.0472, 1e-12);
  EXPECT_NO_THROW(scene.vehicle.place(scene.world, test::at_height(2.0), most_rad));
  EXPECT_EQ(scene.vehicle.camera_pitch_rad(scene.world), most_rad);
  EXPECT_THROW(scene.vehicle.place(scene.world, test::at_height(2.0), most_rad + 0.01),
               ConfigError);
}

TEST(Quadrotor, NeedsGravityAndNoneAside) {
  for (const char* gravity : {"0 0 0", "0 0 9.81", "0.1 0 -9.81", "0 -0.1 -9.81"}) {
    const test::SceneFolder folder("<mujoco><option gravity='" + std::string(gravity) +
                                   "'/><worldbody/></mujoco>");
    const World world({folder.path(), test::quadrotor_file()}, kFlightWorld);
    EXPECT_THROW(test::quadrotor(world), InputError) << gravity;
  }
}

TEST(Quadrotor, StateIsItsOwnWhateverMovesBesideIt) {
  FlightWorld scene(test::exact_tracking(), make_pose({1.0, 2.0, 3.0}, 0.7),
                    "<body pos='5 0 1'><freejoint/><geom size='.1'/></body>");
  ASSERT_EQ(scene.world.model().body_dofadr[scene.vehicle.base_body_id()], 6);
  for (int i = 0; i < scene.world.model().nv; ++i) scene.world.data().qvel[i] = 0.25 * i;
  const FlightState state = scene.vehicle.state(scene.world);
  EXPECT_TRUE(state.T_world_body.isApprox(make_pose({1.0, 2.0, 3.0}, 0.7), 1e-12));
  EXPECT_EQ(state.v_world_m_s, Eigen::Vector3d(1.5, 1.75, 2.0));
  EXPECT_EQ(state.w_body_rad_s, Eigen::Vector3d(2.25, 2.5, 2.75));
}

}  // namespace
}  // namespace vantage
