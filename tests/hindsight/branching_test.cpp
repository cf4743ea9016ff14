// Branches of a recorded run: the recorded bits where the choice is as recorded, other runs where
// it is not, and forked or repeated the same.
#include "vantage/hindsight/branching.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "tests/hindsight/short_run.hpp"
#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace {

using Json = nlohmann::json;

class Branches : public testing::Test {
 protected:
  static void SetUpTestSuite() { draw_without_threads(); }
  RecordedRun recorded(const std::vector<std::string>& more = {}) {
    return support::short_run(folder.path() / "run", more);
  }
  RunOptions lean(const char* name) {
    RunOptions options;
    options.directory = folder.path() / name;
    options.lean = true;
    return options;
  }
  support::TemporaryDirectory folder;
};

TEST_F(Branches, AsChosenHaveTheRecordedBits) {
  for (const char* choice : {"greedy", "random", "tour", "oracle_tour"}) {
    const RecordedRun run =
        support::short_run(folder.path() / choice, {std::string("choice=") + choice, "scans=4"});
    RunOptions options = lean("again");
    options.overwrite = true;
    const auto again = Json::parse(run_branch(run, 2, std::nullopt, options).metrics);
    EXPECT_EQ(again["state_hash"], run.state_hash) << choice;
    const auto named = Json::parse(run_branch(run, 2, run.scans[2].chosen_view, options).metrics);
    EXPECT_EQ(named["state_hash"], run.state_hash) << choice;
  }
}

TEST_F(Branches, AreTheSameUpToTheDecisionAndNotAfterIt) {
  const RecordedRun run = recorded();
  const int other = (run.scans[2].chosen_view + 15) % 30;
  const auto metrics = Json::parse(run_branch(run, 2, other, lean("other")).metrics);
  const Json& scans = metrics["scans"];
  ASSERT_EQ(scans.size(), 5U);
  EXPECT_EQ(scans[1]["time_s"], run.scans[1].time_s);
  EXPECT_EQ(scans[2]["chosen_view"], other);
  EXPECT_NE(metrics["state_hash"], run.state_hash);
  EXPECT_NE(metrics["method"], run.method);
}

/// The chosen one brought what was recorded, and any other what a run of its own brings.
TEST_F(Branches, OfAllViewsAreWhatRunsBring) {
  const RecordedRun run = recorded({"candidates.yaw_offsets_rad=[0]"});  // ten views
  const auto decisions = branch_views(run, {.scans = {2, 3}, .all = true, .then = 1});
  EXPECT_LE(::waitpid(-1, nullptr, WNOHANG), 0) << "a process was not waited for";
  ASSERT_EQ(decisions.size(), 2U);
  for (const BranchedDecision& decision : decisions) {
    ASSERT_EQ(decision.branches.size(), 10U);
    const auto chosen = std::ranges::find_if(decision.branches, &Branch::chosen);
    ASSERT_NE(chosen, decision.branches.end());
    const RecordedScan& before = run.scans[decision.scan - 1];
    const RecordedScan& after = run.scans[decision.scan];
    EXPECT_EQ(chosen->view, after.chosen_view);
    EXPECT_EQ(chosen->cells, static_cast<long long>(before.cells_left - after.cells_left));
    EXPECT_EQ(chosen->seconds, after.time_s - before.time_s);
    EXPECT_EQ(chosen->way_m, after.path_length_m - before.path_length_m);
    EXPECT_EQ(chosen->seconds_then, run.scans[decision.scan + 1].time_s - before.time_s);
    EXPECT_GE(regret_of(decision)->cells, 0.0);
    EXPECT_GE(regret_of(decision)->cells_per_s, 0.0);
  }
  const Branch& other = decisions[0].branches[7];
  const Json scans = Json::parse(run_branch(run, 2, 7, lean("other")).metrics)["scans"];
  EXPECT_EQ(other.seconds, scans[2]["time_s"].get<double>() - run.scans[1].time_s);
  EXPECT_EQ(*other.cells, static_cast<long long>(run.scans[1].cells_left) -
                              scans[2]["observable_unobserved_cells"].get<long long>());
  EXPECT_EQ(other.seconds_then, scans[3]["time_s"].get<double>() - run.scans[1].time_s);
}

TEST_F(Branches, OfAProcessThatHasThreadsAreTheSame) {
  const RecordedRun run = recorded({"scans=3"});
  const BranchRequest request{.scans = {1}, .all = false, .view = 9};
  const auto told_by = [&](std::vector<BranchedDecision>& decisions) {
    set_verbosity(Verbosity::verbose);
    testing::internal::CaptureStderr();
    decisions = branch_views(run, request);
    set_verbosity(Verbosity::quiet);
    return testing::internal::GetCapturedStderr();
  };
  const std::filesystem::directory_iterator threads("/proc/self/task");
  const bool alone = std::distance(threads, {}) == 1;  // sanitizers have some of their own
  std::vector<BranchedDecision> forked;
  const std::string told_forked = told_by(forked);
  std::atomic<bool> over = false;
  std::jthread other([&] { over.wait(false); });
  std::vector<BranchedDecision> repeated;
  const std::string told_repeated = told_by(repeated);
  over = true;
  over.notify_all();
  const std::string repetition = "view 9 after scan 1: repeated";
  EXPECT_EQ(told_forked.find(repetition) == std::string::npos, alone) << told_forked;
  EXPECT_NE(told_repeated.find(repetition), std::string::npos) << told_repeated;
  const std::string of_its_scan = "scan 2: view 9";
  EXPECT_EQ(told_forked.find(of_its_scan) == std::string::npos, alone) << "a child says nothing";
  EXPECT_NE(told_repeated.find(of_its_scan), std::string::npos) << told_repeated;
  EXPECT_EQ(branched_json(forked[0]), branched_json(repeated[0]));
  EXPECT_TRUE(repeated[0].branches[0].cells);
}

TEST_F(Branches, OfARunThatIsNotRepeatedSayWhere) {
  RecordedRun run = recorded({"scans=3"});
  run.scans[1].cells_left += 1;
  run.version = "0.0.1 (elsewhere)";
  try {
    run_branch(run, 2, std::nullopt, lean("again"));
    FAIL() << "it was repeated";
  } catch (const ReplayDiffers& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("scan 2"), std::string::npos) << what;
    EXPECT_NE(what.find("0.0.1 (elsewhere)"), std::string::npos) << what;
  }
}

TEST_F(Branches, ThatCannotBeAreRefused) {
  const RecordedRun run = recorded({"scans=3"});
  for (const std::size_t scan : {0U, 3U, 99U}) {
    EXPECT_THROW(branch_views(run, {.scans = {scan}}), ConfigError) << scan;
  }
  EXPECT_THROW(branch_views(run, {.scans = {1}, .all = false, .view = 30}), ConfigError);
  for (const int view : {-1, 30}) {
    EXPECT_THROW(run_branch(run, 1, view, lean("again")), ConfigError);
  }
  EXPECT_FALSE(std::filesystem::exists(lean("again").directory)) << "nothing was repeated";
}

TEST_F(Branches, AreKeptDecisionByDecision) {
  Branch chosen;
  chosen.chosen = true;
  chosen.cells = 40;
  chosen.seconds = 10.0;
  Branch more;
  more.view = 1;
  more.cells = 50;
  more.seconds = 25.0;
  Branch faster;
  faster.view = 2;
  faster.cells = 30;
  faster.seconds = 5.0;
  BranchedDecision decision;
  decision.branches = {chosen, more, faster};
  const auto regret = regret_of(decision);
  ASSERT_TRUE(regret);
  EXPECT_EQ(regret->best_view, 1);
  EXPECT_EQ(regret->cells, 10.0);
  EXPECT_EQ(regret->fastest_view, 2);
  EXPECT_EQ(regret->cells_per_s, 2.0);
  for (const std::size_t scan : {3U, 1U, 3U}) {
    decision.scan = scan;
    keep_branches(folder.path(), {decision});
  }
  const auto kept = Json::parse(read_file(folder.path() / "branches.json"))["decisions"];
  ASSERT_EQ(kept.size(), 2U);
  EXPECT_EQ(kept[0]["scan"], 1);
  EXPECT_EQ(kept[1]["regret"]["best_view"], 1);
  decision.branches[0].cells.reset();
  EXPECT_FALSE(regret_of(decision));
}

/// Of three scans: after the second but one is left to take.
TEST_F(Branches, EndWithTheEpisode) {
  const RecordedRun run = recorded({"scans=3"});
  const auto decisions = branch_views(run, {.scans = {1, 2}, .then = 5});
  ASSERT_EQ(decisions.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(decisions[i].scan, i + 1);
    EXPECT_EQ(decisions[i].then, 5U);
    EXPECT_FALSE(decisions[i].gain_unit.empty());
    ASSERT_EQ(decisions[i].branches.size(), 1U) << "the view that was chosen";
    EXPECT_TRUE(decisions[i].branches[0].chosen);
    EXPECT_EQ(decisions[i].branches[0].view, run.scans[i + 1].chosen_view);
    EXPECT_EQ(decisions[i].branches[0].cells,
              static_cast<long long>(run.scans[i].cells_left) -
                  static_cast<long long>(run.scans[i + 1].cells_left));
  }
  const Branch& first = decisions[0].branches[0];
  EXPECT_EQ(first.cells_then, static_cast<long long>(run.scans[0].cells_left) -
                                  static_cast<long long>(run.scans[2].cells_left));
  EXPECT_EQ(first.seconds_then, run.scans[2].time_s - run.scans[0].time_s);
  EXPECT_TRUE(first.planned_m);
  EXPECT_GT(first.gain, 0.0);
  EXPECT_FALSE(decisions[1].branches[0].cells_then);
  EXPECT_EQ(decisions[1].branches[0].seconds_then, 0.0);
}

TEST_F(Branches, OfOneViewAreNotTheChosenOne) {
  const RecordedRun run = recorded({"scans=3"});
  const int other = run.scans[1].chosen_view == 9 ? 10 : 9;
  const auto decisions = branch_views(run, {.scans = {1}, .all = false, .view = other});
  ASSERT_EQ(decisions.size(), 1U);
  ASSERT_EQ(decisions[0].branches.size(), 1U);
  const Branch& branch = decisions[0].branches[0];
  EXPECT_EQ(branch.view, other);
  EXPECT_FALSE(branch.chosen);
  EXPECT_FALSE(branch.cells_then);
  EXPECT_GT(branch.seconds, 0.0);
}

TEST_F(Branches, AreOfARunWhoseFolderTellsAllOfIt) {
  const RecordedRun run = recorded({"scans=2"});
  const auto file = run.directory / "metrics.json";
  const Json whole = Json::parse(read_file(file));
  EXPECT_EQ(whole["method"], run.method);
  EXPECT_EQ(whole["status"], run.status);
  ASSERT_EQ(run.scans.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(whole["scans"][k]["scan_time_s"], run.scans[k].scan_time_s);
    EXPECT_EQ(whole["scans"][k]["path_length_m"], run.scans[k].path_length_m);
  }
  const auto begins = [&](const Json& metrics, const std::string& refusal) {
    write_file(file, metrics.dump());
    try {
      read_recorded_run(run.directory);
      ADD_FAILURE() << refusal;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find(file.string() + refusal), 0U) << error.what();
    }
  };
  for (const char* key :
       {"time_s", "path_length_m", "scan_time_s", "observable_unobserved_cells", "chosen_view"}) {
    Json less = whole;
    less["scans"][1].erase(key);
    begins(less, ": scans[1]: " + std::string(key) + ": missing or of another kind");
  }
  for (const char* key : {"method", "state_hash", "status", "observable_cells"}) {
    Json less = whole;
    less.erase(key);
    begins(less, ": " + std::string(key) + ": missing or of another kind");
  }
  Json none = whole;
  none["scans"] = Json::array();
  begins(none, ": scans: empty, the run took none");
  none.erase("scans");
  begins(none, ": scans: missing; task ");
  begins(Json::array(), ": not a JSON object");
}

TEST(DrawWithoutThreads, UnlessTheUserSaysOtherwise) {
  ::setenv("LP_NUM_THREADS", "3", 1);
  ::setenv("MESA_SHADER_CACHE_DISABLE", "false", 1);
  draw_without_threads();
  EXPECT_STREQ(std::getenv("LP_NUM_THREADS"), "3");
  EXPECT_STREQ(std::getenv("MESA_SHADER_CACHE_DISABLE"), "false");
  ::unsetenv("LP_NUM_THREADS");
  ::unsetenv("MESA_SHADER_CACHE_DISABLE");
  draw_without_threads();
  EXPECT_STREQ(std::getenv("LP_NUM_THREADS"), "0");
  EXPECT_STREQ(std::getenv("MESA_SHADER_CACHE_DISABLE"), "true");
}

TEST_F(Branches, AreOfARunOfItsFoldersNameAndOfTheVersionThatWroteIt) {
  const RecordedRun run = recorded({"scans=2"});
  EXPECT_EQ(run.episode.setup.name, "run");
  EXPECT_EQ(read_recorded_run(run.directory / "").episode.setup.name, "run");
  const auto version_of = [&](const char* manifest) {
    write_file(run.directory / "manifest.json", manifest);
    return read_recorded_run(run.directory).version;
  };
  EXPECT_EQ(version_of(R"({"versions": {"vantage": "1.2.3"}})"), "1.2.3");
  EXPECT_EQ(version_of(R"({"versions": {"vantage": 3}})"), "unknown");
  EXPECT_EQ(version_of(R"({"versions": {}})"), "unknown");
  EXPECT_EQ(version_of(R"({"versions": 3})"), "unknown");
  EXPECT_EQ(version_of("{}"), "unknown");
}

TEST_F(Branches, OfAnotherViewAreNamedAfterItAndCheckedUpToIt) {
  const RecordedRun run = recorded({"scans=3"});
  const int other = run.scans[1].chosen_view == 9 ? 10 : 9;
  RecordedRun differs_after = run;
  differs_after.scans[1].cells_left += 1;
  const auto metrics = Json::parse(run_branch(differs_after, 1, other, lean("other")).metrics);
  EXPECT_EQ(metrics["method"], run.method + ", view " + std::to_string(other) + " after scan 1");
  RecordedRun differs_before = run;
  differs_before.scans[0].cells_left += 1;
  EXPECT_THROW(run_branch(differs_before, 1, other, lean("again")), ReplayDiffers);
}

/// As of a program of the user's, which took the same views; its name is not the choice's.
TEST_F(Branches, OfARunThatWasChosenOutsideDoNotGoOn) {
  RecordedRun run = recorded({"scans=3"});
  const int other = run.scans[1].chosen_view == 9 ? 10 : 9;
  const BranchRequest request{.scans = {1}, .all = false, .view = other};
  const auto own = branch_views(run, request);
  run.method = "mine";
  const auto outside = branch_views(run, request);
  ASSERT_EQ(outside.size(), 1U);
  EXPECT_EQ(branched_json(outside[0]), branched_json(own[0]));
  EXPECT_THROW(branch_views(run, {.scans = {1}, .then = 1}), ConfigError);
  EXPECT_THROW(run_branch(run, 1, other, lean("again")), ConfigError);
  run.scans[1].chosen_view = 99;
  try {
    run_branch(run, 1, std::nullopt, lean("again"));
    ADD_FAILURE() << "there is no such view";
  } catch (const ConfigError& error) {
    EXPECT_EQ(std::string(error.what())
                  .find(run.directory.string() + ": scan 2 was taken from a pose of the planner's"),
              0U)
        << error.what();
  }
}

/// What the run did after the last decision that is asked for is not repeated, what it did before
/// is.
TEST_F(Branches, GoNoFartherThanTheLastDecision) {
  RecordedRun run = recorded({"scans=3"});
  run.scans[2].cells_left += 1;
  ::unsetenv("LP_NUM_THREADS");
  const auto decisions = branch_views(run, {.scans = {1}});
  EXPECT_STREQ(std::getenv("LP_NUM_THREADS"), "0");
  ASSERT_EQ(decisions.size(), 1U);
  EXPECT_TRUE(decisions[0].branches.at(0).cells);
  run.scans[0].cells_left += 1;
  EXPECT_THROW(branch_views(run, {.scans = {1}}), ReplayDiffers);
}

}  // namespace
}  // namespace vantage
