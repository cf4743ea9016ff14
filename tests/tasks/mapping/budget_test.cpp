#include "vantage/tasks/mapping/driving/budget.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "tests/tasks/mapping/standing_robot.hpp"
#include "vantage/runtime/episode_loop.hpp"
#include "vantage/tasks/mapping/driving/budget_keeper.hpp"

namespace vantage {
namespace {

using support::StandingRobot;

/// 3 s to start, 2 s a metre; scans of 20 s at 100 W, driving at 400 W.
SpendingRates known_rates() {
  SpendingRates rates(0.6);
  ScanRecord before;
  before.scan_time_s = 20.0;
  before.time_s = 30.0;
  before.scan_energy_j = 2000.0;
  before.energy_j = 6000.0;
  rates.observe(before, nullptr);
  for (int k = 0; k < 2000; ++k) {
    ScanRecord scan = before;
    scan.planned_way_m = 1.0 + k % 10;
    scan.leg_length_m = 2.0 * scan.planned_way_m;  // what was truly driven is not for planning
    const double drive_s = 3.0 + 2.0 * scan.planned_way_m;
    scan.time_s += drive_s + scan.scan_time_s;
    scan.energy_j += 400.0 * drive_s + scan.scan_energy_j;
    rates.observe(scan, &before);
    before = scan;
  }
  return rates;
}

TEST(SpendingRates, AreLearntFromScans) {
  const SpendingRates rates = known_rates();
  EXPECT_NEAR(rates.travel_time().of_m(10.0), 23.0, 0.05);
  EXPECT_EQ(rates.scan_s(), 20.0);
  EXPECT_NEAR(rates.driving_w(), 400.0, 0.1);
  EXPECT_NEAR(rates.scanning_w(), 100.0, 1e-9);
}

TEST(SpendingRates, TakeTheTimeOfAScanFromWholeOnes) {
  SpendingRates rates = known_rates();
  ScanRecord scan;
  scan.scan_time_s = 7.0;
  scan.scan_share = 0.25;
  rates.observe(scan, nullptr);
  EXPECT_EQ(rates.scan_s(), 20.0);
  scan.scan_share = 1.0;
  rates.observe(scan, nullptr);
  EXPECT_EQ(rates.scan_s(), 7.0);
}

TEST(SpendingRates, TakeNoDriveThatEndedShortOfItsGoal) {
  SpendingRates rates(0.6);
  const double before_s = rates.travel_time().of_m(5.0);
  ScanRecord first;
  ScanRecord scan;
  scan.time_s = 500.0;
  scan.planned_way_m = 0.1;
  scan.fallback = true;
  rates.observe(scan, &first);
  EXPECT_EQ(rates.travel_time().of_m(5.0), before_s);
}

TEST(SpendingRates, TakeNoTurnAtTheStartAndNoWayThatWasNotPlanned) {
  SpendingRates rates(0.6);
  const double before_s = rates.travel_time().of_m(5.0);
  EXPECT_EQ(rates.driving_w(), 0.0) << "nothing is known yet";
  ScanRecord first;
  first.time_s = 90.0;
  first.scan_time_s = 20.0;
  first.planned_way_m = 4.0;
  rates.observe(first, nullptr);
  ScanRecord scan = first;
  scan.time_s = 500.0;
  scan.planned_way_m = std::numeric_limits<double>::infinity();
  rates.observe(scan, &first);
  EXPECT_EQ(rates.travel_time().of_m(5.0), before_s);
}

/// 6 s are for what cannot be foreseen.
TEST(Budget, LeavesWhatIsNotSpent) {
  const Allowance all = Budget({}).left(known_rates(), {100.0, 2000.0});
  EXPECT_TRUE(std::isinf(all.time_s) && std::isinf(all.energy_j));
  const SpendingRates rates = known_rates();
  const Allowance left =
      Budget({.time_s = 1000.0, .energy_j = 50000.0}).left(rates, {100.0, 2000.0});
  EXPECT_DOUBLE_EQ(left.time_s, 894.0);
  ASSERT_GT(rates.driving_w(), 0.0);
  EXPECT_DOUBLE_EQ(left.energy_j, 48000.0 - 6.0 * rates.driving_w());
}

TEST(Budget, WithoutALimitAffordsEverything) {
  const Budget budget({});
  EXPECT_TRUE(budget.affords_view(known_rates(), {1e9, 1e12}, 1e6, 1e6));
}

/// 10 m there take 3 + 1.15 x 20 s, the scan 20, the reserve 6: 52 s, and home as much as there
/// without scan and reserve: 78 s.
TEST(Budget, AffordsAViewUpToItsLimitOfTime) {
  const Budget budget({.time_s = 1000.0});
  const SpendingRates rates = known_rates();
  EXPECT_TRUE(budget.affords_view(rates, {1000.0 - 52.1, 0.0}, 10.0, 0.0));
  EXPECT_FALSE(budget.affords_view(rates, {1000.0 - 51.9, 0.0}, 10.0, 0.0));
  EXPECT_TRUE(budget.affords_view(rates, {1000.0 - 78.1, 0.0}, 10.0, 10.0));
  EXPECT_FALSE(budget.affords_view(rates, {1000.0 - 77.9, 0.0}, 10.0, 10.0));
}

/// (26 + 6) s at 400 W and 20 s at 100 W.
TEST(Budget, AffordsAViewUpToItsLimitOfEnergy) {
  const Budget budget({.energy_j = 50000.0});
  const SpendingRates rates = known_rates();
  EXPECT_TRUE(budget.affords_view(rates, {0.0, 50000.0 - 14820.0}, 10.0, 0.0));
  EXPECT_FALSE(budget.affords_view(rates, {0.0, 50000.0 - 14780.0}, 10.0, 0.0));
}

TEST(Budget, AffordsNoWayThatIsNotKnown) {
  const Budget budget({.time_s = 1e6});
  EXPECT_FALSE(
      budget.affords_view(known_rates(), {}, 3.0, std::numeric_limits<double>::infinity()));
}

TEST(Budget, TurnsBackWhileAScanAndTheWayHomeAreStillAffordable) {
  const Budget budget({.time_s = 100.0, .return_to_start = true});
  const SpendingRates rates = known_rates();
  // 26 s home, a scan of 20 s where it stands, 6 s of reserve.
  EXPECT_TRUE(budget.affords_way_home(rates, {47.9, 0.0}, 10.0));
  EXPECT_FALSE(budget.affords_way_home(rates, {48.1, 0.0}, 10.0));
}

/// Why no view is taken, of one at 3 m that is in reach or not; no floor is known but where the
/// robot stands.
std::string reason(const BudgetOptions& options, bool in_reach, double now_s = 50.0,
                   std::size_t scans = 3) {
  StandingRobot robot;
  Navigator navigator({}, {}, {}, robot, ReferenceMap(RegistrationOptions{}), 1);
  const BudgetKeeper keeper(options, 0.6, robot, navigator);
  robot.now_s = now_s;
  Candidate view;
  view.T_world_sensor = make_pose({3.0, 0.0, 1.0}, 0.0);
  view.reachable = in_reach;
  view.path_length_m = in_reach ? 3.0 : std::numeric_limits<double>::infinity();
  return keeper.used_up({view}, scans);
}

TEST(BudgetKeeper, BlamesTheBudgetForWhatItDoesNotAffordAlone) {
  EXPECT_EQ(reason({.time_s = 1000.0}, true), "");
  EXPECT_EQ(reason({.time_s = 1000.0}, true, 999.0), "budget.time_s 1000 allows no further view");
  EXPECT_EQ(reason({.time_s = 1000.0}, false), "no view is left in reach");
  EXPECT_EQ(reason({.time_s = 1000.0}, false, 999.0), "no view is left in reach");
  EXPECT_EQ(reason({.time_s = 1000.0, .return_to_start = true}, true),
            "no view is left in reach that has a way back");
  EXPECT_EQ(reason({}, false), "");
}

TEST(BudgetKeeper, FailsTheEpisodeThatComesToNothing) {
  EXPECT_THROW(reason({.time_s = 1000.0}, false, 50.0, 1), EpisodeFailed);
  EXPECT_THROW(reason({.time_s = 1000.0}, true, 999.0, 1), EpisodeFailed);
}

/// It is at each waypoint for long enough to scan the floor.
struct WalkingRobot : StandingRobot {
  DriveResult drive_along(std::span<const Pose2> path, double /*max_speed_m_s*/,
                          const std::function<bool()>& go_on) override {
    for (const Pose2& waypoint : path) {
      T_world_base = waypoint;
      for (int tick = 0; tick < 10; ++tick) {
        if (!go_on()) return {.status = DriveStatus::stopped};
      }
    }
    return {.status = DriveStatus::arrived};
  }
};

/// On open floor, home at the origin.
struct OnOpenFloor {
  explicit OnOpenFloor(const BudgetOptions& options) : keeper(options, 0.6, robot, navigator) {}

  WalkingRobot robot;
  Navigator navigator = [this] {
    Navigator on_floor({}, {}, {}, robot, ReferenceMap(RegistrationOptions{}), 1);
    std::ranges::fill(on_floor.floor().log_odds, -2.0F);
    return on_floor;
  }();
  BudgetKeeper keeper;
};

Candidate view_at(double x_m, double way_m) {
  Candidate view;
  view.T_world_sensor = make_pose({x_m, 0.0, 1.0}, 0.0);
  view.path_length_m = way_m;
  return view;
}

TEST(BudgetKeeper, NamesAllThatIsLimitedAndTheWayBack) {
  OnOpenFloor open({.time_s = 100.0, .energy_j = 9000.0, .return_to_start = true});
  const std::vector<Candidate> views{view_at(3.0, 3.0)};
  EXPECT_EQ(open.keeper.used_up(views, 3), "");
  open.robot.now_s = 99.0;
  EXPECT_EQ(open.keeper.used_up(views, 3),
            "budget.time_s 100 and budget.energy_j 9000 allow no further view and the way back");
  try {
    static_cast<void>(open.keeper.used_up(views, 1));
    FAIL() << "it has come to nothing";
  } catch (const EpisodeFailed& error) {
    EXPECT_STREQ(error.what(),
                 "budget.time_s 100 and budget.energy_j 9000: too small to go anywhere and scan "
                 "again and come back");
  }
}

TEST(BudgetKeeper, LeavesOutWhatCannotBePaid) {
  OnOpenFloor open({.time_s = 100.0});
  std::vector<Candidate> views{view_at(3.0, 3.0), view_at(2.0, 2.0), view_at(4.0, 400.0)};
  views[1].exhausted = true;
  open.keeper.leave_affordable(views);
  EXPECT_FALSE(views[0].exhausted);
  EXPECT_TRUE(views[1].exhausted) << "as it was before";
  EXPECT_TRUE(views[2].exhausted);
  OnOpenFloor unlimited({.return_to_start = true});
  std::vector<Candidate> far{view_at(4.0, 1e9)};
  unlimited.keeper.leave_affordable(far);
  EXPECT_FALSE(far[0].exhausted);
}

/// 2.5 s to start and 1.1 s for each 0.6 m, before any drive.
TEST(BudgetKeeper, KnowsTheTimesHome) {
  OnOpenFloor open({.time_s = 100.0, .return_to_start = true});
  open.robot.T_world_base = {-1.0, 0.0, 0.0};
  const std::vector<Eigen::Vector2d> places{{3.0, 0.0}, {50.0, 0.0}};
  const std::vector<double> home_s = open.keeper.home_s(places);
  ASSERT_EQ(home_s.size(), 3U);
  EXPECT_NEAR(home_s[0], 8.0, 0.2);
  EXPECT_TRUE(std::isinf(home_s[1])) << "off the floor";
  EXPECT_NEAR(home_s[2], 2.5 + 1.1 / 0.6, 0.2) << "from here";
  EXPECT_TRUE(OnOpenFloor({.time_s = 100.0}).keeper.home_s(places).empty());
  EXPECT_TRUE(OnOpenFloor({.return_to_start = true}).keeper.home_s(places).empty()) << "no limit";
}

TEST(BudgetKeeper, IsAskedOnTheWay) {
  EXPECT_TRUE(OnOpenFloor({.return_to_start = true}).navigator.may_go_on == nullptr) << "no limit";
  OnOpenFloor one_way({.time_s = 100.0});
  ASSERT_TRUE(one_way.navigator.may_go_on != nullptr);
  one_way.robot.T_world_base = {5.0, 0.0, 0.0};
  one_way.robot.now_s = 94.1;
  EXPECT_TRUE(one_way.navigator.may_go_on()) << "nothing is scanned yet";
  ScanRecord scan;
  scan.scan_time_s = 10.0;
  one_way.keeper.observe(scan, nullptr);
  one_way.robot.now_s = 83.9;
  EXPECT_TRUE(one_way.navigator.may_go_on()) << "it need not come back";
  one_way.robot.now_s = 84.1;
  EXPECT_FALSE(one_way.navigator.may_go_on()) << "6 s are kept, and a scan";
  OnOpenFloor open({.time_s = 100.0, .return_to_start = true});
  ASSERT_TRUE(open.navigator.may_go_on != nullptr);
  open.robot.now_s = 93.9;
  EXPECT_TRUE(open.navigator.may_go_on()) << "it is at home";
  open.robot.now_s = 94.1;
  EXPECT_FALSE(open.navigator.may_go_on());
}

/// Back the way it came are at least 2.8 m, for which 6 s are too few; straight home are 0.2 m.
TEST(BudgetKeeper, LooksForAShorterWayHomeBeforeItTurnsBack) {
  OnOpenFloor open({.time_s = 100.0, .return_to_start = true});
  for (const double x_m : {3.0, 0.2}) {
    EXPECT_TRUE(open.navigator.approach({x_m, 0.0, 0.0}, std::nullopt).reached);
    EXPECT_NEAR(open.robot.T_world_base.x_m, x_m, 1e-9);
  }
  open.robot.now_s = 88.0;
  EXPECT_TRUE(open.navigator.may_go_on());
  open.robot.now_s = 92.0;
  EXPECT_FALSE(open.navigator.may_go_on()) << "not even there in 2 s";
}

/// Its scanner sees nothing.
TEST(Navigator, TellsNothingOfTheWayWhereItDoesNotKnowWhereItIs) {
  OnOpenFloor open({});
  int told = 0;
  open.navigator.on_the_way = [&] { ++told; };
  EXPECT_TRUE(open.navigator.approach({3.0, 0.0, 0.0}, std::nullopt).reached);
  EXPECT_EQ(told, 0);
  EXPECT_GT(open.navigator.path_m().size(), 0U);
}

nlohmann::ordered_json told(const BudgetOptions& options, double now_s, double used_j) {
  OnOpenFloor open(options);
  open.robot.now_s = now_s;
  open.robot.used_j = used_j;
  open.robot.T_world_base = {0.3, -0.4, 1.0};
  nlohmann::ordered_json metrics;
  open.keeper.add_metrics(metrics);
  EXPECT_EQ(metrics["energy_j"], used_j);
  return metrics;
}

TEST(BudgetKeeper, TellsWhetherItWasKept) {
  EXPECT_FALSE(told({}, 10.0, 20.0).contains("budget"));
  const BudgetOptions limits{.time_s = 100.0, .energy_j = 50.0};
  EXPECT_EQ(told(limits, 100.0, 50.0)["budget"]["kept"], true);
  EXPECT_EQ(told(limits, 100.5, 50.0)["budget"]["kept"], false);
  EXPECT_EQ(told(limits, 100.0, 50.5)["budget"]["kept"], false);
  const auto home = told({.time_s = 100.0, .return_to_start = true}, 10.0, 20.0)["budget"];
  EXPECT_EQ(home["kept"], false) << "it has not returned";
  EXPECT_EQ(home["returned"], false);
  EXPECT_EQ(home["time_s"], 100.0);
  EXPECT_TRUE(home["energy_j"].is_null());
  EXPECT_NEAR(home["from_start_m"].get<double>(), 0.5, 1e-12);
  EXPECT_TRUE(told({.return_to_start = true}, 10.0, 20.0).contains("budget"));
}

TEST(BudgetText, NamesWhatIsLimited) {
  EXPECT_EQ(budget_text({.energy_j = 2500.0}), "budget.energy_j 2500");
  EXPECT_EQ(budget_text({.time_s = 600.0}), "budget.time_s 600");
  EXPECT_EQ(budget_text({.time_s = 600.0, .energy_j = 9e5}),
            "budget.time_s 600 and budget.energy_j 900000");
}

/// 4000 J in 10 s of driving and 2000 J in 20 s of scanning; then 100 J in half a second, and 25 J.
TEST(SpendingRates, CountFromTheStartOfTheEpisode) {
  SpendingRates rates(0.6);
  ScanRecord scan;
  scan.time_s = 30.0;
  scan.scan_time_s = 20.0;
  scan.energy_j = 6000.0;
  scan.scan_energy_j = 2000.0;
  rates.observe(scan, nullptr);
  EXPECT_NEAR(rates.driving_w(), 400.0, 1e-9);
  EXPECT_NEAR(rates.scanning_w(), 100.0, 1e-9);
  SpendingRates brief(0.6);
  scan.time_s = 0.75;
  scan.scan_time_s = 0.25;
  scan.energy_j = 125.0;
  scan.scan_energy_j = 25.0;
  brief.observe(scan, nullptr);
  EXPECT_NEAR(brief.driving_w(), 200.0, 1e-9);
  EXPECT_NEAR(brief.scanning_w(), 100.0, 1e-9);
  scan.scan_share = 0.75;
  scan.scan_time_s = 9.0;
  brief.observe(scan, nullptr);
  EXPECT_EQ(brief.scan_s(), 0.25) << "of the last whole one";
}

/// 10 m there and half a metre home take 1.15 x 21 s, twice 3 s to start, the scan 20, the reserve
/// 6: 56.15 s. From where it is half a metre from home: 1.15 + 3 + 20 + 6 s.
TEST(Budget, AShortWayHomeIsADriveToo) {
  const Budget budget({.time_s = 1000.0});
  const SpendingRates rates = known_rates();
  EXPECT_TRUE(budget.affords_view(rates, {1000.0 - 56.3, 0.0}, 10.0, 0.5));
  EXPECT_FALSE(budget.affords_view(rates, {1000.0 - 56.0, 0.0}, 10.0, 0.5));
  EXPECT_TRUE(budget.affords_way_home(rates, {1000.0 - 30.3, 0.0}, 0.5));
  EXPECT_FALSE(budget.affords_way_home(rates, {1000.0 - 30.0, 0.0}, 0.5));
}

TEST(BudgetKeeper, FailsNoEpisodeThatHasScannedTwice) {
  EXPECT_EQ(reason({.time_s = 1000.0}, false, 50.0, 2), "no view is left in reach");
  EXPECT_EQ(reason({.time_s = 1000.0}, true, 999.0, 2),
            "budget.time_s 1000 allows no further view");
}

/// With 13 s left 1.5 m home are affordable (11.7 s), back the way it came (18 s) or 3 m (14.8 s)
/// are not.
TEST(BudgetKeeper, CountsOnFromTheShorterWayHomeItFound) {
  OnOpenFloor open({.time_s = 100.0, .return_to_start = true});
  for (const double x_m : {3.0, 1.5}) {
    ASSERT_TRUE(open.navigator.approach({x_m, 0.0, 0.0}, std::nullopt).reached);
  }
  open.robot.now_s = 87.0;
  EXPECT_TRUE(open.navigator.may_go_on());
  const Approach farther = open.navigator.approach({3.0, 0.0, 0.0}, std::nullopt);
  EXPECT_FALSE(farther.reached);
  EXPECT_TRUE(farther.turned_back);
}

/// Though the time that is left does not allow for it.
TEST(BudgetKeeper, ComesHomeWithoutTurningBack) {
  OnOpenFloor open({.time_s = 100.0, .return_to_start = true});
  open.robot.T_world_base = {3.0, 0.0, 0.0};
  open.robot.now_s = 99.0;
  open.keeper.come_home();
  nlohmann::ordered_json metrics;
  open.keeper.add_metrics(metrics);
  EXPECT_EQ(metrics["budget"]["returned"], true);
  EXPECT_EQ(metrics["budget"]["kept"], true);
  EXPECT_NEAR(metrics["budget"]["from_start_m"].get<double>(), 0.0, 1e-9);
}

/// A flat wall two metres ahead, which does not tell where along it the robot is.
struct RobotBeforeAWall : StandingRobot {
  PlanarScan read_base_scanner() override {
    PlanarScan scan{.T_base_sensor = {}, .azimuth_rad = {}, .range_m = {}, .range_max_m = 10.0};
    for (int i = -50; i <= 50; ++i) {
      scan.azimuth_rad.push_back(0.01 * i);
      scan.range_m.push_back(static_cast<float>(2.02 / std::cos(0.01 * i)));
    }
    return scan;
  }
};

TEST(Navigator, KnowsTheFloorAheadWhereItMayNotTurn) {
  RobotBeforeAWall robot;
  Navigator navigator({}, {}, {}, robot, ReferenceMap(RegistrationOptions{}), 1);
  navigator.turn_in_place();
  EXPECT_EQ(navigator.floor().state_at({1.5, 0.02}), CellState::free);
  EXPECT_EQ(navigator.floor().state_at({2.02, 0.02}), CellState::occupied);
  EXPECT_EQ(navigator.floor().state_at({-1.5, 0.02}), CellState::unobserved);
}

/// The floor, what blocks it, or where the robot is.
TEST(Navigator, PlansAnewOnlyWhereSomethingHasChanged) {
  OnOpenFloor open({});
  const auto first = open.navigator.plan();
  EXPECT_TRUE(open.navigator.plan() == first);
  open.navigator.floor().log_odds.back() = 2.0F;
  const auto second = open.navigator.plan();
  EXPECT_FALSE(second == first);
  open.navigator.floor().blocked.back() = 1;
  const auto third = open.navigator.plan();
  EXPECT_FALSE(third == second);
  open.robot.T_world_base.yaw_rad = 0.1;
  EXPECT_FALSE(open.navigator.plan() == third);
}

/// All beams are at the end of their range.
struct SaturatedRobot : StandingRobot {
  PlanarScan read_base_scanner() override {
    PlanarScan scan{.T_base_sensor = {}, .azimuth_rad = {}, .range_m = {}, .range_max_m = 3.0};
    for (int i = -50; i <= 50; ++i) {
      scan.azimuth_rad.push_back(0.01 * i);
      scan.range_m.push_back(3.0F);
    }
    return scan;
  }
};

TEST(Navigator, LearnsNothingFromReadingsThatAreSaturated) {
  SaturatedRobot robot;
  Navigator navigator({}, {}, {}, robot, ReferenceMap(RegistrationOptions{}), 1);
  navigator.turn_in_place();
  EXPECT_EQ(navigator.floor().state_at({1.5, 0.02}), CellState::unobserved);
  EXPECT_EQ(navigator.floor().state_at({2.98, 0.02}), CellState::unobserved);
  EXPECT_TRUE(navigator.reference_map().cloud().empty());
}

struct SquareRobot : StandingRobot {
  [[nodiscard]] RobotOutline outline() const override {
    return {.outline = {{-0.2, -0.2}, {0.2, -0.2}, {0.2, 0.2}, {-0.2, 0.2}}};
  }
};

TEST(Navigator, PlansByTheFinerMapAsItIs) {
  SquareRobot robot;
  Navigator navigator({.cell_m = 0.1, .half_size_m = 2.0}, {}, {}, robot,
                      ReferenceMap(RegistrationOptions{}), 1);
  navigator.use_passages({}, {});
  ASSERT_TRUE(navigator.detail() != nullptr);
  std::ranges::fill(navigator.detail()->log_odds, -2.0F);
  const FloorOutline outline = robot.outline().outline;
  const Pose2 ahead{1.0, 0.0, 0.0};
  EXPECT_TRUE(navigator.plan()->space->fits(outline, ahead));
  block_box(*navigator.detail(), {Eigen::Vector2d(1.0, -0.1), Eigen::Vector2d(1.1, 0.1)});
  EXPECT_FALSE(navigator.plan()->space->fits(outline, ahead));
}

TEST(BudgetKeeper, LooksForOneThatCanBePaidAmongAllViews) {
  OnOpenFloor open({.time_s = 100.0});
  std::vector<Candidate> views{view_at(4.0, 400.0), view_at(3.0, 3.0)};
  EXPECT_EQ(open.keeper.used_up(views, 3), "");
  views[0].exhausted = true;
  EXPECT_EQ(open.keeper.used_up(views, 3), "");
  views[0].exhausted = false;
  views[1].exhausted = true;
  EXPECT_EQ(open.keeper.used_up(views, 3), "budget.time_s 100 allows no further view");
}

/// For 3 m it needs 8.8 s, for 4 m it would need 10.9 s.
TEST(BudgetKeeper, CountsTheWayItCameWhereItKnowsNoWayHome) {
  OnOpenFloor open({.time_s = 100.0, .return_to_start = true});
  ASSERT_TRUE(open.navigator.approach({3.0, 0.0, 0.0}, std::nullopt).reached);
  std::ranges::fill(open.navigator.floor().log_odds, 2.0F);
  open.robot.now_s = 100.0 - 6.0 - 9.8;
  EXPECT_TRUE(open.navigator.may_go_on());
  open.robot.now_s = 100.0 - 6.0 - 7.8;
  EXPECT_FALSE(open.navigator.may_go_on());
}

}  // namespace
}  // namespace vantage
