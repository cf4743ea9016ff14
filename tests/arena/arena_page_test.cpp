// What a page of an arena says of planners that are alike, were not run or were run here and there.
#include "vantage/arena/arena_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/arena/hand_made_study.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/arena/foreign_planner.hpp"
#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Of two scenes and three planners, with a budget of 100 s.
class WrittenArena : public testing::Test {
 protected:
  void SetUp() override {
    results_ = support::hand_made_results(folder_.path(), R"(    greedy: {choice: greedy}
    random: {choice: random}
    oracle: {choice: oracle}
)",
                                          "[1]");
  }
  void put_metrics(const std::string& name, EpisodeState state,
                   const nlohmann::ordered_json& metrics) {
    const auto planned = std::ranges::find(results_.plan, name, &PlannedEpisode::name);
    ASSERT_NE(planned, results_.plan.end()) << name;
    const auto i = static_cast<std::size_t>(planned - results_.plan.begin());
    results_.states[i] = state;
    results_.measures[i].emplace();
    const auto episode = episode_folder(folder_.path(), *planned);
    std::filesystem::create_directories(episode);
    write_file(episode / "metrics.json", metrics.dump());
  }
  /// The share is seen from 50 s on.
  void put(const std::string& name, double share, EpisodeState state = EpisodeState::completed) {
    put_metrics(name, state,
                {{"observable_cells", 1000},
                 {"reason", "as it came"},
                 {"scans",
                  {{{"time_s", 10.0}, {"observable_unobserved_cells", 1000}},
                   {{"time_s", 50.0}, {"observable_unobserved_cells", 1000.0 * (1.0 - share)}}}}});
  }
  std::string page() {
    write_arena_page(results_, leaderboard_of(results_));
    return read_file(folder_ / "arena.html");
  }

  support::TemporaryDirectory folder_;
  StudyResults results_;
};

TEST_F(WrittenArena, PlannersThatWereNotRunAreOutOfIt) {
  put("a/greedy/1", 0.6);
  put("a/random/1", 0.4, EpisodeState::failed);
  const std::string html = page();
  EXPECT_THAT(html, Not(HasSubstr("<th scope=\"row\">oracle")));
  EXPECT_THAT(html, Not(HasSubstr(" s in b"))) << "nothing was run there";
  EXPECT_THAT(html, Not(HasSubstr("<small>(0)</small>")));
  EXPECT_THAT(html, HasSubstr("<td class=\"bad\">1/1</td>"));
  EXPECT_THAT(html, HasSubstr("<td>0/1</td>"));
  EXPECT_THAT(html, HasSubstr("1 seed<"));
  const Standing none = leaderboard_of(results_).standings.back();
  EXPECT_EQ(none.planner, "oracle");
  EXPECT_FALSE(none.rank);
  EXPECT_EQ(none.seen_share, 0.0);
}

TEST_F(WrittenArena, PlannersThatWereNotRunHaveNoRank) {
  put("a/oracle/1", 0.6);
  const Leaderboard board = leaderboard_of(results_);
  ASSERT_EQ(board.standings.size(), 3U);
  EXPECT_EQ(board.standings[0].planner, "oracle");
  for (const Standing& standing : board.standings) EXPECT_FALSE(standing.rank) << standing.planner;
}

/// One in the first scene alone, the other one in the second.
TEST_F(WrittenArena, PlannersAreShownInTheScenesThatTheyWereRunIn) {
  put("a/greedy/1", 0.6);
  put("b/random/1", 0.4);
  const Figure scenes = scene_figure(results_, leaderboard_of(results_));
  ASSERT_EQ(scenes.panels.size(), 2U);
  ASSERT_EQ(scenes.panels[0].series.size(), 1U);
  EXPECT_EQ(scenes.panels[0].series[0].name, "greedy");
  ASSERT_EQ(scenes.panels[1].series.size(), 1U);
  EXPECT_EQ(scenes.panels[1].series[0].name, "random");
  const std::string html = page();
  EXPECT_THAT(html, HasSubstr("<tr><th scope=\"row\">random</th><td>–</td><td style="));
  EXPECT_THAT(html, HasSubstr("</td><td>–</td></tr>")) << "greedy in the second";
}

TEST_F(WrittenArena, PlannersThatAreAlikeAreNeitherGoodNorBad) {
  for (const char* planner : {"greedy", "random"}) {
    put(std::string("a/") + planner + "/1", 0.6);
    put(std::string("b/") + planner + "/1", 0.4);
  }
  const std::string html = page();
  EXPECT_THAT(html, HasSubstr("<td title=\"95 %: +0.000 to +0.000, 2 pairs\">+0.000</td>"));
  EXPECT_THAT(html, HasSubstr("--shade:0%\">0.300<"));
  EXPECT_THAT(html, Not(HasSubstr("nan")));
}

TEST_F(WrittenArena, WhatMetricsDoNotTellIsNothing) {
  put_metrics("a/greedy/1", EpisodeState::completed,
              {{"observable_cells", 1000},
               {"scans", {{{"observable_unobserved_cells", 400}}, {{"time_s", 50.0}}}}});
  put_metrics("a/random/1", EpisodeState::completed,
              {{"scans", nlohmann::ordered_json::array(
                             {{{"time_s", 5.0}, {"observable_unobserved_cells", 0}}})}});
  write_file(folder_ / "episodes/a/greedy/1/branches.json",
             R"({"decisions": [{"regret": {}, "branches": [{"new_cells": 10}]}]})");
  const std::vector<EpisodeScore> scores = episode_scores(results_);
  ASSERT_EQ(scores.size(), 2U);
  ASSERT_EQ(scores[0].steps.size(), 2U);
  EXPECT_EQ(scores[0].steps[0].time_s, 0.0);
  EXPECT_DOUBLE_EQ(scores[0].steps[0].share, 0.6);
  EXPECT_EQ(scores[0].steps[1].share, 1.0);
  EXPECT_EQ(scores[0].decision_times_s, (std::vector<double>{0.0}));
  EXPECT_EQ(scores[0].regret_share, 0.0);
  EXPECT_EQ(scores[1].seen_share, 0.0) << "of no cells";
}

TEST(ArenaDefaults, AreOfAPlannerThatHasDoneNothing) {
  EXPECT_EQ(ForeignPlanner{}.timeout_s, 10.0);
  EXPECT_EQ(Standing{}.level, 0U);
  EXPECT_EQ(ShareSeen{}.time_s, 0.0);
  EXPECT_EQ(ShareSeen{}.share, 0.0);
  EXPECT_EQ(EpisodeScore{}.score, 0.0);
  EXPECT_EQ(EpisodeScore{}.seen_share, 0.0);
}

}  // namespace
}  // namespace vantage
