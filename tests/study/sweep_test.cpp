// Sweeps as a user meets them: killed, resumed, sharded, with episodes that fail.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

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

constexpr const char* kStudy = VANTAGE_SOURCE_DIR "/assets/studies/smoke.yaml";

class Sweep : public testing::Test {
 protected:
  ShellResult vantage(const std::string& arguments) {
    return shell("cd '" + folder_.path().string() + "' && " VANTAGE_BINARY " " + arguments);
  }
  ShellResult sweep(const std::string& out, const std::string& options = {}) {
    return vantage(std::string("sweep run -q ") + kStudy + " --out " + out + " " + options);
  }
  std::string collected(const std::string& out) {
    vantage("sweep collect " + out);
    return read_file(folder_ / (out + "/results.csv"));
  }
  /// Of one sweep that nothing disturbed.
  static const std::string& reference() {
    static const std::string csv = [] {
      const support::TemporaryDirectory folder;
      const std::string out = (folder / "whole").string();
      shell(std::string(VANTAGE_BINARY " sweep run -q ") + kStudy + " --out " + out);
      shell(std::string(VANTAGE_BINARY " sweep collect ") + out);
      return read_file(fs::path(out) / "results.csv");
    }();
    return csv;
  }
  /// Processes whose command line names this test's folder.
  [[nodiscard]] std::size_t processes() const {
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator("/proc")) {
      std::ifstream stream(entry.path() / "cmdline");
      const std::string line((std::istreambuf_iterator<char>(stream)), {});
      if (line.find("attempts/start") != std::string::npos &&
          line.find(out_name_) != std::string::npos) {
        ++count;
      }
    }
    return count;
  }
  std::string file(const std::string& name, const std::string& content) {
    std::ofstream(folder_ / name) << content;
    return name;
  }

  support::TemporaryDirectory folder_;
  std::string out_name_ = "killed-" + folder_.path().filename().string();
};

TEST_F(Sweep, KilledAndResumedGivesTheSameResults) {
  const std::string out = out_name_;
  const ShellResult killed = shell(
      "cd '" + folder_.path().string() + "' && " VANTAGE_BINARY " sweep run -q " + kStudy +
      " --jobs 1 --out " + out + " & sweep=$!; until [ -n \"$(find '" + folder_.path().string() +
      "' -path '*/episodes/*' -name metrics.json)\" ]; do sleep 0.02; done; sleep 0.3; kill -9 "
      "$sweep; wait $sweep");
  EXPECT_EQ(killed.exit_code, 137) << killed.output;
  for (int i = 0; i < 100 && processes() > 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_EQ(processes(), 0U) << "an orphan goes on";
  EXPECT_EQ(vantage("sweep status " + out).exit_code, 1);
  EXPECT_THAT(vantage("sweep plan " + out).output, Not(HasSubstr("start_0/random")));
  const ShellResult partly = vantage("sweep collect " + out);
  EXPECT_EQ(partly.exit_code, 1);
  EXPECT_THAT(partly.output, HasSubstr("missing     start_5/adaptive"));

  const ShellResult resumed = sweep(out);
  EXPECT_EQ(resumed.exit_code, 0) << resumed.output;
  EXPECT_EQ(collected(out), reference());
  EXPECT_EQ(vantage("sweep status " + out).exit_code, 0);
  EXPECT_EQ(vantage("sweep plan " + out).output, "");
  EXPECT_EQ(vantage("sweep plan " + std::string(kStudy) + " --out " + out).output, "");
}

TEST_F(Sweep, ShardsMergeToTheSameResults) {
  EXPECT_EQ(sweep("parts", "--shard 2/2 --jobs 1").exit_code, 0);
  EXPECT_THAT(vantage("sweep status parts").output, HasSubstr("2 completed, 2 missing of 4"));
  EXPECT_EQ(sweep("parts", "--shard 1/2 --jobs 2").exit_code, 0);
  EXPECT_EQ(collected("parts"), reference());
}

TEST_F(Sweep, ShardsMayBeginTogether) {
  const std::string run =
      std::string(VANTAGE_BINARY " sweep run -q ") + kStudy + " --out together --jobs 1 --shard ";
  std::string shards = "cd '" + folder_.path().string() + "'; ";
  for (int i = 1; i <= 4; ++i)
    shards += run + std::to_string(i) + "/4 & s" + std::to_string(i) + "=$!; ";
  const ShellResult all = shell(shards + "wait $s1 && wait $s2 && wait $s3 && wait $s4");
  EXPECT_EQ(all.exit_code, 0) << all.output;
  EXPECT_EQ(collected("together"), reference());
  for (const auto& entry : fs::directory_iterator(folder_ / "together")) {
    EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr("study-")));
  }
}

// What another had begun when it was looked at may be done by the end. It depends on the clock
// whether the two meet so; ./faults together tries it more often.
TEST_F(Sweep, OfTwoOnOneFolderTheLastToEndHasAll) {
  const auto study = file("two.yaml", R"(episode: assets/episodes/tabletop.yaml
set: {scans: 1, laser.scan_duration_s: 1, map.cells: [9, 9, 5]}
factors: {start: {a: {robot.start_view: 0}, b: {robot.start_view: 5}}}
report: {compare: start, reference: a, tables: [area], curves: [share_left]}
)");
  const std::string run = VANTAGE_BINARY " sweep run -q " + study + " --jobs 1 --out ";
  for (const char* out : {"both1", "both2", "both3", "both4", "both5", "both6"}) {
    const ShellResult either =
        shell(fmt::format("cd '{0}'; {1}{2} & a=$!; {1}{2} & b=$!; wait $a; a=$?; wait $b; b=$?; "
                          "test $a = 0 -o $b = 0",
                          folder_.path().string(), run, out));
    EXPECT_EQ(either.exit_code, 0) << either.output;
  }
}

TEST_F(Sweep, InterruptedSweepEndsIn130AndResumes) {
  const ShellResult interrupted =
      shell("cd '" + folder_.path().string() +
            "' && timeout --preserve-status -s INT 1 " VANTAGE_BINARY " sweep run -q " + kStudy +
            " --out stopped --jobs 2");
  EXPECT_EQ(interrupted.exit_code, 130) << interrupted.output;
  EXPECT_EQ(sweep("stopped").exit_code, 0);
  EXPECT_EQ(collected("stopped"), reference());
}

TEST_F(Sweep, AFailingEpisodeDoesNotStopTheOthers) {
  file("bare.xml", "<mujoco><worldbody><geom type='plane' size='5 5 .1'/></worldbody></mujoco>");
  const auto study = file("s.yaml", R"(episode: assets/episodes/tabletop.yaml
set: {scans: 1, laser.scan_duration_s: 2, map.cells: [17, 17, 9]}
factors:
  scene:
    bare: {scene: bare.xml}
    table: {}
report: {compare: scene, reference: table, tables: [area], curves: [share_left]}
)");
  const ShellResult result = vantage("sweep run -q " + study + " --out f");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.output, HasSubstr("1 completed, 1 crashed of 2"));
  EXPECT_THAT(result.output, HasSubstr("no table"));
  EXPECT_THAT(result.output, HasSubstr("bare: exit code 3; see f/episodes/bare/output.txt"));
  EXPECT_THAT(result.output, Not(HasSubstr("table: exit code")));
  EXPECT_TRUE(fs::exists(folder_ / "f/episodes/bare/failure.json"));
  EXPECT_THAT(read_file(folder_ / "f/episodes/bare/output.txt"), HasSubstr("no table"));
  EXPECT_EQ(vantage("sweep collect f").exit_code, 1);
  EXPECT_THAT(read_file(folder_ / "f/results.csv"), HasSubstr("bare,bare,crashed,,"));
  EXPECT_THAT(read_file(folder_ / "f/summary.json"), HasSubstr("\"bare\": \"crashed\""));
  EXPECT_EQ(vantage("sweep plan f").output, "bare\n");  // it would be tried again
}

TEST_F(Sweep, AnotherStudyInTheFolderNeedsOverwrite) {
  file("out/study.yaml", "");
  fs::create_directory(folder_ / "out");
  file("out/study.yaml", "title: another\n");
  const ShellResult refused = sweep("out");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.output, HasSubstr("--overwrite"));
}

TEST_F(Sweep, FoldersOfEpisodesAreLean) {
  ASSERT_EQ(sweep("lean", "--shard 1/4").exit_code, 0);
  const fs::path folder = folder_ / "lean/episodes/start_0/random";
  for (const char* name : {"metrics.json", "steps.csv", "config.yaml", "manifest.json",
                           "trajectory.tum", "trajectory_estimated.tum"}) {
    EXPECT_TRUE(fs::exists(folder / name)) << name;
  }
  for (const char* name : {"states.bin", "map.bt", "map.ot", "cloud.ply", "report.html",
                           "output.txt", "failure.json"}) {
    EXPECT_FALSE(fs::exists(folder / name)) << name;
  }
  // In full, the same episode is the same.
  ASSERT_EQ(vantage("run -q lean/episodes/start_0/random/config.yaml --out full").exit_code, 0);
  const ShellResult same = vantage("compare lean/episodes/start_0/random full");
  EXPECT_EQ(same.exit_code, 0) << same.output;
  EXPECT_EQ(vantage("compare lean/episodes/start_0/random full --json").exit_code, 0);
}

TEST_F(Sweep, StatesAreKeptOnDemandAndALeanEpisodeSaysHow) {
  ASSERT_EQ(sweep("lean", "--shard 1/4").exit_code, 0);
  const ShellResult lean = vantage("replay lean/episodes/start_0/random");
  EXPECT_EQ(lean.exit_code, 3);
  const std::string config = "lean/episodes/start_0/random/config.yaml";
  EXPECT_THAT(lean.output, HasSubstr("vantage run " + config + " --out lean"));
  EXPECT_THAT(lean.output, HasSubstr("--keep-states"));
  const ShellResult page = vantage("report lean/episodes/start_0/random");
  EXPECT_EQ(page.exit_code, 3);
  EXPECT_THAT(page.output, HasSubstr("vantage run " + config + " --out lean"));
  EXPECT_EQ(vantage("view lean/episodes/start_0/random").exit_code, 3);
  EXPECT_EQ(
      vantage("run -q " + config + " --out lean/episodes/start_0/random --overwrite").exit_code, 0);
  EXPECT_EQ(vantage("replay lean/episodes/start_0/random").exit_code, 0);
  EXPECT_THAT(vantage("sweep status lean").output, HasSubstr("1 completed"));
  ASSERT_EQ(sweep("whole", "--shard 1/4 --keep-states").exit_code, 0);
  for (const char* name : {"states.bin", "story.bin", "candidates.csv", "report.html"}) {
    EXPECT_TRUE(fs::exists(folder_ / "whole/episodes/start_0/random" / name)) << name;
  }
}

TEST_F(Sweep, ResultsHaveTheColumnsOfTheTasksThatOccur) {
  const std::string header = reference().substr(0, reference().find('\n'));
  EXPECT_THAT(header, HasSubstr(",observed_share,"));
  for (const char* of_another : {"accuracy", "entropy_bits", "bin_error", "flight_time_s"}) {
    EXPECT_THAT(header, Not(HasSubstr(of_another)));
  }
}

TEST_F(Sweep, ThePageOfAStudyHoldsItsFigures) {
  ASSERT_EQ(sweep("page", "--shard 1/2").exit_code, 0);
  const ShellResult result = vantage("report page");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  const std::string page = read_file(folder_ / "page/report.html");
  for (const char* part : {"<svg", "Two methods from two starts", "missing", "path length, m"}) {
    EXPECT_THAT(page, HasSubstr(part));
  }
  EXPECT_THAT(page, Not(HasSubstr("{{")));
}

TEST_F(Sweep, ErrorsOfUse) {
  EXPECT_EQ(vantage("sweep").exit_code, 2);
  EXPECT_EQ(vantage("sweep status nowhere").exit_code, 3);
  EXPECT_EQ(sweep("x", "--shard 3/2").exit_code, 2);
  EXPECT_EQ(sweep("x", "--set nonsense=1").exit_code, 2);
  EXPECT_FALSE(fs::exists(folder_ / "x"));
  file("s.yaml",
       "episode: assets/episodes/tabletop.yaml\nfactors: {m: {a: {gian: simple}}}\n"
       "report: {compare: m}\n");
  const ShellResult wrong = vantage("validate s.yaml");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.output, HasSubstr("s.yaml:2: gian"));
  EXPECT_THAT(vantage("list studies").output, HasSubstr("assets/studies/smoke.yaml"));
}

/// One signal each: a second one would end them at once. The first decision takes a while.
TEST_F(Sweep, InterruptedEpisodesWriteWhatTheyHave) {
  file("slow.yaml", R"(episode: assets/episodes/tabletop.yaml
set:
  scans: 10
  laser.scan_duration_s: 1
  map.cells: [33, 33, 17]
  choice: {name: oracle_lookahead, width: 20000}
seeds: [1, 2]
)");
  const ShellResult stopped =
      shell("cd '" + folder_.path().string() +
            "'; " VANTAGE_BINARY
            " sweep run -q slow.yaml --jobs 1 --out slow & sweep=$!; at=slow/attempts/1; "
            "for i in $(seq 3000); do "
            "[ -e $at/1/output.txt ] && [ $at/1.json -nt $at/1/episode.yaml ] && "
            "[ $(($(stat -c %Y $at/1.json) - $(stat -c %Y $at/1/episode.yaml))) -lt 10 ] && "
            "echo signs of life too often; "
            "grep -qs 'scan 1 of' $at/1/output.txt && break; sleep 0.02; done; kill -INT $sweep; "
            "wait $sweep");
  EXPECT_EQ(stopped.exit_code, 130) << stopped.output;
  EXPECT_THAT(stopped.output, Not(HasSubstr("too often"))) << "one in 15 s is enough";
  EXPECT_THAT(vantage("sweep status slow").output, HasSubstr("1 interrupted, 1 missing of 2"))
      << "nothing else was begun";
}

TEST_F(Sweep, WhatAnotherWorkerIsAtIsLeftToIt) {
  const auto study = file("one.yaml", "episode: assets/episodes/tabletop.yaml\nseeds: [1]\n");
  fs::create_directories(folder_ / "shared/attempts/1");
  file("shared/attempts/1/1.json",
       R"({"host": "n9", "machine": "n9 x", "pid": 5, "started": "9", "released": false})");
  const ShellResult result = vantage("sweep run " + study + " --out shared");
  EXPECT_EQ(result.exit_code, 1) << result.output;
  EXPECT_THAT(result.output, HasSubstr("1: another worker is at it\n"));
  EXPECT_FALSE(fs::exists(folder_ / "shared/attempts/1/2.json"));
}

}  // namespace
}  // namespace vantage
