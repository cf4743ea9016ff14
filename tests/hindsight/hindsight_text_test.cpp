// What is said of bounds and branches, without a run.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

#include "tests/support/temporary_directory.hpp"
#include "tests/tasks/undescribed.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/hindsight/branching.hpp"
#include "vantage/hindsight/hindsight_records.hpp"
#include "vantage/hindsight/run_bound.hpp"

namespace vantage {
namespace {

using TextJson = nlohmann::ordered_json;

RunBound told_bound() {
  RunBound bound{.poses = 31,
                 .observable_cells = 900,
                 .speed_m_s = 0.5,
                 .scan_s = 12.34,
                 .first_scan = {1, 0.0, 12.5},
                 .has_oracle_tour = false,
                 .shares = {}};
  bound.shares.push_back({.percent = 80,
                          .run = ShareReached{6, 9.0, 150.0},
                          .oracle_tour = ShareReached{4, 0.0, 100.0},
                          .least = ShareReached{3, 4.5, 60.0},
                          .exact_scans = true,
                          .exact_way = false,
                          .exact_time = true,
                          .given_cells = 7});
  bound.shares.emplace_back().percent = 97;
  return bound;
}

TEST(RunBoundText, HasARowForEachOfThem) {
  RunBound bound = told_bound();
  EXPECT_EQ(run_bound_text(bound),
            "any policy, from 31 poses, at 0.5 m/s at most, with scans of 12.3 s at least\n"
            "80 % observed      scans     way m    time s\n"
            "  run               6      9.00     150.0\n"
            "  at least          3      4.50      60.0\n"
            "  run / least    2.00      2.00      2.50\n"
            "  run / oracle   1.50         -      1.50\n"
            "97 % observed      scans     way m    time s\n"
            "  run           never\n"
            "  at least      never\n");
  bound.has_oracle_tour = true;
  bound.shares.pop_back();
  EXPECT_NE(run_bound_text(bound).find("  run               6      9.00     150.0\n"
                                       "  oracle_tour       4      0.00     100.0\n"
                                       "  at least "),
            std::string::npos);
}

TEST(RunBoundText, IsJsonToo) {
  const TextJson json = run_bound_json(told_bound());
  EXPECT_EQ(json["poses"], 31);
  EXPECT_EQ(json["observable_cells"], 900);
  EXPECT_EQ(json["scan_s"], 12.34);
  EXPECT_EQ(json["first_scan"]["time_s"], 12.5);
  ASSERT_EQ(json["shares"].size(), 2U);
  EXPECT_EQ(json["shares"][0], TextJson::parse(R"({"percent": 80,
    "run": {"scans": 6, "way_m": 9.0, "time_s": 150.0},
    "least": {"scans": 3, "way_m": 4.5, "time_s": 60.0},
    "exact": {"scans": true, "way_m": false, "time_s": true},
    "given_cells": 7,
    "run_over_least": {"scans": 2.0, "way_m": 2.0, "time_s": 2.5},
    "oracle_tour": {"scans": 4, "way_m": 0.0, "time_s": 100.0},
    "run_over_oracle_tour": {"scans": 1.5, "way_m": null, "time_s": 1.5}})"));
  EXPECT_TRUE(json["shares"][1]["run"].is_null());
  EXPECT_TRUE(json["shares"][1]["run_over_least"].is_null());
}

TEST(RunBoundText, IsReadBackForTheTourOfTheOracle) {
  RunBound former = told_bound();
  former.has_oracle_tour = true;
  RunBound bound = told_bound();
  for (ShareBound& share : bound.shares) share.oracle_tour.reset();
  keep_oracle_tour(run_bound_json(told_bound()), bound);
  EXPECT_FALSE(bound.has_oracle_tour) << "there was none";
  keep_oracle_tour(nullptr, bound);
  EXPECT_FALSE(bound.has_oracle_tour) << "no former bound";
  keep_oracle_tour(run_bound_json(former), bound);
  EXPECT_EQ(run_bound_json(bound), run_bound_json(former));
}

TEST(ProgressTo, IsTheFirstScanThatLeavesNoMoreThanTheShare) {
  RecordedRun run;
  run.observable_cells = 1000;
  for (const std::size_t left : {700U, 210U, 190U, 100U, 51U}) {
    const auto k = static_cast<double>(run.scans.size() + 1);
    run.scans.push_back({.time_s = 10.0 * k, .path_length_m = 2.0 * k, .cells_left = left});
  }
  const auto reached = progress_to(run, 80);
  ASSERT_TRUE(reached);
  EXPECT_EQ(reached->scans, 3U);
  EXPECT_EQ(reached->way_m, 6.0);
  EXPECT_EQ(reached->time_s, 30.0);
  EXPECT_EQ(progress_to(run, 95), std::nullopt) << "51 are left, 50 may be";
  run.scans.push_back({.time_s = 60.0, .path_length_m = 12.0, .cells_left = 50});
  ASSERT_TRUE(progress_to(run, 95));
  EXPECT_EQ(progress_to(run, 95)->scans, 6U);
}

TEST(StepRow, IsReadByTheNamesOfItsColumns) {
  const StepRow row =
      read_step("time_s,scan,fallback,other,path_length_m,observable_unobserved_cells,chosen_view",
                "12.5,3,true,x,4.25,987,17");
  EXPECT_EQ(row.scan, 3U);
  EXPECT_EQ(row.time_s, 12.5);
  EXPECT_EQ(row.path_length_m, 4.25);
  EXPECT_EQ(row.cells_left, 987);
  EXPECT_EQ(row.chosen_view, 17);
  EXPECT_TRUE(row.fallback);
}

RecordedRun three_scans() {
  RecordedRun run;
  run.directory = "out/run";
  run.version = "1";
  for (const double time_s : {10.0, 20.0, 30.0}) {
    run.scans.push_back({.time_s = time_s, .cells_left = static_cast<std::size_t>(time_s)});
  }
  return run;
}

TEST(RecordedDecisions, CheckEachScanThatWasRecorded) {
  const RecordedRun run = three_scans();
  const RecordedDecisions recorded(run);
  EXPECT_NO_THROW(recorded.check({.scan = 2, .time_s = 20.0, .cells_left = 20}));
  EXPECT_NO_THROW(recorded.check({.scan = 3, .time_s = 30.0, .cells_left = 30}));
  EXPECT_NO_THROW(recorded.check({.scan = 4, .time_s = 1.0, .cells_left = 1})) << "was not there";
  EXPECT_NO_THROW(recorded.check({.scan = 0, .time_s = 1.0, .cells_left = 1}));
  EXPECT_THROW(recorded.check({.scan = 2, .time_s = 20.5, .cells_left = 20}), ReplayDiffers);
  EXPECT_THROW(recorded.check({.scan = 3, .time_s = 30.0, .cells_left = 29}), ReplayDiffers);
  EXPECT_THROW(recorded.check({.scan = 1, .time_s = 20.0, .cells_left = 20}), ReplayDiffers);
}

TEST(RecordedDecisions, AreAfterEachScanButTheLast) {
  RecordedRun run = three_scans();
  EXPECT_NO_THROW(require_decision(run, 1));
  EXPECT_NO_THROW(require_decision(run, 2));
  for (const long long scan : {-1LL, 0LL, 3LL}) {
    try {
      require_decision(run, scan);
      ADD_FAILURE() << scan;
    } catch (const ConfigError& error) {
      EXPECT_EQ(error.what(), "--scan: " + std::to_string(scan) +
                                  ": out/run has 3 scans, and decisions after scan 1 to 2");
    }
  }
  run.scans.resize(1);
  try {
    require_decision(run, 1);
    ADD_FAILURE() << "nothing was decided";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "--scan: 1: out/run has one scan, after which nothing was decided");
  }
}

BranchedDecision two_branches() {
  BranchedDecision decision{.scan = 2, .then = 1, .gain_unit = "cells", .branches = {}};
  Branch chosen;
  chosen.view = 4;
  chosen.chosen = true;
  chosen.gain = 12.34;
  chosen.planned_m = 1.5;
  chosen.cells = 40;
  chosen.seconds = 10.0;
  chosen.way_m = 2.0;
  chosen.cells_then = 60;
  chosen.seconds_then = 25.0;
  Branch other;
  other.view = 11;
  other.gain = 5.0;
  other.fallback = true;
  decision.branches = {chosen, other};
  return decision;
}

TEST(BranchedText, HasARowForEachView) {
  EXPECT_EQ(branched_text(two_branches()),
            "decision after scan 2; new cells are of those that can be observed\n"
            "  view         cells  new cells  seconds   way m   cells/s\n"
            "*    4          12.3         40     10.0    2.00       4.0\n"
            "    11           5.0       none      0.0    0.00       0.0  not reached\n"
            "regret: 0 cells (best view 4), 0.0 cells/s (fastest view 4)\n");
  EXPECT_EQ(branched_json(two_branches()), TextJson::parse(R"({"scan": 2, "then": 1,
    "gain_unit": "cells",
    "regret": {"best_view": 4, "cells": 0.0, "fastest_view": 4, "cells_per_s": 0.0},
    "branches": [
      {"view": 4, "chosen": true, "gain": 12.34, "planned_m": 1.5, "fallback": false,
       "new_cells": 40, "seconds": 10.0, "way_m": 2.0, "new_cells_then": 60,
       "seconds_then": 25.0},
      {"view": 11, "chosen": false, "gain": 5.0, "planned_m": null, "fallback": true,
       "new_cells": null, "seconds": 0.0, "way_m": 0.0, "new_cells_then": null,
       "seconds_then": 0.0}]})"));
  BranchedDecision none = two_branches();
  none.branches[0].chosen = false;
  EXPECT_FALSE(regret_of(none));
  EXPECT_TRUE(branched_json(none)["regret"].is_null());
}

TEST(BranchedText, IsKeptBesideWhatIsThereUnlessThatIsNoRecord) {
  const support::TemporaryDirectory folder;
  const auto kept = [&] {
    return TextJson::parse(read_file(folder / "branches.json"))["decisions"];
  };
  write_file(folder / "branches.json", R"({"decisions": [{"scan": 5}, {"scan": 2, "old": 1}, 7]})");
  keep_branches(folder.path(), {two_branches()});
  ASSERT_EQ(kept().size(), 3U);
  EXPECT_EQ(kept()[0], 7) << "of no scan";
  EXPECT_EQ(kept()[1]["scan"], 2);
  EXPECT_FALSE(kept()[1].contains("old"));
  EXPECT_EQ(kept()[2]["scan"], 5);
  for (const char* text : {"nothing", "[]", "{}", R"({"decisions": 3})"}) {
    write_file(folder / "branches.json", text);
    keep_branches(folder.path(), {two_branches()});
    EXPECT_EQ(kept().size(), 1U) << text;
  }
}

TEST(ProgressTo, CountsCellsOfWhatShareThereIs) {
  RecordedRun run;
  run.observable_cells = 1000;
  run.scans.push_back({.time_s = 10.0, .path_length_m = 2.5, .cells_left = 31});
  EXPECT_EQ(progress_to(run, 97), std::nullopt);
  run.scans.push_back({.time_s = 24.0, .path_length_m = 7.5, .cells_left = 30});
  const auto reached = progress_to(run, 97);
  ASSERT_TRUE(reached);
  EXPECT_EQ(reached->scans, 2U);
  EXPECT_EQ(reached->way_m, 7.5);
  run.observable_cells = 333;  // 3 % of which are 9.99
  run.scans.back().cells_left = 10;
  EXPECT_EQ(progress_to(run, 97), std::nullopt);
  run.scans.back().cells_left = 9;
  EXPECT_TRUE(progress_to(run, 97));
}

TEST(RunBound, IsOfFourShares) { EXPECT_EQ(kBoundShares_percent, (std::array{80, 90, 95, 97})); }

Branch branch_that(int view, long long cells, double seconds) {
  Branch branch;
  branch.view = view;
  branch.cells = cells;
  branch.seconds = seconds;
  return branch;
}

/// What was brought in no time counts for nothing a second.
TEST(Regret, IsOfCellsAndOfCellsASecond) {
  BranchedDecision decision;
  decision.branches = {branch_that(3, 60, 12.0), branch_that(5, 90, 30.0), branch_that(8, 35, 5.0),
                       branch_that(9, 80, 0.0)};
  decision.branches[0].chosen = true;
  decision.branches.emplace_back().view = 11;
  const auto regret = regret_of(decision);
  ASSERT_TRUE(regret);
  EXPECT_EQ(regret->best_view, 5);
  EXPECT_EQ(regret->cells, 30.0);
  EXPECT_EQ(regret->fastest_view, 8);
  EXPECT_NEAR(regret->cells_per_s, 7.0 - 5.0, 1e-12);
}

TEST(BranchedText, OfSeveralDecisionsIsKeptInTheirOrder) {
  const support::TemporaryDirectory folder;
  BranchedDecision one = two_branches();
  BranchedDecision other = two_branches();
  one.scan = 12;
  other.scan = 9;
  keep_branches(folder.path(), {one, other});
  other.gain_unit = "bits";
  keep_branches(folder.path(), {two_branches(), other});
  const auto kept = TextJson::parse(read_file(folder / "branches.json"))["decisions"];
  ASSERT_EQ(kept.size(), 3U);
  EXPECT_EQ(kept[0]["scan"], 2);
  EXPECT_EQ(kept[1]["scan"], 9);
  EXPECT_EQ(kept[1]["gain_unit"], "bits");
  EXPECT_EQ(kept[2]["scan"], 12);
}

std::string way_it_differs(const StepRow& step) {
  const RecordedRun run = three_scans();
  try {
    RecordedDecisions(run).check(step);
  } catch (const ReplayDiffers& error) {
    return error.what();
  }
  return "not at all";
}

TEST(RecordedDecisions, SayHowAScanDiffers) {
  EXPECT_EQ(way_it_differs({.scan = 2, .time_s = 20.5, .cells_left = 20})
                .find("out/run: the repetition differs at scan 2: it ends at 20.5 s, recorded 20"),
            0U);
  EXPECT_EQ(way_it_differs({.scan = 3, .time_s = 30.0, .cells_left = 28})
                .find("out/run: the repetition differs at scan 3: 28 cells are left, recorded 30"),
            0U);
}

TEST(HindsightDefaults, OfScansAndBranchesAreOfNothing) {
  EXPECT_EQ(StepRow{}.scan, 0U);
  EXPECT_EQ(StepRow{}.time_s, 0.0);
  EXPECT_EQ(StepRow{}.path_length_m, 0.0);
  EXPECT_EQ(StepRow{}.cells_left, 0);
  EXPECT_EQ(StepRow{}.chosen_view, -1);
  EXPECT_FALSE(StepRow{}.fallback);
  EXPECT_FALSE(BranchRequest{}.all);
  EXPECT_EQ(BranchRequest{}.then, 0U);
  const Branch branch;
  EXPECT_EQ(branch.view, 0);
  EXPECT_FALSE(branch.chosen || branch.fallback);
  EXPECT_EQ(branch.gain + branch.seconds + branch.way_m + branch.seconds_then, 0.0);
  EXPECT_EQ(BranchedDecision{}.scan, 0U);
  EXPECT_EQ(BranchedDecision{}.then, 0U);
  EXPECT_EQ(Regret{}.best_view, 0);
  EXPECT_EQ(Regret{}.cells, 0.0);
  EXPECT_EQ(Regret{}.fastest_view, 0);
  EXPECT_EQ(Regret{}.cells_per_s, 0.0);
}

TEST(HindsightDefaults, OfRunsAndBoundsAreOfNothing) {
  const RecordedScan scan;
  EXPECT_EQ(scan.time_s, 0.0);
  EXPECT_EQ(scan.path_length_m, 0.0);
  EXPECT_EQ(scan.scan_time_s, 0.0);
  EXPECT_EQ(scan.cells_left, 0U);
  EXPECT_EQ(scan.chosen_view, -1);
  EXPECT_EQ(RecordedRun{}.observable_cells, 0U);
  EXPECT_EQ(ShareReached{}.scans, 0U);
  EXPECT_EQ(ShareReached{}.way_m, 0.0);
  EXPECT_EQ(ShareReached{}.time_s, 0.0);
  const ShareBound share;
  EXPECT_EQ(share.percent, 0);
  EXPECT_FALSE(share.exact_scans || share.exact_way || share.exact_time);
  EXPECT_EQ(share.given_cells, 0U);
  const RunBound bound;
  EXPECT_EQ(bound.poses, 0U);
  EXPECT_EQ(bound.observable_cells, 0U);
  EXPECT_EQ(bound.speed_m_s, 0.0);
  EXPECT_EQ(bound.scan_s, 0.0);
  EXPECT_FALSE(bound.has_oracle_tour);
}

/// Of a task that does not map too; a branch goes by another name than the method.
TEST(RecordedRuns, WereChosenOutsideIfTheirChoiceOrTheirNameIsAnothers) {
  RecordedRun run;
  for_each_task([&](const auto& task) {
    run.episode.task = task;
    run.method = method_name(run.episode.task);
    EXPECT_FALSE(was_chosen_outside(run)) << run.method;
    run.method += ", view 3 after scan 2";
    EXPECT_TRUE(was_chosen_outside(run)) << run.method;
  });
  Tabletop asking;
  asking.choice = ExternalChoice{};
  run.episode.task = asking;
  run.method = method_name(run.episode.task);
  EXPECT_TRUE(was_chosen_outside(run)) << run.method;
}

TEST(HindsightRecords, SayWhatEveryKeyMeansAndNoOther) {
  const test::Described described(hindsight_records());
  std::set<std::string> written;
  const auto take = [&](const std::string& file, const TextJson& json) {
    std::set<std::string> keys;
    test::collect_keys(nlohmann::json::parse(json.dump()), "", keys);
    for (const std::string& key : keys) {
      EXPECT_TRUE(described.has(file, key)) << file << ": " << key;
      written.insert(file + ":" + key);
    }
  };
  take("bound.json", run_bound_json(told_bound()));
  take("branches.json", {{"decisions", TextJson::array({branched_json(two_branches())})}});
  for (const RecordText& record : hindsight_records()) {
    const std::string name = std::string(record.file) + ":" + std::string(record.name);
    EXPECT_TRUE(written.contains(name)) << name << " is written nowhere";
  }
}

TEST(RecordedDecisions, HaveTheViewsThatTheyWereChosenFrom) {
  RecordedRun run = three_scans();
  EXPECT_EQ(run.scans[1].candidates, 0) << "unless told";
  run.scans[1].candidates = 7;
  for (const int view : {0, 6}) EXPECT_NO_THROW(require_view(run, 1, view)) << view;
  for (const int view : {-1, 7}) {
    try {
      require_view(run, 1, view);
      ADD_FAILURE() << view;
    } catch (const ConfigError& error) {
      EXPECT_EQ(error.what(),
                "--view: " + std::to_string(view) + ": the decision after scan 1 has views 0 to 6");
    }
  }
}

TEST(HindsightRecords, TellOfBoundsBeforeBranches) {
  const RecordTexts records = hindsight_records();
  EXPECT_EQ(records.front().file, "bound.json");
  EXPECT_EQ(records.back().file, "branches.json");
}

TEST(BranchedText, IsKeptBesideWhatTellsOfNoScan) {
  const support::TemporaryDirectory folder;
  write_file(folder / "branches.json",
             R"({"decisions": [{"scan": 5}, {}, {"scan": -3}, {"scan": "two"}]})");
  keep_branches(folder.path(), {two_branches()});
  const auto kept = TextJson::parse(read_file(folder / "branches.json"))["decisions"];
  ASSERT_EQ(kept.size(), 5U);
  EXPECT_EQ(kept[0], TextJson::object());
  EXPECT_EQ(kept[1]["scan"], -3);
  EXPECT_EQ(kept[2]["scan"], "two");
  EXPECT_EQ(kept[3]["scan"], 2);
  EXPECT_EQ(kept[4]["scan"], 5);
}

TEST(Regret, OfWhatBroughtNothingIsNone) {
  BranchedDecision decision;
  decision.branches = {branch_that(3, 0, 10.0), branch_that(5, 0, 5.0)};
  decision.branches[0].chosen = true;
  decision.branches[1].cells.reset();
  const auto regret = regret_of(decision);
  ASSERT_TRUE(regret);
  EXPECT_EQ(regret->best_view, 3);
  EXPECT_EQ(regret->cells, 0.0);
  EXPECT_EQ(regret->fastest_view, 3);
  EXPECT_EQ(regret->cells_per_s, 0.0);
}

/// 29 % of 100 cells are a rounding below 29.
TEST(ProgressTo, CountsWholeCells) {
  RecordedRun run;
  run.observable_cells = 100;
  run.scans.emplace_back().cells_left = 30;
  EXPECT_EQ(progress_to(run, 71), std::nullopt);
  run.scans.back().cells_left = 29;
  EXPECT_TRUE(progress_to(run, 71));
  run.observable_cells = 10;
  run.scans.back().cells_left = 1;
  EXPECT_EQ(progress_to(run, 97), std::nullopt) << "not one may be left";
  run.scans.back().cells_left = 0;
  EXPECT_TRUE(progress_to(run, 97));
}

}  // namespace
}  // namespace vantage
