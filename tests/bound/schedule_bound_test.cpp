// Bounds against brute force: every order of every set of views.
#include "vantage/bound/schedule_bound.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "tests/bound/line_problem.hpp"
#include "vantage/bound/fewest_scans.hpp"
#include "vantage/bound/witness_way.hpp"
#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Views at random places of a square, each of which shows the cells round it.
CoverProblem random_problem(Rng& rng, std::size_t views) {
  constexpr std::size_t kCells = 300;
  const auto anywhere = [&] { return Eigen::Vector2d(10.0 * rng.uniform(), 10.0 * rng.uniform()); };
  std::vector<Eigen::Vector2d> cells;
  std::vector<Eigen::Vector2d> places;
  for (std::size_t i = 0; i < kCells; ++i) cells.push_back(anywhere());
  for (std::size_t i = 0; i < views; ++i) places.push_back(anywhere());
  const double sight_m = 2.0 + 3.0 * rng.uniform();
  CoverProblem problem;
  problem.speed_m_s = 0.3 + rng.uniform();
  problem.scan_s = 20.0 * rng.uniform();
  const auto n = static_cast<Eigen::Index>(views);
  problem.way_m = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t i = 0; i < views; ++i) {
    problem.shows.emplace_back((kCells + 63) / 64, 0);
    for (std::size_t c = 0; c < kCells; ++c) {
      if ((cells[c] - places[i]).norm() > sight_m) continue;
      problem.shows[i][c / 64] |= std::uint64_t{1} << (c % 64);
    }
    for (std::size_t j = 0; j < views; ++j) {
      problem.way_m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          (places[i] - places[j]).norm();
    }
  }
  const auto all = static_cast<double>(count_cells(shown_by_all(problem)));
  problem.needed = static_cast<std::size_t>((0.5 + 0.5 * rng.uniform()) * all);
  return problem;
}

struct BruteForce {
  std::size_t scans = std::numeric_limits<std::size_t>::max();
  double way_m = kInfinity;
  double time_s = kInfinity;
};

/// Goes on from the last view of `order` to every other, and looks whether that is enough.
void try_all(const CoverProblem& problem, std::vector<std::size_t>& order, const CellBits& shown,
             double way_m, BruteForce& best) {
  if (count_cells(shown) >= problem.needed) {
    const std::size_t scans = order.size() - 1;
    best.scans = std::min(best.scans, scans);
    best.way_m = std::min(best.way_m, way_m);
    best.time_s = std::min(best.time_s,
                           way_m / problem.speed_m_s + static_cast<double>(scans) * problem.scan_s);
    return;  // what comes after costs more
  }
  for (std::size_t next = 1; next < problem.views(); ++next) {
    if (std::ranges::find(order, next) != order.end()) continue;
    CellBits more = shown;
    unite(more, problem.shows[next]);
    const double leg_m = problem.between_m(order.back(), next);
    order.push_back(next);
    try_all(problem, order, more, way_m + leg_m, best);
    order.pop_back();
  }
}

BruteForce brute_force(const CoverProblem& problem) {
  BruteForce best;
  std::vector<std::size_t> order{0};
  try_all(problem, order, problem.shows.front(), 0.0, best);
  return best;
}

TEST(ScheduleBound, EqualsBruteForceOn200RandomProblemsOfUpTo10Views) {
  Rng rng = Rng::stream(1, "bound");
  for (int trial = 0; trial < 200; ++trial) {
    const std::size_t views = 2 + static_cast<std::size_t>(trial) % 9;
    const CoverProblem problem = random_problem(rng, views);
    const BruteForce best = brute_force(problem);
    const auto bound = schedule_bounds(problem, std::vector{problem.needed}).front();
    ASSERT_TRUE(bound) << trial;
    EXPECT_EQ(bound->least.scans, best.scans) << trial;
    EXPECT_NEAR(bound->least.way_m, best.way_m, 1e-9) << trial;
    EXPECT_NEAR(bound->least.time_s, best.time_s, 1e-9) << trial;
    EXPECT_TRUE(bound->exact_scans && bound->exact_way && bound->exact_time);
    EXPECT_EQ(fewest_scans_exactly(problem, 100000), best.scans) << trial;
    const auto least_time = least_time_exactly(problem, 100000);
    ASSERT_TRUE(least_time && least_time->reached) << trial;
    EXPECT_NEAR(least_time->time_s, best.time_s, 1e-9) << trial;
  }
}

TEST(ScheduleBound, IsNeverAboveBruteForceWhereItIsRelaxed) {
  Rng rng = Rng::stream(2, "bound");
  double scans_share = 0.0;
  double way_share = 0.0;
  int counted = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const CoverProblem problem = random_problem(rng, 10);
    const BruteForce best = brute_force(problem);
    const auto bound = relaxed_bound(problem);
    ASSERT_TRUE(bound) << trial;
    EXPECT_LE(bound->least.scans, best.scans) << trial;
    EXPECT_LE(bound->least.way_m, best.way_m + 1e-9) << trial;
    EXPECT_LE(bound->least.time_s, best.time_s + 1e-9) << trial;
    if (best.scans == 0) continue;
    ++counted;
    scans_share += static_cast<double>(bound->least.scans) / static_cast<double>(best.scans);
    way_share += bound->least.way_m / best.way_m;
  }
  EXPECT_GT(scans_share / counted, 0.9);  // and it says something
  EXPECT_GT(way_share / counted, 0.5);
}

TEST(ScheduleBound, OfMergedViewsIsNoHigher) {
  Rng rng = Rng::stream(3, "bound");
  for (int trial = 0; trial < 50; ++trial) {
    const CoverProblem problem = random_problem(rng, 10);
    const auto whole = least_schedule(problem);
    CoverProblem places = merged(problem, places_of(problem, 3.0));
    EXPECT_LT(places.views(), problem.views());
    const auto less = least_schedule(places);
    EXPECT_LE(less->scans, whole->scans);
    EXPECT_LE(less->way_m, whole->way_m + 1e-9);
    EXPECT_LE(less->time_s, whole->time_s + 1e-9);
  }
}

TEST(ScheduleBound, OfManyViewsIsExactAsFarAsItSays) {
  Rng rng = Rng::stream(4, "bound");
  for (int trial = 0; trial < 5; ++trial) {
    CoverProblem problem = random_problem(rng, 13);
    const auto exact = least_schedule(problem);
    // The same views once more, at the same places: nothing is won by them.
    std::vector<Eigen::Index> twice;
    for (int copy = 0; copy < 2; ++copy) {
      for (Eigen::Index i = 0; i < 13; ++i) twice.push_back(i);
    }
    problem.way_m = Eigen::MatrixXd(problem.way_m(twice, twice));
    const std::vector<CellBits> shows = problem.shows;
    problem.shows.insert(problem.shows.end(), shows.begin(), shows.end());
    const auto bound = schedule_bounds(problem, std::vector{problem.needed}).front();
    EXPECT_TRUE(bound->exact_scans && bound->exact_way && bound->exact_time) << trial;
    EXPECT_EQ(bound->least.scans, exact->scans);
    EXPECT_NEAR(bound->least.way_m, exact->way_m, 1e-9);
    EXPECT_NEAR(bound->least.time_s, exact->time_s, 1e-9);
  }
}

/// 1.04 m are needed; by views 4 cm apart taken for one place 1 m is no more than a bound.
TEST(ScheduleBound, OfPlacesThatAreNoPointsIsNoExactWay) {
  std::vector<double> x_m{0.0, 1.0, 1.04};
  for (int k = 0; k < 14; ++k) x_m.push_back(0.0);
  CoverProblem problem = test::views_at(x_m);
  for (std::size_t view = 3; view < problem.views(); ++view) problem.shows[view] = {1};
  const auto bound = schedule_bounds(problem, std::vector<std::size_t>{3}).front();
  ASSERT_TRUE(bound);
  EXPECT_NEAR(bound->least.way_m, 1.0, 0.04 + 1e-9);
  EXPECT_FALSE(bound->exact_way);
  EXPECT_TRUE(bound->exact_scans && bound->exact_time);
  EXPECT_NEAR(bound->least.time_s, 1.04 + 2.0, 1e-9);
}

TEST(ScheduleBound, ThroughManyViewsIsNoExactTime) {
  std::vector<double> x_m;
  for (int k = 0; k < 16; ++k) x_m.push_back(0.5 * k);
  const CoverProblem problem = test::views_at(x_m);
  const auto bounds = schedule_bounds(problem, std::vector<std::size_t>{13, 14});
  ASSERT_TRUE(bounds[0] && bounds[1]);
  EXPECT_TRUE(bounds[0]->exact_time) << "twelve scans after the first";
  EXPECT_NEAR(bounds[0]->least.time_s, 6.0 + 12.0, 1e-9);
  EXPECT_FALSE(bounds[1]->exact_time) << "thirteen";
  EXPECT_LE(bounds[1]->least.time_s, 6.5 + 13.0 + 1e-9);
}

TEST(ScheduleBound, IsNoneWhereNothingSuffices) {
  Rng rng = Rng::stream(5, "bound");
  for (const std::size_t views : {5U, 20U}) {
    const CoverProblem problem = random_problem(rng, views);
    const std::size_t all = count_cells(shown_by_all(problem));
    const auto bounds = schedule_bounds(problem, std::vector{all, all + 1, std::size_t{0}});
    EXPECT_TRUE(bounds[0]);
    EXPECT_FALSE(bounds[1]);
    EXPECT_EQ(bounds[2]->least.time_s, 0.0);
  }
}

/// A corridor of rooms, each of which shows cells of its own: whoever needs them all comes to all.
TEST(WitnessWay, GoesToEveryRoomThatIsNeeded) {
  CoverProblem problem;
  constexpr std::size_t kRooms = 8;
  problem.way_m = Eigen::MatrixXd::Zero(kRooms + 1, kRooms + 1);
  problem.shows.assign(kRooms + 1, CellBits(kRooms, 0));
  for (std::size_t room = 1; room <= kRooms; ++room)
    problem.shows[room][room - 1] = ~std::uint64_t{0};
  for (Eigen::Index i = 0; i <= static_cast<Eigen::Index>(kRooms); ++i) {
    for (Eigen::Index j = 0; j <= static_cast<Eigen::Index>(kRooms); ++j) {
      problem.way_m(i, j) = 10.0 * std::abs(static_cast<double>(i - j));
    }
  }
  problem.needed = 64 * kRooms;
  EXPECT_NEAR(least_way_m(problem, find_witnesses(problem)), 80.0, 1e-9);
  problem.needed = 64 * (kRooms - 2);
  EXPECT_NEAR(least_way_m(problem, find_witnesses(problem)), 60.0, 1e-9);
  EXPECT_EQ(fewest_scans(problem), kRooms - 2);
}

}  // namespace
}  // namespace vantage
