// Witnesses on a line: which views are round them, and the way that comes to them.
#include "vantage/bound/witness_way.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/bound/line_problem.hpp"

namespace vantage {
namespace {

using Views = std::vector<std::size_t>;
using test::views_at;

/// The farthest view is 100 m away; of others there is one on either side of each radius.
TEST(Witnesses, AreRoundPlacesOfFourSizes) {
  const CoverProblem problem =
      views_at({0.0, 100.0, 92.1, 91.9, 86.1, 85.9, 80.1, 79.9, 70.1, 69.9});
  const auto witnesses = find_witnesses(problem);
  ASSERT_EQ(witnesses.size(), 36U) << "nine places";
  EXPECT_EQ(witnesses[0].around, (Views{1, 2}));
  EXPECT_EQ(witnesses[9].around, (Views{1, 2, 3, 4}));
  EXPECT_EQ(witnesses[18].around, (Views{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(witnesses[27].around, (Views{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(witnesses[0].cells, 2U);
  EXPECT_EQ(witnesses[27].cells, 8U);
}

/// Out of reach is view 5.
TEST(Witnesses, AreRoundPlacesEachAsFarAsCanBeFromThoseBefore) {
  CoverProblem problem = views_at({0.0, 60.0, 100.0, 90.0, 30.0, 0.0});
  for (Eigen::Index i = 0; i < 5; ++i) {
    problem.way_m(i, 5) = problem.way_m(5, i) = std::numeric_limits<double>::infinity();
  }
  const auto witnesses = find_witnesses(problem);
  ASSERT_EQ(witnesses.size(), 15U) << "none that is 30 m wide round a place at 30 m";
  EXPECT_EQ(witnesses[0].around, Views{2});
  EXPECT_EQ(witnesses[1].around, Views{1});
  EXPECT_EQ(witnesses[2].around, Views{4});
  EXPECT_EQ(witnesses[3].around, Views{3});
  EXPECT_EQ(witnesses[4].around, (Views{2, 3})) << "14 m wide";
}

TEST(Witnesses, AreRoundFortyPlacesAtMost) {
  std::vector<double> x_m{0.0};
  for (int k = 41; k <= 100; ++k) x_m.push_back(k);
  EXPECT_EQ(find_witnesses(views_at(x_m)).size(), 4U * 40U);
}

TEST(Witnesses, AreNotRoundTheStart) {
  EXPECT_EQ(find_witnesses(views_at({0.0, 100.0, 20.0})).size(), 2U + 2U + 1U + 1U);
}

TEST(Witnesses, HaveTheCellsThatAreSeenFromNowhereElse) {
  CoverProblem problem = views_at({0.0, 100.0, 99.0, 98.0});
  problem.shows[2] = problem.shows[0];
  problem.shows[3][0] |= problem.shows[1][0];
  const auto witnesses = find_witnesses(problem);
  ASSERT_FALSE(witnesses.empty());
  EXPECT_EQ(witnesses[0].around, (Views{1, 2, 3}));
  EXPECT_EQ(witnesses[0].views, (Views{1, 3}));
  EXPECT_EQ(witnesses[0].cells, 2U);
  problem = views_at({0.0, 100.0});
  problem.shows[1] = problem.shows[0];
  EXPECT_TRUE(find_witnesses(problem).empty());
}

double way_for(CoverProblem problem, std::size_t needed, const std::vector<Witness>& witnesses) {
  problem.needed = needed;
  return least_way_m(problem, witnesses);
}

/// Five cells are seen at -8 m, three at 6 m and one at the start.
TEST(WitnessWay, LeavesOutNoMoreThanIsNotNeeded) {
  CoverProblem problem = views_at({0.0, -8.0, 6.0});
  problem.shows = {{0b1}, {0b111110}, {0b111000000}};
  const std::vector<Witness> witnesses{{{1}, {1}, 5}, {{2}, {2}, 3}};
  EXPECT_NEAR(way_for(problem, 9, witnesses), 20.0, 1e-12);
  EXPECT_NEAR(way_for(problem, 7, witnesses), 20.0, 1e-12);
  EXPECT_NEAR(way_for(problem, 6, witnesses), 8.0, 1e-12);
  EXPECT_NEAR(way_for(problem, 5, witnesses), 8.0, 1e-12);
  EXPECT_NEAR(way_for(problem, 4, witnesses), 6.0, 1e-12);
  EXPECT_EQ(way_for(problem, 1, witnesses), 0.0);
  EXPECT_EQ(way_for(problem, 10, witnesses), std::numeric_limits<double>::infinity());
}

TEST(WitnessWay, ReachesAsFarAsViewsShowEnough) {
  const CoverProblem problem = views_at({0.0, 9.0, 4.0, 6.0});
  EXPECT_EQ(way_for(problem, 1, {}), 0.0);
  EXPECT_EQ(way_for(problem, 2, {}), 4.0);
  EXPECT_EQ(way_for(problem, 3, {}), 6.0);
  EXPECT_EQ(way_for(problem, 4, {}), 9.0);
}

/// The first witness has a view in common with the second, which has more cells.
TEST(WitnessWay, GoesToThoseWithMostCells) {
  const CoverProblem problem = views_at({0.0, 4.0, -5.0, -8.0, 6.0});
  const std::vector<Witness> witnesses{{{1, 2}, {1}, 1}, {{2, 3}, {3}, 5}, {{4}, {4}, 3}};
  EXPECT_NEAR(way_for(problem, 5, witnesses), 6.0 + 14.0, 1e-12);
}

TEST(WitnessWay, GoesToTheNearestViewThatShowsSomething) {
  const CoverProblem problem = views_at({0.0, 10.0, 14.0, -6.0, 8.0});
  const std::vector<Witness> witnesses{{{1, 2, 4}, {1, 2}, 2}, {{3}, {3}, 1}};
  EXPECT_NEAR(way_for(problem, 5, witnesses), 6.0 + 16.0, 1e-12);
}

/// Seven rooms to each side: it comes to the twelve that are named first.
TEST(WitnessWay, GoesToTwelveAtMost) {
  std::vector<double> x_m{0.0};
  std::vector<Witness> witnesses;
  for (const double side : {1.0, -1.0}) {
    for (int k = 1; k <= 7; ++k) {
      const std::size_t view = x_m.size();
      x_m.push_back(10.0 * side * k);
      witnesses.push_back({{view}, {view}, 1});
    }
  }
  EXPECT_NEAR(way_for(views_at(x_m), 15, witnesses), 2.0 * 50.0 + 70.0, 1e-12);
}

/// The third has a view beside either of two far ones, and no way of its own between them.
TEST(WitnessWay, ToMoreIsNoShorterThanToFewer) {
  const CoverProblem problem = views_at({0.0, -10.0, 10.0, -9.0, 9.0});
  const std::vector<Witness> witnesses{{{1}, {1}, 1}, {{2}, {2}, 1}, {{3, 4}, {3, 4}, 2}};
  EXPECT_NEAR(way_for(problem, 5, witnesses), 30.0, 1e-12);
}

}  // namespace
}  // namespace vantage
