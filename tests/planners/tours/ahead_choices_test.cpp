/// What each choice that plans ahead is known for.
#include <gtest/gtest.h>

#include "tests/planners/tours/small_problem.hpp"
#include "vantage/planners/tours/frontier_tour.hpp"
#include "vantage/planners/tours/information_rate.hpp"
#include "vantage/planners/tours/receding_horizon.hpp"
#include "vantage/planners/tours/rollout.hpp"
#include "vantage/planners/tours/tour.hpp"
#include "vantage/planners/tours/two_level_tour.hpp"

namespace vantage {
namespace {

/// Views on a line at those places, showing so many cells of their own; the robot at 0, a metre a
/// second.
PlanningProblem on_a_line(const std::vector<double>& x_m, const std::vector<float>& cells) {
  PlanningProblem problem;
  problem.cells = cells;
  problem.scan_s = 2.0;
  const auto n = static_cast<Eigen::Index>(x_m.size());
  problem.travel_s.resize(n + 1, n);
  for (Eigen::Index i = 0; i <= n; ++i) {
    const double from = i == n ? 0.0 : x_m[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < n; ++j) {
      problem.travel_s(i, j) = std::abs(x_m[static_cast<std::size_t>(j)] - from);
    }
  }
  for (std::size_t i = 0; i < x_m.size(); ++i) {
    problem.place_m.emplace_back(x_m[i], 0.0);
    problem.shows.push_back({{static_cast<std::uint32_t>(i)}, {1.0F}});
  }
  return problem;
}

test::Order order_of(const auto& choice, const PlanningProblem& problem, std::uint64_t seed = 1) {
  Rng rng(seed);
  return choice(problem, rng).order;
}

TEST(InformationRate, TakesTheMostASecond) {
  // 10 / 3, 30 / 12, 100 / 22 cells a second
  const PlanningProblem problem = on_a_line({1.0, -10.0, 20.0}, {10.0F, 30.0F, 100.0F});
  EXPECT_EQ(order_of(InformationRate{}, problem), test::Order{2});
}

TEST(FrontierTour, TakesTheShortestWayWhateverIsSeen) {
  const PlanningProblem problem = on_a_line({9.0, -2.0, 4.0}, {1000.0F, 1.0F, 5.0F});
  EXPECT_EQ(order_of(FrontierTour{}, problem), (test::Order{1, 2, 0}));
}

TEST(FrontierTour, LeavesOutWhatIsOutOfReach) {
  PlanningProblem problem = on_a_line({9.0, -2.0, 4.0}, {1.0F, 1.0F, 1.0F});
  problem.travel_s.col(1).setConstant(std::numeric_limits<double>::infinity());
  problem.travel_s.row(1).setConstant(std::numeric_limits<double>::infinity());
  EXPECT_EQ(order_of(FrontierTour{}, problem), (test::Order{2, 0}));
}

TEST(TwoLevelTour, CoversWhatIsNearThenGoesToTheNextRegion) {
  PlanningProblem problem =
      on_a_line({2.0, 3.0, -1.0, 30.0, 31.0, 60.0}, {50.0F, 50.0F, 1.0F, 10.0F, 20.0F, 10.0F});
  const TwoLevelTour choice{.horizon_s = 5.0, .cover = 0.9, .region_m = 10.0};
  // View 2 is not needed to cover; of 3 and 4 the one that shows more stands for their region.
  EXPECT_EQ(order_of(choice, problem), (test::Order{0, 1, 4, 5}));
  EXPECT_EQ(order_of(TwoLevelTour{.horizon_s = 5.0, .cover = 1.0, .region_m = 10.0}, problem),
            (test::Order{2, 0, 1, 4, 5}));
}

TEST(TwoLevelTour, GoesFarWhereNothingIsNear) {
  const PlanningProblem problem = on_a_line({20.0, 35.0}, {1.0F, 1.0F});
  EXPECT_EQ(order_of(TwoLevelTour{.horizon_s = 5.0}, problem), (test::Order{0, 1}));
}

TEST(RecedingHorizon, TakesTheFirstViewOfTheBestBranch) {
  // To the right one view shows most at once; to the left three in a row show more.
  const PlanningProblem problem = on_a_line({5.0, -4.0, -5.0, -6.0}, {20.0F, 15.0F, 15.0F, 15.0F});
  const test::Order order = order_of(RecedingHorizon{.lambda_per_s = 0.01}, problem, 3);
  ASSERT_FALSE(order.empty());
  EXPECT_NE(order.front(), 0U);
  EXPECT_EQ(order_of(RecedingHorizon{.lambda_per_s = 3.0}, problem, 3).front(), 1U);
}

TEST(RecedingHorizon, IsTheSameForTheSameRandomNumbers) {
  Rng rng(5);
  const PlanningProblem problem = test::random_problem(12, 30, rng);
  EXPECT_EQ(order_of(RecedingHorizon{}, problem, 7), order_of(RecedingHorizon{}, problem, 7));
}

/// The oracle knows every view there will be; the others do not.
TEST(OracleTour, CountsAScanOnce) {
  EXPECT_EQ(OracleTour{}.objective().scan_weight, 1.0);
  EXPECT_GT(TourChoice{}.objective().scan_weight, 1.0);
}

ShownBlocks shown_by(const PlanningProblem& problem) { return {problem.cells, problem.shows}; }

/// In the map as expected the left is worth more; in every map that is drawn, the right.
TEST(Rollout, TakesWhatIsBestInTheMapsDrawn) {
  PlanningProblem problem = on_a_line({5.0, -5.0}, {10.0F, 30.0F});
  problem.draw = [](Rng&) { return shown_by(on_a_line({5.0, -5.0}, {30.0F, 1.0F})); };
  EXPECT_EQ(order_of(TourChoice{}, problem).front(), 1U);
  EXPECT_EQ(order_of(Rollout{}, problem).front(), 0U);
}

TEST(Rollout, IsTheTourWhereTheMapIsCertain) {
  Rng rng(6);
  for (int k = 0; k < 10; ++k) {
    PlanningProblem problem = test::random_problem(8, 25, rng);
    problem.draw = [&problem](Rng&) { return shown_by(problem); };
    EXPECT_EQ(order_of(Rollout{}, problem), order_of(TourChoice{}, problem));
  }
}

/// The way past the poor view on to the rich one cannot be paid, on no map.
TEST(Rollout, HasTheBudgetInTheMapsDrawnToo) {
  PlanningProblem problem = on_a_line({15.0, -28.0, 75.0}, {10.0F, 100.0F, 1000.0F});
  problem.scan_s = 10.0;
  problem.draw = [&problem](Rng&) { return shown_by(problem); };
  Rollout rollout;
  rollout.worth_s = 500.0;
  EXPECT_EQ(order_of(rollout, problem).front(), 2U);
  problem.left.time_s = 40.0;
  EXPECT_EQ(order_of(rollout, problem), test::Order{1});
}

TEST(Rollout, KeepsAPlanUnlessAnotherIsBetterByEnough) {
  PlanningProblem problem = on_a_line({5.0, -5.0}, {10.0F, 11.0F});
  problem.intended = 0;
  problem.draw = [&problem](Rng&) { return shown_by(problem); };
  Rollout rollout;
  rollout.keep_s = 0.0;
  EXPECT_EQ(order_of(rollout, problem).front(), 1U);
  rollout.keep_s = 1e6;
  EXPECT_EQ(order_of(rollout, problem).front(), 0U);
}

/// With one scan left, what shows most for its time; with two, the near one on the way.
TEST(AheadChoices, PlanNoMoreScansThanAreLeft) {
  PlanningProblem problem = on_a_line({2.0, 12.0}, {100.0F, 500.0F});
  problem.draw = [&problem](Rng&) { return shown_by(problem); };
  for (const std::size_t scans : {1U, 2U}) {
    problem.left.scans = scans;
    const test::Order wanted = scans == 1 ? test::Order{1} : test::Order{0, 1};
    EXPECT_EQ(order_of(TourChoice{}, problem), wanted);
    EXPECT_EQ(order_of(OracleTour{}, problem), wanted);
    EXPECT_EQ(order_of(Rollout{}, problem), wanted);
  }
}

/// A plan is empty only where nothing can be paid.
TEST(TwoLevelTour, TakesANearViewThoughNoneShowsAnything) {
  const PlanningProblem problem = on_a_line({2.0, -3.0}, {0.0F, 0.0F});
  EXPECT_FALSE(order_of(TwoLevelTour{}, problem).empty());
}

TEST(AheadChoices, TakeNothingThatCannotBePaid) {
  Rng rng(8);
  for (int k = 0; k < 40; ++k) {
    PlanningProblem problem = test::random_problem(10, 20, rng);
    problem.left.time_s = rng.uniform(0.0, 25.0);
    problem.home_s.assign(11, 0.0);
    for (std::size_t i = 0; i < 10; ++i) {
      problem.home_s[i] = (problem.place_m[i] - Eigen::Vector2d(5.0, 5.0)).norm();
    }
    problem.draw = [&problem](Rng&) { return shown_by(problem); };
    const bool any = !affordable_views(problem).empty();
    const auto expect_paid = [&](const auto& choice) {
      const test::Order order = order_of(choice, problem);
      EXPECT_EQ(order.empty(), !any);
      EXPECT_TRUE(order.empty() || is_affordable(problem, order));
    };
    expect_paid(InformationRate{});
    expect_paid(FrontierTour{});
    expect_paid(TwoLevelTour{});
    expect_paid(RecedingHorizon{});
    expect_paid(TourChoice{});
    Rollout rollout;
    rollout.draws = 2;
    expect_paid(rollout);
  }
}

}  // namespace
}  // namespace vantage
