// `vantage sweep`, `compare` and `arena` as a user meets them.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command_line.hpp"
#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace {

using nlohmann::json;
using testing::Not;

/// Two episodes of a second each.
constexpr auto kStudy = R"(episode: assets/episodes/tabletop.yaml
set: {scans: 1, laser.scan_duration_s: 1, map.cells: [9, 9, 5]}
factors: {start: {a: {robot.start_view: 0}, b: {robot.start_view: 5}}}
report: {compare: start, reference: a, tables: [area], curves: [share_left]}
)";

TEST_F(CommandLine, ASweepKeepsWholeRunsIfToldTo) {
  file("two.yaml", kStudy);
  for (const bool whole : {false, true}) {
    const std::string flag = whole ? "--keep-states " : "";
    const Result result = vantage("sweep run two.yaml --out study --overwrite -q " + flag);
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_THAT(result.output, Not(testing::StartsWith("{")));
    EXPECT_TRUE(fs::exists(folder_ / "study/episodes/b/metrics.json"));
    EXPECT_EQ(fs::exists(folder_ / "study/episodes/b/states.bin"), whole);
    fs::remove_all(folder_ / "study");
  }
}

TEST_F(CommandLine, WhatWasNotSubmittedCannotBeCancelled) {
  fs::create_directories(folder_ / "study");
  file("study/study.yaml", kStudy);
  expect_error(vantage("sweep cancel study"), 2, {"study: nothing was submitted from it"});
}

TEST_F(CommandLine, RunsAreComparedToTheLastDigitUnlessToldOtherwise) {
  for (const char* run : {"--out first", "--out second --set seed=2"}) {
    ASSERT_EQ(vantage(std::string("run ") + kShort + run).exit_code, 0);
  }
  const Result few = vantage("compare first second");
  EXPECT_EQ(few.exit_code, 1);
  EXPECT_THAT(few.output, HasSubstr("values differ beyond the tolerance; --all lists them\n"));
  const Result all = vantage("compare first second --all");
  EXPECT_EQ(all.exit_code, 1);
  EXPECT_THAT(all.output, HasSubstr("values differ beyond the tolerance\n"));
  EXPECT_EQ(json::parse(vantage("compare first second --json").output)["tolerance"], 0.0);
  EXPECT_EQ(vantage("compare first first").exit_code, 0);
}

constexpr const char* kSmallArena = R"(episode: assets/episodes/tabletop.yaml
set: {scans: 3, budget.time_s: 60, laser.scan_duration_s: 1, map.cells: [33, 33, 17],
      metrics.predictors: [adaptive]}
factors:
  scene: {few: {scene: models/scenes/tabletop_4/scene.xml}}
  planner: {greedy: {choice: greedy}, random: {choice: random}}
seeds: [1]
report: {compare: planner, reference: greedy, panels: scene}
)";

/// A planner that writes a line whenever it is started: to be tried, and for every episode.
TEST_F(CommandLine, AReplacedPlannersEpisodesAreRunAgain) {
  file("small.yaml", kSmallArena);
  const Result made = vantage("arena run small.yaml --out arena -q");
  ASSERT_EQ(made.exit_code, 0) << made.output;
  const auto planner =
      file("mine.sh", fmt::format("echo x >> '{}'; read hello; echo '{}'; read request; exit 9\n",
                                  (folder_ / "started").string(),
                                  R"({"protocol": "vantage-planner", "version": 1})"));
  const std::string command = " -- sh " + planner;
  EXPECT_EQ(vantage("arena add arena mine -q" + command).exit_code, 1);
  const std::string once = read_file(folder_ / "started");
  ASSERT_GT(once.size(), 2U) << "tried, and for an episode";
  EXPECT_EQ(vantage("arena add arena mine -q --overwrite" + command).exit_code, 1);
  EXPECT_EQ(read_file(folder_ / "started"), once + once);
}

TEST_F(CommandLine, AnArenaHasBoundsIfAskedForThem) {
  file("small.yaml", kSmallArena);
  for (const std::string arguments : {"small.yaml --out arena", "arena --bounds"}) {
    const Result result = vantage("arena run -q " + arguments);
    ASSERT_EQ(result.exit_code, 0) << result.output;
    for (const char* planner : {"greedy", "random"}) {
      EXPECT_EQ(fs::exists(folder_ / "arena/episodes/few" / planner / "1/bound.json"),
                arguments.ends_with("--bounds"))
          << planner << ": " << arguments << "\n"
          << result.output;
    }
  }
}

/// By programs that stand in for Slurm's.
TEST_F(CommandLine, CancelEndsWhatIsOpenIfSlurmAnswers) {
  fs::create_directories(folder_ / "study/slurm");
  file("study/study.yaml", kStudy);
  file("study/slurm/41.json", R"({"array": "41", "collect": "42", "tasks": 2})");
  const auto program = [&](const std::string& name, const std::string& text) {
    fs::permissions(file(name, "#!/bin/sh\n" + text), fs::perms::owner_all);
  };
  program("sbatch", "exit 0\n");
  program("squeue",
          "[ ! -e silent ] || { echo no contact >&2; exit 1; }\necho '41|0|RUNNING|None|0|n1|'\n");
  program("scancel", "echo \"$@\" >>cancelled\n");
  const auto cancel = [&] {
    return shell("cd '" + folder_.string() +
                 "' && PATH=\"$PWD:$PATH\" " VANTAGE_BINARY " sweep cancel study");
  };
  file("silent", "");
  expect_error(cancel(), 2, {"study: Slurm does not answer: no contact"});
  EXPECT_FALSE(fs::exists(folder_ / "cancelled"));
  fs::remove(folder_ / "silent");
  EXPECT_EQ(cancel().output, "study: cancelled 42 41; results so far are kept\n");
  EXPECT_EQ(read_file(folder_ / "cancelled"), "42 41\n");
}

TEST_F(CommandLine, NoPlannerEntersAnArenaWithoutACommand) {
  const Result result = vantage("arena add nowhere mine");
  EXPECT_EQ(result.exit_code, 2) << result.output;
  EXPECT_THAT(result.output, HasSubstr("command"));
}

TEST_F(CommandLine, AnArenaIsToldAsJsonIfAskedFor) {
  file("two.yaml", kStudy);
  const Result told = vantage("arena run two.yaml --out arena -q --json 2>errors");
  ASSERT_EQ(told.exit_code, 0) << told.output;
  const json state = json::parse(told.output, nullptr, false);
  ASSERT_TRUE(state.is_object()) << told.output;
  EXPECT_EQ(state["completed"], 2);
  EXPECT_EQ(state["page"], "arena/arena.html");
  EXPECT_THAT(vantage("arena page arena -q").output, HasSubstr("page arena/arena.html\n"));
}

}  // namespace
}  // namespace vantage
