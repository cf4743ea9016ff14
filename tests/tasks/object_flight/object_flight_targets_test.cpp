// Which of several targets a flight looks at next.
#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "tests/tasks/object_flight/scripted_flight.hpp"
#include "vantage/tasks/object_flight/object_flight_metrics.hpp"
#include "vantage/tasks/object_flight/object_flight_parts.hpp"

namespace vantage {
namespace {

using support::expect_same_places;
using support::expect_same_turn;
using support::kRightAngle_rad;
using support::ScriptedFlight;
using testing::ElementsAre;
using testing::HasSubstr;

/// The nearest view of each counts, however far off its others are.
TEST_F(ScriptedFlight, GoesOnToTheTargetThatIsReachedSoonest) {
  task_.decision.max_views = 1;
  const FlightGoal three = goal(3);
  ObjectFlightParts parts(context(), three, what_is_it(), 0.5);
  look(parts);
  const double radius_m = task_.orbit().radius_m;
  const auto targets_of = [&](double second_s, double third_s) {
    robot_.duration_s = [=](const Pose& place) {
      const Eigen::Vector2d from_m = (place.translation() - three.p_world_m[1]).head<2>();
      const bool second = std::abs(from_m.norm() - radius_m) < 1e-6;
      const double x_m = second ? from_m.x() : from_m.x() - 0.3;
      const double farther_m = x_m + radius_m * std::cos(0.5);
      return second ? second_s + 4.0 * farther_m : third_s + farther_m;
    };
    std::vector<std::size_t> targets;
    for (const BearingOption& option : offered(parts)) targets.push_back(option.target);
    return targets;
  };
  EXPECT_THAT(targets_of(3.0, 2.0), ElementsAre(2U, 2U, 2U, 2U));
  EXPECT_THAT(targets_of(2.0, 3.0), ElementsAre(1U, 1U, 1U, 1U));
  robot_.duration_s = [](const Pose& /*place*/) { return 1.5; };
  for (const BearingOption& option : offered(parts)) EXPECT_EQ(option.target, 1U) << "the first";
}

TEST_F(ScriptedFlight, AllTargetsCompeteAtOnceEachByItsOwnLastView) {
  FlightGoal both = goal(2);
  both.all_at_once = true;
  ObjectFlightParts parts(context(), both, what_is_it(), 0.5);
  look(parts);
  const std::vector<BearingOption> first = offered(parts);
  std::vector<std::size_t> targets;
  for (const BearingOption& option : first) targets.push_back(option.target);
  ASSERT_THAT(targets, ElementsAre(0U, 0U, 0U, 1U, 1U, 1U, 1U));
  expect_same_turn(first[4].action.yaw_rad, kRightAngle_rad);
  EXPECT_FALSE(first[3].action.visited) << "from there the other one was looked at";
  parts.act(first[4]);
  look(parts);
  EXPECT_EQ(parts.records().back().target, 1U);
  EXPECT_EQ(parts.tour().current_id(), 1U);
  EXPECT_THAT(parts.tour().targets()[1].bearing_ids, ElementsAre(1));
  EXPECT_EQ(parts.tour().targets()[1].bearing_rad, first[4].bearing_rad);
  EXPECT_EQ(last_view_of(parts, 0), &parts.records()[0]);
  EXPECT_EQ(last_view_of(parts, 1), &parts.records()[1]);
  EXPECT_EQ(last_view_of(parts, 2), nullptr);

  const std::vector<BearingOption> second = offered(parts);
  ASSERT_EQ(second.size(), 7U);
  EXPECT_EQ(second[0].id, 0);
  EXPECT_TRUE(second[0].action.visited);
  EXPECT_FALSE(second[1].action.visited);
  expect_same_turn(second[0].action.yaw_rad, 0.0);
  expect_same_turn(second[5].action.yaw_rad, kRightAngle_rad);
  expect_same_places(second[0].T_world_way,
                     orbit_way(task_.orbit_round(both.p_world_m[1]), first[4].bearing_rad,
                               task_.orbit(), 0.5, task_.arc_rad));
}

TEST_F(ScriptedFlight, TriesATargetAgainWhileOthersAreLookedAt) {
  FlightGoal both = goal(2);
  both.time_limit_s = 30.0;
  both.all_at_once = true;
  ObjectFlightParts parts(context(), both, what_is_it(), 0.5);
  look(parts);
  const double radius_m = task_.orbit().radius_m;
  robot_.duration_s = [&](const Pose& place) {
    const Eigen::Vector2d from_m = (place.translation() - both.p_world_m[1]).head<2>();
    return std::abs(from_m.norm() - radius_m) < 1e-6 ? 100.0 : 1.5;
  };
  const std::vector<BearingOption> first = offered(parts);
  EXPECT_EQ(first.size(), 3U) << "the second target is too far";
  parts.act(first[0]);
  look(parts);
  robot_.duration_s = [](const Pose& /*place*/) { return 1.5; };
  EXPECT_EQ(parts.finished(), "");
  EXPECT_THAT(parts.tour().open(), ElementsAre(0U, 1U));
  robot_.now_s = 29.0;
  EXPECT_THAT(parts.finished(), HasSubstr("time_limit_s = 30; no view"));
}

/// Also where a target is looked at until it is over.
TEST_F(ScriptedFlight, ATargetThatIsOutOfReachWaitsForViewsOfOthers) {
  FlightGoal both = goal(2);
  both.time_limit_s = 30.0;
  ObjectFlightParts parts(context(), both, what_is_it(), 0.5);
  look(parts);
  const double radius_m = task_.orbit().radius_m;
  robot_.duration_s = [&](const Pose& place) {
    const Eigen::Vector2d from_m = (place.translation() - both.p_world_m[0]).head<2>();
    return std::abs(from_m.norm() - radius_m) < 1e-6 ? 100.0 : 1.5;
  };
  const std::vector<BearingOption> second = offered(parts);
  ASSERT_EQ(second.size(), 4U);
  EXPECT_EQ(second[0].target, 1U);
  parts.act(second[0]);
  look(parts);
  EXPECT_THAT(parts.tour().not_over(), ElementsAre(0U, 1U)) << "the first is not given up";
}

}  // namespace
}  // namespace vantage
