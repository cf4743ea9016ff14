// A task is a folder and a line of the variant: the dummy task `wait` runs, reports, replays, lists
// itself and is swept, and nothing but that folder and that line knows of it.
#include <nlohmann/json.hpp>

#include "tests/cli/command_line.hpp"
#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace {

using testing::Not;
using testing::StartsWith;

class DummyTask : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    episode_ = file("dummy.yaml", "task: wait\nrobot: {start_pose: [-2.0, 0.0, 0.0]}\nscans: 3\n");
  }
  Result run() { return vantage("run -q --out done " + episode_); }
  nlohmann::json metrics(const fs::path& of) {
    return nlohmann::json::parse(read_file(folder_ / of / "metrics.json"));
  }

  std::string episode_;
};

TEST_F(DummyTask, Runs) {
  const Result result = run();
  EXPECT_EQ(result.exit_code, 0) << result.output;
  const auto found = metrics("done");
  EXPECT_EQ(found["task"], "wait");
  EXPECT_EQ(found["status"], "completed");
  EXPECT_EQ(found["reason"], "all scans");
  EXPECT_EQ(found["method"], "either side");
  ASSERT_EQ(found["scans"].size(), 3U);
  std::size_t returns = 0;
  for (const auto& scan : found["scans"]) {
    EXPECT_GT(scan["returns"], 100) << "the scanner sees the walls";
    returns += scan["returns"].get<std::size_t>();
  }
  EXPECT_EQ(found["returns"], returns);
  EXPECT_NEAR(found["simulated_time_s"], 1.0, 1e-9) << "two turns between three scans";
  EXPECT_THAT(result.output,
              StartsWith("wait: completed, " + std::to_string(returns) + " returns in 3 scans\n"));
  EXPECT_THAT(result.output, HasSubstr("\nended by: all scans\n"));
}

TEST_F(DummyTask, TurnsInPlace) {
  run();
  EXPECT_LT(metrics("done")["path_length_m"], 0.01);
  const Result still = vantage("run -q --out still --set turning_rate_rad_s=0 " + episode_);
  ASSERT_EQ(still.exit_code, 0) << still.output;
  EXPECT_EQ(metrics("done")["simulated_time_s"], metrics("still")["simulated_time_s"]);
  EXPECT_NE(metrics("done")["state_hash"], metrics("still")["state_hash"]);
}

TEST_F(DummyTask, Reports) {
  run();
  const fs::path page = folder_ / "done/report.html";
  ASSERT_TRUE(fs::exists(page));
  EXPECT_THAT(read_file(page), HasSubstr("Where the robot waits"));
  fs::remove(page);
  EXPECT_EQ(vantage("report done").exit_code, 0);
  EXPECT_THAT(read_file(page), HasSubstr("Where the robot waits"));
}

TEST_F(DummyTask, Replays) {
  run();
  const Result result = vantage("replay done");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("every state the same"));
  EXPECT_THAT(result.output, HasSubstr(metrics("done")["state_hash"].get<std::string>()));
}

TEST_F(DummyTask, ListsItself) {
  EXPECT_THAT(vantage("list tasks").output, HasSubstr("\nwait\n"));
  const Result unknown = vantage("run --set task=weit");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.output, HasSubstr("trajectory, wait")) << "among the tasks that are known";
}

TEST_F(DummyTask, PrintsItsConfigurationAndItsPlan) {
  const Result config = vantage("run --print-config " + episode_);
  EXPECT_THAT(config.output, HasSubstr("\ntask: wait\n"));
  for (const char* key : {"\nscans: 3\n", "\nturning_rate_rad_s: 0.8\n", "\nbase_scanner:"}) {
    EXPECT_THAT(config.output, HasSubstr(key));
  }
  EXPECT_THAT(config.output, Not(HasSubstr("\ngain:"))) << "a key of another task";
  const Result plan = vantage("run --dry-run " + episode_);
  EXPECT_EQ(plan.exit_code, 0) << plan.output;
  EXPECT_THAT(plan.output, StartsWith("dummy: 3 scans in "));
  EXPECT_EQ(vantage("validate " + episode_).exit_code, 0);
}

TEST_F(DummyTask, ItsErrorsNameFileLineAndKey) {
  expect_error(vantage("run " + file("range.yaml", "task: wait\nturning_rate_rad_s: 2\n")), 2,
               {"range.yaml:2", "turning_rate_rad_s", "1.5"});
  expect_error(vantage("run " + file("owner.yaml", "task: wait\ngain: adaptive\n")), 2,
               {"owner.yaml:2", "gain", "tabletop"});
  expect_error(vantage("run " + file("owned.yaml", "task: tabletop\nturning_time_s: 1\n")), 2,
               {"owned.yaml:2", "turning_time_s", "wait"});
  expect_error(vantage("run --set turning_time_s=0.001 " + episode_), 2, {"turning_time_s"});
}

TEST_F(DummyTask, IsSweptAndCollected) {
  const auto study = file("study.yaml",
                          "title: Waits\nepisode: dummy.yaml\nfactors:\n  length:\n"
                          "    short: {scans: 2}\n    long: {scans: 3}\n"
                          "report: {compare: length, tables: [returns], curves: [scan_returns]}\n");
  const Result swept = vantage("sweep run -q --out study " + study);
  EXPECT_EQ(swept.exit_code, 0) << swept.output;
  const Result collected = vantage("sweep collect study");
  EXPECT_EQ(collected.exit_code, 0) << collected.output;
  const auto summary =
      nlohmann::json::parse(read_file(folder_ / "study/summary.json"), nullptr, false);
  EXPECT_EQ(summary["completed"], 2);
  EXPECT_TRUE(summary["tables"].contains("returns")) << summary;
  EXPECT_TRUE(fs::exists(folder_ / "study/figures/scan_returns.svg"));
  EXPECT_THAT(read_file(folder_ / "study/results.csv"), HasSubstr("returns"));
}

}  // namespace
}  // namespace vantage
