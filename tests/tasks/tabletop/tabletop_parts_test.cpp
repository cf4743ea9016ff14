// What the parts at a table make of scans and of views that they do not get to.
#include "vantage/tasks/tabletop/tabletop_parts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tests/tasks/mapping/still_table.hpp"

namespace vantage {
namespace {

using support::still_table;
using support::StillTable;
using support::StillTabletopRobot;
using testing::HasSubstr;

/// It sees what it is told to, and asks on its way whether it may go on.
struct ToldTabletopRobot : StillTabletopRobot {
  using StillTabletopRobot::StillTabletopRobot;
  TabletopObservation observe() override { return to_see.at(asked++); }
  PlanarScan read_base_scanner() override { return {}; }
  DriveResult drive_along(std::span<const Pose2> /*path*/, double /*max_speed_m_s*/,
                          const std::function<bool()>& go_on) override {
    for (int tick = 0; tick < 10; ++tick) {
      if (!go_on()) return {.status = DriveStatus::stopped};
    }
    return {};
  }
  std::vector<TabletopObservation> to_see;
  std::size_t asked = 0;
};

struct ScannedParts : TabletopParts {
  ScannedParts(StillTable& table, StillTabletopRobot& robot, TabletopBelief& belief)
      : TabletopParts(
            MappingContext{table.options, robot, table.evaluator, table.recorder, nullptr},
            table.task, robot, belief) {}
  using TabletopParts::before_update;
  using TabletopParts::current_;
  using TabletopParts::navigator_;
  using TabletopParts::predict;
  using TabletopParts::scans_;
  std::vector<std::pair<std::string, double>> predicted_cells() {
    static_cast<void>(before_update());
    return current_.predicted_cells;
  }
};

struct AtToldTable {
  StillTable& table = still_table();
  ToldTabletopRobot robot{table.episode.setup, table.task};
  TabletopBelief belief{table.options, table.task};
  ScannedParts parts{table, robot, belief};
  AtToldTable() { robot.T_world_base = {-1.5, 0.0, 0.0}; }
};

/// Of 20 lines of 3 beams, up to 5 m, all readings different.
TabletopObservation lines_from(float least_m) {
  TabletopObservation observation;
  RangeScan& scan = observation.scan;
  for (int line = 0; line < 20; ++line) scan.tilt_rad.push_back(0.01 * line);
  scan.azimuth_rad = {-0.1, 0.0, 0.1};
  for (int i = 0; i < 60; ++i) scan.range_m.push_back(least_m + 0.01F * static_cast<float>(i));
  scan.field_of_view.range_max_m = 5.0;
  return observation;
}

TabletopObservation with_usable_lines(std::ptrdiff_t lines, float least_m) {
  TabletopObservation observation = lines_from(least_m);
  std::fill(observation.scan.range_m.begin() + 3 * lines, observation.scan.range_m.end(), 0.0F);
  return observation;
}

TEST(TabletopParts, TakeAScanAgainOfWhichLessThanATenthSaysAnything) {
  AtToldTable at;
  at.parts.scans_.resize(1);
  at.robot.to_see = {with_usable_lines(1, 1.0F), with_usable_lines(2, 1.5F)};
  testing::internal::CaptureStderr();
  const TabletopObservation seen = at.parts.observe();
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("it is taken again"));
  EXPECT_EQ(at.robot.asked, 2U);
  EXPECT_EQ(std::ranges::count_if(seen.scan.range_m, [](float m) { return m > 0.0F; }), 6);
}

/// The second scan begins with the line that the first one ended with.
TEST(TabletopParts, DiscardReadingsThatSayNothing) {
  AtToldTable at;
  at.parts.scans_.resize(1);
  at.robot.to_see = {lines_from(1.0F), lines_from(2.0F)};
  at.robot.to_see[0].scan.range_m[7] = 5.0F;
  at.robot.to_see[0].base_scan = {
      .T_base_sensor = {}, .azimuth_rad = {0.0, 0.1}, .range_m = {2.0F, 0.0F}, .range_max_m = 9.0};
  std::copy(at.robot.to_see[0].scan.range_m.end() - 3, at.robot.to_see[0].scan.range_m.end(),
            at.robot.to_see[1].scan.range_m.begin());
  const TabletopObservation first = at.parts.observe();
  for (std::size_t i = 0; i < first.scan.range_m.size(); ++i) {
    EXPECT_EQ(std::isnan(first.scan.range_m[i]), i == 7) << i;
  }
  EXPECT_EQ(first.base_scan.range_m[0], 2.0F);
  EXPECT_TRUE(std::isnan(first.base_scan.range_m[1]));
  const TabletopObservation second = at.parts.observe();
  for (std::size_t i = 0; i < second.scan.range_m.size(); ++i) {
    EXPECT_EQ(std::isnan(second.scan.range_m[i]), i < 3) << i;
  }
}

TEST(TabletopParts, ScanFromTheViewThatTheyHaveReached) {
  AtToldTable at;
  std::ranges::fill(at.parts.navigator_.floor().log_odds, -2.0F);
  const Candidate view = at.parts.views()[5];
  testing::internal::CaptureStderr();
  at.parts.act(view);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(at.parts.current_.chosen_view, 5);
  EXPECT_FALSE(at.parts.current_.fallback);
  EXPECT_FALSE(at.parts.views()[5].exhausted);
  const auto predicted = at.parts.predicted_cells();
  at.parts.predict(view.T_world_sensor);
  EXPECT_EQ(predicted, at.parts.predicted_cells());
}

/// The floor is not known there.
TEST(TabletopParts, GiveUpAViewThatIsOutOfReach) {
  AtToldTable at;
  const Candidate view = at.parts.views()[5];
  testing::internal::CaptureStderr();
  at.parts.act(view);
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              HasSubstr("view 5 is out of reach: scanning from as near as possible"));
  EXPECT_EQ(at.parts.current_.chosen_view, 5);
  EXPECT_TRUE(at.parts.current_.fallback);
  EXPECT_TRUE(at.parts.views()[5].exhausted);
  EXPECT_EQ(std::ranges::count(at.parts.views(), true, &Candidate::exhausted), 1);
  const auto predicted = at.parts.predicted_cells();
  at.parts.predict(at.robot.estimated_sensor());
  EXPECT_EQ(predicted, at.parts.predicted_cells()) << "from where it is";
  at.parts.predict(view.T_world_sensor);
  EXPECT_NE(predicted, at.parts.predicted_cells());
}

TEST(TabletopParts, KeepAViewThatTheBudgetKeptThemFrom) {
  AtToldTable at;
  std::ranges::fill(at.parts.navigator_.floor().log_odds, -2.0F);
  at.parts.navigator_.may_go_on = [] { return false; };
  testing::internal::CaptureStderr();
  at.parts.act(at.parts.views()[5]);
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              HasSubstr("view 5 is given up, since the budget allows no longer way"));
  EXPECT_TRUE(at.parts.current_.fallback);
  EXPECT_FALSE(at.parts.views()[5].exhausted);
}

}  // namespace
}  // namespace vantage
