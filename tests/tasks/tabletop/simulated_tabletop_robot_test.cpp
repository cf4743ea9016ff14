// The simulated robot of a table top by itself: where it starts, what it observes, how it drives.
#include "vantage/tasks/tabletop/simulated_tabletop_robot.hpp"

#include <gmock/gmock.h>

#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/tasks/tabletop/own_scene.hpp"
#include "vantage/core/log.hpp"
#include "vantage/tasks/episode.hpp"

namespace vantage {
namespace {

using support::kWalls;
using support::OwnScene;
using support::table_at;
using testing::HasSubstr;

const std::string kTableAndWalls = table_at(0.0, 0.0, 0.72, 0.5, 0.5) + kWalls;

/// That a test may push.
struct PushedTabletopRobot : SimulatedTabletopRobot {
  using SimulatedTabletopRobot::SimulatedTabletopRobot;
  void push() { base_.robot().command_twist(base_.world(), {0.5, 0.0, 0.0}); }
};

class TabletopRobot : public testing::Test {
 protected:
  static ResolvedEpisode episode(const OwnScene& scene, std::vector<std::string> more) {
    set_verbosity(Verbosity::quiet);
    more.push_back(scene.set());
    return load_episode(VANTAGE_SOURCE_DIR "/assets/episodes/tabletop.yaml", more);
  }
  static void expect_same(const Pose2& a, const Pose2& b, double within) {
    EXPECT_NEAR(a.x_m, b.x_m, within);
    EXPECT_NEAR(a.y_m, b.y_m, within);
    EXPECT_NEAR(wrap_angle(a.yaw_rad - b.yaw_rad), 0.0, within);
  }
};

/// Of eight positions the fourth is at 135 degrees; the laser looks at the middle whatever the
/// offsets of the views.
TEST_F(TabletopRobot, StartsBehindAPositionOfTheRing) {
  const OwnScene scene(kTableAndWalls);
  const ResolvedEpisode resolved =
      episode(scene, {"candidates.positions=8", "candidates.yaw_offsets_rad=[-0.2,0.1]",
                      "robot.start_view=3", "robot.start_behind_m=0.2"});
  const SimulatedTabletopRobot robot(resolved.setup, std::get<Tabletop>(resolved.task));
  EXPECT_THAT(robot.start_notes(), testing::IsEmpty());
  const Pose sensor = robot.estimated_sensor();
  const double along_m = 1.4 * std::numbers::sqrt2 / 2.0;
  EXPECT_NEAR(sensor.translation().x(), -along_m, 1e-3);
  EXPECT_NEAR(sensor.translation().y(), along_m, 1e-3);
  EXPECT_NEAR(sensor.translation().z(), 1.05, 2e-3);
  EXPECT_NEAR(project_to_se2(sensor).yaw_rad, -0.25 * std::numbers::pi, 1e-3);
  expect_same(robot.estimated_base(), robot.ground_truth().T_world_base(), 1e-9);
  expect_same(robot.base_for_sensor(sensor), robot.estimated_base(), 1e-9);
  EXPECT_EQ(robot.energy_used_j(), 0.0);
}

TEST_F(TabletopRobot, LiftsItsLaserToTheHeightOfTheViews) {
  const OwnScene scene(kTableAndWalls);
  const ResolvedEpisode resolved =
      episode(scene, {"candidates.height_m=1.25", "laser.scan_duration_s=1"});
  SimulatedTabletopRobot robot(resolved.setup, std::get<Tabletop>(resolved.task));
  EXPECT_NEAR(robot.estimated_sensor().translation().z(), 1.25, 5e-3);
  robot.observe();
  EXPECT_NEAR(robot.estimated_sensor().translation().z(), 1.25, 5e-3) << "it stays there";
}

/// 20 ticks of 25 ms to come to rest, then a line at both ends of each of 120 ticks.
TEST_F(TabletopRobot, SweepsItsLaserOnceWhileItStands) {
  const OwnScene scene(kTableAndWalls);
  const ResolvedEpisode resolved = episode(scene, {"laser.scan_duration_s=3"});
  PushedTabletopRobot robot(resolved.setup, std::get<Tabletop>(resolved.task));
  const Pose2 before = robot.ground_truth().T_world_base();
  const double before_s = robot.time_s();
  robot.push();
  const TabletopObservation seen = robot.observe();
  expect_same(robot.ground_truth().T_world_base(), before, 0.01);
  EXPECT_NEAR(robot.time_s() - before_s, 0.025 * (20 + 121), 1e-6);
  ASSERT_FALSE(seen.scan.tilt_rad.empty());
  EXPECT_NEAR(static_cast<double>(seen.scan.tilt_rad.size()), 121.0, 2.0);
  EXPECT_NEAR(seen.scan.tilt_rad.front(), -0.36, 0.02);
  EXPECT_NEAR(seen.scan.tilt_rad.back(), 0.62, 0.04);
  EXPECT_NEAR(seen.scan.tilt_rad[60], 0.13, 0.04) << "evenly";
  EXPECT_EQ(seen.scan.field_of_view.tilt_max_rad, robot.view_field().tilt_max_rad);
  EXPECT_EQ(seen.base_scan_height_m, robot.base_scan_height_m());
  EXPECT_GT(seen.base_scan_height_m, 0.05);
  expect_same(seen.T_world_base_odometry, robot.estimated_base(), 0.0);
  const Pose sensor = to_se3(seen.T_world_base_odometry) * seen.T_base_laser;
  EXPECT_TRUE(sensor.isApprox(robot.estimated_sensor(), 1e-9));
}

TEST_F(TabletopRobot, RemembersWhatItsWheelsSayThroughCorrections) {
  const OwnScene scene(kTableAndWalls);
  const ResolvedEpisode resolved = episode(scene, {});
  SimulatedTabletopRobot robot(resolved.setup, std::get<Tabletop>(resolved.task));
  const Pose2 start = robot.estimated_base();
  expect_same(robot.dead_reckoned_base(), start, 1e-12);
  const Pose2 corrected{start.x_m + 0.1, start.y_m - 0.2, start.yaw_rad + 0.3};
  robot.correct_pose(corrected);
  expect_same(robot.estimated_base(), corrected, 1e-12);
  expect_same(robot.dead_reckoned_base(), start, 1e-9);
  const std::vector<Pose2> back{compose(corrected, {-0.4, 0.0, 0.0})};
  EXPECT_EQ(robot.drive_along(back, 1.0, [] { return true; }).status, DriveStatus::arrived);
  const Pose2 moved = compose(inverse(corrected), robot.estimated_base());
  EXPECT_NEAR(moved.x_m, -0.4, 0.02);
  const Pose2 reckoned = compose(start, moved);
  expect_same(robot.dead_reckoned_base(), reckoned, 1e-9);
  robot.correct_pose(start);
  expect_same(robot.estimated_base(), start, 1e-12);
  expect_same(robot.dead_reckoned_base(), reckoned, 1e-9);
  robot.restart_dead_reckoning();
  expect_same(robot.dead_reckoned_base(), start, 1e-12);
}

TEST_F(TabletopRobot, DrivesNoFasterThanItMayAndNoLongerThanItShall) {
  const OwnScene scene(kTableAndWalls);
  const ResolvedEpisode resolved = episode(scene, {});
  SimulatedTabletopRobot robot(resolved.setup, std::get<Tabletop>(resolved.task));
  const auto drive_back = [&](double speed_m_s, bool go_on) {
    const std::vector<Pose2> path{compose(robot.estimated_base(), {-0.4, 0.0, 0.0})};
    return robot.drive_along(path, speed_m_s, [go_on] { return go_on; });
  };
  const DriveResult slow = drive_back(0.1, true);
  EXPECT_EQ(slow.status, DriveStatus::arrived);
  EXPECT_GT(slow.duration_s, 3.8);
  const DriveResult brisk = drive_back(10.0, true);
  EXPECT_EQ(brisk.status, DriveStatus::arrived);
  EXPECT_LT(brisk.duration_s, 0.8 * slow.duration_s);
  const DriveResult stopped = drive_back(1.0, false);
  EXPECT_EQ(stopped.status, DriveStatus::stopped);
  EXPECT_LT(stopped.path_length_m, 0.05);
}

TEST_F(TabletopRobot, ThatRunsIntoSomethingIsReported) {
  const OwnScene scene(kTableAndWalls +
                       "<geom name='post' type='box' pos='2.3 0 .5' size='.1 .1 .5'/>");
  const ResolvedEpisode resolved = episode(scene, {});
  SimulatedTabletopRobot robot(resolved.setup, std::get<Tabletop>(resolved.task));
  EXPECT_EQ(robot.ground_truth().collisions(), 0);
  const std::vector<Pose2> path{compose(robot.estimated_base(), {-1.0, 0.0, 0.0})};
  testing::internal::CaptureStderr();
  const DriveResult result = robot.drive_along(path, 0.3, [] { return true; });
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_NE(result.status, DriveStatus::arrived);
  EXPECT_GE(robot.ground_truth().collisions(), 1);
  EXPECT_THAT(log, HasSubstr("touches 'post'"));
}

/// Of a place where the region of the map is nearer than the robot's radius.
TEST_F(TabletopRobot, DoesNotStartAmidItsMap) {
  const OwnScene scene(kTableAndWalls);
  const auto complaint = [&](const std::string& radius_m) -> std::string {
    const ResolvedEpisode resolved = episode(scene, {"candidates.radius_m=" + radius_m});
    try {
      const SimulatedTabletopRobot robot(resolved.setup, std::get<Tabletop>(resolved.task));
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  };
  // Its base is 0.12 m behind the laser, the map ends at 0.5 m.
  EXPECT_THAT(complaint("0.85"),
              testing::AllOf(HasSubstr("would stand 0.47 m from the region"),
                             HasSubstr("robot.start_view 0 on the ring of candidates.radius_m "
                                       "0.85, robot.start_behind_m 0"),
                             HasSubstr("candidates.radius_m 1.19 clears it")));
  EXPECT_THAT(complaint("0.87"), testing::Not(HasSubstr("from the region")));
}

}  // namespace
}  // namespace vantage
