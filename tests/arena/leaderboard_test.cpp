// The share seen that a leader board is of, and the board as text, to the letter.
#include "vantage/arena/leaderboard.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vantage {
namespace {

TEST(ShareSeen, IsTheMeanOverTheBudget) {
  const std::vector<ShareSeen> steps{{10.0, 0.5}, {60.0, 0.8}, {100.0, 1.0}};
  // 0 for 10 s, 0.5 for 50 s, 0.8 for 40 s; the last scan ends too late.
  EXPECT_DOUBLE_EQ(mean_share_seen(steps, 100.0), 0.57);
  EXPECT_DOUBLE_EQ(mean_share_seen(steps, 200.0), (25.0 + 32.0 + 100.0) / 200.0);
  EXPECT_EQ(mean_share_seen({}, 100.0), 0.0);
  EXPECT_EQ(mean_share_seen(steps, 5.0), 0.0);
  EXPECT_EQ(mean_share_seen(steps, 0.0), 0.0) << "of no time";
  EXPECT_DOUBLE_EQ(mean_share_seen({{0.25, 0.5}}, 1.0), 0.375);
  EXPECT_EQ(sampled_share_seen(steps, 100.0, 6),
            (std::vector<double>{0.0, 0.5, 0.5, 0.8, 0.8, 1.0}));
}

/// A planner with everything, a reference with little, and one that was not run.
Leaderboard written_board() {
  Standing mine{.planner = "mine", .level = 1, .kind = PlannerKind::foreign, .rank = 1};
  mine.episodes = 4;
  mine.failed = 1;
  mine.score = 0.35;
  mine.interval = Interval{0.25, 0.45};
  mine.difference = Difference{};
  mine.difference->mean = 0.05;
  mine.difference->pairs = 4;
  mine.difference->clusters = 2;
  mine.difference->interval = {-0.1, 0.2};
  mine.seen_share = 0.7;
  mine.path_length_m = 4.3;
  mine.collisions = 1.5;
  mine.time_over_bound_90 = 1.75;
  mine.bounded = 3;
  mine.regret_share = 0.125;
  Standing oracle{.planner = "oracle_of_all", .level = 2, .kind = PlannerKind::reference};
  oracle.episodes = 2;
  oracle.score = 0.5;
  oracle.difference = Difference{};
  oracle.difference->mean = 0.2;
  oracle.difference->clusters = 1;
  oracle.seen_share = 1.0;
  oracle.path_length_m = 12.0;
  const Standing none{.planner = "none", .level = 0};
  return {{mine, oracle, none}, {}, {}};
}

TEST(LeaderboardText, HasARowAPlanner) {
  const std::string csv = leaderboard_csv(written_board());
  EXPECT_EQ(csv,
            "rank,planner,kind,episodes,failed,score,score_low,score_high,difference,"
            "difference_low,difference_high,seen_share,path_length_m,collisions,"
            "time_over_bound_90,bounded_episodes,regret_share\n"
            "1,mine,foreign,4,1,0.35,0.25,0.45,0.05,-0.1,0.2,0.7,4.3,1.5,1.75,3,0.125\n"
            ",oracle_of_all,reference,2,0,0.5,,,0.2,,,1,12,,,0,\n"
            ",none,built-in,0,0,,,,,,,0,,,,0,\n");
}

TEST(LeaderboardText, ForTheTerminalLeavesOutWhatWasNotRun) {
  EXPECT_EQ(leaderboard_text(written_board()),
            "      planner                   score  95 %              seen   path m  failed\n"
            "   1  mine           foreign    0.350  [0.250, 0.450]   0.700      4.3   1/4\n"
            "   -  oracle_of_all  reference  0.500                   1.000     12.0   0/2\n");
}

TEST(LeaderboardText, OfShortNamesIsAsWideAsItsHeading) {
  Standing short_one{.planner = "a", .level = 0, .rank = 1};
  short_one.episodes = 1;
  EXPECT_EQ(leaderboard_text({{short_one}, {}, {}}),
            "      planner             score  95 %              seen   path m  failed\n"
            "   1  a        built-in   0.000                   0.000        -   0/1\n");
}

TEST(LeaderboardText, KindsHaveNames) {
  EXPECT_EQ(kind_name(PlannerKind::built_in), "built-in");
  EXPECT_EQ(kind_name(PlannerKind::foreign), "foreign");
  EXPECT_EQ(kind_name(PlannerKind::reference), "reference");
}

}  // namespace
}  // namespace vantage
