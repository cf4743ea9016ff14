// `sweep submit`, `status`, `cancel` and `work` against programs that stand in for Slurm's; those
// of tests/cluster are run by the real ones.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/shell.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using support::shell;
using support::ShellResult;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kSmokeStudy = VANTAGE_SOURCE_DIR "/assets/studies/smoke.yaml";

class Submit : public testing::Test {
 protected:
  void SetUp() override {
    program("sbatch",
            "[ \"$1\" != --version ] || exit 0\necho sbatch \"$@\" >>$here/calls\ncase \" $* \" in "
            "*--partition=nowhere*)\n  echo 'sbatch: error: invalid partition specified: nowhere' "
            ">&2; exit 1 ;;\n*--dependency*) [ ! -e $here/no_collect ] || { echo full >&2; exit 1; "
            "} ;; esac\nn=$(cat $here/next 2>/dev/null || echo 41); echo $((n + 1)) "
            ">$here/next\necho \"$n;loopback\"\n");
    program("squeue",
            "echo squeue \"$@\" >>$here/calls\n[ ! -e $here/silent ] || { cat $here/silent >&2; "
            "exit 1; }\ncat $here/queue 2>/dev/null || true\n");
    program("scancel", "echo scancel \"$@\" >>$here/calls\n");
  }

  void program(const std::string& name, const std::string& text) {
    const fs::path file = folder_ / name;
    std::ofstream(file) << "#!/bin/sh\nhere=" << folder_.path().string() << "\n" << text;
    fs::permissions(file, fs::perms::owner_all);
  }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }
  ShellResult vantage(const std::string& arguments, const std::string& environment = {}) {
    return shell("cd '" + folder_.path().string() + "' && PATH='" + folder_.path().string() +
                 "':/usr/bin:/bin " + environment + " " VANTAGE_BINARY " sweep " + arguments);
  }
  ShellResult submit(const std::string& options = {}) {
    return vantage(std::string("submit ") + kSmokeStudy + " --out dir " + options);
  }
  std::string calls() {
    const fs::path file = folder_ / "calls";
    return fs::exists(file) ? read_file(file) : "";
  }
  [[nodiscard]] std::string directory() const { return (folder_ / "dir").string(); }

  support::TemporaryDirectory folder_;
};

TEST_F(Submit, AnArrayAndAJobThatCollects) {
  const ShellResult result =
      submit("--array 3 --partition fast --time 2:00 --sbatch-arg --mem=2G --sbatch-arg=-Aus");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("4 episodes by 3 tasks, array 41; job 42 collects"));
  const std::string common = "--requeue --open-mode=append --output=" + directory() + "/slurm/";
  const std::string given = " --partition=fast --time=2:00 --mem=2G -Aus ";
  EXPECT_EQ(calls(), "sbatch --parsable --job-name=vantage-sweep " + common + "%A_%a.txt" + given +
                         "--array=0-2 " + directory() + "/slurm/work.sh\n" +
                         "sbatch --parsable --job-name=vantage-collect " + common +
                         "%j_collect.txt" + given + "--dependency=afterany:41 " + directory() +
                         "/slurm/collect.sh\n");
  EXPECT_THAT(read_file(folder_ / "dir/slurm/work.sh"),
              HasSubstr("' sweep work '" + directory() + "'\n"));
  EXPECT_THAT(read_file(folder_ / "dir/slurm/collect.sh"),
              HasSubstr("' sweep collect '" + directory() + "'\n"));
  EXPECT_THAT(read_file(folder_ / "dir/study.yaml"), HasSubstr("factors"));
}

TEST_F(Submit, WhatCannotBeRecordedIsTakenBack) {
  program("sbatch",
          "[ \"$1\" != --version ] || exit 0\necho sbatch \"$@\" >>$here/calls\n"
          "mkdir -p $here/dir/slurm/41.json/taken\necho '41;loopback'\n");
  const ShellResult result = submit();
  EXPECT_EQ(result.exit_code, 5) << result.output;
  EXPECT_THAT(result.output, HasSubstr("41.json"));
  EXPECT_THAT(calls(), HasSubstr("scancel 41"));
  EXPECT_THAT(calls(), Not(HasSubstr("vantage-collect"))) << "nothing more is queued";
}

TEST_F(Submit, NoMoreTasksThanEpisodes) {
  EXPECT_EQ(submit("--json").exit_code, 0);
  EXPECT_THAT(calls(), HasSubstr("--array=0-3 "));
}

TEST_F(Submit, NamesOfFoldersAreTakenAsTheyAre) {
  const ShellResult result =
      vantage(std::string("submit ") + kSmokeStudy + " --out \"it's 5% done\" --keep-states");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_THAT(calls(), HasSubstr("/it's 5%% done/slurm/%A_%a.txt"));
  const fs::path script = folder_ / "it's 5% done/slurm/work.sh";
  EXPECT_THAT(read_file(script), HasSubstr("5% done' --keep-states\n"));
  EXPECT_EQ(shell("sh -n \"" + script.string() + "\"").output, "");
}

TEST_F(Submit, WhatIsUnderWayIsNotSubmittedAgain) {
  ASSERT_EQ(submit().exit_code, 0);
  write("queue",
        "41|0|RUNNING|None|0|n1|\n41|1|PENDING|Priority|0||\n42|N/A|PENDING|Dependency|0||\n");
  const ShellResult twice = submit();
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_THAT(
      twice.output,
      HasSubstr("--out dir: is submitted already: array 41: 1 running, 1 queued (1 Priority)"));
  EXPECT_THAT(twice.output, HasSubstr("vantage sweep cancel dir"));
  write("silent", "Unable to contact slurm controller");
  EXPECT_THAT(submit().output, HasSubstr("Slurm does not answer: Unable to contact"));
  EXPECT_THAT(calls(), Not(HasSubstr("afterany:43")));
  fs::remove(folder_ / "silent");
  write("queue", "");
  EXPECT_EQ(submit().exit_code, 0) << "it is over";
  EXPECT_THAT(calls(), HasSubstr("afterany:43"));
}

TEST_F(Submit, ErrorsOfUse) {
  const auto expect = [&](const ShellResult& result, int code, const std::string& part) {
    EXPECT_EQ(result.exit_code, code) << result.output;
    EXPECT_THAT(result.output, HasSubstr(part));
  };
  expect(submit("--array 0"), 2, "--array: Value 0 not in range");
  expect(submit("--array many"), 2, "--array");
  expect(submit("--time ''"), 2, "--time: is empty");
  expect(submit("--sbatch-arg --array=3"), 2, "--sbatch-arg --array=3: submit sets --array itself");
  expect(submit("--sbatch-arg -a3"), 2, "--sbatch-arg -a3: submit sets -a3 itself");
  for (const std::string other : {"--clusters=far", "-Mfar"}) {
    expect(submit("--sbatch-arg " + other), 2, other + ": jobs of another cluster");
  }
  expect(submit("--sbatch-arg mem"), 2, "--sbatch-arg mem: expected an option of sbatch");
  expect(submit("--set nonsense=1"), 2, "nonsense");
  expect(vantage("submit " VANTAGE_SOURCE_DIR "/assets/episodes/tabletop.yaml --out dir"), 2,
         "this is an episode");
  expect(vantage("submit nowhere.yaml --out dir"), 3, "nowhere.yaml");
  EXPECT_FALSE(fs::exists(folder_ / "dir"));
  EXPECT_EQ(calls(), "");
  expect(submit("--partition nowhere"), 2, "invalid partition specified: nowhere");
  expect(vantage("cancel dir"), 2, "dir: nothing was submitted from it");
  expect(vantage("cancel nowhere"), 3, "nowhere");
  expect(vantage(std::string("cancel ") + kSmokeStudy), 2, "expected the folder of a study");
  write("dir/study.yaml", "title: another\n");
  expect(submit(), 2, "--out dir: holds another study");
  fs::remove(folder_ / "sbatch");
  const ShellResult without =
      shell("PATH=" + folder_.path().string() + " " VANTAGE_BINARY " sweep submit " +
            std::string(kSmokeStudy) + " --out " + (folder_ / "other").string());
  expect(without, 2, "sbatch: no such program");
  EXPECT_THAT(without.output, HasSubstr("apt-get install slurm-client"));
  EXPECT_FALSE(fs::exists(folder_ / "other"));
}

TEST_F(Submit, AnArrayThatNothingWouldCollectIsCancelled) {
  write("no_collect", "");
  const ShellResult result = submit();
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.output, HasSubstr("full"));
  EXPECT_THAT(calls(), HasSubstr("scancel 41\n"));
  EXPECT_EQ(read_file(folder_ / "dir/slurm/41.json"),
            "{\n  \"array\": \"41\",\n  \"collect\": \"\",\n  \"tasks\": 4\n}\n");
}

TEST_F(Submit, StatusSaysWhatSlurmAndTheFolderSay) {
  ASSERT_EQ(submit().exit_code, 0);
  fs::create_directories(folder_ / "dir/attempts/start_0/adaptive");
  write("dir/attempts/start_0/adaptive/2.json",
        R"({"host": "n1", "machine": "n1 x", "pid": 5, "started": "9", "released": false,
            "slurm": {"cluster": "c", "job": "41", "task": "0", "restart": 1}})");
  fs::create_directories(folder_ / "dir/attempts/start_5/random");
  write("dir/attempts/start_5/random/1.json",
        R"({"host": "n2", "machine": "n2 x", "pid": 5, "started": "9", "released": false,
            "slurm": {"cluster": "c", "job": "41", "task": "1", "restart": 0}})");
  fs::create_directories(folder_ / "dir/episodes/start_5/adaptive");
  write("dir/episodes/start_5/adaptive/failure.json",
        R"({"exit_code": 3, "reason": "error: no table"})");
  write("queue",
        "41|0|RUNNING|None|1|n1|\n41|1|PENDING|BeginTime|1||\n41|2|NODE_FAIL|None|0|n2|\n42|N/"
        "A|PENDING|Dependency|0||\n");
  const ShellResult status = vantage("status dir");
  EXPECT_EQ(status.exit_code, 1);
  EXPECT_EQ(status.output,
            "dir: 1 running, 2 queued, 1 crashed of 4 episodes\nqueued      "
            "start_0/random\nrunning     start_0/adaptive: on n1, task 41_0, requeued once\nqueued "
            "     start_5/random: was lost on n2, task 41_1\ncrashed     start_5/adaptive: error: "
            "no table\narray 41: 1 running, 1 queued (1 BeginTime), 1 node_fail, 1 ended, 2 "
            "requeued before\ncollect 42: 1 queued (1 Dependency)\n");
  EXPECT_THAT(calls(), HasSubstr("--jobs=41,42"));
  const std::string json = vantage("status dir --json").output;
  EXPECT_THAT(json, HasSubstr("\"running\": 1"));
  EXPECT_THAT(json, HasSubstr("\"BeginTime\": 1"));
  write("queue", "");
  EXPECT_THAT(vantage("status dir").output, HasSubstr("1 crashed, 3 missing of 4 episodes\n"));
  write("silent", "slurm_load_jobs error: Invalid job id specified\n");  // it has forgotten them
  EXPECT_THAT(vantage("status dir").output, HasSubstr("array 41: 4 ended\ncollect 42: 1 ended\n"));
  write("silent", "slurm_load_jobs error: Unable to contact slurm controller\n");
  EXPECT_THAT(vantage("status dir").output, HasSubstr("Slurm does not answer: slurm_load_jobs"));
}

TEST_F(Submit, CancelEndsWhatIsOpen) {
  ASSERT_EQ(submit().exit_code, 0);
  write("queue", "41|0|COMPLETED|None|0|n1|\n42|N/A|COMPLETED|None|0|n1|\n");
  EXPECT_EQ(vantage("cancel dir").output, "dir: nothing is queued or running\n");
  write("queue", "41|0|COMPLETED|None|0|n1|\n41|1|PENDING|None|0||\n");
  const ShellResult result = vantage("cancel dir");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_THAT(calls(), HasSubstr("scancel 42 41\n"));
}

TEST_F(Submit, TasksShareTheEpisodesAndSubmitGoesOnWithWhatIsMissing) {
  ASSERT_EQ(submit("--array 2").exit_code, 0);
  const auto task = [&](int index) {
    return "SLURM_JOB_ID=5" + std::to_string(index) +
           " SLURM_ARRAY_JOB_ID=41 SLURM_ARRAY_TASK_ID=" + std::to_string(index) +
           " SLURM_ARRAY_TASK_COUNT=2 SLURM_ARRAY_TASK_MIN=0 SLURMD_NODENAME=n" +
           std::to_string(index);
  };
  write("queue", "41|0|RUNNING|None|0|n0|\n41|1|RUNNING|None|0|n1|\n");
  // A task that was killed at work, and comes again beside another.
  fs::create_directories(folder_ / "dir/attempts/start_5/random/1");
  write("dir/attempts/start_5/random/1/metrics.part.json", "{");
  write("dir/attempts/start_5/random/1.json",
        R"({"host": "n9", "pid": 5, "started": "9", "released": false,
            "slurm": {"cluster": "", "job": "41", "task": "1", "restart": 0}})");
  write("queue", "41|0|RUNNING|None|0|n0|\n41|1|RUNNING|None|1|n1|\n");
  const std::string run = std::string(VANTAGE_BINARY) + " sweep work -q dir";
  const ShellResult both =
      shell("cd '" + folder_.path().string() + "' && export PATH='" + folder_.path().string() +
            "':$PATH; " + task(0) + " " + run + " & first=$!; " + task(1) +
            " SLURM_RESTART_COUNT=1 " + run + " && wait $first");
  EXPECT_EQ(both.exit_code, 0) << both.output;
  write("queue", "");
  EXPECT_EQ(vantage("status dir").exit_code, 0) << vantage("status dir").output;
  EXPECT_TRUE(fs::exists(folder_ / "dir/attempts/start_5/random/2.json"));
  EXPECT_FALSE(fs::exists(folder_ / "dir/attempts/start_5/random/1"));
  for (const char* once : {"start_0/random", "start_0/adaptive", "start_5/adaptive"}) {
    EXPECT_FALSE(fs::exists(folder_ / "dir/attempts" / once / "2.json")) << once;
  }
  EXPECT_FALSE(fs::exists(folder_ / "dir/results.csv")) << "a task does not collect";
  const ShellResult again = submit();
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.output, HasSubstr("every episode has a result; nothing is submitted"));
}

TEST_F(Submit, WhatCrashedInAnArrayIsTriedOnceInIt) {
  write("bare.xml", "<mujoco><worldbody><geom type='plane' size='5 5 .1'/></worldbody></mujoco>");
  write("s.yaml", "episode: assets/episodes/tabletop.yaml\nset: {scene: bare.xml}\nseeds: [1]\n");
  ASSERT_EQ(vantage("submit s.yaml --out dir").exit_code, 0);
  const std::string first = "SLURM_JOB_ID=50 SLURM_ARRAY_JOB_ID=41 SLURM_ARRAY_TASK_ID=0";
  EXPECT_EQ(vantage("work -q dir", first).exit_code, 1);
  EXPECT_EQ(vantage("work -q dir", "SLURM_JOB_ID=51 SLURM_ARRAY_JOB_ID=41 SLURM_ARRAY_TASK_ID=1")
                .exit_code,
            0);
  EXPECT_EQ(vantage("work -q dir").exit_code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "dir/attempts/1/2.json"));
  EXPECT_THAT(vantage("status dir").output, HasSubstr("crashed     1: error:"));
  EXPECT_EQ(vantage("work -q dir", "SLURM_JOB_ID=60 SLURM_ARRAY_JOB_ID=43 SLURM_ARRAY_TASK_ID=0")
                .exit_code,
            1);
  EXPECT_TRUE(fs::exists(folder_ / "dir/attempts/1/2.json"));
}

TEST_F(Submit, StatusInJsonTellsLostTasksFromThoseThatEnded) {
  ASSERT_EQ(submit().exit_code, 0);
  write("queue",
        "41|0|RUNNING|None|0|n1|\n41|1|NODE_FAIL|None|0|n2|\n41|2|TIMEOUT|None|0|n2|\n42|N/"
        "A|PENDING|Dependency|0||\n");
  const std::string json = vantage("status dir --json").output;
  for (const char* part : {"\"ended\": 1,", "\"node_fail\": 1", "\"timeout\": 1"}) {
    EXPECT_THAT(json, HasSubstr(part));
  }
}

}  // namespace
}  // namespace vantage
