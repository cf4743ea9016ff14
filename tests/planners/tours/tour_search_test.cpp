#include "vantage/planners/tours/tour_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "tests/planners/tours/small_problem.hpp"
#include "vantage/core/cancellation/stop_poll.hpp"
#include "vantage/planners/tours/joint_gain.hpp"

namespace vantage {
namespace {

/// One view of 10 cells at 5 s, one of 30 at 1 s; they share nothing.
PlanningProblem two_views() {
  PlanningProblem problem;
  problem.cells = {10.0F, 30.0F};
  problem.shows = {{{0}, {1.0F}}, {{1}, {1.0F}}};
  problem.place_m.resize(2, Eigen::Vector2d::Zero());
  problem.travel_s.resize(3, 2);
  problem.travel_s << 0.0, 4.0,  //
      4.0, 0.0,                  //
      5.0, 1.0;
  problem.scan_s = 2.0;
  return problem;
}

TEST(TourCost, IsTheMeanTimeUntilSeenAndTheEnd) {
  const PlanningProblem problem = two_views();
  const test::Order both{1, 0};  // seen at 3 s and 9 s
  EXPECT_NEAR(tour_cost_s(problem, {.finish_weight = 0.0}, both), (30.0 * 3.0 + 10.0 * 9.0) / 40.0,
              1e-9);
  EXPECT_NEAR(tour_cost_s(problem, {.finish_weight = 1.0}, both), 9.0, 1e-9);
  EXPECT_NEAR(tour_cost_s(problem, {.finish_weight = 0.25}, both), 0.75 * 4.5 + 0.25 * 9.0, 1e-9);
  // What is left out counts as seen at the end, and costs what it is worth.
  EXPECT_NEAR(tour_cost_s(problem, {.finish_weight = 0.0, .worth_s = 100.0}, test::Order{1}),
              (30.0 * 3.0 + 10.0 * 3.0) / 40.0 + 100.0 * 10.0 / 40.0, 1e-9);
}

TEST(TourCost, CountsOfAScanTheShareThatIsTaken) {
  PlanningProblem problem = two_views();
  problem.scan_share = {1.0, 0.25};
  const test::Order both{1, 0};  // seen at 1.5 s and 7.5 s
  EXPECT_NEAR(tour_cost_s(problem, {.finish_weight = 1.0}, both), 7.5, 1e-9);
  EXPECT_NEAR(tour_cost_s(problem, {.finish_weight = 1.0, .scan_weight = 2.0}, both), 10.0, 1e-9);
}

TEST(TourCost, HoldsWhatIsLeftOutAgainstAllThereIs) {
  PlanningProblem problem = two_views();
  problem.seen = 160.0;  // of 200
  EXPECT_NEAR(tour_cost_s(problem, {.finish_weight = 1.0, .worth_s = 100.0}, test::Order{1}),
              3.0 + 100.0 * 10.0 / 200.0, 1e-9);
}

TEST(TourCost, HasTheTimeThatWhatLiesBeyondTakes) {
  PlanningProblem problem = two_views();
  problem.beyond = {60.0, 0.0};
  problem.pace_per_s = 3.0;      // 20 s behind view 0
  const test::Order both{0, 1};  // at 7 s and 7 + 20 + 4 + 2 s
  EXPECT_NEAR(tour_cost_s(problem, {.finish_weight = 0.0}, both),
              (10.0 * 7.0 + 60.0 * 17.0 + 30.0 * 33.0) / 100.0, 1e-6);
  EXPECT_NEAR(tour_cost_s(problem, {.finish_weight = 1.0}, both), 33.0, 1e-6);
  // Left out with its view.
  EXPECT_NEAR(tour_cost_s(problem, {.finish_weight = 1.0, .worth_s = 50.0}, test::Order{1}),
              3.0 + 50.0 * 70.0 / 100.0, 1e-6);
  // Where no pace is known it does not count.
  problem.pace_per_s = 0.0;
  EXPECT_NEAR(tour_cost_s(problem, {.finish_weight = 1.0}, both), 13.0, 1e-9);
}

TEST(TourCost, CountsAScanForAsManyAsItIsToldTo) {
  PlanningProblem problem = two_views();
  const test::Order both{1, 0};
  const TourObjective thrice{.finish_weight = 1.0, .scan_weight = 3.0};
  EXPECT_NEAR(tour_cost_s(problem, thrice, both), 1.0 + 6.0 + 4.0 + 6.0, 1e-9);
  problem.left.time_s = 9.0;  // what they take in truth
  EXPECT_NEAR(tour_cost_s(problem, thrice, both), 17.0, 1e-9);
}

/// A quarter of all is worth 7 s; the way there takes 4 s, the scan 2 s.
TEST(SearchTour, LeavesOutAViewThatIsNotWorthAScanOfThatWeight) {
  const PlanningProblem problem = two_views();
  const auto order = [&](double scan_weight) {
    return search_tour(problem, {.finish_weight = 1.0, .worth_s = 28.0, .scan_weight = scan_weight},
                       {})
        .order;
  };
  EXPECT_EQ(order(1.0), (test::Order{1, 0}));
  EXPECT_EQ(order(2.0), test::Order{1});
}

/// It takes 6 s and shows a quarter of all.
TEST(SearchTour, TakesAViewInThatSavesMoreThanRoundingMakes) {
  const PlanningProblem problem = two_views();
  const auto order = [&](double saved_s) {
    return search_tour(problem, {.finish_weight = 1.0, .worth_s = 4.0 * (6.0 + saved_s)}, {}).order;
  };
  EXPECT_EQ(order(0.8e-9), test::Order{1});
  EXPECT_EQ(order(1.5e-9), (test::Order{1, 0}));
}

/// After view 0 a 2^-24 is left of the block, of which view 1 shows a quarter. With view 1 in front
/// rounding takes that back: the tour costs as much as without it, though not by the gains before.
TEST(SearchTour, EndsWhereRoundingTakesBackWhatAViewAdds) {
  PlanningProblem problem = two_views();
  problem.cells = {1.0F};
  problem.shows = {{{0}, {std::nextafter(1.0F, 0.0F)}}, {{0}, {0.25F}}};
  problem.travel_s.setZero();
  problem.scan_s = 0.0;
  const double alone_s = tour_cost_s(problem, {}, test::Order{0});
  ASSERT_GT(alone_s, 1e-5);
  ASSERT_EQ(tour_cost_s(problem, {}, test::Order{0, 1}), 0.0);
  ASSERT_EQ(tour_cost_s(problem, {}, test::Order{1, 0}), alone_s);
  int asked = 0;
  const StopPoll poll([&] {
    if (++asked > 100) throw std::runtime_error("it goes on for ever");
  });
  const Tour tour = search_tour(problem, {}, {});
  EXPECT_EQ(tour.order, test::Order{0});
  EXPECT_EQ(tour.cost_s, alone_s);
}

/// Jobs without ways between them: the mean time is least by falling weight per time. [Smith1956]
TEST(SearchTour, TakesRegionsByWhatTheyShowPerTime) {
  Rng rng(31);
  for (int k = 0; k < 20; ++k) {
    PlanningProblem problem;
    problem.scan_s = 2.0;
    problem.pace_per_s = 4.0;
    problem.travel_s = Eigen::MatrixXd::Zero(7, 6);
    std::vector<double> rate;
    for (std::uint32_t i = 0; i < 6; ++i) {
      problem.cells.push_back(static_cast<float>(rng.uniform(1.0, 50.0)));
      problem.shows.push_back({{i}, {1.0F}});
      problem.place_m.emplace_back(0.0, 0.0);
      problem.beyond.push_back(rng.uniform(0.0, 100.0));
      rate.push_back((static_cast<double>(problem.cells[i]) + problem.beyond[i]) /
                     (problem.scan_s + problem.dwell_s(i)));
    }
    test::Order by_rate{0, 1, 2, 3, 4, 5};
    std::ranges::sort(by_rate, std::greater<>(), [&](std::size_t i) { return rate[i]; });
    EXPECT_EQ(search_tour(problem, {.finish_weight = 0.0, .worth_s = 1e6}, {}).order, by_rate);
  }
}

/// Neither is worth its time; what shows most per second comes nearest to it, not what is nearest.
TEST(SearchTours, RaiseTheWorthUntilAViewIsWorthItsTime) {
  PlanningProblem problem = two_views();
  problem.cells = {1.0F, 30.0F};
  problem.travel_s << 0.0, 20.0,  //
      20.0, 0.0,                  //
      1.0, 20.0;
  const TourObjective objective{.finish_weight = 1.0, .worth_s = 1.0};
  EXPECT_EQ(search_tour(problem, objective, {}).order, test::Order{0});
  EXPECT_EQ(search_tours(problem, objective, {}).front().order.front(), 1U);
}

/// View 1 shows three quarters of all and takes 3 s.
TEST(WithRaisedWorth, RisesByHalfUntilAViewIsWorthItsTime) {
  PlanningProblem problem = two_views();
  const auto worth_s = [&](double from_s) {
    return with_raised_worth(problem, {.finish_weight = 1.0, .worth_s = from_s}, {}).worth_s;
  };
  EXPECT_EQ(worth_s(4.1), 4.1);
  EXPECT_EQ(worth_s(1.0), 1.5 * 1.5 * 1.5 * 1.5);
  problem.scan_s = 1e9;
  EXPECT_NEAR(worth_s(1.0), std::pow(1.5, 30.0), 1e-6) << "it gives up";
  EXPECT_EQ(worth_s(0.0), 0.0);
}

/// Left and right of the robot, the right one a second nearer.
TEST(SearchTours, KeepToTheIntendedUnlessAnotherIsBetterByEnough) {
  PlanningProblem problem = two_views();
  problem.cells = {10.0F, 10.0F};
  problem.travel_s << 0.0, 20.0,  //
      20.0, 0.0,                  //
      5.0, 4.0;
  const TourObjective objective{.finish_weight = 1.0};
  const auto first = [&](double keep_s, std::size_t first_moves) {
    return search_tours(problem, objective, {.first_moves = first_moves, .keep_s = keep_s})
        .front()
        .order.front();
  };
  EXPECT_EQ(first(5.0, 8), 1U);
  problem.intended = 0;
  EXPECT_EQ(first(0.0, 8), 1U);
  EXPECT_EQ(first(0.5, 8), 1U);
  EXPECT_EQ(first(1.5, 8), 0U);
  EXPECT_EQ(first(1.5, 1), 0U);  // it is tried though it does not promise most
  problem.intended = 1;
  EXPECT_EQ(first(1.5, 8), 1U);
}

TEST(ViewNear, IsTheNearestWithinReach) {
  PlanningProblem problem = two_views();
  problem.place_m = {{0.0, 0.0}, {2.0, 0.0}};
  EXPECT_EQ(view_near(problem, {0.8, 0.0}, 1.5), 0U);
  EXPECT_EQ(view_near(problem, {1.2, 0.0}, 1.5), 1U);
  EXPECT_EQ(view_near(problem, {1.0, 0.0}, 1.5), 0U);  // of equals the first
  EXPECT_EQ(view_near(problem, {4.0, 0.0}, 1.5), std::nullopt);
}

/// A small view that leads to a room goes before a larger one that leads nowhere.
TEST(SearchTour, GoesWhereMoreLiesBeyond) {
  PlanningProblem problem = two_views();
  problem.travel_s << 0.0, 4.0,  //
      4.0, 0.0,                  //
      3.0, 3.0;
  const TourObjective objective{.finish_weight = 0.0, .worth_s = 1e6};
  EXPECT_EQ(search_tour(problem, objective, {}).order, (test::Order{1, 0}));
  problem.beyond = {500.0, 0.0};
  problem.pace_per_s = 100.0;
  EXPECT_EQ(search_tour(problem, objective, {}).order, (test::Order{0, 1}));
}

TEST(SearchTour, IsSeldomMuchDearerThanTheBestOfAllTours) {
  Rng rng(21);
  const TourObjective objective{.finish_weight = 0.5, .worth_s = 80.0};
  int best = 0;
  double sum = 0.0;
  constexpr int kProblems = 60;
  for (int k = 0; k < kProblems; ++k) {
    const PlanningProblem problem = test::random_problem(6, 20, rng);
    double by_trying = std::numeric_limits<double>::infinity();
    test::for_each_order(6, [&](const test::Order& order) {
      by_trying = std::min(by_trying, tour_cost_s(problem, objective, order));
    });
    const auto tours = search_tours(problem, objective, {});
    ASSERT_FALSE(tours.empty());
    EXPECT_GE(tours.front().cost_s, by_trying - 1e-6);
    EXPECT_NEAR(tours.front().cost_s, tour_cost_s(problem, objective, tours.front().order), 1e-6);
    best += tours.front().cost_s < by_trying + 1e-6 ? 1 : 0;
    sum += tours.front().cost_s / by_trying;
  }
  EXPECT_GE(best, kProblems * 8 / 10);
  EXPECT_LT(sum / kProblems, 1.01);
}

TEST(SearchTour, LeavesOutWhatIsNotWorthItsTime) {
  PlanningProblem problem = two_views();
  problem.cells[0] = 0.1F;
  const TourObjective objective{.finish_weight = 0.5, .worth_s = 100.0};
  EXPECT_EQ(search_tour(problem, objective, {}).order, test::Order{1});
  // Worth it if nothing else counts.
  EXPECT_EQ(search_tour(problem, {.finish_weight = 0.0, .worth_s = 1e6}, {}).order,
            (test::Order{1, 0}));
}

TEST(SearchTour, LeavesOutAViewOfWhatAnotherShowed) {
  PlanningProblem problem = two_views();
  problem.shows[0] = problem.shows[1];
  EXPECT_EQ(search_tour(problem, {}, {}).order, test::Order{1});
}

TEST(SearchTour, TakesOneViewThoughNoneIsWorthIt) {
  PlanningProblem problem = two_views();
  problem.scan_s = 1e6;
  EXPECT_EQ(search_tour(problem, {.finish_weight = 1.0}, {}).order.size(), 1U);
}

TEST(SearchTour, NeverSpendsMoreThanIsLeft) {
  Rng rng(22);
  for (int k = 0; k < 100; ++k) {
    PlanningProblem problem = test::random_problem(9, 25, rng);
    problem.driving_w = 100.0;
    problem.scanning_w = 50.0;
    problem.left.time_s = rng.uniform(2.0, 40.0);
    problem.left.energy_j = rng.uniform(300.0, 4000.0);
    problem.home_s.assign(10, 0.0);
    for (double& home_s : problem.home_s) home_s = rng.uniform(0.0, 8.0);
    for (const Tour& tour : search_tours(problem, {.worth_s = 1000.0}, {})) {
      EXPECT_TRUE(is_affordable(problem, tour.order));
    }
    if (affordable_views(problem).empty()) continue;
    EXPECT_FALSE(search_tour(problem, {}, {}).order.empty());
  }
}

TEST(SearchTour, BeginsWhereItIsTold) {
  Rng rng(23);
  const PlanningProblem problem = test::random_problem(8, 25, rng);
  for (std::size_t first = 0; first < 8; ++first) {
    const Tour tour = search_tour(problem, {}, {}, first);
    EXPECT_EQ(tour.order.front(), first);
    test::Order sorted = tour.order;
    std::ranges::sort(sorted);
    EXPECT_EQ(std::ranges::adjacent_find(sorted), sorted.end());
  }
}

/// It costs what nobody can pay, and no cheaper tour stands in its place.
TEST(SearchTour, BeginsWhereItIsToldThoughThatCannotBePaid) {
  PlanningProblem problem = two_views();
  problem.left.time_s = 6.0;  // view 0 takes 7 s
  const Tour tour = search_tour(problem, {}, {}, 0);
  EXPECT_EQ(tour.order, test::Order{0});
  EXPECT_EQ(tour.cost_s, std::numeric_limits<double>::infinity());
}

/// The first of two views is chosen from 2, the second from 1. Then, in each of two rounds, parts
/// are moved from 2 + 1 places and turned round from 2, and 2 views are left out.
TEST(SearchTour, AsksNowAndThenWhetherToGoOn) {
  const PlanningProblem problem = two_views();
  const int once = 2 + 1 + 2 * (3 + 2 + 2);
  int asked = 0;
  const StopPoll poll([&] { ++asked; });
  EXPECT_EQ(search_tour(problem, {}, {}).order, (test::Order{1, 0}));
  EXPECT_EQ(asked, once);
  // With view 0 in front there is less to change.
  EXPECT_EQ(search_tour(problem, {}, {}, 0).order, (test::Order{0, 1}));
  const int with_a_first = 1 + 2 * (1 + 1 + 1);
  EXPECT_EQ(asked, once + with_a_first);
  asked = 0;
  EXPECT_EQ(search_tours(problem, {}, {}).size(), 2U);
  EXPECT_EQ(asked, once + once + 1 + with_a_first)
      << "is any worth it, the best, how good view 0 is in front, and the best that begins there";
}

TEST(SearchTourDeathTest, NeedsAProblemWhoseSizesFit) {
  PlanningProblem problem = two_views();
  problem.place_m.pop_back();
  EXPECT_DEATH(search_tour(problem, {}, {}), "a place of each view");
  problem.left.scans = 0;  // there is nothing to search
  EXPECT_DEATH(search_tours(problem, {}, {}), "a place of each view");
}

/// Four views in a room near by, one far away that shows somewhat more than each of them: who goes
/// there first comes back.
TEST(SearchTour, IsDoneWithARoomBeforeItLeaves) {
  PlanningProblem problem;
  problem.scan_s = 5.0;
  problem.cells = {10.0F, 10.0F, 10.0F, 10.0F, 12.0F};
  for (std::uint32_t i = 0; i < 5; ++i) problem.shows.push_back({{i}, {1.0F}});
  for (int i = 0; i < 4; ++i) problem.place_m.emplace_back(static_cast<double>(i), 0.0);
  problem.place_m.emplace_back(40.0, 0.0);
  problem.travel_s.resize(6, 5);
  for (Eigen::Index i = 0; i < 6; ++i) {
    const double from = i == 5 ? 0.0 : problem.place_m[static_cast<std::size_t>(i)].x();
    for (Eigen::Index j = 0; j < 5; ++j) {
      problem.travel_s(i, j) = std::abs(problem.place_m[static_cast<std::size_t>(j)].x() - from);
    }
  }
  EXPECT_EQ(search_tours(problem, {}, {}).front().order, (test::Order{0, 1, 2, 3, 4}));
}

TEST(SearchTours, TryAsManyFirstViewsAsTheyAreTold) {
  for (const std::size_t first_moves : {1U, 2U}) {
    EXPECT_EQ(search_tours(two_views(), {}, {.first_moves = first_moves}).size(), first_moves);
  }
}

/// How good a first view is, is told by the free tour with that view in front.
TEST(SearchTours, TryTheMostPromisingFirstView) {
  Rng rng(24);
  for (int k = 0; k < 10; ++k) {
    const PlanningProblem problem = test::random_problem(7, 25, rng);
    const TourObjective objective{.finish_weight = 0.5, .worth_s = 1e4};
    const TourSearchOptions options{.first_moves = 2};
    const Tour free = search_tour(problem, objective, options);
    std::size_t promising = 7;
    double least_s = std::numeric_limits<double>::infinity();
    for (std::size_t view = 0; view < 7; ++view) {
      if (view == free.order.front()) continue;
      test::Order order{view};
      std::ranges::copy_if(free.order, std::back_inserter(order),
                           [&](std::size_t other) { return other != view; });
      const double cost_s = tour_cost_s(problem, objective, order);
      if (cost_s >= least_s) continue;
      least_s = cost_s;
      promising = view;
    }
    const auto tours = search_tours(problem, objective, options);
    ASSERT_EQ(tours.size(), 2U);
    EXPECT_TRUE(tours[0].order.front() == promising || tours[1].order.front() == promising) << k;
  }
}

TEST(WithRaisedWorth, SearchesNothingWhereNothingIsWorthAnything) {
  int asked = 0;
  const StopPoll poll([&] { ++asked; });
  EXPECT_EQ(with_raised_worth(two_views(), {.worth_s = 0.0}, {}).worth_s, 0.0);
  EXPECT_EQ(asked, 0);
}

/// One round finds it: a view is chosen from 2, one from 1, parts are moved from 2 + 1 places and
/// turned round from 2, and 2 views are left out. Another round would ask 7 times more.
TEST(SearchTour, GoesOnForNoMoreRoundsThanItIsToldTo) {
  const PlanningProblem problem = two_views();
  int asked = 0;
  const StopPoll poll([&] { ++asked; });
  EXPECT_EQ(search_tour(problem, {}, {.rounds = 1}).order, (test::Order{1, 0}));
  EXPECT_EQ(asked, 2 + 1 + 3 + 2 + 2);
  EXPECT_EQ(search_tour(problem, {}, {.rounds = 0}).order, test::Order{1}) << "a tour has a view";
}

/// Four views on a line, chosen from 4, 3, 2 and 1. Then, in each of two rounds, parts of one, two
/// and three are moved from 4 + 3 + 2 places and turned round from 4, and 4 views are left out.
TEST(SearchTour, MovesPartsOfThreeViewsAtMost) {
  PlanningProblem problem;
  problem.scan_s = 2.0;
  problem.travel_s.resize(5, 4);
  for (Eigen::Index j = 0; j < 4; ++j) {
    for (Eigen::Index i = 0; i < 5; ++i) {
      problem.travel_s(i, j) = std::abs(static_cast<double>(j + 1 - (i == 4 ? 0 : i + 1)));
    }
    problem.cells.push_back(10.0F);
    problem.shows.push_back({{static_cast<std::uint32_t>(j)}, {1.0F}});
    problem.place_m.emplace_back(static_cast<double>(j + 1), 0.0);
  }
  int asked = 0;
  const StopPoll poll([&] { ++asked; });
  EXPECT_EQ(search_tour(problem, {}, {}).order, (test::Order{0, 1, 2, 3}));
  EXPECT_EQ(asked, 10 + 2 * (9 + 4 + 4));
}

}  // namespace
}  // namespace vantage
