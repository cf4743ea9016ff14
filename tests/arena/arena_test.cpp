// The leader board of episodes whose results are written by hand.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

#include "tests/arena/hand_made_study.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/arena/arena_page.hpp"
#include "vantage/arena/foreign_planner.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/runtime/episode_loop.hpp"

namespace vantage {
namespace {
using Json = nlohmann::ordered_json;
using testing::HasSubstr;

class Arena : public testing::Test {
 protected:
  void SetUp() override {
    results = support::hand_made_results(folder.path(), R"(    greedy: {choice: greedy}
    oracle: {choice: oracle}
    mine: {choice: {name: external, command: [sh, -c, "exit 1"]}}
)",
                                         "[1, 2]");
  }

  /// The share is seen from 50 s on.
  void put(const std::string& name, EpisodeState state, double share, const Json& more = {}) {
    for (std::size_t i = 0; i < results.plan.size(); ++i) {
      if (results.plan[i].name != name) continue;
      results.states[i] = state;
      if (state != EpisodeState::crashed) results.measures[i].emplace();
      Json metrics = {{"observable_cells", 1000},
                      {"reason", "the <reason>"},
                      {"path_length_m", 4.0},
                      {"collisions", 1},
                      {"scans",
                       {{{"time_s", 10.0}, {"observable_unobserved_cells", 1000}},
                        {{"time_s", 50.0},
                         {"observable_unobserved_cells", 1000.0 * (1.0 - share)},
                         {"plan_time_s", 0.25}}}}};
      if (more.is_object()) metrics.update(more);
      write_file(make_folder(episode_folder(folder.path(), results.plan[i])) / "metrics.json",
                 metrics.dump());
      return;
    }
    FAIL() << name;
  }
  static std::filesystem::path make_folder(const std::filesystem::path& path) {
    std::filesystem::create_directories(path);
    return path;
  }

  support::TemporaryDirectory folder;
  StudyResults results;
};

TEST_F(Arena, RanksPlannersByWhatTheySee) {
  for (const char* scene : {"a", "b"}) {
    for (const char* seed : {"1", "2"}) {
      const auto name = [&](const char* planner) {
        return std::string(scene) + "/" + planner + "/" + seed;
      };
      put(name("greedy"), EpisodeState::completed, 0.6);
      put(name("oracle"), EpisodeState::completed, 1.0);
      put(name("mine"), EpisodeState::completed, scene[0] == 'a' ? 0.7 : 0.9);
    }
  }
  put("b/mine/2", EpisodeState::failed, 0.5);
  const Leaderboard board = leaderboard_of(results);
  ASSERT_EQ(board.standings.size(), 3U);
  const auto& [oracle, mine, greedy] =
      std::tie(board.standings[0], board.standings[1], board.standings[2]);
  EXPECT_EQ(oracle.planner, "oracle");
  EXPECT_EQ(oracle.kind, PlannerKind::reference);
  EXPECT_FALSE(oracle.rank);
  EXPECT_DOUBLE_EQ(oracle.score, 0.5);
  EXPECT_EQ(mine.planner, "mine");
  EXPECT_EQ(mine.kind, PlannerKind::foreign);
  EXPECT_EQ(mine.rank, 1);
  EXPECT_EQ(mine.failed, 1U);
  EXPECT_EQ(mine.episodes, 4U);
  EXPECT_DOUBLE_EQ(mine.score, (0.35 + 0.35 + 0.45 + 0.25) / 4.0);
  ASSERT_TRUE(mine.interval);  // of two scenes, of means 0.35 and 0.35
  EXPECT_NEAR(mine.interval->low, 0.35, 1e-12);
  ASSERT_TRUE(mine.difference);
  EXPECT_NEAR(mine.difference->mean, 0.05, 1e-12);
  EXPECT_EQ(greedy.rank, 2);
  EXPECT_FALSE(greedy.difference && greedy.difference->pairs > 0);
  EXPECT_EQ(greedy.decision_s, 0.25);
  EXPECT_EQ(greedy.collisions, 1.0);
}

TEST_F(Arena, ShowsWhatThereIs) {
  put("a/greedy/1", EpisodeState::completed, 0.6);
  put("a/mine/1", EpisodeState::failed, 0.2);
  put("a/mine/2", EpisodeState::crashed, 0.9);  // of which nothing is known
  write_file(folder / "episodes/a/greedy/1/bound.json",
             R"({"shares": [{"percent": 80, "run_over_least": {"time_s": 9}},
                            {"percent": 90, "run_over_least": {"time_s": 1.5}}]})");
  write_file(folder / "episodes/a/greedy/1/branches.json",
             R"({"decisions": [{"regret": {"cells": 20}, "branches": [{"new_cells": 80},
                {"new_cells": 100}, {"new_cells": null}]}, {"regret": null, "branches": []}]})");
  const Leaderboard board = leaderboard_of(results);
  EXPECT_EQ(board.standings[0].planner, "greedy");
  EXPECT_FALSE(board.standings[0].interval);  // of one scene there is none
  EXPECT_EQ(board.standings[0].time_over_bound_90, 1.5);
  EXPECT_EQ(board.standings[0].bounded, 1U);
  EXPECT_DOUBLE_EQ(*board.standings[0].regret_share, 0.2);
  EXPECT_EQ(board.standings[1].failed, 2U);
  EXPECT_DOUBLE_EQ(board.standings[1].score, 0.05);
  write_arena_page(results, board);
  EXPECT_EQ(read_file(folder / "leaderboard.csv").substr(0, 5), "rank,");
  const std::string page = read_file(folder / "arena.html");
  EXPECT_THAT(page, HasSubstr("9 of 12 episodes missing"));
  EXPECT_THAT(page, HasSubstr("the &lt;reason&gt;"));
  EXPECT_THAT(page, HasSubstr("100 s in a"));
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, Not(HasSubstr("nan")));
  EXPECT_THAT(page, Not(HasSubstr("{{")));
}

TEST_F(Arena, OfOneSceneHasScoresToo) {
  results.study.factors.front().levels.pop_back();
  results.plan = plan_study(results.study);
  results.states.resize(results.plan.size());
  results.measures.resize(results.plan.size());
  put("a/greedy/1", EpisodeState::completed, 0.6);
  put("a/mine/1", EpisodeState::completed, 0.4);
  const Leaderboard board = leaderboard_of(results);
  EXPECT_DOUBLE_EQ(board.standings[0].score, 0.3);
  EXPECT_DOUBLE_EQ(board.standings[1].score, 0.2);
  ASSERT_TRUE(board.standings[1].difference);
  EXPECT_NEAR(board.standings[1].difference->mean, -0.1, 1e-12);
}

TEST_F(Arena, WallTimeIsOnThePageAlone) {
  put("a/greedy/1", EpisodeState::completed, 0.6);
  const std::string before = leaderboard_csv(leaderboard_of(results));
  put("a/greedy/1", EpisodeState::completed, 0.6, {{"wall_time_s", 123.0}});
  EXPECT_EQ(leaderboard_csv(leaderboard_of(results)), before);
  EXPECT_EQ(std::ranges::count(before.substr(0, before.find('\n')), ','), 16);
  EXPECT_EQ(std::ranges::count(before, ','), 16 * 4);
}

TEST_F(Arena, TakesAPlannerMore) {
  const ForeignPlanner planner{"theirs", {"sh", "-c", "exit 0", "null", "5"}, 2.5};
  const Study study = study_with(folder.path(), planner, false);
  const Factor& planners = study.factors[factor_index(study, "planner")];
  ASSERT_EQ(planners.levels.size(), 4U);
  EXPECT_EQ(planners.levels.back().name, "theirs");
  std::size_t theirs = 0;
  for (const PlannedEpisode& episode : plan_study(study)) {
    if (episode.name.find("/theirs/") == std::string::npos) continue;
    ++theirs;
    const auto& choice = std::get<Tabletop>(episode.resolved.task).choice;
    EXPECT_EQ(std::get<ExternalChoice>(choice).command, planner.command);
    EXPECT_EQ(std::get<ExternalChoice>(choice).timeout_s, 2.5);
  }
  EXPECT_EQ(theirs, 4U);
  EXPECT_THROW(study_with(folder.path(), {"mine", {"sh"}}, false), ConfigError);  // taken
  EXPECT_EQ(study_with(folder.path(), {"mine", {"sh"}}, true).factors[1].levels.size(), 3U);
  EXPECT_THROW(study_with(folder.path(), {"new", {"no_such_program_zz"}}, false), ConfigError);
}

TEST_F(Arena, NamesANameThatCannotBe) {
  for (const char* name : {"a/b", "", ".hidden", "two words"}) {
    try {
      study_with(folder.path(), {name, {"sh"}}, false);
      FAIL() << name;
    } catch (const ConfigError& error) {
      EXPECT_EQ(error.what(),
                fmt::format("NAME: '{}' may hold letters, digits and _ . - + only", name));
    }
  }
}

TEST_F(Arena, TriesAPlannerBeforeItEnters) {
  const auto tried = [&](const char* script) {
    const Study study = study_with(folder.path(), {"theirs", {"sh", "-c", script}}, false);
    try_planner(plan_study(study), study, "theirs");
  };
  tried(R"(read hello; echo '{"protocol": "vantage-planner", "version": 1}'; read end)");
  try {
    tried("echo 'no such file' >&2; exit 2");
    FAIL() << "no error";
  } catch (const EpisodeFailed& error) {
    EXPECT_THAT(error.what(), HasSubstr("it ended: exit code 2, after it said: no such file"));
  }
  EXPECT_THROW(tried("echo hello"), EpisodeFailed);
}

TEST_F(Arena, ForgetsWhatAPlannerHasDone) {
  put("a/mine/1", EpisodeState::completed, 0.5);
  put("a/greedy/1", EpisodeState::completed, 0.5);
  forget_episodes(folder.path(), results.study, "mine");
  EXPECT_FALSE(std::filesystem::exists(folder / "episodes/a/mine/1"));
  EXPECT_TRUE(std::filesystem::exists(folder / "episodes/a/greedy/1"));
}

TEST_F(Arena, WithoutABudgetTheLongestOfItsSceneAndSeedCounts) {
  for (PlannedEpisode& planned : results.plan) {
    std::get<Tabletop>(planned.resolved.task).budget.time_s.reset();
  }
  const Json late = {{{"time_s", 20.0}, {"observable_unobserved_cells", 1000}},
                     {{"time_s", 80.0}, {"observable_unobserved_cells", 400}}};
  put("a/greedy/1", EpisodeState::completed, 0.6, {{"scans", late}});
  put("a/mine/1", EpisodeState::completed, 0.5);
  put("a/mine/2", EpisodeState::completed, 0.5);
  const std::vector<EpisodeScore> scores = episode_scores(results);
  ASSERT_EQ(scores.size(), 3U);
  EXPECT_EQ(scores[0].horizon_s, 80.0);
  EXPECT_EQ(scores[0].score, 0.0);
  EXPECT_DOUBLE_EQ(scores[0].seen_share, 0.6);
  EXPECT_EQ(scores[1].horizon_s, 80.0);
  EXPECT_DOUBLE_EQ(scores[1].score, 0.5 * 30.0 / 80.0);
  EXPECT_EQ(scores[2].horizon_s, 50.0);
  EXPECT_EQ(scores[2].score, 0.0);
}

TEST_F(Arena, ItsFiguresAndItsPageAgree) {
  put("a/greedy/1", EpisodeState::completed, 0.6);
  put("a/mine/1", EpisodeState::completed, 0.4);
  const Leaderboard board = leaderboard_of(results);
  const Figure overall = overall_figure(results, board);
  ASSERT_EQ(overall.panels[0].series.size(), 2U);
  const auto& points = overall.panels[0].series[0].points;
  ASSERT_EQ(points.size(), 41U);
  EXPECT_EQ(points[0].x, 0.0);
  EXPECT_DOUBLE_EQ(points[40].x, 100.0);
  EXPECT_EQ(points[19].mean, 0.0);
  EXPECT_DOUBLE_EQ(points[20].mean, 0.6);
  const Figure scenes = scene_figure(results, board);
  ASSERT_EQ(scenes.panels.size(), 2U);
  ASSERT_EQ(scenes.panels[0].series.size(), 2U);
  EXPECT_TRUE(scenes.panels[1].series.empty());
  EXPECT_EQ(scenes.panels[0].series[1].name, "mine");
  EXPECT_EQ(scenes.panels[0].series[1].style, 2U);
  write_arena_page(results, board);
  const std::string page = read_file(folder / "arena.html");
  for (const char* part :
       {"2 scenes", "3 planners", "2 seeds", "--shade:60%\" class=\"best\">0.300<",
        "--shade:0%\">0.200<", "<i style=\"width:30.00%\">", "1 pairs\">-0.100<",
        "<td class=\"dim\">reference</td>", "<td>60.0</td><td>4.0</td><td>1.00</td>",
        "<td>0/1</td><td>250.0</td>", "10 of 12 episodes missing"}) {
    EXPECT_THAT(page, HasSubstr(part));
  }
}

/// Of two scenes: greedy has 0.3 and 0.2, and whoever else what it is given.
TEST_F(Arena, ThePageColoursWhatTheIntervalsLeaveNoDoubtOf) {
  put("a/greedy/1", EpisodeState::completed, 0.6);
  put("b/greedy/1", EpisodeState::completed, 0.4);
  put("b/oracle/2", EpisodeState::completed, 0.4);  // greedy has nothing beside it
  results.study.split = "development";
  const auto page_with = [&](double of_mine_in_a, double of_mine_in_b) {
    put("a/mine/1", EpisodeState::completed, of_mine_in_a);
    put("b/mine/1", EpisodeState::completed, of_mine_in_b);
    write_arena_page(results, leaderboard_of(results));
    return read_file(folder / "arena.html");
  };
  const std::string better = page_with(0.8, 0.8);
  for (const char* part :
       {"<i class=\"whisker\" style=\"left:20.00%;width:10.00%\"></i>",
        "<td class=\"value\">0.250</td><td class=\"dim\">0.200 to 0.300</td>",
        "<td class=\"value\">0.200</td><td class=\"dim\"></td><td>–</td>",
        "<td class=\"good\" title=\"95 %: +0.100 to +0.200, 2 pairs\">+0.150</td>", "100 s in a, b",
        "<span class=\"tag \">split development</span>"}) {
    EXPECT_THAT(better, HasSubstr(part));
  }
  EXPECT_THAT(page_with(0.8, 0.2), HasSubstr("<td title=\"95 %: -0.100 to +0.100, 2 pairs\">"));
  EXPECT_THAT(page_with(0.4, 0.2),
              HasSubstr("<td class=\"bad\" title=\"95 %: -0.100 to -0.100, 2 pairs\">-0.100<"));
}

TEST(StandardArena, HasEveryChoiceInEachScene) {
  const Study study = read_study(VANTAGE_SOURCE_DIR "/assets/studies/arena.yaml");
  const Factor& planners = study.factors[factor_index(study, "planner")];
  std::vector<std::string> levels;
  for (const Level& level : planners.levels) levels.push_back(level.name);
  for (const std::string_view choice : strategy_names<ViewChoice>()) {
    if (choice == ExternalChoice::name) continue;
    EXPECT_THAT(levels, testing::Contains(std::string(choice)));
  }
  for (const char* split : {"development", "report", "six"}) {
    const Study part = read_study(VANTAGE_SOURCE_DIR "/assets/studies/arena.yaml", {}, split);
    EXPECT_EQ(part.factors[factor_index(part, "scene")].levels.size(), 6U) << split;
  }
}

TEST_F(Arena, ThePageTellsThatAllHasRun) {
  for (const PlannedEpisode& planned : results.plan) {
    put(planned.name, EpisodeState::completed, 0.5);
  }
  write_arena_page(results, leaderboard_of(results));
  const std::string page = read_file(folder / "arena.html");
  EXPECT_THAT(page, HasSubstr("<span class=\"tag good\">all 12 episodes run</span>"));
  EXPECT_THAT(page, HasSubstr("No episode failed."));
  EXPECT_THAT(page, Not(HasSubstr("episodes missing")));
  EXPECT_THAT(page, Not(HasSubstr("<th>regret, %</th>")));
}

/// Of episodes without a budget; the bound and the regret are of one of them alone.
TEST_F(Arena, ThePageTellsBudgetsBoundsAndRegrets) {
  for (PlannedEpisode& planned : results.plan) {
    std::get<Tabletop>(planned.resolved.task).budget.time_s.reset();
  }
  const Json late = {{{"time_s", 20.0}, {"observable_unobserved_cells", 1000}},
                     {{"time_s", 80.0}, {"observable_unobserved_cells", 400}}};
  put("a/greedy/1", EpisodeState::completed, 0.6, {{"scans", late}});
  put("b/greedy/1", EpisodeState::completed, 0.5);
  write_file(folder / "episodes/a/greedy/1/bound.json",
             R"({"shares": [{"percent": 90, "run_over_least": {"time_s": 1.5}}]})");
  write_file(folder / "episodes/a/greedy/1/branches.json",
             R"({"decisions": [{"regret": {"cells": 20}, "branches": [{"new_cells": 100}]}]})");
  write_arena_page(results, leaderboard_of(results));
  const std::string page = read_file(folder / "arena.html");
  EXPECT_THAT(page, HasSubstr("50 s in b; 80 s in a"));
  EXPECT_THAT(page, HasSubstr("<th>regret, %</th>"));
  EXPECT_THAT(page, HasSubstr("<td>1.50 <small>(1)</small></td><td>20.0</td></tr>"));
}

TEST_F(Arena, AFileOfAnotherKindIsNamed) {
  put("a/greedy/1", EpisodeState::completed, 0.6);
  write_file(folder / "episodes/a/greedy/1/bound.json", R"({"shares": [null]})");
  try {
    leaderboard_of(results);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("episodes/a/greedy/1: metrics.json, bound.json"));
  }
}

TEST_F(Arena, ASplitThatNamesPlannersTakesOneMore) {
  const std::string plain = read_file(folder / "study.yaml");
  const auto planners_of = [&](const std::string& split, const std::string& name) {
    write_file(folder / "study.yaml", plain + "splits: {few: {" + split + "}}\n");
    const Study study = study_with(folder.path(), {name, {"sh", "-c", "exit 0"}}, true);
    std::vector<std::string> names;
    for (const Level& level : study.factors[factor_index(study, "planner")].levels) {
      names.push_back(level.name);
    }
    return names;
  };
  using testing::ElementsAre;
  EXPECT_THAT(planners_of("planner: [greedy]", "theirs"), ElementsAre("greedy", "theirs"));
  EXPECT_THAT(planners_of("planner: [greedy, mine]", "mine"), ElementsAre("greedy", "mine"));
  EXPECT_THAT(planners_of("scene: [a, b]", "theirs"),
              ElementsAre("greedy", "oracle", "mine", "theirs"));
}

TEST_F(Arena, AGroupOfPlannersIsOfTheKindOfItsFirst) {
  results.study.report.groups.push_back({"taught", {"greedy", "oracle"}});
  results.study.report.reference = "taught";
  put("a/greedy/1", EpisodeState::completed, 0.6);
  const Leaderboard board = leaderboard_of(results);
  ASSERT_EQ(board.standings.size(), 2U);
  EXPECT_EQ(board.standings[0].planner, "taught");
  EXPECT_EQ(board.standings[0].kind, PlannerKind::built_in);
  EXPECT_EQ(board.standings[0].rank, 1);
  EXPECT_EQ(board.standings[1].kind, PlannerKind::foreign);
}

/// The first scan is no decision, and what crashed has seen nothing.
TEST_F(Arena, StandingsAreMeansOfTheirEpisodes) {
  const auto facts = [](double plan_time_s, double path_length_m, int collisions) {
    const Json scans = {
        {{"time_s", 10.0}, {"observable_unobserved_cells", 1000}, {"plan_time_s", 7.0}},
        {{"time_s", 50.0}, {"observable_unobserved_cells", 400}, {"plan_time_s", plan_time_s}}};
    return Json({{"scans", scans}, {"path_length_m", path_length_m}, {"collisions", collisions}});
  };
  put("a/greedy/1", EpisodeState::completed, 0.6, facts(0.1, 4.0, 0));
  put("a/greedy/2", EpisodeState::completed, 0.6, facts(0.9, 7.0, 3));
  put("b/greedy/1", EpisodeState::crashed, 0.6);
  write_file(folder / "episodes/b/greedy/1/failure.json", R"({"reason": "no table"})");
  put("b/greedy/2", EpisodeState::completed, 0.6, facts(0.2, 10.0, 3));
  const Leaderboard board = leaderboard_of(results);
  const Standing& greedy = board.standings[0];
  EXPECT_EQ(greedy.planner, "greedy");
  EXPECT_EQ(greedy.level, 0U);
  EXPECT_EQ(greedy.episodes, 4U);
  EXPECT_EQ(greedy.failed, 1U);
  EXPECT_DOUBLE_EQ(greedy.score, 3.0 * 0.3 / 4.0);
  EXPECT_DOUBLE_EQ(greedy.seen_share, 3.0 * 0.6 / 4.0);
  EXPECT_DOUBLE_EQ(*greedy.path_length_m, 7.0);
  EXPECT_DOUBLE_EQ(*greedy.collisions, 2.0);
  EXPECT_DOUBLE_EQ(*greedy.decision_s, 0.2);
  EXPECT_FALSE(greedy.difference) << "to itself";
  const EpisodeScore& crashed = board.scores[2];
  EXPECT_EQ(crashed.reason, "crashed: no table");
  EXPECT_EQ(crashed.score, 0.0);
  EXPECT_FALSE(crashed.path_length_m);
}

TEST_F(Arena, BandsOfASceneAreOfItsSeedsAndThoseOfAllOfScenes) {
  put("a/greedy/1", EpisodeState::completed, 0.6);
  put("a/greedy/2", EpisodeState::completed, 0.4);
  put("b/greedy/1", EpisodeState::completed, 0.5);
  const Figure overall = overall_figure(results, leaderboard_of(results));
  EXPECT_THAT(overall.note, HasSubstr("levels of scene resampled"));
  EXPECT_EQ(overall.x_label, "budget of time, %");
  const FigurePoint& of_all = overall.panels[0].series[0].points[40];
  EXPECT_EQ(of_all.count, 3U);
  EXPECT_EQ(of_all.clusters, 2U);
  EXPECT_DOUBLE_EQ(of_all.mean, 0.5);
  const Figure scenes = scene_figure(results, leaderboard_of(results));
  EXPECT_EQ(scenes.panels[0].title, "a");
  const FigurePoint& of_a = scenes.panels[0].series[0].points[40];
  EXPECT_DOUBLE_EQ(of_a.x, 100.0);
  EXPECT_EQ(of_a.count, 2U);
  EXPECT_EQ(of_a.clusters, 2U);
  EXPECT_EQ(scenes.panels[1].series[0].points[40].count, 1U);
  results.study.report.cluster.clear();
  const Figure by_pairs = overall_figure(results, leaderboard_of(results));
  EXPECT_THAT(by_pairs.note, HasSubstr("pairs resampled"));
  EXPECT_EQ(by_pairs.panels[0].series[0].points[40].clusters, 3U);
}

TEST_F(Arena, TheComparisonSaysWhatItIsOf) {
  put("a/greedy/1", EpisodeState::completed, 0.6);
  const Comparison comparison = leaderboard_of(results).comparison;
  EXPECT_EQ(comparison.name, "score");
  EXPECT_EQ(comparison.reference, "greedy");
  EXPECT_EQ(comparison.better, Better::higher);
  EXPECT_EQ(comparison.cluster, "scene");
  results.study.report.cluster.clear();
  EXPECT_EQ(leaderboard_of(results).comparison.cluster, "");
}

/// Of an episode that never saw 90 %, of one without a least time, and of one with no object at
/// all.
TEST_F(Arena, WhatDidNotGetToABoundHasNoTimeOverIt) {
  put("a/greedy/1", EpisodeState::completed, 0.6);
  for (const char* bound :
       {R"({"shares": [{"percent": 90, "run_over_least": {"time_s": null}}]})",
        R"({"shares": [{"percent": 90, "run_over_least": null}]})", R"({"shares": []})", "[1]"}) {
    write_file(folder / "episodes/a/greedy/1/bound.json", bound);
    const Standing greedy = leaderboard_of(results).standings[0];
    EXPECT_FALSE(greedy.time_over_bound_90) << bound;
    EXPECT_EQ(greedy.bounded, 0U) << bound;
  }
}

/// Where every view shows nothing, or nothing was reckoned, nothing was given away.
TEST_F(Arena, RegretIsTheMeanOverTheDecisionsThatHaveOne) {
  put("a/greedy/1", EpisodeState::completed, 0.6);
  const auto regret_of = [&](const std::string& decisions) {
    write_file(folder / "episodes/a/greedy/1/branches.json",
               R"({"decisions": [)" + decisions + "]}");
    return leaderboard_of(results).standings[0].regret_share;
  };
  const std::string none = R"({"regret": {"cells": 0}, "branches": [{"new_cells": 0}]},
                              {"regret": null, "branches": [{"new_cells": 50}]})";
  EXPECT_FALSE(regret_of(none));
  EXPECT_DOUBLE_EQ(regret_of(R"({"regret": {"cells": 20}, "branches": [{"new_cells": 100}]},
                   {"regret": {"cells": 5}, "branches": [{"new_cells": 5}, {"new_cells": 10}]},)" +
                             none)
                       .value(),
                   0.35);
}

TEST_F(Arena, OfNoScanAndOfNothingToSeeNothingIsSeen) {
  put("a/greedy/1", EpisodeState::failed, 0.6, {{"scans", Json::array()}});
  put("a/mine/1", EpisodeState::completed, 0.6, {{"observable_cells", 0}});
  const std::vector<EpisodeScore> scores = episode_scores(results);
  ASSERT_EQ(scores.size(), 2U);
  for (const EpisodeScore& score : scores) {
    EXPECT_EQ(score.seen_share, 0.0);
    EXPECT_EQ(score.score, 0.0);
    EXPECT_EQ(score.horizon_s, 100.0);
  }
  EXPECT_TRUE(scores[0].steps.empty());
  EXPECT_EQ(scores[0].reason, "the <reason>");
  EXPECT_EQ(scores[1].reason, "") << "it was completed";
}

}  // namespace
}  // namespace vantage
