// Whole short episodes: the same seed gives the same bytes, and replay proves it.
#include "vantage/tasks/run.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "tests/support/csv_column.hpp"
#include "tests/support/overrides.hpp"
#include "tests/tasks/replayed.hpp"
#include "tests/tasks/undescribed.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/log.hpp"
#include "vantage/report/report_data.hpp"
#include "vantage/runtime/log/video.hpp"
#include "vantage/tasks/mapping/drawing/map_panel.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using support::replayed;

void drop_wall_times(nlohmann::json& json) {
  for (const char* key : {"wall_time_s", "real_time_factor"}) json.erase(key);
  for (auto& scan : json["scans"]) {
    scan.erase("plan_time_s");
    scan.erase("map_time_s");
  }
}

class Run : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    set_verbosity(Verbosity::quiet);
    folder_ = fs::temp_directory_path() / fmt::format("vantage-run-{}", ::getpid());
    first_ = short_run("first", {});
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  static ResolvedEpisode short_episode(const std::vector<std::string>& more) {
    std::vector<std::string> overrides = {"scans=2", "map.cells=[49,49,25]",
                                          "laser.scan_duration_s=3"};
    overrides = support::overridden(std::move(overrides), more);
    return load_episode(fs::path(VANTAGE_SOURCE_DIR) / "assets/episodes/tabletop.yaml", overrides);
  }
  static nlohmann::json short_run(const std::string& name, const std::vector<std::string>& more) {
    const auto outcome = run(short_episode(more), {folder_ / name, false, false, {}});
    return nlohmann::json::parse(outcome.metrics);
  }
  static fs::path copy_of_first(const std::string& name) {
    fs::copy(folder_ / "first", folder_ / name, fs::copy_options::recursive);
    return folder_ / name;
  }

  static inline fs::path folder_;
  static inline nlohmann::json first_;
};

TEST_F(Run, SameSeedSameBytes) {
  auto second = short_run("second", {"threads=1"});
  auto first = first_;
  drop_wall_times(first);
  drop_wall_times(second);
  EXPECT_EQ(first.dump(2), second.dump(2));
  for (const char* name :
       {"states.bin", "actions.csv", "trajectory.tum", "trajectory_estimated.tum", "map.bt",
        "map.ot", "cloud.ply", "voxels.bin", "story.bin"}) {
    EXPECT_EQ(read_file(folder_ / "first" / name), read_file(folder_ / "second" / name)) << name;
  }
}

TEST_F(Run, PathLengthIsATotalAndScansCountFromOne) {
  double sum_m = 0.0;
  for (const auto& scan : first_["scans"]) {
    sum_m += scan["leg_length_m"].get<double>();
    EXPECT_NEAR(scan["path_length_m"].get<double>(), sum_m, 1e-9);
  }
  EXPECT_GT(first_["scans"][1]["leg_length_m"], 0.01);
  EXPECT_NEAR(first_["path_length_m"].get<double>(), sum_m, 1e-9) << "it ends with a scan";
  const CsvTable steps = read_csv(folder_ / "first" / "steps.csv");
  ASSERT_EQ(steps.columns[1], "scan");
  EXPECT_EQ(steps.rows[0][1], "1");
  EXPECT_EQ(steps.rows[1][1], "2");
}

TEST_F(Run, KeepsWhatEachDecisionWasMadeAmong) {
  const CsvTable table = read_csv(folder_ / "first" / "candidates.csv");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"decision", "candidate", "x_m", "y_m", "z_m",
                                                     "yaw_rad", "pitch_rad", "gain", "gain_unit",
                                                     "predicted_cells", "way_m", "chosen"}));
  ASSERT_EQ(table.rows.size(), 30U) << "one decision between two scans";
  const auto chosen =
      std::ranges::find(table.rows, "1", [](const auto& row) { return row.back(); });
  ASSERT_NE(chosen, table.rows.end());
  EXPECT_EQ(std::ranges::count(table.rows, "1", [](const auto& row) { return row.back(); }), 1);
  const CsvTable steps = read_csv(folder_ / "first" / "steps.csv");
  EXPECT_EQ((*chosen)[1], steps.rows[1][support::column_index(steps, "chosen_view")]);
  for (const auto& row : table.rows) {
    EXPECT_EQ(row[0], "1");
    EXPECT_EQ(row[8], "bits");
    EXPECT_EQ(row[9], row[7]) << "the gain in use predicts cells";
    EXPECT_LE(std::stod(row[7]), std::stod((*chosen)[7]));
  }
  EXPECT_GT(std::stod((*chosen)[10]), 0.01);
  for (const char* axis : {"x_m", "y_m", "z_m", "yaw_rad"}) {
    EXPECT_NEAR(std::stod(steps.rows[1][support::column_index(steps, axis)]),
                std::stod((*chosen)[support::column_index(table, axis)]), 0.1)
        << axis;
  }
}

TEST_F(Run, SaysWhichLimitEndedIt) { EXPECT_EQ(first_["reason"], "limit of 2 scans"); }

TEST_F(Run, HoldsEachScanAfterTheFirstAgainstItsForecast) {
  EXPECT_TRUE(first_["scans"][0]["forecast"].is_null());
  const auto& scan = first_["scans"][1];
  double predicted = 0.0;
  double actual = 0.0;
  for (const auto& band : scan["by_distance"]) {
    predicted += band["predicted_cells"].get<double>();
    actual += band["actual_cells"].get<double>();
  }
  EXPECT_GT(predicted, 0.0);
  EXPECT_DOUBLE_EQ(scan["forecast"]["cells"].get<double>(), predicted);
  EXPECT_DOUBLE_EQ(scan["actual_new_cells"].get<double>(), actual);
}

TEST_F(Run, CountsTheTimeOfADecisionFromItsBeginning) {
  EXPECT_EQ(first_["scans"][0]["plan_time_s"], 0.0) << "none led there";
  const double plan_time_s = first_["scans"][1]["plan_time_s"];
  EXPECT_GT(plan_time_s, 0.0);
  EXPECT_LT(plan_time_s, first_["wall_time_s"].get<double>());
}

TEST_F(Run, GoingByWaysAloneTakesNoViewTwice) {
  const auto run = short_run("by_ways", {"choice=nearest_frontier", "scans=5"});
  std::set<int> taken;
  for (const auto& scan : run["scans"]) taken.insert(scan["chosen_view"].get<int>());
  EXPECT_EQ(taken.size(), 5U);
  EXPECT_GT(run["path_length_m"], 0.5) << "it leaves where it stands";
}

TEST_F(Run, AnotherSeedAnotherEpisode) {
  const auto other = short_run("other", {"seed=2"});
  EXPECT_NE(first_["state_hash"], other["state_hash"]);
}

TEST_F(Run, RecordsTheWantedPredictorsAndItsOwn) {
  const auto metrics = short_run(
      "predictors", {"scans=1", "metrics.predictors=[simple, {name: beer_lambert, a: 0.9}]",
                     "gain=beer_lambert", "gain.a=0.8"});
  EXPECT_EQ(metrics["method"], "beer_lambert a=0.8");
  const auto& predicted = metrics["scans"][0]["predicted"];
  EXPECT_EQ(predicted.size(), 3U);
  EXPECT_GT(predicted.at("beer_lambert a=0.8"), 0.0);
  EXPECT_LT(predicted.at("beer_lambert a=0.8"), predicted.at("beer_lambert a=0.9"));
  EXPECT_LT(predicted.at("beer_lambert a=0.9"), predicted.at("simple"));
}

TEST_F(Run, WritesTheWholeFolder) {
  for (const char* name :
       {"manifest.json", "config.yaml", "steps.csv", "candidates.csv", "metrics.json",
        "trajectory.tum", "trajectory_estimated.tum", "states.bin", "actions.csv", "map.bt",
        "map.ot", "cloud.ply", "story.bin", "report.html", "log.txt"}) {
    EXPECT_TRUE(fs::exists(folder_ / "first" / name)) << name;
  }
  for (const auto& entry : fs::directory_iterator(folder_ / "first")) {
    EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
  }
}

TEST_F(Run, ItsFolderIsNoOtherProcessesFolderMeanwhile) {
  const fs::path shared = folder_ / "shared";
  fs::create_directories(shared);
  const int other = ::open(shared.c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(::flock(other, LOCK_EX | LOCK_NB), 0);
  try {
    short_run("shared", {"scans=1"});
    ADD_FAILURE() << "it ran into the folder";
  } catch (const OutputError& error) {
    EXPECT_NE(std::string(error.what()).find("another process runs into it"), std::string::npos);
  }
  EXPECT_TRUE(fs::is_empty(shared));
  ::close(other);
  EXPECT_EQ(short_run("shared", {"scans=1"})["status"], "completed");
  const int again = ::open(shared.c_str(), O_RDONLY | O_DIRECTORY);
  EXPECT_EQ(::flock(again, LOCK_EX | LOCK_NB), 0) << "it is given back";
  ::close(again);
}

TEST_F(Run, KeepsItsFolderUntilTheReportIsWritten) {
  const fs::path held = folder_ / "held";
  fs::create_directories(held / "report.part.html");  // in the report's way
  EXPECT_THROW(short_run("held", {"scans=1"}), OutputError);
  EXPECT_TRUE(fs::exists(held / "map.bt"));
  const int other = ::open(held.c_str(), O_RDONLY | O_DIRECTORY);
  EXPECT_NE(::flock(other, LOCK_EX | LOCK_NB), 0);
  ::close(other);
}

TEST_F(Run, AVideoThatFailsCostsNothingElse) {
  if (const auto missing = missing_video_codec(); !missing.empty()) GTEST_SKIP() << missing;
  RunOptions options;
  options.directory = folder_ / "unfilmed";
  options.video = true;
  options.spectator.on_step = [&](std::string_view, std::string_view) {
    fs::create_directories(options.directory / "video.mp4");  // in the video's way
  };
  EXPECT_THROW(run(short_episode({"scans=1", "recording.height_px=240"}), options), OutputError);
  for (const char* name :
       {"metrics.json", "map.bt", "map.ot", "cloud.ply", "voxels.bin", "report.html"}) {
    EXPECT_TRUE(fs::exists(options.directory / name)) << name;
  }
}

TEST_F(Run, WhatItWritesIsDescribed) {
  EXPECT_EQ(test::undescribed(folder_ / "first", Tabletop::records()), std::vector<std::string>{});
}

TEST_F(Run, ReplayReachesTheSameStates) {
  const ReplayResult result = replayed(folder_ / "first");
  EXPECT_FALSE(result.first_difference) << result.what;
  EXPECT_GT(result.ticks, 100U);
  EXPECT_EQ(fmt::format("{:016x}", result.state_hash), first_["state_hash"]);
}

TEST_F(Run, ReplayNamesTheStepOfAnyChangedByte) {
  const fs::path changed = copy_of_first("changed");
  const std::string original = read_file(changed / "actions.csv");
  const std::size_t header = original.find('\n') + 1;
  for (const std::size_t at : {std::size_t{2}, header, header + 4, original.size() / 2,
                               original.size() / 3, original.size() - 2, original.size() - 1}) {
    std::string bytes = original;
    bytes[at] = bytes[at] == '7' ? '3' : '7';
    write_file(changed / "actions.csv", bytes);
    const ReplayResult result = replayed(changed);
    ASSERT_TRUE(result.first_difference) << "byte " << at;
    const auto line_start = original.rfind('\n', at == 0 ? 0 : at - 1);
    if (at >= header && original[at] != '\n') {
      const auto tick = std::stoull(original.substr(line_start + 1));
      EXPECT_LE(*result.first_difference, tick) << "byte " << at << ": " << result.what;
      const auto previous = original.rfind('\n', line_start - 1);
      if (previous != std::string::npos) {
        EXPECT_GE(*result.first_difference, std::stoull(original.substr(previous + 1))) << at;
      }
    }
  }
}

TEST_F(Run, ReplayNamesFilesThatChanged) {
  EXPECT_TRUE(replayed(folder_ / "first").changed_files.empty());
  const fs::path other = copy_of_first("other_scene");
  auto manifest = nlohmann::json::parse(read_file(other / "manifest.json"));
  manifest["assets"]["scene.xml"] = "0";
  write_file(other / "manifest.json", manifest.dump());
  const ReplayResult result = replayed(other);
  EXPECT_EQ(result.changed_files, std::vector<std::string>{"scene.xml"});
  EXPECT_FALSE(result.first_difference) << "the states agree all the same";
}

/// A run is of the data root's scene, whatever the working directory has under that name.
TEST_F(Run, WhatWasRecordedIsFoundInTheDataRootFirst) {
  const ResolvedEpisode recorded = load_recorded(folder_ / "first");
  // Of a scene outside of the data root the path is absolute, and must not be written to.
  const fs::path decoy = folder_ / "decoy" / fs::path(recorded.setup.options.scene).relative_path();
  fs::create_directories(decoy.parent_path());
  write_file(decoy, "<mujoco/>");
  const fs::path before = fs::current_path();
  fs::current_path(folder_ / "decoy");
  const fs::path found = load_recorded(folder_ / "first").setup.scene;
  fs::current_path(before);
  EXPECT_EQ(found, recorded.setup.scene);
}

TEST_F(Run, ReplayRefusesActionsAndKeysOfAnotherKind) {
  const fs::path other = copy_of_first("other_kind");
  const std::string actions = read_file(other / "actions.csv");
  for (const std::string& content :
       {std::string(), std::string("tick,a\n"), actions.substr(0, actions.find('\n')) + "\r\n"}) {
    write_file(other / "actions.csv", content);
    EXPECT_THROW(replayed(other), InputError);
  }
  write_file(other / "actions.csv", actions);
  write_file(other / "config.yaml", read_file(other / "config.yaml") + "old_key: 1\n");
  EXPECT_THROW(replayed(other), InputError);
}

TEST_F(Run, ReplayRefusesATruncatedLog) {
  const fs::path cut = copy_of_first("cut");
  fs::resize_file(cut / "states.bin", fs::file_size(cut / "states.bin") - 3);
  EXPECT_THROW(replayed(cut), InputError);
  fs::remove(cut / "states.bin");
  EXPECT_THROW(replayed(cut), InputError);
}

/// By what was seen where the scan was forecast to look: if that is more than forecast, there is
/// less clutter than was thought.
TEST_F(Run, CorrectsItsHazardByWhatAScanHasShown) {
  const auto metrics = short_run("calibrated", {"forecast.calibrate=true"});
  EXPECT_EQ(metrics["scans"][0]["hazard_scale"], 1.0);
  const auto& scan = metrics["scans"][1];
  double predicted = 0.0;
  double seen = 0.0;
  for (const auto& band : scan["by_distance"]) {
    predicted += band["predicted_cells"].get<double>();
    seen += band["actual_cells"].get<double>() - band["outside_cells"].get<double>();
  }
  EXPECT_NE(scan["hazard_scale"], 1.0);
  EXPECT_EQ(scan["hazard_scale"].get<double>() < 1.0, seen > predicted);
}

TEST_F(Run, WithoutLoopsNothingIsCorrectedOverThem) {
  const auto& localisation = first_["localisation"];
  for (const char* key : {"loops", "loops_refused", "corrections"}) {
    EXPECT_EQ(localisation[key], 0) << key;
  }
  EXPECT_TRUE(localisation["contradicted_share"].is_null());
}

TEST_F(Run, EnergyIsATotalUpToEachScan) {
  double before_j = 0.0;
  for (const auto& scan : first_["scans"]) {
    EXPECT_GT(scan["energy_j"].get<double>(), before_j);
    before_j = scan["energy_j"].get<double>();
  }
  EXPECT_NEAR(first_["energy_j"].get<double>(), before_j, 1e-9) << "it ends with a scan";
}

/// 20 ticks of 25 ms until the laser rests, 120 of the sweep, and one for its last line.
TEST_F(Run, AScanTakesItsSweepAndTheTimeToComeToRest) {
  for (const auto& scan : first_["scans"]) {
    EXPECT_NEAR(scan["scan_time_s"].get<double>(), 0.5 + 3.0 + 0.025, 1e-6);
  }
}

/// On the card in the right half of a still.
TEST_F(Run, ItsPanelHasTheFiguresOfTheLastScan) {
  if (const auto missing = missing_video_codec(); !missing.empty()) GTEST_SKIP() << missing;
  RunOptions options;
  options.directory = folder_ / "filmed";
  options.video = true;
  const RunOutcome outcome = run(short_episode({"scans=1", "recording.video_speed=100"}), options);
  const nlohmann::json metrics = nlohmann::json::parse(outcome.metrics);
  const nlohmann::json& scan = metrics["scans"][0];
  const OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.5}, {1.0, 1.0, 1.0}, {4, 4, 4}));
  MapPanelInput input;
  input.grid = &grid;
  input.observable_unobserved_cells = {scan["observable_unobserved_cells"].get<double>()};
  input.predicted_new_cells = scan["predicted"]["adaptive"].get<double>();
  input.actual_new_cells = scan["actual_new_cells"].get<double>();
  ASSERT_GT(input.predicted_new_cells, 0.0);
  const cv::Mat still = cv::imread((options.directory / "frames/scan_01.png").string());
  ASSERT_EQ(still.size(), cv::Size(1280, 720));
  const cv::Rect figures(430, 530, 180, 160);
  const cv::Mat shown = still(cv::Rect(640, 0, 640, 720))(figures);
  const cv::Mat expected = draw_map_panel(input, {640, 720})(figures);
  EXPECT_EQ(cv::norm(shown, expected, cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace vantage
