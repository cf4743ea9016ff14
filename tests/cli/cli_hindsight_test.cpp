// `vantage bound` and `vantage branch` as a user meets them.
#include <nlohmann/json.hpp>

#include "tests/cli/command_line.hpp"

namespace vantage {
namespace {

class HindsightCommands : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    const Result run = vantage(
        "run --set scans=3 --set laser.scan_duration_s=2 --set 'map.cells=[33,33,17]' -q --out "
        "run");
    ASSERT_EQ(run.exit_code, 0) << run.output;
  }
  void replace(const std::string& name, const std::string& by) {
    shell("cd '" + folder_.string() + "/run' && sed -i '" + by + "' " + name);
  }
};

TEST_F(HindsightCommands, BoundIsKeptAndOnThePage) {
  EXPECT_THAT(shell("cat '" + folder_.string() + "/run/report.html'").output,
              HasSubstr("\"bound\":null"));
  const Result bound = vantage("bound run --json -q");
  EXPECT_EQ(bound.exit_code, 0) << bound.output;
  EXPECT_THAT(bound.output, HasSubstr("\"run_over_least\""));
  EXPECT_EQ(shell("cat '" + folder_.string() + "/run/bound.json'").output, bound.output);
  EXPECT_THAT(shell("cat '" + folder_.string() + "/run/report.html'").output,
              HasSubstr("\"run_over_least\""));
}

TEST_F(HindsightCommands, AnInterruptedRepetitionIsNoResult) {
  replace("config.yaml", "s/scan_duration_s: 2$/scan_duration_s: 3600/");  // hours of scanning
  const fs::path before = fs::temp_directory_path();
  fs::create_directory(folder_ / "scratch");
  ::setenv("TMPDIR", (folder_ / "scratch").c_str(), 1);
  const Result tour = interrupted("bound run --oracle-tour -q",
                                  "ls scratch/*/oracle_tour/steps.part.csv >listed 2>&1", "INT");
  const Result branches = interrupted("branch run --scan 1 --all -q",
                                      "ls scratch/*/0/steps.part.csv >listed 2>&1", "INT");
  ::setenv("TMPDIR", before.c_str(), 1);
  EXPECT_EQ(tour.exit_code, 130) << tour.output;
  EXPECT_FALSE(fs::exists(folder_ / "run/bound.json"));
  EXPECT_EQ(branches.exit_code, 130) << branches.output;
  EXPECT_FALSE(fs::exists(folder_ / "run/branches.json"));
}

TEST_F(HindsightCommands, BranchAsChosenHasTheRecordedHash) {
  const Result as_chosen = vantage("branch run --scan 1 -q");
  EXPECT_EQ(as_chosen.exit_code, 0) << as_chosen.output;
  EXPECT_THAT(as_chosen.output, HasSubstr("as recorded"));
  const Result other = vantage("branch run --scan 1 --view 14 --json -q --out other");
  EXPECT_EQ(other.exit_code, 0) << other.output;
  EXPECT_THAT(other.output, HasSubstr("\"same_bits\": false"));
  EXPECT_EQ(shell("test -f '" + folder_.string() + "/other/report.html'").exit_code, 0);
  const auto manifest =
      nlohmann::json::parse(shell("cat '" + folder_.string() + "/other/manifest.json'").output);
  EXPECT_EQ(manifest["command"],
            nlohmann::json({"vantage", "branch", "run", "--scan", "1", "--view", "14"}));
  const Result all = vantage("branch run --scan 2 --all -q");
  EXPECT_EQ(all.exit_code, 0) << all.output;
  EXPECT_THAT(all.output, HasSubstr("regret: "));
  EXPECT_THAT(shell("cat '" + folder_.string() + "/run/branches.json'").output,
              HasSubstr("\"scan\": 2"));
  EXPECT_THAT(shell("cat '" + folder_.string() + "/run/report.html'").output,
              testing::Not(HasSubstr("\"branches\":null")));
}

TEST_F(HindsightCommands, WhatCannotBeIsOneClearLine) {
  expect_error(vantage("branch run"), 2, {"--scan", "missing"});
  expect_error(vantage("branch run --scan 0"), 2, {"--scan: 0", "after scan 1 to 2"});
  expect_error(vantage("branch run --scan 3"), 2, {"--scan: 3", "3 scans", "after scan 1 to 2"});
  expect_error(vantage("branch run --scan 1 --view 30 -q"), 2, {"--view: 30", "views 0 to 29"});
  expect_error(vantage("branch run --scan 1 --then 0 --view 30 -q"), 2, {"--view: 30"});
  expect_error(vantage("branch run --scan 1 --scan 2"), 2, {"--scan", "several"});
  expect_error(vantage("branch run --scan 1 --all --out x"), 2, {"--out"});
  ASSERT_EQ(vantage(std::string("run ") + kShort + "--out one").exit_code, 0);
  expect_error(vantage("branch one --all -q"), 2, {"--scan: 1", "one has one scan"});
  expect_error(vantage("bound nowhere"), 3, {"nowhere", "no such folder"});
  expect_error(vantage("branch . --scan 1"), 3, {"not a run folder"});
  shell("mv '" + folder_.string() + "/run/trajectory.tum' '" + folder_.string() + "'");
  expect_error(vantage("bound run -q"), 3, {"trajectory.tum"});
  shell("mv '" + folder_.string() + "/run/metrics.json' '" + folder_.string() + "'");
  expect_error(vantage("bound run -q"), 3, {"metrics.json"});
  expect_error(vantage("branch run --scan 1 -q"), 3, {"metrics.json"});
}

TEST_F(HindsightCommands, ARunOfAnotherVersionIsOneClearLine) {
  replace("manifest.json", "s/\"vantage\": \".*\"/\"vantage\": \"0.0.1 (then)\"/");
  replace("metrics.json", "0,/\"time_s\": [0-9.]*/s//\"time_s\": 1.5/");
  expect_error(vantage("branch run --scan 1 -q"), 1, {"scan 1", "recorded 1.5", "0.0.1 (then)"});
  expect_error(vantage("branch run --scan 1 --all -q"), 1, {"scan 1", "recorded 1.5"});
  replace("metrics.json", "s/\"scan_time_s\"/\"scan_s\"/");
  expect_error(vantage("bound run -q"), 3, {"scans[0]", "scan_time_s", "another", "0.0.1 (then)"});
  replace("config.yaml", "s/^scans:/shots:/");
  expect_error(vantage("bound run -q"), 3, {"config.yaml", "shots", "not a configuration of this"});
  expect_error(vantage("branch run --scan 1 -q"), 3, {"config.yaml", "shots"});
}

TEST_F(HindsightCommands, AnInterruptedBranchWritesWhatThereIs) {
  replace("config.yaml", "s/scan_duration_s: 2$/scan_duration_s: 3600/");  // hours of scanning
  const Result result =
      interrupted("branch run --scan 1 --out other -q",
                  "[ $(stat -c %s other/states.part.bin || echo 0) -gt 100000 ]", "INT");
  EXPECT_EQ(result.exit_code, 130) << result.output;
  EXPECT_THAT(shell("cat '" + folder_.string() + "/other/metrics.json'").output,
              HasSubstr("\"status\": \"interrupted\""));
}

TEST_F(HindsightCommands, ABranchIsToldBesideWhatWasRecorded) {
  const auto recorded =
      nlohmann::json::parse(shell("cat '" + (folder_ / "run/metrics.json").string() + "'").output);
  const auto same =
      nlohmann::json::parse(vantage("branch run --scan 1 --json -q 2>/dev/null").output);
  EXPECT_EQ(same["directory"], "run");
  EXPECT_EQ(same["scan"], 1);
  EXPECT_TRUE(same["view"].is_null());
  EXPECT_EQ(same["state_hash"], recorded["state_hash"]);
  EXPECT_EQ(same["recorded_state_hash"], recorded["state_hash"]);
  EXPECT_EQ(same["same_bits"], true);
  EXPECT_EQ(same["metrics"]["state_hash"], recorded["state_hash"]);
  const int other = same["recorded_view"].get<int>() == 14 ? 15 : 14;
  const Result words = vantage("branch run --scan 1 -q --view " + std::to_string(other));
  EXPECT_EQ(words.exit_code, 0) << words.output;
  EXPECT_THAT(words.output,
              testing::EndsWith(", recorded " + recorded["state_hash"].get<std::string>() + "\n"));
}

TEST_F(HindsightCommands, DecisionsAreBranchedInOrderAndOnceEach) {
  const auto told = nlohmann::json::parse(
      vantage("branch run --scan 2 --scan 1 --scan 2 --then 0 --view 14 --json -q 2>/dev/null")
          .output);
  EXPECT_EQ(told["directory"], "run");
  ASSERT_EQ(told["decisions"].size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& decision = told["decisions"][i];
    EXPECT_EQ(decision["scan"], i + 1);
    EXPECT_EQ(decision["then"], 0);
    ASSERT_EQ(decision["branches"].size(), 1U);
    EXPECT_EQ(decision["branches"][0]["view"], 14);
  }
  EXPECT_FALSE(fs::exists(folder_ / "run/branches.json")) << "of all candidates alone";
}

}  // namespace
}  // namespace vantage
