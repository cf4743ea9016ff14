#include "vantage/tasks/mapping/driving/budget.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "vantage/runtime/episode_loop.hpp"
#include "vantage/tasks/mapping/driving/budget_keeper.hpp"

namespace vantage {
namespace {

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

/// Knows no floor but what it stands on.
class StandingRobot : public MobileRobotInterface {
 public:
  double now_s = 0.0;
  [[nodiscard]] double time_s() const override { return now_s; }
  [[nodiscard]] double energy_used_j() const override { return 0.0; }
  PlanarScan read_base_scanner() override { return {}; }
  DriveResult drive_along(std::span<const Pose2> /*path*/, double /*max_speed_m_s*/,
                          const std::function<bool()>& /*go_on*/) override {
    return {};
  }
  void correct_pose(const Pose2& /*T_world_base*/) override {}
  [[nodiscard]] Pose2 dead_reckoned_base() const override { return {}; }
  void restart_dead_reckoning() override {}
  [[nodiscard]] Pose2 estimated_base() const override { return {}; }
  [[nodiscard]] double base_scan_height_m() const override { return 0.3; }
  [[nodiscard]] double inscribed_radius_m() const override { return 0.2; }
  [[nodiscard]] RobotOutline outline() const override { return {}; }
  [[nodiscard]] Pose estimated_sensor() const override { return Pose::Identity(); }
  [[nodiscard]] Pose2 base_for_sensor(const Pose& T_world_sensor) const override {
    return project_to_se2(T_world_sensor);
  }
  [[nodiscard]] FieldOfView view_field() const override { return {}; }
};

/// Why no view is taken, of one at 3 m that is in reach or not.
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

TEST(BudgetText, NamesWhatIsLimited) {
  EXPECT_EQ(budget_text({.time_s = 600.0}), "budget.time_s 600");
  EXPECT_EQ(budget_text({.time_s = 600.0, .energy_j = 9e5}),
            "budget.time_s 600 and budget.energy_j 900000");
}

}  // namespace
}  // namespace vantage
