// What is handed to a choice from outside, and what is made of its answer.
#include "vantage/tasks/mapping/outside_decision.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>
#include <vector>

#include "tests/tasks/mapping/standing_robot.hpp"
#include "vantage/planners/swept_gain.hpp"
#include "vantage/runtime/episode_loop.hpp"
#include "vantage/tasks/mapping/view_planner.hpp"

namespace vantage {
namespace {

MappingOptions small_map() {
  MappingOptions options;
  options.map.cells = {4, 4, 2};
  return options;
}

struct NothingKnown : MapBelief {
  NothingKnown() : MapBelief(small_map()) {}
};

/// A robot on open floor, and two views of which the second is out of reach.
struct Asking {
  explicit Asking(const BudgetOptions& options = {}) : budget(options, 0.6, robot, navigator) {
    robot.now_s = 12.5;
    robot.used_j = 340.0;
    candidates[0].id = 0;
    candidates[0].path_length_m = 3.0;
    candidates[0].gain_bits = 40.0;
    candidates[1].id = 1;
    candidates[1].path_length_m = std::numeric_limits<double>::infinity();
    candidates[1].gain_bits = 90.0;
    interval.start(500.0);
  }
  std::size_t decide(const Gain& gain,
                     const std::function<OutsideDecision(const DecisionRequest&)>& answer) {
    const OutsideChoice outside{.name = "mine", .decide = answer, .ended = {}};
    return decide_outside(
        outside, {belief, transmission, robot, budget, 3, 4, &interval}, *navigator.plan(), gain,
        [] { return std::size_t{1}; }, candidates);
  }
  PlanningSituation situation(const PathField& paths) {
    return {.belief = belief,
            .transmission = transmission,
            .robot = robot,
            .paths = paths,
            .budget = budget,
            .threads = 1};
  }
  std::string failure(const OutsideDecision& decision) {
    try {
      decide(SimpleGain{}, [&](const DecisionRequest&) { return decision; });
    } catch (const EpisodeFailed& error) {
      return error.what();
    }
    return "none";
  }

  support::StandingRobot robot;
  NothingKnown belief;
  BlockField transmission = belief.hazard().transmission();
  Navigator navigator = [this] {
    Navigator on_floor({}, {}, {}, robot, ReferenceMap(RegistrationOptions{}), 1);
    std::ranges::fill(on_floor.floor().log_odds, -2.0F);
    return on_floor;
  }();
  BudgetKeeper budget;
  ForecastInterval interval{ForecastIntervalOptions{}};
  std::vector<Candidate> candidates = std::vector<Candidate>(2);
};

TEST(OutsideDecision, IsAskedWithWhatTheRobotKnows) {
  Asking asking({.time_s = 1000.0});
  const std::size_t chosen = asking.decide(AdaptiveGain{}, [&](const DecisionRequest& request) {
    EXPECT_EQ(request.situation.scans, 3U);
    EXPECT_EQ(request.situation.scans_left, 4);
    EXPECT_EQ(request.situation.time_s, 12.5);
    EXPECT_EQ(request.situation.energy_j, 340.0);
    EXPECT_DOUBLE_EQ(request.situation.left.time_s, 981.5);
    EXPECT_EQ(request.travel_s.size(), 2U);
    EXPECT_NEAR(request.travel_s[0], 8.0, 1e-9) << "2.5 s to start and 1.1 s for each 0.6 m";
    EXPECT_TRUE(std::isinf(request.travel_s[1]));
    EXPECT_EQ(request.interval_cells.size(), 2U);
    const CellInterval second = asking.interval.of(90.0);
    EXPECT_EQ(request.interval_cells[1][0], second.low);
    EXPECT_EQ(request.interval_cells[1][1], second.high);
    return OutsideDecision(request.own_choice());
  });
  EXPECT_EQ(chosen, 1U);
  EXPECT_EQ(asking.candidates.size(), 2U);
}

TEST(OutsideDecision, OfAnotherGainForecastsNothing) {
  Asking asking;
  asking.decide(SimpleGain{}, [](const DecisionRequest& request) {
    EXPECT_TRUE(request.interval_cells.empty());
    return OutsideDecision(std::size_t{0});
  });
}

/// The sensor is 0.25 m ahead of the base, and a metre up.
TEST(OutsideDecision, APoseIsOneMoreCandidate) {
  Asking asking;
  const std::size_t chosen = asking.decide(SimpleGain{}, [](const DecisionRequest&) {
    return OutsideDecision(Pose2{2.0, 0.0, 0.5 * std::numbers::pi});
  });
  EXPECT_EQ(chosen, 2U);
  ASSERT_EQ(asking.candidates.size(), 3U);
  const Candidate& own = asking.candidates.back();
  EXPECT_EQ(own.id, 2);
  EXPECT_NEAR(own.path_length_m, 2.0, 0.1);
  EXPECT_NEAR((own.T_world_sensor.translation() - Eigen::Vector3d(2.0, 0.25, 1.0)).norm(), 0.0,
              1e-9);
}

TEST(OutsideDecision, ThatCannotBeCarriedOutSaysWhoseItIs) {
  EXPECT_EQ(Asking().failure(std::size_t{2}), "mine: view 2 was chosen, there are 2");
  EXPECT_EQ(Asking({.time_s = 20.0}).failure(Pose2{5.0, 0.0, 0.0}),
            "mine: the budget does not allow the pose that was chosen");
  EXPECT_EQ(Asking({.time_s = 100.0}).failure(Pose2{5.0, 0.0, 0.0}), "none");
}

TEST(MapBelief, IsPartOfThatOfATask) {
  EXPECT_TRUE(std::is_destructible_v<NothingKnown>);
  EXPECT_FALSE(std::is_destructible_v<MapBelief>);
}

/// It looks at the map as the other one does.
TEST(PlanAhead, ExpectsNothingOfAnExhaustedView) {
  Asking asking;
  for (Candidate& view : asking.candidates) view.T_world_sensor = make_pose({-1.5, 0.0, 1.0}, 0.0);
  asking.candidates[1].exhausted = true;
  MappingOptions options = small_map();
  options.gain = SimpleGain{};
  options.choice = TourChoice{};
  const auto paths = asking.navigator.plan();
  const PlanningSituation situation = asking.situation(*paths);
  Rng rng(1);
  const MappingPlan plan = plan_ahead(options, asking.candidates, situation, rng);
  ASSERT_EQ(plan.gains.size(), 2U);
  EXPECT_GT(plan.gains[0], 0.0);
  EXPECT_EQ(plan.gains[1], 0.0);
}

TEST(OutsideDecision, APoseIsWorthWhatTheGainInUseSaysOfIt) {
  Asking asking;
  asking.decide(SimpleGain{}, [](const DecisionRequest&) {
    return OutsideDecision(Pose2{-1.5, 0.0, 0.0});
  });
  ASSERT_EQ(asking.candidates.size(), 3U);
  const std::vector<Candidate> own{asking.candidates.back()};
  EXPECT_GT(own[0].gain_bits, 0.0);
  EXPECT_EQ(own[0].gain_bits,
            view_gains_bits(Gain{SimpleGain{}}, {asking.belief.filled_grid(), &asking.transmission},
                            own, asking.robot.view_field(), 1)
                .front());
}

/// Ten seconds of driving at 400 W, and 20 of scanning at 100 W.
TEST(PlanAhead, KnowsWhatIsLeftAndWhatItTakes) {
  Asking asking({.time_s = 1000.0, .return_to_start = true});
  ScanRecord scan;
  scan.time_s = 30.0;
  scan.scan_time_s = 20.0;
  scan.energy_j = 6000.0;
  scan.scan_energy_j = 2000.0;
  asking.budget.observe(scan, nullptr);
  asking.candidates.resize(3);
  asking.candidates[0].exhausted = true;
  asking.candidates[1].T_world_sensor = make_pose({3.0, 0.0, 1.0}, 0.0);
  asking.candidates[2].T_world_sensor = make_pose({1.0, 1.0, 1.0}, 0.0);
  std::vector<Candidate> later(1);
  later[0].T_world_sensor = make_pose({-2.0, 1.0, 1.0}, 0.0);
  MappingOptions options = small_map();
  options.choice = TourChoice{};
  const auto paths = asking.navigator.plan();
  PlanningSituation situation = asking.situation(*paths);
  situation.scans_left = 5;
  situation.later = later;
  situation.intended_m = Eigen::Vector2d(1.0, 2.2);
  const PlanningProblem problem =
      planning_problem(options, SimpleGain{}, asking.candidates, situation);
  const std::vector<Eigen::Vector2d> places_m{{3.0, 0.0}, {1.0, 1.0}, {-2.0, 1.0}};
  ASSERT_EQ(problem.views(), 3U) << "none of the exhausted one";
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR((problem.place_m[i] - places_m[i]).norm(), 0.0, 1e-12) << i;
  }
  EXPECT_EQ(problem.left.scans, 5U);
  EXPECT_DOUBLE_EQ(problem.left.time_s, 1000.0 - 12.5 - 6.0);
  EXPECT_EQ(problem.home_s, asking.budget.home_s(places_m));
  EXPECT_EQ(problem.home_s.size(), 4U);
  EXPECT_DOUBLE_EQ(problem.driving_w, 400.0);
  EXPECT_DOUBLE_EQ(problem.scanning_w, 100.0);
  EXPECT_EQ(problem.scan_s, 20.0);
  EXPECT_EQ(problem.intended, std::size_t{1}) << "1.2 m off";
  situation.intended_m = Eigen::Vector2d(1.0, 3.0);
  EXPECT_FALSE(planning_problem(options, SimpleGain{}, asking.candidates, situation).intended)
      << "2 m off";
}

/// The first of its candidates is exhausted.
TEST(PlanAhead, NamesItsViewsByTheirPlaceAmongAllCandidates) {
  Asking asking;
  for (Candidate& view : asking.candidates) view.T_world_sensor = make_pose({-1.5, 0.0, 1.0}, 0.1);
  asking.candidates[0].exhausted = true;
  asking.candidates[1].id = 7;
  asking.candidates[1].path_length_m = 2.0;
  MappingOptions options = small_map();
  options.gain = SimpleGain{};
  options.choice = TourChoice{};
  const auto paths = asking.navigator.plan();
  const PlanningSituation situation = asking.situation(*paths);
  Rng rng(1);
  const MappingPlan plan = plan_ahead(options, asking.candidates, situation, rng);
  EXPECT_EQ(plan.order, std::vector<std::size_t>{1});
  ASSERT_EQ(plan.gains.size(), 2U);
  EXPECT_EQ(plan.gains[0], 0.0);
  EXPECT_GT(plan.gains[1], 0.0);
  ASSERT_EQ(plan.tour.stops.size(), 1U);
  EXPECT_EQ(plan.tour.stops[0].id, 7);
  EXPECT_NEAR(plan.tour.stops[0].yaw_rad, 0.1, 1e-9);
  EXPECT_NEAR((plan.tour.stops[0].place_m - Eigen::Vector2d(-1.5, 0.0)).norm(), 0.0, 1e-9);
}

}  // namespace
}  // namespace vantage
