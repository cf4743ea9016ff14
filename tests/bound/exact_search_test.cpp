// How far the searches go, and what they say where they end early.
#include <gtest/gtest.h>

#include <vector>

#include "tests/bound/line_problem.hpp"
#include "vantage/bound/fewest_scans.hpp"
#include "vantage/bound/schedule_bound.hpp"

namespace vantage {
namespace {

using test::evenly_spaced_views;
using test::views_at;

/// View 0 shows nothing and each other one what its bits say.
CoverProblem showing(const std::vector<std::uint64_t>& cells, std::size_t needed) {
  CoverProblem problem = views_at(std::vector<double>(cells.size() + 1, 0.0));
  problem.shows[0] = {0};
  for (std::size_t i = 0; i < cells.size(); ++i) problem.shows[i + 1] = {cells[i]};
  problem.needed = needed;
  return problem;
}

TEST(ExactSearch, LooksAtNoMoreSetsThanAllowed) {
  const CoverProblem one = showing({0b11}, 2);
  EXPECT_EQ(fewest_scans_exactly(one, 2), 1U) << "none, and the only view";
  EXPECT_EQ(fewest_scans_exactly(one, 1), std::nullopt);
  EXPECT_FALSE(least_time_exactly(one, 1));
  const CoverProblem none = showing({0b11}, 0);
  EXPECT_EQ(fewest_scans_exactly(none, 1), 0U);
  EXPECT_EQ(fewest_scans_exactly(none, 0), std::nullopt);
}

TEST(ExactSearch, TriesFirstWhatShowsMost) {
  EXPECT_EQ(fewest_scans_exactly(showing({0b001, 0b111}, 3), 2), 1U);
}

TEST(ExactSearch, IsNoneWhereNothingSuffices) {
  EXPECT_EQ(fewest_scans_exactly(showing({0b001, 0b010}, 3), 1000), std::nullopt);
  EXPECT_FALSE(least_time_exactly(showing({0b001, 0b010}, 3), 1000));
  EXPECT_EQ(fewest_scans_exactly(showing({0b001, 0b010}, 2), 1000), 2U);
}

TEST(ExactSearch, OfTimeMayTakeMoreScansThanTheFewest) {
  // Two views nearby, or one far off that shows as much.
  CoverProblem problem = views_at({0.0, 1.0, 2.0, 9.0});
  problem.shows = {{0b0}, {0b01}, {0b10}, {0b11}};
  problem.needed = 2;
  problem.scan_s = 3.0;
  EXPECT_EQ(fewest_scans_exactly(problem, 1000), 1U);
  const auto least = least_time_exactly(problem, 1000);
  ASSERT_TRUE(least);
  EXPECT_NEAR(least->time_s, 2.0 + 6.0, 1e-12);
  EXPECT_TRUE(least->reached);
}

TEST(ScheduleBound, LooksAtEverySetOfFourteenViews) {
  const CoverProblem problem = evenly_spaced_views(15);
  const auto bound = schedule_bounds(problem, std::vector<std::size_t>{14}).front();
  ASSERT_TRUE(bound);
  EXPECT_TRUE(bound->exact_scans && bound->exact_way && bound->exact_time);
  EXPECT_NEAR(bound->least.time_s, 6.5 + 13.0, 1e-9);
}

TEST(ScheduleBound, IsOfAnExactWayBetweenFifteenPlaces) {
  std::vector<double> x_m{0.0, 0.0};
  for (int k = 1; k <= 14; ++k) x_m.push_back(0.5 * k);
  const std::vector<std::size_t> needed{5};
  const auto fifteen = schedule_bounds(views_at(x_m), needed).front();
  ASSERT_TRUE(fifteen);
  EXPECT_TRUE(fifteen->exact_way);
  EXPECT_NEAR(fifteen->least.way_m, 1.5, 1e-9);
  x_m.push_back(7.5);
  const auto sixteen = schedule_bounds(views_at(x_m), needed).front();
  ASSERT_TRUE(sixteen);
  EXPECT_FALSE(sixteen->exact_way);
  EXPECT_LE(sixteen->least.way_m, 1.5 + 1e-9);
}

TEST(ScheduleBound, IsSearchedForAmongSixtyFourViews) {
  const std::vector<std::size_t> needed{2};
  const auto searched = schedule_bounds(evenly_spaced_views(64), needed).front();
  ASSERT_TRUE(searched);
  EXPECT_TRUE(searched->exact_scans && searched->exact_time);
  EXPECT_EQ(searched->least.scans, 1U);
  EXPECT_NEAR(searched->least.time_s, 1.5, 1e-9);
  const auto more = schedule_bounds(evenly_spaced_views(65), needed).front();
  ASSERT_TRUE(more);
  EXPECT_FALSE(more->exact_scans || more->exact_time);
  EXPECT_EQ(more->least.scans, 1U);
}

/// 17 views of three words each: 51 words for a set.
TEST(ScheduleBound, IsSearchedForByAsMuchWorkAsAllowed) {
  CoverProblem problem = evenly_spaced_views(17);
  for (CellBits& cells : problem.shows) cells.resize(3, 0);
  const std::vector<std::size_t> needed{2};
  const auto enough = schedule_bounds(problem, needed, {.work = 102.0}).front();
  ASSERT_TRUE(enough);
  EXPECT_TRUE(enough->exact_scans && enough->exact_time);
  const auto less = schedule_bounds(problem, needed, {.work = 101.0}).front();
  ASSERT_TRUE(less);
  EXPECT_FALSE(less->exact_scans || less->exact_time);
}

TEST(ScheduleBound, HasItsDefaults) {
  EXPECT_EQ(BoundOptions{}.place_m, 0.05);
  EXPECT_EQ(BoundOptions{}.work, 1e10);
  EXPECT_EQ(ScanBoundOptions{}.rounds, 60);
  EXPECT_EQ(ScanBoundOptions{}.tolerance, 0.002);
  EXPECT_EQ(CoverProblem{}.needed, 0U);
  EXPECT_EQ(LeastSchedule{}.scans, 0U);
  EXPECT_EQ(LeastSchedule{}.way_m, 0.0);
  EXPECT_EQ(LeastSchedule{}.time_s, 0.0);
  EXPECT_EQ(LeastTime{}.time_s, 0.0);
  EXPECT_FALSE(LeastTime{}.reached);
  const ScheduleBound bound;
  EXPECT_FALSE(bound.exact_scans || bound.exact_way || bound.exact_time);
}

/// Two views show the same six cells, three more a cell each. The program's first solution takes
/// one and a half of the two; once it is told that this brings no more than six, all are needed.
TEST(FewestScans, GrowWithEachCut) {
  const CoverProblem problem = showing({0b111111, 0b111111, 1U << 6, 1U << 7, 1U << 8}, 9);
  EXPECT_EQ(fewest_scans(problem, {.rounds = 0}), 0U);
  EXPECT_EQ(fewest_scans(problem, {.rounds = 1}), 2U);
  EXPECT_EQ(fewest_scans(problem, {.rounds = 2}), 4U);
  EXPECT_EQ(fewest_scans(problem), 4U);
}

/// Six of nine cells are shown by the first solution.
TEST(FewestScans, AreCutUntilTheSolutionLacksNoMoreThanTheTolerance) {
  const CoverProblem problem = showing({0b111111, 0b111111, 1U << 6, 1U << 7, 1U << 8}, 9);
  EXPECT_EQ(fewest_scans(problem, {.tolerance = 0.34}), 2U);
  EXPECT_EQ(fewest_scans(problem, {.tolerance = 0.33}), 4U);
}

TEST(FewestScans, AreNoneWhereNothingSuffices) {
  EXPECT_EQ(fewest_scans(showing({0b01, 0b10}, 2)), 2U);
  EXPECT_EQ(fewest_scans(showing({0b01, 0b10}, 3)), std::nullopt);
  EXPECT_EQ(fewest_scans(showing({0b01, 0b10}, 0)), 0U);
}

/// 63 views at the start, which show one cell, and three that show two of three more each: 1 m to
/// either side, and 10 m away. Any two do, and none shows a cell that no other does.
CoverProblem two_of_three() {
  std::vector<double> x_m(63, 0.0);
  x_m.insert(x_m.end(), {1.0, -1.0, 10.0});
  CoverProblem problem = views_at(x_m);
  for (CellBits& cells : problem.shows) cells = {0b0001};
  problem.shows[63] = {0b0110};
  problem.shows[64] = {0b1100};
  problem.shows[65] = {0b1010};
  problem.needed = 4;
  return problem;
}

TEST(ScheduleBound, OfTooManyViewsToSearchTakesTheTimeOfItsWay) {
  const auto bound = schedule_bounds(two_of_three(), std::vector<std::size_t>{4}).front();
  ASSERT_TRUE(bound);
  EXPECT_EQ(bound->least.scans, 2U);
  EXPECT_NEAR(bound->least.way_m, 3.0, 1e-9) << "to one side and to the other";
  EXPECT_NEAR(bound->least.time_s, 3.0 + 2.0, 1e-9);
  EXPECT_TRUE(bound->exact_way);
  EXPECT_FALSE(bound->exact_scans || bound->exact_time);
}

TEST(RelaxedBound, TakesTheTimeOfItsWayAndOfItsScans) {
  const auto bound = relaxed_bound(two_of_three());
  ASSERT_TRUE(bound);
  EXPECT_EQ(bound->least.scans, 2U);
  EXPECT_NEAR(bound->least.way_m, 1.0, 1e-9) << "as far as views show enough";
  EXPECT_NEAR(bound->least.time_s, 1.0 + 2.0, 1e-9);
  EXPECT_FALSE(bound->exact_scans || bound->exact_way || bound->exact_time);
}

TEST(ScheduleBound, TellsHowManyBoundsThereAre) {
  std::vector<std::size_t> told;
  const auto bounds =
      schedule_bounds(evenly_spaced_views(17), std::vector<std::size_t>{1, 2, 99, 3},
                      {.done = [&](std::size_t count) { told.push_back(count); }});
  EXPECT_EQ(told, (std::vector<std::size_t>{0, 1, 2, 3}));
  ASSERT_EQ(bounds.size(), 4U);
  EXPECT_FALSE(bounds[2]) << "99 cells there are not";
  ASSERT_TRUE(bounds[0] && bounds[3]);
  EXPECT_EQ(bounds[0]->least.scans, 0U);
  EXPECT_EQ(bounds[3]->least.scans, 2U);
}

/// One view shows four of six cells: taken one and a half times it would do.
TEST(FewestScans, TakeNoViewTwice) {
  EXPECT_EQ(fewest_scans(showing({0b001111, 0b010000, 0b100000}, 6), {.rounds = 1}), 3U);
}

/// Three scans are found with the fourth set, two with the sixth.
TEST(ExactSearch, SaysNothingWhereItIsCutShortAfterItHasFoundSome) {
  const CoverProblem problem = showing({0b001111, 0b010011, 0b101100}, 6);
  EXPECT_EQ(fewest_scans_exactly(problem, 6), 2U);
  for (const std::size_t most_sets : {4U, 5U}) {
    EXPECT_EQ(fewest_scans_exactly(problem, most_sets), std::nullopt) << most_sets;
  }
}

TEST(ExactSearch, LooksAtNoSetThatCannotBeBetter) {
  EXPECT_EQ(fewest_scans_exactly(showing({0b01, 0b10, 0b01, 0b10}, 2), 3), 2U);
  CoverProblem problem = views_at({0.0, 1.0, -1.0});
  problem.shows = {{0b0}, {0b1}, {0b1}};
  problem.needed = 1;
  const auto least = least_time_exactly(problem, 2);
  ASSERT_TRUE(least) << "none, and the one of two that are as good";
  EXPECT_NEAR(least->time_s, 1.0 + 1.0, 1e-12);
}

}  // namespace
}  // namespace vantage
