// Whole episodes within a budget: it is kept, and the robot comes back.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tests/support/overrides.hpp"
#include "tests/support/temporary_directory.hpp"
#include "tests/tasks/mapping/standing_robot.hpp"
#include "vantage/core/log.hpp"
#include "vantage/planners/navigation/path_planning.hpp"
#include "vantage/tasks/mapping/driving/budget_keeper.hpp"
#include "vantage/tasks/run.hpp"

namespace vantage {
namespace {

nlohmann::json budgeted_tabletop(const std::vector<std::string>& more) {
  set_verbosity(Verbosity::quiet);
  const support::TemporaryDirectory folder;
  const std::vector<std::string> quick{"scans=10", "map.cells=[49,49,25]",
                                       "laser.scan_duration_s=3"};
  const auto overrides = support::overridden(quick, more);
  const auto outcome =
      run(load_episode(VANTAGE_SOURCE_DIR "/assets/episodes/tabletop.yaml", overrides),
          {folder.path() / "run", true, false, {}});
  return nlohmann::json::parse(outcome.metrics);
}

class Budgets : public testing::TestWithParam<const char*> {};

TEST_P(Budgets, OfTimeAreKeptWithTheWayHome) {
  const auto metrics = budgeted_tabletop({std::string("choice=") + GetParam(), "budget.time_s=75",
                                          "budget.return_to_start=true", "seed=4"});
  EXPECT_EQ(metrics["status"], "completed");
  EXPECT_TRUE(metrics["budget"]["kept"].get<bool>());
  EXPECT_TRUE(metrics["budget"]["returned"].get<bool>());
  EXPECT_LE(metrics["simulated_time_s"].get<double>(), 75.0);
  EXPECT_LT(metrics["budget"]["from_start_m"].get<double>(), 0.05);
  // It is made use of: the robot went somewhere and came back.
  EXPECT_GE(metrics["scans"].size(), 2U);
  EXPECT_LT(metrics["scans"].size(), 10U);
  EXPECT_GT(metrics["path_length_m"].get<double>(), 1.0);
  EXPECT_NE(metrics["reason"].get<std::string>().find("budget.time_s 75"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Choices, Budgets, testing::Values("greedy", "tour", "information_rate"));

TEST(Budgets, OfEnergyAreKept) {
  const auto metrics = budgeted_tabletop({"budget.energy_j=25000", "seed=5"});
  EXPECT_EQ(metrics["status"], "completed");
  EXPECT_LE(metrics["energy_j"].get<double>(), 25000.0);
  EXPECT_GT(metrics["energy_j"].get<double>(), 15000.0);
  EXPECT_LT(metrics["scans"].size(), 10U);
  EXPECT_GE(metrics["scans"].size(), 2U);
}

/// 300 W are drawn whatever it does, and the motors' power on top of that while it drives.
TEST(Budgets, DrivingTakesEnergyToo) {
  const auto metrics = budgeted_tabletop({"scans=2"});
  const double at_rest_j = 300.0 * metrics["simulated_time_s"].get<double>();
  EXPECT_GT(metrics["energy_j"].get<double>(), at_rest_j);
  EXPECT_LT(metrics["energy_j"].get<double>(), 2.0 * at_rest_j);
}

TEST(Budgets, TooSmallToMoveAreAFailureThatSaysSo) {
  const auto metrics = budgeted_tabletop({"budget.time_s=10"});
  EXPECT_EQ(metrics["status"], "failed");
  EXPECT_NE(metrics["reason"].get<std::string>().find("budget.time_s 10: too small to go anywhere"),
            std::string::npos);
}

TEST(Budgets, ComeHomeWithoutALimitToo) {
  const auto metrics = budgeted_tabletop({"scans=2", "budget.return_to_start=true"});
  EXPECT_TRUE(metrics["budget"]["returned"].get<bool>());
}

/// It is at each waypoint for so many ticks.
struct SteppingRobot : support::StandingRobot {
  int ticks = 10;
  DriveResult drive_along(std::span<const Pose2> path, double /*max_speed_m_s*/,
                          const std::function<bool()>& go_on) override {
    DriveResult result;
    for (const Pose2& waypoint : path) {
      T_world_base = waypoint;
      for (int tick = 0; tick < ticks; ++tick) {
        if (go_on()) continue;
        result.status = DriveStatus::stopped;
        return result;
      }
    }
    return result;
  }
};

Navigator navigator_on_open_floor(SteppingRobot& robot) {
  Navigator navigator({}, {}, {}, robot, ReferenceMap(RegistrationOptions{}), 1);
  std::ranges::fill(navigator.floor().log_odds, -2.0F);
  return navigator;
}

/// For the 3 m that it came it needs 8.8 s. A wall that it has met since leaves 10 m, which would
/// take more than 20 s.
TEST(BudgetKeeper, GoesOnWhileTheWayThatItCameCanBePaid) {
  SteppingRobot robot;
  Navigator navigator = navigator_on_open_floor(robot);
  BudgetKeeper keeper({.time_s = 100.0, .return_to_start = true}, 0.6, robot, navigator);
  ASSERT_TRUE(navigator.approach({3.0, 0.0, 0.0}, std::nullopt).reached);
  block_box(navigator.floor(), {Eigen::Vector2d(1.0, -7.0), Eigen::Vector2d(1.2, 4.0)});
  const double round_m = path_length_m(navigator.ways_from({}), {3.0, 0.0, 0.0});
  ASSERT_GT(round_m, 8.0);
  ASSERT_LT(round_m, 12.0);
  robot.now_s = 100.0 - 6.0 - 9.8;
  EXPECT_TRUE(navigator.may_go_on());
}

/// Walls all round that it has met since it left.
TEST(BudgetKeeper, FailsTheEpisodeThatDoesNotComeHome) {
  SteppingRobot robot;
  Navigator navigator = navigator_on_open_floor(robot);
  BudgetKeeper keeper({.return_to_start = true}, 0.6, robot, navigator);
  ASSERT_TRUE(navigator.approach({3.0, 0.0, 0.0}, std::nullopt).reached);
  block_box(navigator.floor(), {Eigen::Vector2d(1.0, -7.0), Eigen::Vector2d(1.2, 7.0)});
  try {
    keeper.come_home();
    ADD_FAILURE() << "it is not there";
  } catch (const EpisodeFailed& failed) {
    EXPECT_STREQ(failed.what(), "budget.return_to_start: the start was not reached");
  }
  nlohmann::ordered_json metrics;
  keeper.add_metrics(metrics);
  EXPECT_EQ(metrics["budget"]["returned"], false);
  EXPECT_EQ(metrics["budget"]["kept"], false);
}

/// A drive of fewer than ten ticks ends before it asks.
TEST(Navigator, HasTurnedBackOnThatDriveAlone) {
  SteppingRobot robot;
  Navigator navigator = navigator_on_open_floor(robot);
  robot.ticks = 2;
  EXPECT_FALSE(navigator.approach({1.0, 0.0, 0.0}, std::nullopt).turned_back);
  robot.ticks = 10;
  navigator.may_go_on = [] { return false; };
  EXPECT_TRUE(navigator.approach({2.0, 0.0, 0.0}, std::nullopt).turned_back);
  robot.ticks = 2;
  const Approach after = navigator.approach({1.0, 0.0, 0.0}, std::nullopt);
  EXPECT_FALSE(after.turned_back);
  EXPECT_TRUE(after.reached);
}

/// Counts the ticks of its drives.
struct TickCountingRobot : SteppingRobot {
  DriveResult drive_along(std::span<const Pose2> path, double max_speed_m_s,
                          const std::function<bool()>& go_on) override {
    return SteppingRobot::drive_along(path, max_speed_m_s, [&] {
      ++asked;
      return go_on();
    });
  }
  std::size_t asked = 0;
};

TEST(Navigator, LooksAtTheFloorAtEveryTenthTick) {
  TickCountingRobot robot;
  Navigator navigator = navigator_on_open_floor(robot);
  robot.ticks = 97;
  ASSERT_TRUE(navigator.approach({1.0, 0.0, 0.0}, std::nullopt).reached);
  ASSERT_GE(robot.asked, 97U);
  EXPECT_EQ(navigator.path_m().size(), robot.asked / 10);
}

/// It drives in place, and says what it is told to say of that.
struct RefusingRobot : SteppingRobot {
  DriveResult drive_along(std::span<const Pose2> /*path*/, double /*max_speed_m_s*/,
                          const std::function<bool()>& /*go_on*/) override {
    return {.status = status, .path_length_m = 0.25, .duration_s = 1.0};
  }
  DriveStatus status = DriveStatus::stopped;
};

TEST(Navigator, PlansAgainAsLongAsItMayGetThere) {
  RefusingRobot robot;
  Navigator navigator = navigator_on_open_floor(robot);
  int plans = 0;
  navigator.on_plan = [&](const PlannedPath&) { ++plans; };
  const auto approach = [&](const Pose2& goal, DriveStatus status) {
    plans = 0;
    robot.status = status;
    return navigator.approach(goal, std::nullopt);
  };
  const Pose2 ahead{3.0, 0.0, 0.0};
  const Approach stopped = approach(ahead, DriveStatus::stopped);
  EXPECT_EQ(plans, 12);
  EXPECT_FALSE(stopped.reached || stopped.turned_back);
  EXPECT_DOUBLE_EQ(stopped.path_length_m, 12 * 0.25);
  EXPECT_FALSE(approach(ahead, DriveStatus::stuck).reached);
  EXPECT_EQ(plans, 1);
  EXPECT_TRUE(approach(ahead, DriveStatus::arrived).reached);
  EXPECT_EQ(plans, 1);
  EXPECT_FALSE(approach({50.0, 0.0, 0.0}, DriveStatus::arrived).reached) << "off the floor";
  EXPECT_EQ(plans, 1) << "it has come no nearer";
}

/// Its scanner sees nothing. It stands within 0.57 m: footprint, margin and a cell.
TEST(Navigator, KnowsTheFloorThatItStandsOn) {
  SteppingRobot robot;
  Navigator navigator({}, {}, {}, robot, ReferenceMap(RegistrationOptions{}), 1);
  navigator.turn_in_place();
  EXPECT_EQ(navigator.floor().state_at({-0.54, 0.02}), CellState::free);
  EXPECT_EQ(navigator.floor().state_at({-0.58, 0.02}), CellState::unobserved);
}

/// But for the reserve of 6 s.
TEST(Budget, MayBeSpentToItsEnd) {
  const Budget budget({.time_s = 100.0, .energy_j = 50.0});
  const SpendingRates rates(0.6);
  EXPECT_TRUE(budget.affords_way_home(rates, {94.0, 50.0}, 0.0));
  EXPECT_FALSE(budget.affords_way_home(rates, {94.001, 50.0}, 0.0));
  EXPECT_FALSE(budget.affords_way_home(rates, {94.0, 50.001}, 0.0));
}

/// One that is too far from what it is to look at may be taken for want of a better one.
TEST(BudgetKeeper, PaysForTheWayToAViewThatIsNotInReach) {
  SteppingRobot robot;
  Navigator navigator = navigator_on_open_floor(robot);
  const BudgetKeeper keeper({.time_s = 100.0}, 0.6, robot, navigator);
  Candidate view;
  view.T_world_sensor = make_pose({3.0, 0.0, 1.0}, 0.0);
  view.reachable = false;
  view.path_length_m = std::numeric_limits<double>::infinity();
  EXPECT_EQ(keeper.used_up({view}, 3), "");
  robot.now_s = 90.0;
  EXPECT_EQ(keeper.used_up({view}, 3), "budget.time_s 100 allows no further view");
}

/// A square of 0.6 m. Each of its drives ends a centimetre short; it notes them.
struct DoorRobot : support::StandingRobot {
  [[nodiscard]] RobotOutline outline() const override {
    return {.outline = {{-0.3, -0.3}, {0.3, -0.3}, {0.3, 0.3}, {-0.3, 0.3}}};
  }
  DriveResult drive_along(std::span<const Pose2> path, double max_speed_m_s,
                          const std::function<bool()>& /*go_on*/) override {
    paths.emplace_back(path.begin(), path.end());
    speeds_m_s.push_back(max_speed_m_s);
    T_world_base = path.back();
    T_world_base.x_m -= 0.01;
    const bool is_stuck = paths.size() == stuck_at;
    return {.status = is_stuck ? DriveStatus::stuck : DriveStatus::arrived, .path_length_m = 0.25};
  }
  std::vector<std::vector<Pose2>> paths;
  std::vector<double> speeds_m_s;
  std::size_t stuck_at = 0;  ///< the number of that drive, from 1
};

/// A door of 0.72 m: there, through it and on.
TEST(Navigator, DrivesThroughADoorLegByLeg) {
  DoorRobot robot;
  const Pose2 start{-1.25, 0.0, 0.0};
  robot.T_world_base = start;
  Navigator navigator({.half_size_m = 2.5}, {}, {}, robot, ReferenceMap(RegistrationOptions{}), 1);
  navigator.use_passages({}, {.parts = 5});
  for (FloorMap* map : {&navigator.floor(), navigator.detail()}) {
    std::ranges::fill(map->log_odds, -2.0F);
    block_box(*map, {Eigen::Vector2d(0.001, -2.5), Eigen::Vector2d(0.099, -0.361)});
    block_box(*map, {Eigen::Vector2d(0.001, 0.361), Eigen::Vector2d(0.099, 2.5)});
  }
  std::vector<PathLeg> legs;
  navigator.on_plan = [&](const PlannedPath& path) { legs = path.legs; };
  const Pose2 beyond{1.4, 0.0, 1.0};
  const Approach through = navigator.approach(beyond, std::nullopt);
  EXPECT_TRUE(through.reached);
  ASSERT_GE(legs.size(), 3U);
  ASSERT_EQ(robot.paths.size(), legs.size());
  EXPECT_DOUBLE_EQ(through.path_length_m, 0.25 * static_cast<double>(legs.size()));
  EXPECT_TRUE(std::ranges::any_of(legs, &PathLeg::narrow));
  for (std::size_t i = 0; i < legs.size(); ++i) {
    EXPECT_EQ(robot.speeds_m_s[i], legs[i].narrow ? PassageOptions{}.speed_m_s
                                                  : std::numeric_limits<double>::infinity());
    EXPECT_EQ(robot.paths[i].back().x_m, legs[i].waypoints.back().x_m);
    const double from_m = i == 0 ? start.x_m : robot.paths[i - 1].back().x_m - 0.01;
    EXPECT_EQ(robot.paths[i].front().x_m, from_m) << "where it is";
  }

  robot.T_world_base = start;
  robot.paths.clear();
  robot.stuck_at = 1;
  ASSERT_FALSE(legs.front().narrow);
  const Approach stuck = navigator.approach(beyond, std::nullopt);
  EXPECT_FALSE(stuck.reached);
  EXPECT_EQ(robot.paths.size(), 1U);
  EXPECT_DOUBLE_EQ(stuck.path_length_m, 0.25);
}

/// The same, but a bar that no sensor sees keeps it from going beyond x in the door at y 0.
struct BarredRobot : DoorRobot {
  DriveResult drive_along(std::span<const Pose2> path, double max_speed_m_s,
                          const std::function<bool()>& go_on) override {
    const Pose2 goal = path.back();
    const bool before_it = T_world_base.x_m < bar_m && std::abs(goal.y_m) < 0.3;
    DriveResult driven = DoorRobot::drive_along(path, max_speed_m_s, go_on);
    if (!before_it || goal.x_m < bar_m) return driven;
    T_world_base = {bar_m - 0.01, goal.y_m, goal.yaw_rad};
    driven.status = DriveStatus::stuck;
    ++touches;
    return driven;
  }
  double bar_m = -0.2;
  int touches = 0;
};

/// Two doors of 0.72 m, the nearer one barred.
TEST(Navigator, WhereItDoesNotGetOnItGoesAnotherWay) {
  BarredRobot robot;
  robot.T_world_base = {-1.25, 0.0, 0.0};
  Navigator navigator({.half_size_m = 2.5}, {}, {}, robot, ReferenceMap(RegistrationOptions{}), 1);
  navigator.use_passages({}, {.parts = 5});
  const auto put_walls = [&] {
    for (FloorMap* map : {&navigator.floor(), navigator.detail()}) {
      std::ranges::fill(map->log_odds, -2.0F);
      std::ranges::fill(map->blocked, 0);
      block_box(*map, {Eigen::Vector2d(0.001, -2.5), Eigen::Vector2d(0.099, -0.361)});
      block_box(*map, {Eigen::Vector2d(0.001, 0.361), Eigen::Vector2d(0.099, 1.139)});
      block_box(*map, {Eigen::Vector2d(0.001, 1.861), Eigen::Vector2d(0.099, 2.5)});
    }
  };
  put_walls();
  const Pose2 beyond{1.4, 0.0, 1.0};
  const Approach detour = navigator.approach(beyond, std::nullopt);
  EXPECT_TRUE(detour.reached);
  EXPECT_EQ(robot.touches, 1);
  EXPECT_GT(robot.paths.size(), 4U);
  EXPECT_DOUBLE_EQ(detour.path_length_m, 0.25 * static_cast<double>(robot.paths.size()))
      << "with the way that it backed off";

  robot.T_world_base = {-1.25, 0.0, 0.0};
  put_walls();  // as the map is made anew
  EXPECT_TRUE(navigator.approach(beyond, std::nullopt).reached);
  EXPECT_EQ(robot.touches, 1) << "it remembers";
}

}  // namespace
}  // namespace vantage
