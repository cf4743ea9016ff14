#include "vantage/sim/robots/drive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/sim/test_world.hpp"

namespace vantage {
namespace {

using test::RobotWorld;

/// 3---2
/// |   |   1.5 m a side, counterclockwise, heading home at the end
/// 0---1
const std::vector<Pose2> kSquare = {
    {1.5, 0.0, 0.0}, {1.5, 1.5, 0.0}, {0.0, 1.5, 0.0}, {0.0, 0.0, std::numbers::pi / 2.0}};

struct DriveError {
  double distance_m;
  double yaw_rad;
};
DriveError error_between(const Pose2& a, const Pose2& b) {
  const Pose2 d = compose(inverse(a), b);
  return {std::hypot(d.x_m, d.y_m), std::abs(d.yaw_rad)};
}

bool is_at_rest(const RobotWorld& scene) {
  const Twist2 twist = scene.robot.twist(scene.world);
  return std::hypot(twist.vx_m_s, twist.vy_m_s) < 0.002;
}

Odometry perfect(const RobotWorld& scene) {
  return {OdometryOptions::perfect(), Rng(1), scene.robot.T_world_base(scene.world)};
}

TEST(Drive, RoundASquare) {
  RobotWorld scene;
  Odometry odometry = perfect(scene);
  const DriveResult result = drive(scene.world, scene.robot, odometry, kSquare);
  EXPECT_EQ(to_string(result.status), "arrived");
  const DriveError error = error_between(scene.robot.T_world_base(scene.world), kSquare.back());
  EXPECT_LT(error.distance_m, 0.01);
  EXPECT_LT(error.yaw_rad, 0.0105);
  EXPECT_TRUE(is_at_rest(scene));
  EXPECT_NEAR(result.path_length_m, 6.0, 0.2);
  EXPECT_LT(result.duration_s, 30.0);
  EXPECT_NEAR(result.duration_s, scene.world.time_s(), 1e-9);
}

TEST(Drive, StaysOnThePath) {
  RobotWorld scene;
  Odometry odometry = perfect(scene);
  const DrivePath path({}, kSquare);
  double max_depth_m = 0.0;
  drive(scene.world, scene.robot, odometry, kSquare, {}, [&](World&, const Pose2& base) {
    const Eigen::Vector2d p(base.x_m, base.y_m);
    max_depth_m =
        std::max(max_depth_m, (path.point(path.project(p, 0.0, path.length_m())) - p).norm());
    return true;
  });
  EXPECT_LT(max_depth_m, 0.03) << "it neither cuts corners nor overshoots";
}

TEST(Drive, NoisyOdometryArrivesWhereItBelievesToBe) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    RobotWorld scene;
    Odometry odometry({}, Rng::stream(seed, "odometry"), {});
    const DriveResult result = drive(scene.world, scene.robot, odometry, kSquare);
    EXPECT_EQ(result.status, DriveStatus::arrived);
    const DriveError believed = error_between(odometry.estimate(), kSquare.back());
    EXPECT_LT(believed.distance_m, 0.01);
    EXPECT_LT(believed.yaw_rad, 0.0105);
    const DriveError real = error_between(scene.robot.T_world_base(scene.world), kSquare.back());
    EXPECT_GT(real.distance_m, 0.005) << "dead reckoning drifts";
    EXPECT_LT(real.distance_m, 0.4);
    EXPECT_TRUE(is_at_rest(scene));
  }
}

TEST(Drive, TurnsInPlaceAndGoesNowhere) {
  RobotWorld scene;
  Odometry odometry = perfect(scene);
  const std::vector<Pose2> turn = {{0.0, 0.0, 2.5}};
  const DriveResult result = drive(scene.world, scene.robot, odometry, turn);
  EXPECT_EQ(result.status, DriveStatus::arrived);
  EXPECT_LT(error_between(scene.robot.T_world_base(scene.world), turn.back()).yaw_rad, 0.0105);
  EXPECT_LT(result.path_length_m, 0.05);
  EXPECT_EQ(drive(scene.world, scene.robot, odometry, {}).status, DriveStatus::arrived)
      << "an empty path";
}

TEST(Drive, StuckAgainstAWall) {
  RobotWorld scene("<geom name='wall' type='box' size='0.1 3 1' pos='1.1 0 1'/>");
  Odometry odometry = perfect(scene);
  const DriveResult result =
      drive(scene.world, scene.robot, odometry, std::vector<Pose2>{{3.0, 0.0, 0.0}});
  EXPECT_EQ(to_string(result.status), "stuck");
  EXPECT_LT(result.duration_s, 8.0);
  EXPECT_NEAR(scene.robot.T_world_base(scene.world).x_m, 1.0 - 0.334, 0.01);
  EXPECT_TRUE(is_at_rest(scene));
}

/// It leans there at a few centimetres a second.
TEST(Drive, AGoalJustInsideAWallEndsToo) {
  RobotWorld scene("<geom name='wall' type='box' size='0.1 3 1' pos='1.1 0 1'/>");
  Odometry odometry = perfect(scene);
  const DriveResult result =
      drive(scene.world, scene.robot, odometry, std::vector<Pose2>{{0.69, 0.0, 0.0}});
  EXPECT_EQ(to_string(result.status), "stuck");
  EXPECT_LT(result.duration_s, 6.0);
}

TEST(Drive, StopsWhenToldAndComesToRest) {
  RobotWorld scene;
  Odometry odometry = perfect(scene);
  const DriveResult result =
      drive(scene.world, scene.robot, odometry, std::vector<Pose2>{{4.0, 0.0, 0.0}}, {},
            [](World&, const Pose2& base) { return base.x_m < 1.0; });
  EXPECT_EQ(result.status, DriveStatus::stopped);
  EXPECT_NEAR(scene.robot.T_world_base(scene.world).x_m, 1.0, 0.3);
  EXPECT_TRUE(is_at_rest(scene));
}

TEST(Drive, TicksTheWorldsRecorder) {
  RobotWorld scene;
  Odometry odometry = perfect(scene);
  std::uint64_t ticks = 0;
  scene.world.on_tick = [&](World&) { ++ticks; };
  drive(scene.world, scene.robot, odometry, std::vector<Pose2>{{0.3, 0.0, 0.0}});
  hold_still(scene.world, scene.robot, odometry, 0.5);
  EXPECT_EQ(ticks, scene.world.ticks());
  EXPECT_NEAR(scene.world.time_s(), 0.025 * static_cast<double>(ticks), 1e-9);
}

TEST(Drive, SameSeedSameBits) {
  const auto run = [] {
    RobotWorld scene(
        "<body name='box' pos='1.5 0.8 .2'><freejoint/>"
        "<geom type='box' size='.1 .1 .2' mass='2'/></body>");
    Odometry odometry({}, Rng::stream(5, "odometry"), {});
    drive(scene.world, scene.robot, odometry, kSquare);
    return scene.world.state();
  };
  EXPECT_EQ(run(), run());
}

TEST(Drive, TakesTheTimeSinceItBegan) {
  RobotWorld scene;
  Odometry odometry = perfect(scene);
  hold_still(scene.world, scene.robot, odometry, 1.0);
  const double start_s = scene.world.time_s();
  ASSERT_GT(start_s, 0.9);
  const DriveResult result =
      drive(scene.world, scene.robot, odometry, std::vector<Pose2>{{0.3, 0.0, 0.0}});
  EXPECT_EQ(result.status, DriveStatus::arrived);
  EXPECT_NEAR(result.duration_s, scene.world.time_s() - start_s, 1e-9);
}

TEST(Drive, BrakingFromATurnLastsUntilItTurnsNoMore) {
  RobotWorld scene;
  Odometry odometry = perfect(scene);
  const DriveResult result =
      drive(scene.world, scene.robot, odometry, std::vector<Pose2>{{0.0, 0.0, 2.5}}, {},
            [](World& world, const Pose2&) { return world.time_s() < 1.0; });
  EXPECT_EQ(result.status, DriveStatus::stopped);
  EXPECT_LT(result.duration_s, 3.0);
  EXPECT_LT(std::abs(scene.robot.twist(scene.world).wz_rad_s) *
                scene.robot.footprint().circumscribed_radius_m,
            DriveOptions{}.rest_speed_m_s);
}

/// Where it ends that slides while it brakes at its goal.
DriveStatus status_after_sliding(double slide_m) {
  RobotWorld scene;
  Odometry odometry = perfect(scene);
  int ticks = 0;
  odometry.on_increment = [&ticks, slide_m](const Pose2&) {
    return ++ticks == 2 ? Pose2{slide_m, 0.0, 0.0} : Pose2{};
  };
  DriveOptions options;
  options.goal_tolerance_m = 0.1;
  return drive(scene.world, scene.robot, odometry, std::vector<Pose2>{{0.0, 0.0, 0.0}}, options,
               [](World& world, const Pose2&) { return world.time_s() < 0.5; })
      .status;
}

TEST(Drive, ItHasArrivedIfItIsWithinItsToleranceOnceItStands) {
  EXPECT_EQ(status_after_sliding(0.07), DriveStatus::arrived);
  EXPECT_EQ(status_after_sliding(0.15), DriveStatus::stopped);
}

}  // namespace
}  // namespace vantage
