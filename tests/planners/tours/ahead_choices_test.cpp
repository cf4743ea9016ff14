/// What each choice that plans ahead is known for.
#include <gtest/gtest.h>

#include <set>

#include "tests/planners/tours/small_problem.hpp"
#include "vantage/planners/tours/frontier_tour.hpp"
#include "vantage/planners/tours/information_rate.hpp"
#include "vantage/planners/tours/joint_gain.hpp"
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

TEST(InformationRate, CountsTheShareOfAScanThatIsTaken) {
  PlanningProblem problem = on_a_line({5.0, -5.0}, {10.0F, 11.0F});
  EXPECT_EQ(order_of(InformationRate{}, problem), test::Order{1});
  problem.scan_share = {0.1, 1.0};
  EXPECT_EQ(order_of(InformationRate{}, problem), test::Order{0});
}

TEST(InformationRate, TakesTheMostASecond) {
  // 10 / 3, 30 / 12, 100 / 22 cells a second
  const PlanningProblem problem = on_a_line({1.0, -10.0, 20.0}, {10.0F, 30.0F, 100.0F});
  EXPECT_EQ(order_of(InformationRate{}, problem), test::Order{2});
}

TEST(InformationRate, OfAViewThatCostsNothingCounts) {
  PlanningProblem problem = on_a_line({0.0, 1.0}, {0.0F, 5.0F});
  problem.scan_s = 0.0;
  EXPECT_EQ(order_of(InformationRate{}, problem), test::Order{1}) << "nothing is shown for nothing";
  problem.cells[0] = 1.0F;
  EXPECT_EQ(order_of(InformationRate{}, problem), test::Order{0});
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
  std::set<test::Order> drawn;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const test::Order order = order_of(RecedingHorizon{}, problem, seed);
    EXPECT_EQ(order_of(RecedingHorizon{}, problem, seed), order);
    drawn.insert(order);
  }
  EXPECT_GT(drawn.size(), 1U) << "it draws nothing";
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

TEST(AheadChoices, TakeTheNearestViewWhereNoneShowsAnything) {
  PlanningProblem problem = on_a_line({2.0, -3.0}, {0.0F, 0.0F});
  problem.draw = [&problem](Rng&) { return shown_by(problem); };
  EXPECT_EQ(order_of(TourChoice{}, problem), test::Order{0});
  EXPECT_EQ(order_of(OracleTour{}, problem), test::Order{0});
  EXPECT_EQ(order_of(Rollout{}, problem), test::Order{0});
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

/// In each square of the floor one far view stands for the others; squares go on below zero.
TEST(TwoLevelTour, ALevelIsAsWideAsItIsSaidToBe) {
  const TwoLevelTour choice{.horizon_s = 5.0, .cover = 1.0, .region_m = 20.0};
  EXPECT_EQ(order_of(choice, on_a_line({5.0, 6.0}, {1.0F, 2.0F})), (test::Order{0, 1}))
      << "just near, and far";
  EXPECT_EQ(order_of(choice, on_a_line({6.0, 7.0}, {1.0F, 2.0F})), test::Order{1}) << "both far";
  EXPECT_EQ(order_of(choice, on_a_line({-19.0, 19.5}, {1.0F, 2.0F})), (test::Order{0, 1}));
  PlanningProblem aside = on_a_line({6.0, 7.0}, {1.0F, 2.0F});
  aside.place_m[1].y() = -1.0;
  EXPECT_EQ(order_of(choice, aside), (test::Order{0, 1})) << "across the floor too";
}

TEST(TwoLevelTour, NearViewsCoverTheShareThatIsAskedFor) {
  const PlanningProblem problem = on_a_line({3.0, 2.0, 1.0}, {50.0F, 30.0F, 20.0F});
  const auto covering = [&](double cover) {
    return order_of(TwoLevelTour{.horizon_s = 5.0, .cover = cover}, problem);
  };
  EXPECT_EQ(covering(0.5), test::Order{0}) << "just half of it";
  EXPECT_EQ(covering(0.51), (test::Order{1, 0}));
  EXPECT_EQ(covering(0.81), (test::Order{2, 1, 0}));
}

/// 10 e^(-10 lambda) = 7 e^(-5 lambda) at lambda = ln(10 / 7) / 5 = 0.0713.
/// The next decision would draw others.
TEST(RecedingHorizon, DrawsNothingWhereThereIsNoChoice) {
  Rng used(5), unused(5);
  EXPECT_EQ(RecedingHorizon{}(on_a_line({1.0}, {1.0F}), used).order, test::Order{0});
  EXPECT_EQ(used.next(), unused.next());
}

TEST(RecedingHorizon, DiscountsAGainByTheWayThere) {
  const PlanningProblem problem = on_a_line({10.0, -5.0}, {10.0F, 7.0F});
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    EXPECT_EQ(order_of(RecedingHorizon{.lambda_per_s = 0.07}, problem, seed), test::Order{0});
    EXPECT_EQ(order_of(RecedingHorizon{.lambda_per_s = 0.073}, problem, seed), test::Order{1});
  }
}

/// The views on the right add up along their branch, by the way through each other.
TEST(RecedingHorizon, SumsTheGainsOfABranchAlongItsWay) {
  const PlanningProblem problem = on_a_line({5.0, 6.0, -4.0}, {10.0F, 10.0F, 10.0F});
  int nearer_first = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const test::Order order = order_of(RecedingHorizon{.lambda_per_s = 0.05}, problem, seed);
    EXPECT_EQ(order.size(), 2U);
    EXPECT_NE(order.front(), 2U);
    nearer_first += order == test::Order{0, 1} ? 1 : 0;
    EXPECT_EQ(order_of(RecedingHorizon{.lambda_per_s = 1.0}, problem, seed), test::Order{2});
  }
  EXPECT_GT(nearer_first, 2);
  EXPECT_LT(nearer_first, 18);
}

TEST(RecedingHorizon, DrawsEveryViewAsOften) {
  const PlanningProblem problem = on_a_line({5.0, 6.0, 7.0}, {10.0F, 10.0F, 10.0F});
  std::vector<int> drawn(3, 0);
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    const test::Order order = order_of(RecedingHorizon{.nodes = 1}, problem, seed);
    ASSERT_EQ(order.size(), 1U);
    ++drawn[order.front()];
  }
  for (const int count : drawn) EXPECT_NEAR(count, 200, 60);
}

/// The map is certain: what is kept to is worth so much a map.
TEST(Rollout, KeepsAPlanThatIsDearerByLessThanThat) {
  PlanningProblem problem = on_a_line({5.0, -5.0}, {10.0F, 11.0F});
  problem.draw = [&problem](Rng&) { return shown_by(problem); };
  Rollout rollout;
  const auto cost_s = [&](std::size_t first) {
    return search_tour(problem, rollout.objective(), rollout.search(), first).cost_s;
  };
  const double dearer_s = cost_s(0) - cost_s(1);
  ASSERT_GT(dearer_s, 0.0);
  problem.intended = 0;
  for (const int draws : {1, 5}) {
    rollout.draws = draws;
    rollout.keep_s = 0.9 * dearer_s;
    EXPECT_EQ(order_of(rollout, problem).front(), 1U);
    rollout.keep_s = 1.1 * dearer_s;
    Rng rng(1);
    const PlannedViews plan = rollout(problem, rng);
    EXPECT_EQ(plan.order.front(), 0U);
    EXPECT_NEAR(plan.costs->taken_s, cost_s(0), 1e-9);
    EXPECT_NEAR(plan.costs->intended_s.value(), cost_s(0), 1e-9);
  }
}

TEST(RecedingHorizon, DrawsEitherOfTwoViewsAsOften) {
  const PlanningProblem problem = on_a_line({5.0, 6.0}, {10.0F, 10.0F});
  int first = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const auto order = order_of(RecedingHorizon{.nodes = 1}, problem, seed);
    first += order == test::Order{0} ? 1 : 0;
  }
  EXPECT_NEAR(first, 200, 50);
}

/// The maps drawn have the same blocks; there the view on the right shows the richer one.
TEST(Rollout, GoesByWhatViewsShowInTheMapsDrawn) {
  PlanningProblem problem = on_a_line({5.0, -5.0}, {10.0F, 30.0F});
  problem.draw = [&problem](Rng&) {
    return ShownBlocks{problem.cells, {problem.shows[1], problem.shows[0]}};
  };
  EXPECT_EQ(order_of(TourChoice{}, problem).front(), 1U);
  EXPECT_EQ(order_of(Rollout{}, problem).front(), 0U);
}

TEST(TwoLevelTour, OfViewsThatShowAsMuchTheFirstStandsForItsRegion) {
  const TwoLevelTour choice{.horizon_s = 5.0, .cover = 1.0, .region_m = 20.0};
  EXPECT_EQ(order_of(choice, on_a_line({6.0, 7.0}, {3.0F, 3.0F})), test::Order{0});
  EXPECT_EQ(order_of(choice, on_a_line({7.0, 6.0}, {3.0F, 3.0F})), test::Order{0});
}

/// The farther view shows nothing.
TEST(RecedingHorizon, GoesNoFartherThanThereIsSomethingToSee) {
  const PlanningProblem problem = on_a_line({5.0, 20.0}, {10.0F, 0.0F});
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    EXPECT_EQ(order_of(RecedingHorizon{}, problem, seed), test::Order{0}) << seed;
  }
}

/// The first two views show parts of one block, and what they show together is a matter of rounding
/// and of their order; the third one, between them, shows nothing.
TEST(TwoLevelTour, TakesNoViewThatShowsNothingForWhatRoundingLost) {
  PlanningProblem problem = on_a_line({1.0, 2.0, 1.5}, {10.0F, 0.0F});
  problem.shows = {{{0}, {0.3F}}, {{0}, {0.7F}}, {{1}, {1.0F}}};
  ASSERT_GT(joint_gain(problem, test::Order{0, 1}), joint_gain(problem, test::Order{1, 0}));
  EXPECT_EQ(order_of(TwoLevelTour{.horizon_s = 5.0, .cover = 1.0}, problem), (test::Order{0, 1}));
}

TEST(TwoLevelTour, PassesByNearViewsThatShowNothing) {
  const PlanningProblem problem = on_a_line({2.0, 20.0, 3.0}, {0.0F, 5.0F, 0.0F});
  EXPECT_EQ(order_of(TwoLevelTour{.horizon_s = 5.0}, problem), test::Order{1});
}

}  // namespace
}  // namespace vantage
