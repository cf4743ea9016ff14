// What an exploration does on its way: images, and loops that move what was chosen and seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/localisation/plan_world.hpp"
#include "tests/tasks/exploration/scripted_drive.hpp"
#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

using support::OpenExploration;
using support::ScriptedDrive;
using support::wall_view;

/// Half a metre or more from where the last one was, and with the head at rest.
TEST(ImagesOnTheWay, AreOfTheMapWhereTheBaseIsBelievedToBe) {
  ScriptedDrive drive;
  drive.task.gaze.on_the_way_m = 0.5;
  OpenExploration parts(drive.context(), drive.task, drive.robot, drive.belief);
  parts.navigator_.on_the_way();
  EXPECT_TRUE(drive.robot.looks.empty()) << "before the first scan";
  parts.scans_.emplace_back();
  drive.robot.view = wall_view(1.5F);
  const auto asked_at = [&](double x_m, double y_m) {
    drive.robot.T_world_base = {x_m, y_m, 0.0};
    parts.navigator_.on_the_way();
    return drive.robot.asked;
  };
  EXPECT_EQ(asked_at(-1.0, 0.5), 0) << "here it begins";
  EXPECT_EQ(drive.robot.looks.size(), 1U);
  drive.robot.rests = false;
  EXPECT_EQ(asked_at(-0.2, 0.5), 0) << "the head turns";
  drive.robot.rests = true;
  EXPECT_EQ(asked_at(-1.0, 0.9), 0) << "too near";
  EXPECT_EQ(drive.robot.looks.size(), 1U);
  EXPECT_EQ(asked_at(-1.0, 1.1), 1);
  EXPECT_EQ(drive.robot.looks.size(), 2U) << "on to the next";
  EXPECT_EQ(parts.current_.images_on_the_way, 1);
  ExplorationBelief fresh(drive.options, drive.task);
  fresh.update(wall_view(1.5F), {-1.0, 1.1, 0.0});
  EXPECT_EQ(drive.belief.grid().log_odds, fresh.grid().log_odds);
  EXPECT_TRUE(drive.belief.kept().empty()) << "no loop will move it";
}

/// Nothing is known, and all of the map is on one side of the robot.
TEST(ImagesOnTheWay, AreOfWhereMostIsPromised) {
  ScriptedDrive drive;
  drive.task.gaze.on_the_way_m = 0.5;
  const auto pan_rad = [&](double yaw_rad) {
    OpenExploration parts(drive.context(), drive.task, drive.robot, drive.belief);
    parts.scans_.emplace_back();
    drive.robot.T_world_base = {0.0, -2.2, yaw_rad};
    parts.navigator_.on_the_way();
    return drive.robot.looks.back().pan_rad;
  };
  EXPECT_NEAR(pan_rad(std::numbers::pi / 2.0), 0.0, 0.1) << "ahead";
  EXPECT_NEAR(pan_rad(0.0), std::numbers::pi / 2.0, 0.6) << "to the left";
  EXPECT_NEAR(pan_rad(std::numbers::pi), -std::numbers::pi / 2.0, 0.6) << "to the right";
}

TEST(ImagesOnTheWay, AreKeptByTheKeyframeBeforeThem) {
  ScriptedDrive drive;
  drive.task.gaze.on_the_way_m = 0.5;
  drive.task.localisation.loops.close = true;
  OpenExploration parts(drive.context(), drive.task, drive.robot, drive.belief);
  parts.scans_.emplace_back();
  const Pose2 keyframe{-1.0, 0.2, 0.3};
  parts.navigator_.remember({}, {});
  parts.navigator_.remember({}, keyframe);
  drive.robot.view = wall_view(1.5F);
  const Pose2 base{-0.4, 0.4, 0.3};
  for (const Pose2& on_the_way : {keyframe, base}) {
    drive.robot.T_world_base = on_the_way;
    parts.navigator_.on_the_way();
  }
  ASSERT_EQ(drive.belief.kept().size(), 1U);
  const KeptSweep& kept = drive.belief.kept().front();
  EXPECT_EQ(kept.keyframe, 1U);
  ASSERT_EQ(kept.views.size(), 1U);
  const Pose T_world_camera = to_se3(keyframe) * kept.views.front().T_base_camera;
  EXPECT_TRUE(T_world_camera.isApprox(to_se3(base) * drive.robot.view->T_base_camera, 1e-9));
}

/// Once there. Without images on the way holes stay as they are.
TEST(ImagesOnTheWay, HaveTheirHolesFilledWhenTheRobotIsThere) {
  ScriptedDrive drive;
  drive.task.gaze.on_the_way_m = 0.5;
  OpenExploration parts(drive.context(), drive.task, drive.robot, drive.belief);
  parts.open_floor();
  parts.record_as(5000.0, 0);
  drive.robot.view = wall_view(1.0F);
  parts.navigator_.on_plan = [&](const PlannedPath&) {
    parts.navigator_.on_the_way();
    drive.robot.T_world_base = {0.6, 0.0, 0.0};
    EXPECT_EQ(drive.belief.filled_grid().count(CellState::occupied), 0U);
    parts.navigator_.on_the_way();
  };
  Candidate goal;
  goal.T_world_sensor = to_se3({1.2, 0.0, 0.0}) * drive.robot.T_base_sweep();
  parts.act(goal);
  ASSERT_EQ(parts.current_.images_on_the_way, 1);
  const std::size_t filled = drive.belief.filled_grid().count(CellState::occupied);
  EXPECT_GT(filled, 0U);

  parts.navigator_.on_plan = nullptr;
  drive.belief.update(wall_view(1.0F), {-1.0, 0.0, 0.0});
  parts.act(goal);
  EXPECT_EQ(drive.belief.filled_grid().count(CellState::occupied), filled);
}

TEST(PartialScans, TakeMoreImagesAfterALongerWay) {
  ScriptedDrive drive;
  drive.task.gaze.worth = 1.0;
  drive.belief.update(wall_view(1.5F), {});
  drive.belief.refill();
  const auto share_after = [&](double way_s) {
    OpenExploration parts(drive.context(), drive.task, drive.robot, drive.belief);
    parts.open_floor();
    parts.record_as(5000.0, 0);
    parts.scans_.back().time_s = drive.robot.time_s() - way_s;
    Candidate here;
    here.T_world_sensor = to_se3(drive.robot.T_world_base) * drive.robot.T_base_sweep();
    parts.act(here);
    return parts.current_.scan_share;
  };
  const double at_once = share_after(0.0);
  EXPECT_GT(at_once, 0.0);
  EXPECT_GT(share_after(1000.0), at_once);
}

/// In a room of 8 x 6 m, tracked 0.7 m apart where it is 0.6 m: what was chosen, driven and seen at
/// the fifth place moves by 0.4 m.
TEST(LoopsOfAnExploration, MoveWhatWasChosenAndSeen) {
  ScriptedDrive drive({"map.size_m=[8,6,2]", "map.cells=[80,60,20]", "floor_map.half_size_m=5",
                       "metrics.pose_spacing_m=4"});
  drive.task.localisation.loops.close = true;
  drive.task.localisation.loops.min_way_m = 0.9;
  std::vector<test_plan::Segment> walls;
  test_plan::add_box(walls, -4.0, -3.0, 4.0, 3.0);
  Rng rng(5);
  const auto scan_from = [&](double x_m) {
    PlanarScan scan{.T_base_sensor = {}, .azimuth_rad = {}, .range_m = {}, .range_max_m = 30.0};
    for (int i = -540; i <= 540; ++i) {
      scan.azimuth_rad.push_back(0.00436 * i);
      const double range_m =
          test_plan::range_m(walls, {x_m, 0.0}, {std::cos(0.00436 * i), std::sin(0.00436 * i)});
      scan.range_m.push_back(static_cast<float>(range_m + 0.01 * rng.normal()));
    }
    return scan;
  };
  const auto tracked = [](int i) { return Pose2{0.7 * i - 1.4, 0.0, 0.0}; };
  drive.robot.T_world_base = tracked(0);
  drive.robot.drives = false;
  OpenExploration parts(drive.context(), drive.task, drive.robot, drive.belief);
  for (int i = 0; i < 5; ++i) {
    if (i > 0) {
      drive.robot.T_world_base = compose(tracked(i - 1), {0.6, 0.0, 0.0});
      parts.navigator_.correct_pose(tracked(i), Eigen::Matrix3d::Zero());
    }
    parts.navigator_.remember(scan_from(0.6 * i - 1.2), tracked(i));
  }
  const HeadView view = wall_view(1.5F);
  drive.belief.update(view, tracked(4));
  drive.belief.refill();
  drive.belief.keep(view, {}, 4);
  parts.open_floor();
  parts.record_as(5000.0, 0, {-3.0, -2.0});
  ASSERT_FALSE(parts.views().empty());
  const Candidate chosen = parts.views().front();
  const Eigen::Vector2d chosen_m = chosen.T_world_sensor.translation().head<2>();
  parts.act(chosen);
  const std::size_t last = parts.navigator_.path_m().size() - 1;
  ASSERT_NEAR(parts.navigator_.path_m()[last].x(), 1.4, 1e-9);

  parts.end();
  ASSERT_NEAR(drive.robot.T_world_base.x_m, 1.0, 0.05);
  for (const Eigen::Vector2d& p_m : parts.navigator_.path_m()) EXPECT_NEAR(p_m.x(), 1.0, 0.05);
  EXPECT_EQ(parts.current_.unobserved_cells, 0U) << "no scan is under way";
  std::vector<Pose2> T_world_bases;
  for (const auto& seen : parts.navigator_.loops()->remembered()) {
    T_world_bases.push_back(seen.T_world_base);
  }
  ExplorationBelief anew(drive.options, drive.task);
  anew.keep(view, {}, 4);
  anew.reintegrate(T_world_bases);
  EXPECT_EQ(drive.belief.grid().log_odds, anew.grid().log_odds);
  const FloorMap& floor = parts.navigator_.floor();
  const auto is_blocked = [&](double x_m, double y_m) {
    return floor.blocked[floor.index(floor.cell_at({x_m, y_m}))] != 0;
  };
  EXPECT_FALSE(is_blocked(0.02, 0.62)) << "round the start";
  EXPECT_FALSE(is_blocked(0.87, 0.17)) << "where it was driven, by the loops";
  EXPECT_TRUE(is_blocked(-2.0, 1.0)) << "never seen";

  parts.open_floor();
  parts.record_as(5000.0, 0, {-3.0, -2.0});
  EXPECT_FALSE(parts.has_view_within(0.2, chosen_m - Eigen::Vector2d(0.4, 0.0)));
}

}  // namespace
}  // namespace vantage
