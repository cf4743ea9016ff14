// Robots that are given by a folder alone, in the tasks for their kind.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <regex>

#include "tests/support/temporary_directory.hpp"
#include "tests/tasks/replayed.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/tasks/run.hpp"
#include "vantage/tasks/validate.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

const fs::path kSource = VANTAGE_SOURCE_DIR;
const std::string kRover = "robot.model=models/robots/rover";

fs::path episode_file(const std::string& name) {
  return kSource / "assets/episodes" / (name + ".yaml");
}

json run_short(const std::string& episode, const fs::path& out, std::vector<std::string> more) {
  set_verbosity(Verbosity::quiet);
  more.insert(more.end(), {"scans=3", "metrics.pose_spacing_m=2"});
  return json::parse(
      run(load_episode(episode_file(episode), more), {out, true, false, {}}).metrics);
}

json run_tabletop(const fs::path& out, std::vector<std::string> more) {
  more.insert(more.end(), {"map.cells=[65,65,33]", "laser.scan_duration_s=3",
                           "candidates.yaw_offsets_rad=[0]"});
  return run_short("tabletop", out, std::move(more));
}

void expect_progress(const json& metrics) {
  EXPECT_EQ(metrics["status"], "completed");
  EXPECT_EQ(metrics["collisions"], 0);
  EXPECT_GT(metrics["path_length_m"], 0.5);
  ASSERT_EQ(metrics["scans"].size(), 3U);
  const double observable = metrics["observable_cells"];
  double left = observable;
  for (const json& scan : metrics["scans"]) {
    EXPECT_LT(scan["observable_unobserved_cells"].get<double>(), left - 0.02 * observable);
    EXPECT_LT(scan["pose_error_m"], 0.02);
    EXPECT_FALSE(scan["fallback"]);
    left = scan["observable_unobserved_cells"];
  }
}

TEST(Robots, ASmallDifferentialDriveScansATableTop) {
  const support::TemporaryDirectory folder;
  const json metrics = run_tabletop(folder.path() / "run", {kRover});
  expect_progress(metrics);
  EXPECT_GT(metrics["map"]["precision"], 0.9);
  const ReplayResult again = support::replayed(folder.path() / "run");
  EXPECT_FALSE(again.first_difference) << again.what;
}

TEST(Robots, ASmallDifferentialDriveExploresAnOffice) {
  const support::TemporaryDirectory folder;
  const json metrics = run_short("office_small", folder.path() / "run",
                                 {kRover, "map.cells=[100,67,20]", "camera.width_px=160",
                                  "camera.height_px=120", "stride_px=1"});
  expect_progress(metrics);
  EXPECT_GT(metrics["map"]["precision"], 0.95);
}

/// A robot outside the repository whose joints have names of their own.
fs::path own_robot(const fs::path& folder) {
  const auto renamed = [](const fs::path& file) {
    return std::regex_replace(read_file(file), std::regex("robot/(left|right)_wheel"),
                              "robot/drive_$1");
  };
  const fs::path rover = kSource / "models/robots/rover";
  fs::create_directories(folder);
  write_file(folder / "robot.yaml", renamed(rover / "robot.yaml"));
  write_file(folder / "rover.xml", renamed(rover / "rover.xml"));
  return folder;
}

TEST(Robots, AFolderAnywhereIsEnough) {
  const support::TemporaryDirectory folder;
  const fs::path own = own_robot(folder.path() / "mine");
  const Validation found = validate_file(own);
  EXPECT_TRUE(found.problems.empty()) << found.problems.front();
  const json mine = run_tabletop(folder.path() / "run", {"robot.model=" + own.string()});
  expect_progress(mine);
  const json rover = run_tabletop(folder.path() / "rover", {kRover});
  EXPECT_EQ(mine["state_hash"], rover["state_hash"]) << "names do not matter";
  EXPECT_THAT(read_file(folder.path() / "run" / "config.yaml"), HasSubstr(own.string()));
  EXPECT_THAT(read_file(folder.path() / "run" / "manifest.json"), HasSubstr("robot.yaml"));
}

TEST(Robots, ValidateSaysWhatARobotLacks) {
  const support::TemporaryDirectory folder;
  const fs::path own = own_robot(folder.path());
  write_file(own / "robot.yaml",
             std::regex_replace(read_file(own / "robot.yaml"), std::regex("drive_left"), "lost"));
  for (const fs::path& file : {own, own / "robot.yaml"}) {
    const Validation found = validate_file(file);
    ASSERT_EQ(found.problems.size(), 1U);
    EXPECT_THAT(found.problems[0], AllOf(HasSubstr("robot.yaml: drive.left_wheel"),
                                         HasSubstr("no joint 'robot/lost'")));
  }
}

void replace_in(const fs::path& file, const std::string& from, const std::string& to) {
  std::string text = read_file(file);
  const auto at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  write_file(file, text.replace(at, from.size(), to));
}

TEST(Robots, ValidateSaysWhichDefaultsFitItsSensors) {
  const support::TemporaryDirectory folder;
  const fs::path own = own_robot(folder.path());
  EXPECT_TRUE(validate_file(own).notes.empty());
  replace_in(own / "rover.xml", "pos=\"0.03 0 1.05\"", "pos=\"0.03 0 0.7\"");
  const Validation low = validate_file(own);
  EXPECT_TRUE(low.problems.empty());
  ASSERT_EQ(low.notes.size(), 1U);
  EXPECT_THAT(low.notes[0],
              AllOf(HasSubstr("robot.yaml: note: task tabletop: candidates.height_m: 1.05"),
                    HasSubstr("{tabletop: {candidates: {height_m: 0.700}}}")));
  const std::string exploration = "exploration: {frontiers: {height_m: 1.2}";
  replace_in(own / "robot.yaml", exploration,
             "tabletop: {candidates: {height_m: 0.700}}\n  " + exploration);
  const Validation cured = validate_file(own);
  EXPECT_TRUE(cured.problems.empty() && cured.notes.empty());
}

TEST(Robots, DefaultsThatItsSensorsCannotReachAreAProblem) {
  const support::TemporaryDirectory folder;
  const fs::path own = own_robot(folder.path());
  replace_in(own / "robot.yaml", "height_m: 1.2}", "height_m: 1.4}");
  const Validation high = validate_file(own);
  ASSERT_EQ(high.problems.size(), 1U);
  EXPECT_THAT(high.problems[0], AllOf(HasSubstr("frontiers.height_m: 1.4"),
                                      HasSubstr("{exploration: {frontiers: {height_m: 1.200}}}")));
  replace_in(own / "robot.yaml", "height_m: 1.4}", "hight_m: 1.2}");
  const Validation unknown = validate_file(own);
  ASSERT_FALSE(unknown.problems.empty());
  EXPECT_THAT(unknown.problems[0], HasSubstr("hight_m"));
  replace_in(own / "robot.yaml", "exploration: {", "explore: {");
  const Validation task = validate_file(own);
  ASSERT_FALSE(task.problems.empty());
  EXPECT_THAT(task.problems[0], HasSubstr("no task 'explore'; known: tabletop"));
  EXPECT_EQ(task.code, ExitCode::usage);
}

TEST(Robots, TheMjcfInTheFolderNamesTheSameRobot) {
  const auto file =
      load_episode(episode_file("tabletop"), {"robot.model=models/robots/pr2/pr2.xml"});
  const auto folder = load_episode(episode_file("tabletop"), {"robot.model=models/robots/pr2"});
  const auto none = load_episode(episode_file("tabletop"), {});
  EXPECT_EQ(file.setup.robot.mjcf, folder.setup.robot.mjcf);
  EXPECT_EQ(file.setup.robot.description, folder.setup.robot.description);
  EXPECT_EQ(folder.setup.options.robot.model, none.setup.options.robot.model);
}

TEST(Robots, TheKindMustSuitTheTask) {
  const auto complaint = [](const std::string& episode, const std::string& robot) -> std::string {
    try {
      load_episode(episode_file(episode), {"robot.model=models/robots/" + robot});
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(complaint("tabletop", "quadrotor"),
              AllOf(HasSubstr("robot.model"), HasSubstr("is a quadrotor"),
                    HasSubstr("needs a mobile_base")));
  EXPECT_THAT(complaint("office_small", "quadrotor_mini"), HasSubstr("needs a mobile_base"));
  EXPECT_THAT(complaint("recognition", "rover"),
              AllOf(HasSubstr("is a mobile_base"), HasSubstr("needs a quadrotor")));
}

TEST(Robots, WhatTheEpisodeLeavesOutTheRobotKnows) {
  const auto load = [](const std::string& robot, std::vector<std::string> more) {
    more.push_back("robot.model=models/robots/" + robot);
    return std::get<Exploration>(load_episode(episode_file("office_small"), more).task);
  };
  EXPECT_EQ(load("pr2", {}).navigation.footprint_radius_m, 0.48);
  EXPECT_EQ(load("rover", {}).navigation.footprint_radius_m, 0.19);
  EXPECT_EQ(load("rover", {"navigation.footprint_radius_m=0.3"}).navigation.footprint_radius_m,
            0.3);
  EXPECT_EQ(load("rover", {"navigation.margin_m=0.1"}).navigation.footprint_radius_m, 0.19);
  EXPECT_EQ(load("pr2", {}).frontiers.height_m, 1.47);
  EXPECT_EQ(load("rover", {}).frontiers.height_m, 1.2);
  EXPECT_EQ(load("rover", {"frontiers.min_cells=7"}).frontiers.height_m, 1.2);
}

TEST(Robots, PathsMustLeaveRoomForTheRobot) {
  const support::TemporaryDirectory folder;
  try {
    run_tabletop(folder.path() / "run", {kRover, "navigation.footprint_radius_m=0.1"});
    FAIL() << "expected an error";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("navigation.footprint_radius_m: 0.1"),
                                    HasSubstr("circumscribed_radius_m 0.18")));
  }
}

TEST(Robots, ReachNoFartherThanTheySay) {
  const support::TemporaryDirectory folder;
  const fs::path own = own_robot(folder / "mine");
  replace_in(own / "robot.yaml", "circumscribed_radius_m: 0.18", "circumscribed_radius_m: 0.172");
  try {
    run_tabletop(folder / "run", {"robot.model=" + own.string()});
    FAIL() << "expected an error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("footprint.circumscribed_radius_m 0.172 is less than its outline"));
  }
}

}  // namespace
}  // namespace vantage
