#include "vantage/sim/robots/mobile_base.hpp"

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/sim/test_world.hpp"
#include "vantage/core/error.hpp"
#include "vantage/geometry/field_of_view.hpp"

namespace vantage {
namespace {

using test::RobotWorld;

const std::string kWallAhead = "<geom name='wall' type='box' size='0.1 3 1' pos='2.1 0 1'/>";

TEST(MobileBase, NeedsARobotInTheModel) {
  const test::SceneFolder folder(test::scene_mjcf(""));
  const World world(folder.alone());
  EXPECT_THROW(test::pr2(world), InputError);
}

TEST(MobileBase, ItsOutlineIsThatOfItsGeoms) {
  const RobotWorld scene;
  const FloorOutline& outline = scene.robot.outline();
  EXPECT_NEAR(inscribed_radius_m(outline), 0.334, 1e-3);
  EXPECT_GT(circumscribed_radius_m(outline), 0.274 * std::sqrt(2.0) + 0.06);
  EXPECT_LE(circumscribed_radius_m(outline), scene.robot.footprint().circumscribed_radius_m);

  MobileBaseDescription said = mobile_base_of(test::robot_folder("pr2"), "robot");
  said.footprint.outline_m = {{-0.4, -0.3}, {0.4, -0.3}, {0.4, 0.3}, {-0.4, 0.3}};
  const MobileBase other(scene.world.model(), said, "robot");
  EXPECT_NEAR(inscribed_radius_m(other.outline()), 0.3, 1e-12);
  EXPECT_NEAR(circumscribed_radius_m(other.outline()), 0.5, 1e-12);

  const test::SceneFolder folder(test::scene_mjcf(""));
  const World world({folder.path(), test::robot_folder("rover").mjcf});
  const MobileBase rover = test::mobile_base(world, test::robot_folder("rover"));
  EXPECT_NEAR(inscribed_radius_m(rover.outline()), 0.175, 1e-3);
  EXPECT_NEAR(circumscribed_radius_m(rover.outline()), 0.175, 2e-3);
}

TEST(MobileBase, MassAndFootprint) {
  const RobotWorld scene;
  const mjModel& m = scene.world.model();
  EXPECT_NEAR(m.body_subtreemass[scene.robot.base_body_id()], 200.0, 0.5);

  double reach_x_m = 0.0;
  double reach_y_m = 0.0;
  double lowest_m = 1.0;
  for (int geom = 0; geom < m.ngeom; ++geom) {
    if (m.geom_bodyid[geom] != scene.robot.base_body_id() || m.geom_conaffinity[geom] == 0)
      continue;
    const bool round = m.geom_type[geom] == mjGEOM_CYLINDER;
    const mjtNum* size = m.geom_size + 3 * geom;
    const mjtNum* pos = m.geom_pos + 3 * geom;
    reach_x_m = std::max(reach_x_m, std::abs(pos[0]) + size[0]);
    reach_y_m = std::max(reach_y_m, std::abs(pos[1]) + size[round ? 0 : 1]);
    lowest_m = std::min(lowest_m, pos[2] - size[round ? 1 : 2]);
  }
  EXPECT_NEAR(2.0 * reach_x_m, 0.668, 1e-6);
  EXPECT_NEAR(2.0 * reach_y_m, 0.668, 1e-6);
  EXPECT_GE(lowest_m, 0.02);
  EXPECT_LE(lowest_m, 0.03);
}

TEST(MobileBase, SensorsAreWhereTheyShouldBe) {
  for (const double torso_m : {0.0, 0.33}) {
    RobotWorld scene("", {1.0, 2.0, 0.5}, torso_m);
    const Pose T_world_base = to_se3(scene.robot.T_world_base(scene.world));
    const Pose T_base_laser = T_world_base.inverse() * scene.robot.T_world_laser(scene.world);
    EXPECT_TRUE(T_base_laser.isApprox(scene.robot.T_base_laser_mount(scene.world), 1e-9));
    EXPECT_NEAR(T_base_laser.translation().z(), 1.05 + torso_m, 1e-9);
    EXPECT_NEAR(T_base_laser.translation().x(), 0.12, 1e-9);
    const Pose T_base_scan = T_world_base.inverse() * scene.robot.T_world_base_scan(scene.world);
    EXPECT_TRUE(T_base_scan.isApprox(
        to_se3(scene.robot.T_base_base_scan(), scene.robot.base_scan_height_m()), 1e-9));
    EXPECT_NEAR(scene.robot.base_scan_height_m(), 0.25, 1e-9);
    const mjData& now = scene.world.snapshot();
    EXPECT_NEAR(now.cam_xpos[3 * scene.robot.camera_id() + 2], 1.47 + torso_m, 0.01);
  }
}

TEST(MobileBase, LaserTiltsDownForPositiveAngles) {
  RobotWorld scene;
  scene.robot.command_laser_tilt(scene.world, 0.6);
  scene.run(1.0);
  EXPECT_NEAR(scene.robot.laser_tilt_rad(scene.world), 0.6, 1e-3);
  const Pose T_world_laser = scene.robot.T_world_laser(scene.world);
  EXPECT_TRUE(T_world_laser.linear().col(0).isApprox(beam_direction({0.0, 0.6}), 2e-3));
  EXPECT_TRUE(T_world_laser.translation().isApprox(Eigen::Vector3d(0.12, 0.0, 1.05), 1e-3));
}

TEST(MobileBase, LaserFollowsASweepEvenly) {
  RobotWorld scene;
  constexpr double kSpeed_rad_s = 0.1;
  scene.robot.command_laser_tilt(scene.world, -0.4);
  scene.run(1.0);
  double slowest = 1.0;
  double fastest = 0.0;
  for (int tick = 0; tick < 400; ++tick) {
    const double target_rad = -0.4 + kSpeed_rad_s * 0.025 * (tick + 1);
    const double before_rad = scene.robot.laser_tilt_rad(scene.world);
    scene.robot.command_laser_tilt(scene.world, target_rad);
    scene.world.advance_tick();
    const double now_rad = scene.robot.laser_tilt_rad(scene.world);
    EXPECT_NEAR(now_rad, target_rad, 0.01);
    if (tick < 20) continue;
    slowest = std::min(slowest, (now_rad - before_rad) / 0.025);
    fastest = std::max(fastest, (now_rad - before_rad) / 0.025);
  }
  EXPECT_NEAR(slowest, kSpeed_rad_s, 0.002);
  EXPECT_NEAR(fastest, kSpeed_rad_s, 0.002);
}

/// First geom of the robot that a ray meets, "" if none; geoms of `without_body` do not count.
std::string blocked_by(const mjModel& m, const mjData& data, const Eigen::Vector3d& p,
                       const Eigen::Vector3d& direction, int without_body) {
  int geom = -1;
  mj_ray(&m, &data, p.data(), direction.data(), nullptr, 1, without_body, &geom);
  if (geom < 0) return "";
  const std::string body = model_name(m, ModelObject::body, m.geom_bodyid[geom]);
  return body.starts_with("robot/") ? body + " geom " + std::to_string(geom) : "";
}

TEST(MobileBase, NothingOfItsOwnIsInTheLasersView) {
  for (const double torso_m : {0.0, 0.33}) {
    RobotWorld scene("", {}, torso_m);
    const mjData& now = scene.world.snapshot();
    const Pose T_world_laser = scene.robot.T_world_laser(scene.world);
    for (double tilt_rad = -0.45; tilt_rad <= 0.9; tilt_rad += 0.05) {
      for (double azimuth_deg = -60.0; azimuth_deg <= 60.0; azimuth_deg += 1.0) {
        const Eigen::Vector3d direction =
            T_world_laser.linear() *
            beam_direction({azimuth_deg * std::numbers::pi / 180.0, tilt_rad});
        ASSERT_EQ(blocked_by(scene.world.model(), now, T_world_laser.translation(), direction,
                             scene.robot.laser_body_id()),
                  "")
            << "torso " << torso_m << " tilt " << tilt_rad << " azimuth " << azimuth_deg;
      }
    }
  }
}

TEST(MobileBase, BaseScannerSees270Degrees) {
  RobotWorld scene;
  const mjData& now = scene.world.snapshot();
  const Pose T_world_scan = scene.robot.T_world_base_scan(scene.world);
  for (double azimuth_deg = -135.0; azimuth_deg <= 135.0; azimuth_deg += 1.0) {
    const Eigen::Vector3d direction =
        T_world_scan.linear() * beam_direction({azimuth_deg * std::numbers::pi / 180.0, 0.0});
    // From outside the scanner's own case, so that no body has to be left out.
    const Eigen::Vector3d p = T_world_scan.translation() + 0.035 * direction;
    ASSERT_EQ(blocked_by(scene.world.model(), now, p, direction, -1), "") << azimuth_deg;
  }
}

TEST(MobileBase, KeepsTheSpeedItIsAskedFor) {
  for (const Twist2 asked :
       {Twist2{0.6, 0.0, 0.0}, Twist2{0.0, -0.4, 0.0}, Twist2{0.3, 0.3, 0.0}}) {
    RobotWorld scene("", {0.0, 0.0, 0.7});
    for (int i = 0; i < 120; ++i) {
      scene.robot.command_twist(scene.world, asked);
      scene.world.advance_tick();
    }
    const Twist2 real = scene.robot.twist(scene.world);
    EXPECT_NEAR(real.vx_m_s, asked.vx_m_s, 1e-3);
    EXPECT_NEAR(real.vy_m_s, asked.vy_m_s, 1e-3);
    EXPECT_NEAR(real.wz_rad_s, 0.0, 1e-3);
  }
}

TEST(MobileBase, SpeedIsCappedAlongTheDirectionAskedFor) {
  RobotWorld scene;
  scene.robot.command_twist(scene.world, {3.0, 4.0, 0.0});
  EXPECT_NEAR(scene.world.controls()[0], 0.6, 1e-12);
  EXPECT_NEAR(scene.world.controls()[1], 0.8, 1e-12);
}

TEST(MobileBase, TurnsInPlace) {
  RobotWorld scene;
  scene.robot.command_twist(scene.world, {0.0, 0.0, 0.8});
  scene.run(4.0);
  EXPECT_NEAR(scene.robot.twist(scene.world).wz_rad_s, 0.8, 0.005);
  const Pose2 pose = scene.robot.T_world_base(scene.world);
  EXPECT_LT(std::hypot(pose.x_m, pose.y_m), 0.02);
}

TEST(MobileBase, TorsoMovesSlowlyAndHoldsItsHeight) {
  RobotWorld scene;
  scene.run(1.0);
  EXPECT_NEAR(scene.robot.lift_m(scene.world), 0.0, 1e-3);
  scene.robot.command_lift(scene.world, 0.33);
  scene.run(2.0);
  const double early_m = scene.robot.lift_m(scene.world);
  scene.run(10.0);
  EXPECT_NEAR((scene.robot.lift_m(scene.world) - early_m) / 10.0, 0.013, 5e-4);
  scene.run(18.0);
  EXPECT_NEAR(scene.robot.lift_m(scene.world), 0.33, 1e-3);
  scene.robot.command_lift(scene.world, 0.2);
  scene.run(5.0);
  EXPECT_NEAR(0.33 - scene.robot.lift_m(scene.world), 5.0 * 0.013, 3e-3);
  scene.run(10.0);
  EXPECT_NEAR(scene.robot.lift_m(scene.world), 0.2, 1e-3);
}

TEST(MobileBase, StandsAndDrivesWithAnyIntegratorOfTheScene) {
  for (const char* integrator : {"Euler", "RK4", "implicit"}) {
    const test::SceneFolder folder("<mujoco><option integrator='" + std::string(integrator) +
                                   "'/><worldbody><geom type='plane' size='5 5 1'/></worldbody>"
                                   "</mujoco>");
    World world(folder.with_pr2());
    const MobileBase robot = test::pr2(world);
    robot.place(world, {}, 0.2);
    robot.command_twist(world, {0.4, 0.0, 0.3});
    robot.command_head(world, 1.0, 1.0);
    robot.command_laser_tilt(world, 0.7);
    for (int tick = 0; tick < 120; ++tick) ASSERT_NO_THROW(world.advance_tick()) << integrator;
    EXPECT_NEAR(robot.lift_m(world), 0.2, 1e-3) << integrator;
    EXPECT_NEAR(robot.head_tilt_rad(world), 1.0, 0.01) << integrator;
    EXPECT_NEAR(robot.laser_tilt_rad(world), 0.7, 1e-3) << integrator;
  }
}

TEST(MobileBase, HeadReachesItsLimits) {
  RobotWorld scene;
  scene.robot.command_head(scene.world, 2.86, 1.40);
  scene.run(4.0);
  EXPECT_NEAR(scene.robot.head_pan_rad(scene.world), 2.86, 0.01);
  EXPECT_NEAR(scene.robot.head_tilt_rad(scene.world), 1.40, 0.01);
  scene.robot.command_head(scene.world, -9.0, -9.0);
  scene.run(5.0);
  EXPECT_NEAR(scene.robot.head_pan_rad(scene.world), -2.86, 0.01);
  EXPECT_NEAR(scene.robot.head_tilt_rad(scene.world), -0.47, 0.01);
}

TEST(MobileBase, AWallStopsItsFootprintWithoutMuchPenetration) {
  const std::vector<Twist2> ways = {{0.6, 0, 0}, {-0.6, 0, 0}, {0, 0.6, 0}, {0, -0.6, 0}};
  for (const Twist2& way : ways) {
    // Turned so that this side of the robot meets the wall.
    RobotWorld scene(kWallAhead, {1.0, 0.0, -std::atan2(way.vy_m_s, way.vx_m_s)});
    double deepest_m = -1.0;
    for (int tick = 0; tick < 200; ++tick) {
      scene.robot.command_twist(scene.world, way);
      scene.world.advance_tick();
      deepest_m = std::max(deepest_m, scene.robot.T_world_base(scene.world).x_m + 0.334 - 2.0);
    }
    EXPECT_GT(deepest_m, 0.0) << "no part of it sticks out of the footprint";
    EXPECT_LT(deepest_m, 0.003);
    EXPECT_GT(scene.robot.contacts(scene.world), 0);
    EXPECT_EQ(scene.robot.touched_geoms(scene.world),
              std::vector<int>{model_id(scene.world.model(), ModelObject::geom, "wall")});
  }
}

// Top view, the table 0.55 m from the base's centre:     |  table
//                                                  (o)   |
TEST(MobileBase, TurnsInPlaceBesideATable) {
  RobotWorld scene(
      "<geom name='table' type='box' size='0.5 1 0.36' pos='1.05 0 0.36'/>"
      "<geom name='other' type='box' size='0.5 1 0.36' pos='-1.05 0 0.36'/>");
  int contacts = 0;
  for (int tick = 0; tick < 400; ++tick) {
    scene.robot.command_twist(scene.world, {0.0, 0.0, 0.8});
    scene.world.advance_tick();
    contacts += scene.robot.contacts(scene.world);
  }
  EXPECT_EQ(contacts, 0);
}

TEST(MobileBase, ItsOwnPartsDoNotTouchEachOtherOrTheFloor) {
  RobotWorld scene;
  scene.robot.command_head(scene.world, 1.0, 1.4);
  scene.robot.command_twist(scene.world, {0.3, 0.1, 0.4});
  scene.run(2.0);
  EXPECT_EQ(scene.world.data().ncon, 0);
}

TEST(MobileBase, ArmsGiveWayAndComeBack) {
  RobotWorld scene;
  const mjModel& m = scene.world.model();
  const int joint = model_id(m, ModelObject::joint, "robot/l_shoulder_pan");
  scene.world.data().qfrc_applied[m.jnt_dofadr[joint]] = 40.0;
  scene.run(2.0);
  EXPECT_GT(scene.world.data().qpos[m.jnt_qposadr[joint]], 0.2);
  scene.world.data().qfrc_applied[m.jnt_dofadr[joint]] = 0.0;
  scene.run(4.0);
  EXPECT_NEAR(scene.world.data().qpos[m.jnt_qposadr[joint]], 0.0, 0.01);
}

TEST(MobileBase, BaseForLaserPutsTheLaserThere) {
  const Pose T_world_sensor = make_pose({1.3, -0.4, 1.2}, 2.1);
  RobotWorld measured;
  const Pose2 T_world_base = measured.robot.base_for_laser(T_world_sensor);
  RobotWorld scene("", T_world_base, 0.15);
  EXPECT_TRUE(scene.robot.T_world_laser(scene.world).isApprox(T_world_sensor, 1e-9));
}

TEST(MobileBase, ItsSensorsHangOnTheJointsThatMoveThem) {
  const RobotWorld scene("<camera name='aside'/><site name='aside'/>");
  const auto refused = [&](const std::function<void(MobileBaseDescription&)>& change) {
    MobileBaseDescription said = mobile_base_of(test::robot_folder("pr2"), "robot");
    change(said);
    return test::message_of<InputError>([&] { MobileBase(scene.world.model(), said, "pr2"); });
  };
  EXPECT_EQ(refused([](MobileBaseDescription&) {}), "");
  EXPECT_EQ(refused([](MobileBaseDescription& said) { said.planar_scanner = "aside"; }),
            "pr2: planar_scanner: it is no part of body 'robot/base'");
  EXPECT_EQ(refused([](MobileBaseDescription& said) { said.head->pan = "robot/base_yaw"; }),
            "pr2: head.pan: it is no part of body 'robot/torso'");
  EXPECT_EQ(refused([](MobileBaseDescription& said) { said.head->tilt = "robot/laser_tilt"; }),
            "pr2: head.tilt: it is no part of body 'robot/head_pan'");
  EXPECT_EQ(refused([](MobileBaseDescription& said) { said.head->camera = "aside"; }),
            "pr2: head.camera: it is no part of body 'robot/head_tilt'");
  EXPECT_EQ(
      refused([](MobileBaseDescription& said) { said.tilting_laser->site = "robot/base_scan"; }),
      "pr2: tilting_laser.site: it is no part of body 'robot/laser_tilt'");
}

}  // namespace
}  // namespace vantage
