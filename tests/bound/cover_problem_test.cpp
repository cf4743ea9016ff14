// Sets of cells, views that are made one, and ways that can be told by heart.
#include "vantage/bound/cover_problem.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/bound/line_problem.hpp"

namespace vantage {
namespace {

using test::views_at;

TEST(CellBits, AreCountedOverAllWords) {
  const CellBits a{0b1011, 0b110 | std::uint64_t{1} << 63};
  const CellBits b{0b0110, 0b011};
  EXPECT_EQ(count_cells(a), 6U);
  EXPECT_EQ(count_without(a, b), 4U);
  EXPECT_EQ(count_without(b, a), 2U);
  CellBits both = b;
  unite(both, a);
  EXPECT_EQ(both, (CellBits{0b1111, 0b111 | std::uint64_t{1} << 63}));
}

TEST(CoverProblem, TakesTimeToDriveAndToScan) {
  CoverProblem problem;
  problem.speed_m_s = 0.5;
  problem.scan_s = 4.0;
  EXPECT_NEAR(problem.time_s(5.0, 3), 22.0, 1e-12);
  EXPECT_NEAR(CoverProblem{}.time_s(5.0, 3), 5.0, 1e-12);
}

TEST(CoverProblemDeath, MustFitTogether) {
  EXPECT_DEATH(CoverProblem{}.check(), "ways between all views");
  CoverProblem problem = views_at({0.0, 3.0});
  problem.check();
  problem.scan_s = 0.0;
  problem.check();
  problem.scan_s = -0.1;
  EXPECT_DEATH(problem.check(), "a time of a scan");
  problem = views_at({0.0, 3.0});
  problem.speed_m_s = 0.0;
  EXPECT_DEATH(problem.check(), "a speed");
  problem = views_at({0.0, 3.0});
  problem.shows[1].push_back(0);
  EXPECT_DEATH(problem.check(), "sets of the same cells");
  problem = views_at({0.0, 3.0});
  problem.way_m.conservativeResize(2, 1);
  EXPECT_DEATH(problem.check(), "ways between all views");
}

TEST(CoverProblem, ShowsWhatAnyViewShows) {
  EXPECT_EQ(shown_by_all(views_at({0.0, 3.0, 10.0})), CellBits{0b111});
}

TEST(CoverProblem, OfGroupsIsAsNearAsTheNearestAndByDetours) {
  CoverProblem problem = views_at({0.0, 3.0, 10.0, 12.0});
  problem.needed = 3;
  const CoverProblem groups = merged(problem, std::vector<std::size_t>{0, 1, 1, 2});
  ASSERT_EQ(groups.views(), 3U);
  EXPECT_EQ(groups.shows[0], CellBits{0b0001});
  EXPECT_EQ(groups.shows[1], CellBits{0b0110});
  EXPECT_EQ(groups.shows[2], CellBits{0b1000});
  EXPECT_EQ(groups.needed, 3U);
  Eigen::Matrix3d way_m;
  way_m << 0, 3, 5, 3, 0, 2, 5, 2, 0;
  EXPECT_LT((groups.way_m - way_m).norm(), 1e-12) << "through the group 0 and 2 are 3 + 2 apart";
}

TEST(CoverProblem, OfGroupsOfOneIsTheSame) {
  const CoverProblem problem = views_at({0.0, 3.0, 10.0});
  const CoverProblem same = merged(problem, std::vector<std::size_t>{0, 1, 2});
  EXPECT_EQ(same.shows, problem.shows);
  EXPECT_EQ(same.way_m, problem.way_m);
}

TEST(Places, HoldWhatIsNoFartherFromTheirFirstView) {
  const CoverProblem problem = views_at({0.0, 0.5, 0.75, 1.25});
  EXPECT_EQ(places_of(problem, 0.5), (std::vector<std::size_t>{0, 0, 1, 1}));
  EXPECT_EQ(places_of(problem, 0.49), (std::vector<std::size_t>{0, 1, 1, 2}));
  EXPECT_EQ(places_of(problem, 0.75), (std::vector<std::size_t>{0, 0, 0, 1}));
  EXPECT_EQ(places_of(problem, 0.0), (std::vector<std::size_t>{0, 1, 2, 3}));
}

TEST(ShortestWays, AreToldOfEachSetOfPlaces) {
  const CoverProblem problem = views_at({0.0, 2.0, -3.0, 7.0});
  const std::vector<double> way_m = ways_through_sets_m(problem.way_m);
  const std::vector<double> expected_m{0.0, 2.0, 3.0, 7.0, 7.0, 7.0, 13.0, 13.0};
  ASSERT_EQ(way_m.size(), expected_m.size());
  for (std::size_t set = 0; set < way_m.size(); ++set) {
    EXPECT_NEAR(way_m[set], expected_m[set], 1e-12) << set;
  }
}

/// Six to one side and six or seven to the other: whoever comes to all goes one of both ways twice,
/// the tree that spans them does not.
TEST(ShortestWays, AreExactThroughTwelveViewsAndATreeThroughMore) {
  std::vector<double> x_m{0.0};
  for (int k = 1; k <= 7; ++k) {
    x_m.push_back(k);
    x_m.push_back(-k);
  }
  const CoverProblem problem = views_at(x_m);
  std::vector<std::size_t> views;
  EXPECT_EQ(shortest_way_m(problem, views), 0.0);
  for (std::size_t view = 1; view <= 12; ++view) views.push_back(view);
  EXPECT_NEAR(shortest_way_m(problem, views), 18.0, 1e-12);
  views.push_back(13);
  EXPECT_NEAR(shortest_way_m(problem, views), 13.0, 1e-12);
}

TEST(ShortestWays, EndAnywhere) {
  const CoverProblem problem = views_at({0.0, 2.0, -3.0, 7.0});
  EXPECT_NEAR(shortest_way_m(problem, std::vector<std::size_t>{3, 1}), 7.0, 1e-12);
  EXPECT_NEAR(shortest_way_m(problem, std::vector<std::size_t>{2, 3, 1}), 13.0, 1e-12);
  EXPECT_NEAR(shortest_way_m(problem, std::vector<std::size_t>{1, 2}), 7.0, 1e-12);
}

}  // namespace
}  // namespace vantage
