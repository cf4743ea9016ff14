#include "vantage/sim/robots/robot_names.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>

#include "tests/sim/test_world.hpp"
#include "tests/support/mjcf.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const char* const kArm = R"(
  <mujoco><worldbody>
    <camera name="overview"/>
    <body name="table"><joint name="rail" type="slide"/><geom size=".1"/></body>
    <body name="robot/base" pos="1 2 3">
      <freejoint name="robot/free"/><geom size=".1"/>
      <site name="robot/mark" pos=".1 .2 .3" quat="0 0 0 1"/>
      <body name="robot/arm" pos=".5 0 .25" euler="0 0 90">
        <joint name="robot/turn" type="hinge" axis="0 1 0"/><geom size=".1"/>
        <body name="robot/hand" pos=".125 0 0" euler="0 0 90">
          <joint name="robot/slip" type="slide"/><joint name="robot/loose" type="hinge"/>
          <joint name="robot/double" type="hinge" axis="1 0 0"/><geom size=".1"/>
          <camera name="robot/eye" pos=".01 .02 .03"/>
        </body>
      </body>
      <body name="robot/ball" pos="0 0 1"><joint name="robot/any" type="ball"/><geom size=".1"/>
      </body>
    </body>
  </worldbody>
  <actuator>
    <motor joint="rail" ctrllimited="true" ctrlrange="-9 9"/>
    <motor joint="robot/double" ctrllimited="true" ctrlrange="-1 1"/>
    <position joint="robot/turn" ctrllimited="true" ctrlrange="-.5 .75"/>
    <motor joint="robot/double" ctrllimited="true" ctrlrange="-1 1"/>
    <motor joint="robot/slip"/>
  </actuator></mujoco>)";

/// A model, and what is found in it.
struct Names {
  explicit Names(const char* mjcf = kArm)
      : scene(test::compile_mjcf(mjcf)), names(*scene.model, "robots/x") {}
  [[nodiscard]] std::string refused(const std::function<void(const RobotNames&)>& call) const {
    return test::message_of<InputError>([&] { call(names); });
  }
  test::MjcfModel scene;
  RobotNames names;
};

TEST(RobotNames, AJointGoesWithTheActuatorThatDrivesIt) {
  const DrivenJoint turn = Names().names.driven("head.pan", "robot/turn", JointType::hinge);
  EXPECT_EQ(turn.joint, 2);
  EXPECT_EQ(turn.qpos, 8);
  EXPECT_EQ(turn.dof, 7);
  EXPECT_EQ(turn.actuator, 2);
  EXPECT_EQ(turn.min, -0.5);
  EXPECT_EQ(turn.max, 0.75);
}

TEST(RobotNames, AJointThatCannotBeDrivenIsRefused) {
  const Names arm;
  const auto driven = [&](const char* joint, JointType type = JointType::hinge) {
    return arm.refused([&](const RobotNames& names) { (void)names.driven("lift", joint, type); });
  };
  EXPECT_EQ(driven("robot/any"), "robots/x: lift: joint 'robot/any' is no hinge");
  EXPECT_EQ(driven("robot/slip"), "robots/x: lift: joint 'robot/slip' is no hinge");
  EXPECT_EQ(driven("robot/turn", JointType::slide),
            "robots/x: lift: joint 'robot/turn' is no slide");
  EXPECT_EQ(driven("robot/loose"),
            "robots/x: lift: 0 actuators drive joint 'robot/loose', expected one");
  EXPECT_EQ(driven("robot/double"),
            "robots/x: lift: 2 actuators drive joint 'robot/double', expected one");
  EXPECT_EQ(driven("robot/slip", JointType::slide),
            "robots/x: lift: the actuator of joint 'robot/slip' has no ctrlrange");
}

TEST(RobotNames, WhatIsNotThereIsNamedWithWhatIs) {
  const Names arm;
  EXPECT_EQ(arm.refused([](const RobotNames& names) {
    (void)names.find(ModelObject::body, "base", "robot/bass");
  }),
            "robots/x: base: the model has no body 'robot/bass'; known: robot/base, robot/arm, "
            "robot/hand, robot/ball");
  EXPECT_EQ(arm.refused([](const RobotNames& names) {
    (void)names.find(ModelObject::actuator, "rotors", "robot/rotor");
  }),
            "robots/x: rotors: the model has no actuator 'robot/rotor'; it has none that starts "
            "with robot/");
  EXPECT_EQ(arm.names.find(ModelObject::camera, "camera", "robot/eye"),
            arm.scene.camera("robot/eye"));
}

TEST(RobotNames, AFreeJointIsThatOfItsBody) {
  const Names arm;
  const int base = arm.scene.body("robot/base");
  EXPECT_EQ(arm.names.free_joint("free_joint", "robot/free", base), 1);
  const auto refused = [&](const char* joint, int body) {
    return arm.refused(
        [&](const RobotNames& names) { (void)names.free_joint("free_joint", joint, body); });
  };
  EXPECT_EQ(refused("robot/free", arm.scene.body("robot/arm")),
            "robots/x: free_joint: joint 'robot/free' is not the free joint of body 'robot/arm'");
  EXPECT_EQ(refused("robot/turn", arm.scene.body("robot/arm")),
            "robots/x: free_joint: joint 'robot/turn' is not the free joint of body 'robot/arm'");
}

TEST(RobotNames, PartsAreBelowTheirAncestors) {
  const Names arm;
  const int base = arm.scene.body("robot/base");
  const int hand = arm.scene.body("robot/hand");
  EXPECT_NO_THROW(arm.names.require_part("head.tilt", hand, base));
  EXPECT_NO_THROW(arm.names.require_part("head.tilt", hand, hand));
  EXPECT_EQ(
      arm.refused([&](const RobotNames& names) { names.require_part("head.tilt", base, hand); }),
      "robots/x: head.tilt: it is no part of body 'robot/hand'");
  const Eigen::Isometry3d T = arm.names.pose_in(base, hand, "head");
  EXPECT_TRUE(T.translation().isApprox(Eigen::Vector3d(0.5, 0.125, 0.25), 1e-9));
  EXPECT_TRUE(
      T.linear().isApprox(Eigen::Vector3d(-1.0, -1.0, 1.0).asDiagonal().toDenseMatrix(), 1e-9));
}

TEST(RobotNames, AnAxisMayBeAThousandthOff) {
  const Names arm;
  const int base = arm.scene.body("robot/base");
  const auto refused = [&](double angle_rad) {
    return arm.refused([&](const RobotNames& names) {
      names.require_axis("lift", 2, base, {-std::cos(angle_rad), std::sin(angle_rad), 0.0});
    });
  };
  EXPECT_EQ(refused(0.0), "");
  EXPECT_EQ(refused(0.0008), "");
  EXPECT_NE(refused(0.0015), "");
  const std::string opposite = refused(std::acos(-1.0));
  EXPECT_THAT(opposite, StartsWith("robots/x: lift: the axis of joint 'robot/turn' is (-1, "));
  EXPECT_THAT(opposite, HasSubstr(") in the base, expected (1, "));
}

/// The axis of robot/turn goes along the base's x, 0.25 m above it.
TEST(RobotNames, APlaceOnAnAxisMayBeAMillimetreOff) {
  const Names arm;
  const int base = arm.scene.body("robot/base");
  const auto refused = [&](const Eigen::Vector3d& p_m) {
    return arm.refused(
        [&](const RobotNames& names) { names.require_on_axis("eye", 2, base, p_m); });
  };
  EXPECT_EQ(refused({7.0, 0.0, 0.25}), "");
  EXPECT_EQ(refused({7.0, 0.0006, 0.2507}), "");
  EXPECT_EQ(refused({0.5, 0.3, 0.65}),
            "robots/x: eye: it is 0.5 m beside the axis of joint 'robot/turn', expected on it");
  EXPECT_NE(refused({0.5, 0.0, 0.2515}), "");
}

TEST(RobotNames, ABaseStandsInNoOtherBody) {
  const Names arm;
  EXPECT_EQ(arm.names.find_root("base", "robot/base"), arm.scene.body("robot/base"));
  EXPECT_THAT(arm.refused([](const RobotNames& names) {
    static_cast<void>(names.find_root("base", "robot/arm"));
  }),
              StartsWith("robots/x: base: body 'robot/arm' stands in another one"));
}

TEST(RobotNames, TheRobotIsFoundByItsPrefix) {
  const Names arm;
  EXPECT_EQ(robot_base(*arm.scene.model), arm.scene.body("robot/base"));
  EXPECT_EQ(robot_camera(*arm.scene.model), arm.scene.camera("robot/eye"));
  const Names bare(
      "<mujoco><worldbody><camera name='overview'/><body name='table'>"
      "<geom size='.1'/><body name='robot/part'/></body></worldbody></mujoco>");
  EXPECT_EQ(robot_camera(*bare.scene.model), std::nullopt);
  EXPECT_THROW(robot_base(*bare.scene.model), InputError);
}

TEST(RobotNames, SitesAndCamerasAreWhereTheyAreInTheirBodies) {
  const Names arm;
  const Eigen::Isometry3d T_site =
      site_in_body(*arm.scene.model, mj_name2id(arm.scene.model.get(), mjOBJ_SITE, "robot/mark"));
  EXPECT_TRUE(T_site.translation().isApprox(Eigen::Vector3d(0.1, 0.2, 0.3), 1e-12));
  EXPECT_TRUE(T_site.linear().col(0).isApprox(-Eigen::Vector3d::UnitX(), 1e-12));
  EXPECT_TRUE(T_site.linear().col(2).isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
  const Eigen::Isometry3d T_camera =
      camera_in_body(*arm.scene.model, arm.scene.camera("robot/eye"));
  EXPECT_TRUE(T_camera.translation().isApprox(Eigen::Vector3d(0.01, 0.02, 0.03), 1e-12));
}

TEST(RobotNames, APoseIsReadInTheOrderOfMuJoCo) {
  const std::array<double, 3> p{0.1, 0.2, 0.3};
  const std::array<double, 4> wxyz{1.6, 0.6, -0.4, 0.8};
  const Eigen::Isometry3d T = pose_of(p.data(), wxyz.data());
  EXPECT_TRUE(T.translation().isApprox(Eigen::Vector3d(0.1, 0.2, 0.3), 1e-12));
  const Eigen::Quaterniond turn(1.6, 0.6, -0.4, 0.8);
  EXPECT_TRUE(T.linear().isApprox(turn.normalized().toRotationMatrix(), 1e-12));
}

TEST(RobotNames, ARobotMayBeTheFirstOfItsScene) {
  const Names robot("<mujoco><worldbody><body name='robot/base'/></worldbody></mujoco>");
  EXPECT_EQ(robot_base(*robot.scene.model), 1);
}

}  // namespace
}  // namespace vantage
