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

/// The first episode tells how long the second may take.
TEST_F(CommandLine, ASweepTellsHowMuchTimeIsLeft) {
  file("two.yaml", kStudy);
  const Result result = vantage("sweep run two.yaml --out study --jobs 1");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_THAT(result.output,
              testing::ContainsRegex("50 % 1 of 2 episodes, about [1-9][0-9]* s left; a"));
  EXPECT_THAT(result.output, HasSubstr("100 % 2 of 2 episodes, about 0 s left; b"));
}

/// The second episode would take far longer than the first.
TEST_F(CommandLine, AnInterruptedSweepCollectsWhatThereIs) {
  file("two.yaml", R"(episode: assets/episodes/tabletop.yaml
set: {laser.scan_duration_s: 1, map.cells: [9, 9, 5]}
factors: {length: {short: {scans: 1}, long: {scans: 900}}}
splits: {all: {length: [short, long]}}
)");
  const Result result = interrupted("sweep run two.yaml --out dir --jobs 1",
                                    "[ -f dir/episodes/short/metrics.json ]", "TERM");
  EXPECT_EQ(result.exit_code, 143);
  EXPECT_THAT(result.output, HasSubstr("1 completed"));
  EXPECT_THAT(read_file(folder_ / "dir/results.csv"), HasSubstr("\nshort,short,completed,"));
  const Result status = vantage("sweep status two.yaml --out dir --split all --json");
  EXPECT_EQ(json::parse(status.output)["completed"], 1);
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
  const fs::path episodes = folder_ / "arena/episodes/few";
  file("arena/episodes/few/greedy/1/bound.json", "{}");
  fs::remove(episodes / "random/1/bound.json");
  ASSERT_EQ(vantage("arena run -q arena --bounds").exit_code, 0);
  EXPECT_TRUE(fs::exists(episodes / "random/1/bound.json"));
  EXPECT_EQ(read_file(episodes / "greedy/1/bound.json"), "{}") << "it had one";
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
  const Result told =
      vantage("arena run two.yaml --out arena -q --json --jobs 1 --set threads=3 2>errors");
  ASSERT_EQ(told.exit_code, 0) << told.output;
  const json state = json::parse(told.output, nullptr, false);
  ASSERT_TRUE(state.is_object()) << told.output;
  EXPECT_EQ(state["completed"], 2);
  EXPECT_EQ(state["page"], "arena/arena.html");
  for (const char* made : {"arena.html", "leaderboard.csv", "results.csv"}) {
    EXPECT_TRUE(fs::exists(folder_ / "arena" / made)) << made;
  }
  EXPECT_THAT(read_file(folder_ / "arena/episodes/a/config.yaml"), HasSubstr("\nthreads: 1\n"))
      << "so that times of decisions can be compared";
  EXPECT_THAT(vantage("arena page arena -q").output, HasSubstr("page arena/arena.html\n"));
}

/// Programs that stand in for Slurm's: ids rise from 41, and the queue is what a file says.
class SlurmStandIns : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    file("two.yaml", kStudy);
    const auto program = [&](const std::string& name, const std::string& text) {
      fs::permissions(file(name, "#!/bin/sh\n" + text), fs::perms::owner_all);
    };
    program("sbatch",
            "[ \"$1\" != --version ] || exit 0\nn=$(cat next 2>/dev/null || echo 41)\n"
            "echo $((n + 1)) >next\necho $n\n");
    program("squeue",
            "[ ! -e silent ] || { echo no contact >&2; exit 1; }\ncat queue 2>/dev/null || true\n");
    program("scancel", "true\n");
  }
  Result sweep(const std::string& arguments, const std::string& environment = {}) {
    return shell("cd '" + folder_.string() + "' && PATH=\"$PWD:$PATH\" " + environment +
                 " " VANTAGE_BINARY " sweep " + arguments);
  }
};

TEST_F(SlurmStandIns, ASubmissionIsTold) {
  const Result told = sweep("submit two.yaml --out dir --json 2>/dev/null");
  EXPECT_EQ(told.exit_code, 0);
  EXPECT_EQ(json::parse(told.output, nullptr, false), json({{"directory", "dir"},
                                                            {"episodes", 2},
                                                            {"tasks", 2},
                                                            {"array", "41"},
                                                            {"collect", "42"}}));
  EXPECT_EQ(sweep("submit two.yaml --out dir --array 1 2>/dev/null").output,
            "dir: 2 episodes by 1 tasks, array 43; job 44 collects\nvantage sweep status dir\n");
  file("many.yaml", "episode: assets/episodes/tabletop.yaml\nseeds: 1..20\n");
  const json many = json::parse(sweep("submit many.yaml --out many --json 2>/dev/null").output);
  EXPECT_EQ(many["episodes"], 20);
  EXPECT_EQ(many["tasks"], 16) << "where nothing else is said";
}

TEST_F(SlurmStandIns, WhatIsUnderWayIsNotSubmittedAgain) {
  ASSERT_EQ(sweep("submit two.yaml --out dir").exit_code, 0);
  file("queue", "41|0|RUNNING|None|0|n1|\n41|1|PENDING|None|0||\n");
  expect_error(sweep("submit two.yaml --out dir"), 2,
               {"--out dir: is submitted already: array 41: 1 running, 1 queued; collect 42: 1 "
                "ended; vantage sweep status dir shows it, vantage sweep cancel dir ends it"});
  const json status = json::parse(sweep("status dir --json 2>/dev/null").output);
  EXPECT_EQ(status["slurm"]["submissions"].size(), 1U);
  EXPECT_EQ(json::parse(sweep("cancel dir --json 2>/dev/null").output),
            json({{"cancelled", json::array({"42", "41"})}}));
  file("silent", "");
  expect_error(sweep("submit two.yaml --out dir"), 2,
               {"--out dir: was submitted before, and Slurm does not answer: no contact"});
  fs::remove(folder_ / "silent");
  file("queue", "");
  EXPECT_EQ(sweep("cancel dir").output, "dir: nothing is queued or running\n");
  EXPECT_EQ(sweep("submit two.yaml --out dir").exit_code, 0);
}

TEST_F(SlurmStandIns, AWorkerRunsWhatIsLeft) {
  ASSERT_EQ(sweep("submit two.yaml --out dir -q").exit_code, 0);
  const Result first = sweep("work dir");
  EXPECT_EQ(first.exit_code, 0) << first.output;
  EXPECT_THAT(first.output, HasSubstr("2 episodes run, 2 completed\n"));
  const Result second = sweep("work dir");
  EXPECT_EQ(second.exit_code, 0) << second.output;
  EXPECT_THAT(second.output, HasSubstr("0 episodes run, 0 completed\n"));
  EXPECT_EQ(json::parse(sweep("work dir --json 2>/dev/null").output),
            json({{"run", 0}, {"completed", 0}}));
  EXPECT_FALSE(fs::exists(folder_ / "dir/results.csv")) << "a worker does not collect";
  EXPECT_EQ(sweep("submit two.yaml --out dir 2>/dev/null").output,
            "dir: every episode has a result; nothing is submitted. vantage sweep collect dir "
            "merges them\n");
  EXPECT_EQ(read_file(folder_ / "next"), "43\n") << "of the first array and its collection";
  EXPECT_EQ(sweep("status dir").exit_code, 0);
}

/// A task of Slurm comes again for a reason; whoever else works leaves it as it is.
TEST_F(SlurmStandIns, WhatCrashedIsTriedAgainByATaskOfSlurm) {
  const std::string bare = file(
      "bare.xml", "<mujoco><worldbody><geom type='plane' size='5 5 .1'/></worldbody></mujoco>");
  fs::create_directories(folder_ / "dir");
  file("dir/study.yaml",
       "episode: assets/episodes/tabletop.yaml\nset: {scene: " + bare + "}\nseeds: [1]\n");
  const auto work = [&](const std::string& environment, int exit_code, const char* told) {
    const Result result = sweep("work dir", environment);
    EXPECT_EQ(result.exit_code, exit_code) << result.output;
    EXPECT_THAT(result.output, HasSubstr(told));
  };
  work("", 1, "1 episodes run, 0 completed\n");
  work("", 0, "0 episodes run, 0 completed\n");
  work("SLURM_JOB_ID=60", 1, "1 episodes run, 0 completed\n");
}

/// The first of its two episodes is there.
TEST_F(CommandLine, AStudyOfWhichAPartIsThere) {
  file("two.yaml", kStudy);
  EXPECT_EQ(vantage("sweep plan two.yaml").output, "a\nb\n");
  EXPECT_EQ(vantage("sweep plan two.yaml --shard 2/2").output, "b\n");
  EXPECT_EQ(json::parse(vantage("sweep status two.yaml --json").output)["directory"], "out/two");
  ASSERT_EQ(vantage("sweep run two.yaml --out study --shard 1/2 -q").exit_code, 0);
  EXPECT_EQ(vantage("sweep plan study").output, "b\n");
  EXPECT_EQ(json::parse(vantage("sweep plan study --json").output),
            json({{"episodes", json::array({"b"})}}));
  EXPECT_EQ(vantage("sweep plan study --set seed=2").output, "a\nb\n") << "those are others";
  const Result status = vantage("sweep status study --json");
  EXPECT_EQ(status.exit_code, 1);
  const json state = json::parse(status.output);
  EXPECT_EQ(state["episodes"], 2);
  EXPECT_EQ(state["completed"], 1);
  EXPECT_EQ(state["missing"], 1);
  EXPECT_FALSE(state.contains("slurm")) << "nothing was submitted";
  EXPECT_EQ(json::parse(vantage("sweep status two.yaml --out study --json").output), state);
  const Result collected = vantage("sweep collect study --json");
  EXPECT_EQ(collected.exit_code, 1);
  EXPECT_EQ(json::parse(collected.output), state);
  EXPECT_THAT(vantage("sweep collect study 2>/dev/null").output, testing::StartsWith("# two\n"));
  expect_error(vantage("sweep plan study --out other"), 2, {"--out: study is a study's folder"});
  EXPECT_EQ(json::parse(vantage("report study --json -q").output),
            json({{"report", "study/report.html"}}));
  EXPECT_THAT(read_file(folder_ / "study/report.html"), HasSubstr("<svg"));
}

TEST_F(CommandLine, ASplitHasAFolderOfItsOwn) {
  const std::string study =
      "episode: assets/episodes/tabletop.yaml\n"
      "factors: {start: {a: {robot.start_view: 0}, b: {robot.start_view: 5}}}\n"
      "splits: {one: {start: [a]}, other: {start: [b]}}\n";
  const auto directory = [&] {
    return json::parse(vantage("sweep status s.yaml --json").output)["directory"];
  };
  file("s.yaml", study);
  EXPECT_EQ(directory(), "out/s_one");
  EXPECT_EQ(vantage("sweep plan s.yaml").output, "a\n");
  EXPECT_EQ(vantage("sweep plan s.yaml --split other").output, "b\n");
  file("s.yaml", study + "split: other\n");
  EXPECT_EQ(directory(), "out/s_other");
  fs::create_directories(folder_ / "study");
  file("study/study.yaml", study + "split: other\n");
  expect_error(vantage("sweep collect study --split one"), 2,
               {"--split one: study holds split 'other'"});
  EXPECT_FALSE(fs::exists(folder_ / "study/results.csv"));
  EXPECT_EQ(vantage("sweep collect study --split other -q").exit_code, 1) << "nothing was run";
}

TEST_F(CommandLine, AnArenaIsOfPlannersOnAMap) {
  file("r.yaml", "episode: assets/episodes/recognition.yaml\nseeds: [1]\n");
  expect_error(vantage("arena run r.yaml --out arena -q"), 2, {"r.yaml: 1: its task chooses no"});
  EXPECT_FALSE(fs::exists(folder_ / "arena"));
  fs::create_directories(folder_ / "study");
  file("study/study.yaml", kStudy);
  expect_error(vantage("arena run study --out arena -q"), 2, {"--out: study is an arena's folder"});
}

TEST_F(CommandLine, WithoutSlurmNothingIsSubmittedOrCancelled) {
  file("two.yaml", kStudy);
  fs::create_directories(folder_ / "study/slurm");
  file("study/study.yaml", kStudy);
  file("study/slurm/41.json", R"({"array": "41", "collect": "42", "tasks": 2})");
  for (const char* command : {"submit two.yaml --out dir", "cancel study"}) {
    const Result told =
        shell("cd '" + folder_.string() + "' && PATH=/nowhere " VANTAGE_BINARY " sweep " + command);
    expect_error(told, 2, {"sbatch"});
  }
  EXPECT_FALSE(fs::exists(folder_ / "dir"));
}

TEST_F(SlurmStandIns, WhatCannotBeSubmittedLeavesNothing) {
  expect_error(sweep("submit two.yaml --out dir --sbatch-arg=--array=3"), 2,
               {"--sbatch-arg --array=3: submit sets --array itself"});
  file("wrong.yaml",
       "episode: assets/episodes/tabletop.yaml\nfactors: {n: {a: {scans: 1}, b: {scans: 0}}}\n");
  expect_error(sweep("submit wrong.yaml --out dir"), 2, {"scans"});
  EXPECT_FALSE(fs::exists(folder_ / "dir"));
}

/// Hours of scanning: both episodes are at it, or the first one alone has gone on and on.
TEST_F(CommandLine, AWorkerRunsAsManyEpisodesAtATimeAsItIsToldTo) {
  const auto begun_by = [&](const std::string& folder, const std::string& option) {
    fs::create_directories(folder_ / folder);
    file(folder + "/study.yaml", R"(episode: assets/episodes/tabletop.yaml
set: {scans: 1, laser.scan_duration_s: 3600, map.cells: [9, 9, 5]}
factors: {start: {a: {robot.start_view: 0}, b: {robot.start_view: 5}}}
)");
    const std::string states = "$(find " + folder + "/attempts -name states.part.bin";
    const Result ended = interrupted(
        fmt::format("sweep work {} --keep-states {}", folder, option),
        fmt::format("[ {0} | wc -l) -ge 2 ] || [ -n \"{0} -size +20M)\" ]", states), "TERM");
    EXPECT_EQ(ended.exit_code, 143) << ended.output;
    EXPECT_THAT(ended.output, HasSubstr("2 episodes run, 0 completed\n")) << folder;
  };
  begun_by("own", "--jobs 2");
  ::setenv("SLURM_JOB_ID", "60", 1);
  ::setenv("SLURM_CPUS_PER_TASK", "1", 1);
  begun_by("said", "--jobs 2");
  ::setenv("SLURM_CPUS_PER_TASK", "2", 1);
  begun_by("slurm", "");
  ::unsetenv("SLURM_CPUS_PER_TASK");
  ::unsetenv("SLURM_JOB_ID");
}

TEST_F(CommandLine, AnArenaIsMadeOfTheFolderOfAStudyAlone) {
  fs::create_directories(folder_ / "empty");
  fs::create_directories(folder_ / "flight");
  file("flight/study.yaml", "episode: assets/episodes/recognition.yaml\nseeds: [1]\n");
  for (const char* command : {"arena run empty", "arena page empty", "arena add empty m -- sh"}) {
    expect_error(vantage(command), 3, {"empty: not the folder of a study, it has no study.yaml"});
  }
  expect_error(vantage("arena page flight -q"), 2, {"flight: 1: its task chooses no views"});
  EXPECT_FALSE(fs::exists(folder_ / "flight/arena.html"));
}

}  // namespace
}  // namespace vantage
