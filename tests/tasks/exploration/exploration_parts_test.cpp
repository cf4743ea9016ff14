// The parts of exploration, step by step: what they record, where they may go, when they end.
#include "vantage/tasks/exploration/exploration_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "tests/tasks/exploration/scripted_drive.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/core/names.hpp"
#include "vantage/planners/swept_gain.hpp"
#include "vantage/planners/views/left_forecast.hpp"

namespace vantage {
namespace {

using support::OpenExploration;
using support::ScriptedDrive;
using support::upward_view;
using support::wall_view;
using support::wall_views;

TEST(ExplorationPredictors, AreThoseOfCellsThatCanBeSweptAndTheGainInUse) {
  std::set<std::string> expected;
  for (const Gain& gain : cell_predictors()) {
    if (can_sweep(gain)) expected.insert(strategy_label(gain));
  }
  const auto labels = [](const Exploration& task) {
    std::set<std::string> found;
    for (const Predictor& predictor : exploration_predictors(task)) found.insert(predictor.label);
    return found;
  };
  EXPECT_EQ(labels({}), expected);
  EXPECT_LE(expected.size(), cell_predictors().size());
  Exploration one;
  one.metrics.predictors = {SimpleGain{}};
  EXPECT_EQ(labels(one), (std::set<std::string>{"adaptive", "simple"}));
}

/// Nothing of the room is seen. From near one corner of the floor map or the other, towards its
/// middle.
TEST(ExplorationParts, MayDriveWhereTheRobotWasThoughNothingIsSeenThere) {
  for (const double side : {-1.0, 1.0}) {
    ScriptedDrive drive;
    drive.task.passages.use = true;
    const Eigen::Vector2d start_m(1.43 * side, 1.42 * side);
    drive.robot.T_world_base = {start_m.x(), start_m.y(), 0.0};
    drive.robot.sweeps = {{upward_view()}};
    OpenExploration parts(drive.context(), drive.task, drive.robot, drive.belief);
    const ExplorationObservation seen = parts.observe();
    parts.open_floor();
    Candidate goal;
    goal.T_world_sensor =
        to_se3({0.3 * start_m.x(), 0.3 * start_m.y(), 0.0}) * drive.robot.T_base_sweep();
    parts.act(goal);
    ExplorationObservation now = seen;
    now.T_world_base_odometry = drive.robot.T_world_base;
    parts.update(now);

    const auto& path_m = parts.navigator_.path_m();
    ASSERT_GT(path_m.size(), 1U);
    const auto expect_open = [&](const FloorMap& floor, double more_m) {
      std::size_t wrong = 0;
      for (std::size_t cell = 0; cell < floor.size(); ++cell) {
        const Eigen::Vector2d p_m = floor.centre(floor.cell(cell));
        const double room_m = drive.task.start_room_m + more_m;
        const double radius_m = drive.robot.inscribed_radius_m() + more_m;
        const bool was_there = (p_m - start_m).norm() <= room_m ||
                               std::ranges::any_of(path_m, [&](const Eigen::Vector2d& point_m) {
                                 return (p_m - point_m).norm() <= radius_m;
                               });
        wrong += (floor.blocked[cell] == 0) != was_there ? 1 : 0;
      }
      EXPECT_EQ(wrong, 0U) << "of " << floor.size();
    };
    expect_open(parts.navigator_.floor(), 0.0);
    const FloorMap* detail = parts.navigator_.detail();
    ASSERT_TRUE(detail != nullptr);
    expect_open(*detail, drive.task.passages.margin_m + detail->cell_m);
  }
}

TEST(ExplorationParts, RecordTheScanWhereTheBaseWasPut) {
  ScriptedDrive drive;
  drive.robot.T_world_base = {0.4, -0.3, 0.5};
  drive.robot.sweeps = {{wall_view(1.5F)}};
  OpenExploration parts(drive.context(), drive.task, drive.robot, drive.belief);
  const ExplorationObservation seen = parts.observe();
  parts.update(seen);
  parts.record();
  ASSERT_EQ(parts.scans().size(), 1U);
  const ScanRecord& scan = parts.scans().back();
  const Pose expected = to_se3({0.4, -0.3, 0.5}) * drive.robot.T_base_sweep();
  EXPECT_TRUE(scan.T_world_sensor.isApprox(expected, 1e-9));
  EXPECT_NEAR(scan.T_world_base.x_m, 0.4, 1e-9);
  EXPECT_FALSE(scan.registered);
  EXPECT_EQ(scan.unconstrained, 3);
  EXPECT_EQ(scan.chosen_view, -1);
  EXPECT_EQ(scan.scan_share, 1.0);
  EXPECT_EQ(scan.unobserved_cells, drive.belief.grid().count(CellState::unobserved));
  EXPECT_NEAR(scan.pose_error_m, 0.5, 1e-9) << "it really stands at the origin";
  EXPECT_FALSE(scan.left);
}

TEST(ExplorationParts, ObserveWhatIsUsable) {
  ScriptedDrive drive;
  const float end_m = 3.5F;  // of the range, where the sensor saturates
  drive.robot.sweeps = {{wall_view(end_m)},
                        {wall_view(std::numeric_limits<float>::quiet_NaN())},
                        {wall_view(1.5F), wall_view(1.5F), wall_view(1.6F)}};
  drive.robot.base_scan = {.T_base_sensor = {},
                           .azimuth_rad = {-0.1, 0.0, 0.1},
                           .range_m = {2.0F, 0.0F, 10.0F},
                           .range_max_m = 10.0};
  OpenExploration parts(drive.context(), drive.task, drive.robot, drive.belief);
  const ExplorationObservation seen = parts.observe();
  EXPECT_EQ(drive.robot.observed, 3U) << "the first two show nothing";
  ASSERT_EQ(seen.views.size(), 2U) << "the second image is stale";
  EXPECT_EQ(seen.views[1].image.depth_m[0], 1.6F);
  EXPECT_EQ(seen.base_scan.range_m[0], 2.0F);
  EXPECT_TRUE(std::isnan(seen.base_scan.range_m[1]));
  EXPECT_TRUE(std::isnan(seen.base_scan.range_m[2]));
}

TEST(ExplorationParts, FallBackIfTheViewIsOutOfReachOrIsNotReached) {
  ScriptedDrive drive;
  const auto falls_back = [&](double x_m, bool reachable) {
    drive.robot.T_world_base = {};
    OpenExploration parts(drive.context(), drive.task, drive.robot, drive.belief);
    parts.open_floor();
    Candidate view;
    view.id = 3;
    view.reachable = reachable;
    view.path_length_m = 0.75;
    view.T_world_sensor = to_se3({x_m, 0.0, 0.0}) * drive.robot.T_base_sweep();
    testing::internal::CaptureStderr();
    parts.act(view);
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_EQ(said.find("view 3 is out of reach") != std::string::npos, x_m > 1.0) << said;
    EXPECT_EQ(parts.current_.chosen_view, 3);
    EXPECT_EQ(parts.current_.planned_way_m, 0.75);
    return parts.current_.fallback;
  };
  EXPECT_FALSE(falls_back(0.7, true));
  EXPECT_TRUE(falls_back(0.7, false));
  EXPECT_TRUE(falls_back(5.0, true)) << "beyond the floor map";
}

/// A metre off, or where an image was lost or enough was seen 0.3 m.
TEST(ExplorationParts, StayAwayFromWhereAScanShowedTooLittle) {
  ScriptedDrive drive;
  drive.belief.update(wall_view(1.5F), {});
  drive.belief.refill();
  const auto recorded_from = [&](const Eigen::Vector2d& p_m, double new_cells, std::size_t images,
                                 const auto& ask) {
    drive.robot.sweeps = {wall_views(images)};
    drive.robot.observed = 0;
    OpenExploration parts(drive.context(), drive.task, drive.robot, drive.belief);
    parts.observe();
    parts.open_floor();
    parts.record_as(new_cells, 0, p_m);
    return ask(parts);
  };
  const Eigen::Vector2d place_m =
      recorded_from({-1.8, -1.8}, 5000.0, 18, [](const OpenExploration& parts) {
        return Eigen::Vector2d(parts.views().at(0).T_world_sensor.translation().head<2>());
      });
  const auto proposes = [&](double new_cells, double off_m, std::size_t images) {
    return recorded_from(
        place_m - Eigen::Vector2d(off_m, 0.0), new_cells, images,
        [&](const OpenExploration& parts) { return parts.has_view_within(1e-6, place_m); });
  };
  EXPECT_TRUE(proposes(1999.0, 1.05, 18));
  EXPECT_FALSE(proposes(1999.0, 0.95, 18));
  EXPECT_TRUE(proposes(2000.0, 0.35, 18));
  EXPECT_FALSE(proposes(2000.0, 0.25, 18));
  EXPECT_TRUE(proposes(1999.0, 0.35, 17));
  EXPECT_TRUE(proposes(1999.0, 0.25, 17)) << "once more, since nothing else is left";
}

/// All cells are said to be known, and no view promises as many. A scan that shows more than ten
/// times what a view would have to promise begins the count anew.
TEST(EnoughToStop, IsSoManyPoorPromisesInARowWithoutAScanThatShowsPlenty) {
  ScriptedDrive drive;
  drive.belief.update(wall_view(1.5F), {});
  drive.belief.refill();
  drive.task.enough.share = 1.0;
  drive.task.enough.scans = 2;
  OpenExploration parts(drive.context(), drive.task, drive.robot, drive.belief);
  parts.open_floor();
  const auto cells = static_cast<double>(drive.belief.grid().size());
  parts.record_as(0.0, 0);
  ASSERT_FALSE(parts.views().empty());
  EXPECT_TRUE(parts.views_have_gains_);
  EXPECT_GT(parts.views().front().gain_bits, 0.0);
  EXPECT_EQ(parts.finished(), "") << "once";
  parts.record_as(10.0 * cells + 1.0, 0);
  EXPECT_FALSE(parts.views_have_gains_) << "not asked";
  EXPECT_EQ(parts.finished(), "");
  parts.record_as(10.0 * cells, 0);
  EXPECT_EQ(parts.finished(), "") << "once again";
  parts.record_as(0.0, 0);
  EXPECT_NE(parts.finished().find("2 in a row, no view promised more than 100 %"),
            std::string::npos)
      << parts.finished();
}

TEST(EnoughToStop, IsMeasuredByWhatIsKnown) {
  ScriptedDrive drive;
  drive.belief.update(wall_view(1.5F), {});
  drive.belief.refill();
  drive.task.gain = SimpleGain{};
  drive.task.enough.share = 2.0;
  drive.task.enough.scans = 1;
  OpenExploration parts(drive.context(), drive.task, drive.robot, drive.belief);
  parts.open_floor();
  const std::size_t cells = drive.belief.grid().size();
  const auto said = [&](std::size_t unobserved_cells) {
    log_to_file(drive.folder / "enough.txt");
    parts.record_as(0.0, unobserved_cells);
    log_to_file({});
    return read_file(drive.folder / "enough.txt").find("views is worth it") != std::string::npos;
  };
  EXPECT_FALSE(said(cells - 10));
  EXPECT_EQ(parts.finished(), "") << "a view promises more than 20 cells";
  EXPECT_FALSE(parts.views_have_gains_) << "by another gain than that in use";
  EXPECT_EQ(parts.views().front().gain_bits, 0.0);
  EXPECT_TRUE(said(0));
  EXPECT_NE(parts.finished().find("1 in a row, no view promised more than 200 %"),
            std::string::npos)
      << parts.finished();
}

TEST(LeftToSee, IsWhatTheViewsShowBesideWhatIsKnown) {
  ScriptedDrive drive;
  drive.task.stop.share = 0.9;
  const std::size_t cells = drive.belief.grid().size();
  const auto left = [&] {
    OpenExploration parts(drive.context(), drive.task, drive.robot, drive.belief);
    parts.open_floor();
    parts.record_as(0.0, cells - 5000);
    EXPECT_TRUE(parts.scans().back().left);
    return parts.scans().back().left.value_or(LeftRecord{});
  };
  const LeftRecord nothing = left();
  EXPECT_EQ(nothing.expected_cells, 0.0) << "no frontier";
  EXPECT_EQ(nothing.share, 0.0);
  drive.belief.update(wall_view(1.5F), {});
  drive.belief.refill();
  const LeftRecord some = left();
  EXPECT_GT(some.expected_cells, 100.0);
  EXPECT_LT(some.expected_cells, static_cast<double>(cells));
  EXPECT_NEAR(some.share, some.expected_cells / (5000.0 + some.expected_cells), 1e-12);
  EXPECT_EQ(some.confidence, confidence_of_left(some.share, 1.0 - 0.9));
  drive.task.reach_m = 0.0;
  EXPECT_EQ(left().expected_cells, some.expected_cells) << "however far from their frontiers";
}

/// A wall at x = 1.2 m keeps them from two of the five places.
TEST(ExplorationParts, ProposeThePlacesOfTheOracleThatAreInReachAndNotTaken) {
  ScriptedDrive drive({"choice=oracle_tour"});
  OpenExploration parts(drive.context(), drive.task, drive.robot, drive.belief);
  parts.open_floor();
  block_box(parts.navigator_.floor(), {Eigen::Vector2d(1.2, -2.0), Eigen::Vector2d(1.4, 2.0)});
  parts.record_as(5000.0, 0);
  ASSERT_EQ(parts.views().size(), 3U);
  const Eigen::Vector2d first_m = parts.views()[0].T_world_sensor.translation().head<2>();
  for (const std::size_t expected : {3U, 2U}) {
    ASSERT_EQ(parts.views().size(), expected);
    for (std::size_t i = 0; i < parts.views().size(); ++i) {
      EXPECT_EQ(parts.views()[i].id, static_cast<int>(i));
      EXPECT_TRUE(std::isfinite(parts.views()[i].path_length_m));
      EXPECT_LT(parts.views()[i].T_world_sensor.translation().x(), 0.6);
    }
    parts.record_as(5000.0, 0, first_m);
  }
}

TEST(ExplorationParts, GoOnWhileItIsNotSureThatEnoughHasBeenSeen) {
  ScriptedDrive drive;
  drive.belief.update(wall_view(1.5F), {});
  drive.belief.refill();
  drive.task.stop.confidence = 0.8;
  OpenExploration parts(drive.context(), drive.task, drive.robot, drive.belief);
  parts.open_floor();
  parts.record_as(5000.0, 0);
  ASSERT_FALSE(parts.views().empty());
  EXPECT_FALSE(parts.views_have_gains_) << "nobody asked";
  LeftRecord left;
  for (const double confidence : {0.79, 0.8}) {
    left.confidence = confidence;
    parts.scans_.back().left = left;
    EXPECT_EQ(parts.finished().empty(), confidence < 0.8) << confidence;
  }
}

/// A choice from outside is told why the episode ended: what is explored was not cut short.
TEST(ExplorationParts, WhatIsExploredIsNotAtItsLimit) {
  for (const std::string limit : {"scans=1", "budget.time_s=0.001"}) {
    ScriptedDrive drive({limit, "stop.confidence=0.8"});
    std::optional<bool> at_limit;
    const OutsideChoice outside{.name = "mine",
                                .decide = {},
                                .ended = [&](const MapSituation&, bool told) { at_limit = told; }};
    MappingContext context = drive.context();
    context.outside = &outside;
    drive.belief.update(wall_view(1.5F), {});
    drive.belief.refill();
    OpenExploration parts(context, drive.task, drive.robot, drive.belief);
    parts.open_floor();
    parts.record_as(5000.0, 0);
    LeftRecord left;
    for (const double confidence : {0.79, 0.8}) {
      left.confidence = confidence;
      parts.scans_.back().left = left;
      parts.end();
      EXPECT_EQ(at_limit, confidence < 0.8) << limit;
    }
  }
}

}  // namespace
}  // namespace vantage
