// A small robot that rolls on its wheels: what moves it is friction.
#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/sim/test_world.hpp"
#include "vantage/geometry/field_of_view.hpp"
#include "vantage/sim/robots/drive.hpp"
#include "vantage/sim/sensors/ray_scene.hpp"
#include "vantage/sim/world/collision_surfaces.hpp"
#include "vantage/sim/world/mesh_surface.hpp"

namespace vantage {
namespace {

using test::RoverWorld;

const std::string kNearWall = "<geom name='wall' type='box' size='0.1 3 1' pos='1.1 0 1'/>";

Odometry perfect(const RoverWorld& scene) {
  return {OdometryOptions::perfect(), Rng(1), scene.robot.T_world_base(scene.world)};
}

/// Of the base's z axis from the vertical.
double tilt_rad(const RoverWorld& scene) {
  const Pose T = body_pose(scene.world, scene.robot.base_body_id());
  return std::acos(std::min(1.0, T.linear().col(2).z()));
}

TEST(Rover, StandsLevelAndTouchesNothing) {
  RoverWorld scene("", {0.3, -0.2, 1.0});
  scene.run(2.0);
  const Pose2 pose = scene.robot.T_world_base(scene.world);
  EXPECT_NEAR(pose.x_m, 0.3, 1e-4);
  EXPECT_NEAR(pose.y_m, -0.2, 1e-4);
  EXPECT_NEAR(pose.yaw_rad, 1.0, 1e-4);
  EXPECT_LT(tilt_rad(scene), 1e-3);
  EXPECT_NEAR(body_pose(scene.world, scene.robot.base_body_id()).translation().z(), 0.0, 2e-4);
  EXPECT_EQ(scene.robot.contacts(scene.world), 0) << "the floor does not count";
  EXPECT_GT(scene.world.data().ncon, 0) << "though it carries the robot";
  EXPECT_TRUE(scene.robot.touched_by_turning(scene.world).empty());
}

TEST(Rover, FitsItsFootprint) {
  const RoverWorld scene;
  const mjData& now = scene.world.snapshot();
  const Footprint& footprint = scene.robot.footprint();
  double reach_m = 0.0;
  for (const SurfacePoint& point : collision_surfaces(scene.world).robot) {
    const Eigen::Vector3d p = T_world_geom(now, point.geom_id) * point.p_geom_m;
    reach_m = std::max(reach_m, p.head<2>().norm());
  }
  EXPECT_LE(reach_m, footprint.circumscribed_radius_m);
  EXPECT_GE(reach_m, footprint.inscribed_radius_m);
  EXPECT_NEAR(2.0 * reach_m, 0.35, 0.01);
}

TEST(Rover, RollsAsFastAsItsWheelsTurn) {
  RoverWorld scene;
  for (int i = 0; i < 40; ++i) {
    scene.robot.command_twist(scene.world, {0.4 * (i + 1) / 40, 0.0, 0.0});
    scene.run(0.025);
  }
  scene.run(1.0);
  const Twist2 twist = scene.robot.twist(scene.world);
  EXPECT_NEAR(twist.vx_m_s, 0.4, 0.005);
  EXPECT_NEAR(twist.vy_m_s, 0.0, 1e-3);
  EXPECT_NEAR(twist.wz_rad_s, 0.0, 1e-3);
  EXPECT_LT(tilt_rad(scene), 2e-3);
}

TEST(Rover, DoesNotMoveWhereTheFloorIsTooSmooth) {
  // Friction of the robot's own geoms wins unless the floor's priority is higher.
  const test::SceneFolder folder(
      "<mujoco><worldbody><geom name='ice' type='plane' size='9 9 1' priority='2' "
      "friction='0.001 0 0'/></worldbody></mujoco>");
  const RobotFolder rover = test::robot_folder("rover");
  World world({folder.path(), rover.mjcf});
  const MobileBase robot = test::mobile_base(world, rover);
  robot.place(world, {});
  robot.command_twist(world, {0.4, 0.0, 0.0});
  for (int i = 0; i < 40; ++i) world.advance_tick();
  EXPECT_LT(robot.twist(world).vx_m_s, 0.1) << "the wheels spin";
}

TEST(Rover, TurnsInPlace) {
  RoverWorld scene;
  scene.robot.command_twist(scene.world, {0.0, 0.0, 0.8});
  scene.run(3.0);
  EXPECT_NEAR(scene.robot.twist(scene.world).wz_rad_s, 0.8, 0.01);
  const Pose2 pose = scene.robot.T_world_base(scene.world);
  EXPECT_NEAR(pose.yaw_rad, 2.4, 0.05);
  EXPECT_LT(std::hypot(pose.x_m, pose.y_m), 0.005);
}

TEST(Rover, CannotGoSideways) {
  RoverWorld scene;
  scene.robot.command_twist(scene.world, {0.0, 0.5, 0.0});
  scene.run(1.0);
  EXPECT_NEAR(scene.robot.T_world_base(scene.world).y_m, 0.0, 1e-3);
  EXPECT_FALSE(scene.robot.is_holonomic());
}

TEST(Rover, SensorsAreWhereTheyShouldBe) {
  RoverWorld scene("", {1.0, 2.0, 0.5});
  const Pose T_world_base = to_se3(scene.robot.T_world_base(scene.world));
  const Pose T_base_laser = T_world_base.inverse() * scene.robot.T_world_laser(scene.world);
  EXPECT_TRUE(T_base_laser.isApprox(scene.robot.T_base_laser_mount(scene.world), 1e-9));
  EXPECT_NEAR(T_base_laser.translation().z(), 1.05, 1e-9);
  const Pose T_base_scan = T_world_base.inverse() * scene.robot.T_world_base_scan(scene.world);
  EXPECT_TRUE(T_base_scan.isApprox(
      to_se3(scene.robot.T_base_base_scan(), scene.robot.base_scan_height_m()), 1e-9));
  EXPECT_NEAR(scene.robot.base_scan_height_m(), 0.17, 1e-9);
  const mjData& now = scene.world.snapshot();
  EXPECT_NEAR(now.cam_xpos[3 * scene.robot.camera_id() + 2], 1.2, 0.01);
  EXPECT_EQ(scene.robot.lift_max_m(), 0.0);
  EXPECT_EQ(scene.robot.lift_m(scene.world), 0.0);
}

TEST(Rover, TheHeadLooksRoundWithoutTurningTheBase) {
  RoverWorld scene;
  scene.run(0.5);
  for (const double pan_rad : {-2.79, -1.4, 0.0, 1.4, 2.79}) {
    scene.robot.command_head(scene.world, pan_rad, 0.7);
    scene.run(2.5);
    EXPECT_NEAR(scene.robot.head_pan_rad(scene.world), pan_rad, 2e-3);
    EXPECT_NEAR(scene.robot.head_tilt_rad(scene.world), 0.7, 5e-3);
    EXPECT_NEAR(scene.robot.T_world_base(scene.world).yaw_rad, 0.0, 2e-3);
  }
}

TEST(Rover, LaserFollowsASweepEvenly) {
  RoverWorld scene;
  scene.robot.command_laser_tilt(scene.world, -0.36);
  scene.run(1.0);
  for (int tick = 0; tick < 600; ++tick) {
    const double target_rad = -0.36 + 0.065 * 0.025 * (tick + 1);
    scene.robot.command_laser_tilt(scene.world, target_rad);
    scene.world.advance_tick();
    EXPECT_NEAR(scene.robot.laser_tilt_rad(scene.world), target_rad, 0.01);
  }
  EXPECT_TRUE(scene.robot.T_world_laser(scene.world)
                  .linear()
                  .col(0)
                  .isApprox(beam_direction({0.0, scene.robot.laser_tilt_rad(scene.world)}), 2e-3));
}

TEST(Rover, ItsScannersSeePastIt) {
  RoverWorld scene;
  const RayScene geometry(scene.world.model(), scene.world.snapshot());
  const Pose T_world_scan = scene.robot.T_world_base_scan(scene.world);
  for (double azimuth_rad = -0.75 * std::numbers::pi; azimuth_rad <= 0.75 * std::numbers::pi;
       azimuth_rad += 0.01) {
    const Eigen::Vector3d d(std::cos(azimuth_rad), std::sin(azimuth_rad), 0.0);
    // From outside its own case.
    ASSERT_FALSE(geometry.cast(T_world_scan.translation() + 0.04 * d, d, 2.0).hit()) << azimuth_rad;
  }
  for (double tilt = -0.45; tilt <= 0.9; tilt += 0.05) {
    for (double azimuth = -0.6; azimuth <= 0.6; azimuth += 0.02) {
      const RayHit hit =
          geometry.cast(scene.robot.T_world_laser(scene.world).translation(),
                        beam_direction({azimuth, tilt}), 1.0, scene.robot.laser_body_id());
      ASSERT_FALSE(hit.hit()) << azimuth << " " << tilt;
    }
  }
}

TEST(Rover, DrivesRoundASquareAndComesToRest) {
  const std::vector<Pose2> square = {
      {1.5, 0.0, 0.0}, {1.5, 1.5, 0.0}, {0.0, 1.5, 0.0}, {0.0, 0.0, std::numbers::pi / 2.0}};
  for (const double timestep_s : {0.0025, 0.005}) {
    RoverWorld scene("", {}, {.timestep_s = timestep_s});
    Odometry odometry = perfect(scene);
    const DrivePath path({}, square);
    double farthest_m = 0.0;
    const DriveResult result =
        drive(scene.world, scene.robot, odometry, square, {}, [&](World&, const Pose2& base) {
          const Eigen::Vector2d p(base.x_m, base.y_m);
          farthest_m =
              std::max(farthest_m, (path.point(path.project(p, 0.0, path.length_m())) - p).norm());
          return true;
        });
    EXPECT_EQ(to_string(result.status), "arrived");
    const Pose2 error = compose(inverse(scene.robot.T_world_base(scene.world)), square.back());
    EXPECT_LT(std::hypot(error.x_m, error.y_m), 0.01);
    EXPECT_LT(std::abs(error.yaw_rad), 0.0105);
    EXPECT_LT(farthest_m, 0.04);
    EXPECT_LT(result.duration_s, 32.0);
    EXPECT_LT(std::hypot(scene.robot.twist(scene.world).vx_m_s, 0.0), 0.002);
  }
}

TEST(Rover, AWallStopsItAndIsACollision) {
  RoverWorld scene(kNearWall);
  Odometry odometry = perfect(scene);
  CollisionCounter counter;
  scene.world.on_step = [&](const World& world) { counter.update(scene.robot, world); };
  const DriveResult result =
      drive(scene.world, scene.robot, odometry, std::vector<Pose2>{{3.0, 0.0, 0.0}});
  EXPECT_EQ(to_string(result.status), "stuck");
  EXPECT_NEAR(scene.robot.T_world_base(scene.world).x_m, 1.0 - 0.176, 0.02);
  EXPECT_EQ(counter.count(), 1);
  EXPECT_LT(tilt_rad(scene), 0.05) << "it does not climb";
}

TEST(Rover, WheelsThatRunIntoSomethingCount) {
  RoverWorld scene("<geom name='step' type='box' size='0.1 3 0.02' pos='1.1 0 0.02'/>");
  CollisionCounter counter;
  scene.world.on_step = [&](const World& world) { counter.update(scene.robot, world); };
  scene.robot.command_twist(scene.world, {0.3, 0.0, 0.0});
  scene.run(5.0);
  EXPECT_GE(counter.count(), 1) << "casters and shell meet a step of 4 cm";
}

TEST(Rover, SameSeedSameBits) {
  const auto run = [] {
    RoverWorld scene;
    Odometry odometry({}, Rng::stream(5, "odometry"), {});
    drive(scene.world, scene.robot, odometry, std::vector<Pose2>{{1.0, 0.3, 0.0}, {0.2, 0.9, 1.0}});
    return scene.world.state();
  };
  EXPECT_EQ(run(), run());
}

const std::string kBallBeside = "<body pos='5 0 1'><freejoint/><geom size='.1'/></body>";

TEST(Rover, IsWhereItIsWhateverMovesBesideIt) {
  RoverWorld scene(kBallBeside, {1.0, 2.0, 0.5});
  ASSERT_EQ(scene.world.model().body_dofadr[scene.robot.base_body_id()], 6);
  for (int i = 0; i < scene.world.model().nv; ++i) scene.world.data().qvel[i] = 0.25 * i;
  const Pose2 pose = scene.robot.T_world_base(scene.world);
  EXPECT_NEAR(pose.x_m, 1.0, 1e-12);
  EXPECT_NEAR(pose.y_m, 2.0, 1e-12);
  EXPECT_NEAR(pose.yaw_rad, 0.5, 1e-12);
  const Twist2 twist = scene.robot.twist(scene.world);
  EXPECT_NEAR(twist.vx_m_s, 1.5 * std::cos(0.5) + 1.75 * std::sin(0.5), 1e-12);
  EXPECT_NEAR(twist.vy_m_s, 1.75 * std::cos(0.5) - 1.5 * std::sin(0.5), 1e-12);
  EXPECT_EQ(twist.wz_rad_s, 2.75);
}

TEST(Rover, TurningTouchesWhatABeamReaches) {
  const RobotFolder rover = test::robot_folder("rover");
  std::string mjcf = read_file(rover.mjcf);
  mjcf.insert(mjcf.find("<!-- Mast. -->"), "<geom pos='.3 0 .6' size='.1 .01 .01'/>");
  const test::SceneFolder folder(
      test::scene_mjcf(kBallBeside +
                       "<geom name='post' type='box' size='.03 .03 1' pos='1 2.4 1'/>"
                       "<geom name='other' type='box' size='.03 .03 1' pos='1 2.45 1'/>"));
  folder.add("robot.xml", mjcf);
  World world({folder.path(), folder.path().parent_path() / "robot.xml"});
  const MobileBase robot = test::mobile_base(world, rover);
  robot.place(world, {1.0, 2.0, 0.0});
  EXPECT_EQ(robot.touched_by_turning(world),
            std::vector<int>{model_id(world.model(), ModelObject::geom, "post")});
}

/// Posts of a centimetre where its beam points after 19 and 24 steps, and between two steps.
TEST(Rover, TurningTouchesWhatIsThereEvery15Degrees) {
  const RobotFolder rover = test::robot_folder("rover");
  std::string mjcf = read_file(rover.mjcf);
  mjcf.insert(mjcf.find("<!-- Mast. -->"), "<geom pos='.3 0 .6' size='.1 .01 .01'/>");
  std::string posts;
  for (const double heading_deg : {285.0, 0.0, 52.5}) {
    const double heading_rad = heading_deg * std::numbers::pi / 180.0;
    posts += "<geom type='box' size='.005 .005 1' pos='" +
             std::to_string(1.0 + 0.37 * std::cos(heading_rad)) + " " +
             std::to_string(2.0 + 0.37 * std::sin(heading_rad)) + " 1'/>";
  }
  const test::SceneFolder folder(test::scene_mjcf(posts));
  folder.add("robot.xml", mjcf);
  World world({folder.path(), folder.path().parent_path() / "robot.xml"});
  const MobileBase robot = test::mobile_base(world, rover);
  robot.place(world, {1.0, 2.0, 0.0});
  EXPECT_EQ(robot.touched_by_turning(world), (std::vector<int>{1, 2})) << "0 is the floor";
}

TEST(Rover, ItHeadsWhereItsFrontPointsHoweverItLeans) {
  RoverWorld scene;
  const mjModel& model = scene.world.model();
  const int joint = model.body_jntadr[scene.robot.base_body_id()];
  mjtNum* q = scene.world.data().qpos + model.jnt_qposadr[joint] + 3;
  const Eigen::Quaterniond lean(0.8, 0.3, -0.2, 0.4);
  const std::array<double, 4> wxyz{lean.w(), lean.x(), lean.y(), lean.z()};
  std::copy(wxyz.begin(), wxyz.end(), q);
  const Eigen::Vector3d front = lean.normalized() * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(scene.robot.T_world_base(scene.world).yaw_rad, std::atan2(front.y(), front.x()),
              1e-12);
}

}  // namespace
}  // namespace vantage
