// The command line as a user meets it: exit codes, one clear line, nothing half-written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace vantage {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

struct Result {
  int exit_code = -1;
  std::string output;  ///< stdout and stderr
};

Result shell(const std::string& command) {
  Result result;
  FILE* pipe = ::popen(("{ " + command + "; } 2>&1").c_str(), "r");
  std::array<char, 4096> buffer{};
  for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    result.output.append(buffer.data(), n);
  }
  const int status = ::pclose(pipe);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

class CommandLine : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("vantage-cli-" + std::string(test->name()) + "-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string file(const std::string& name, const std::string& content) {
    std::ofstream(folder_ / name) << content;
    return (folder_ / name).string();
  }
  Result vantage(const std::string& arguments) {
    return shell("cd '" + folder_.string() + "' && " VANTAGE_BINARY " " + arguments);
  }
  /// Exit code, every one of `parts` in the message, one line.
  void expect_error(const Result& result, int exit_code, const std::vector<std::string>& parts) {
    EXPECT_EQ(result.exit_code, exit_code) << result.output;
    for (const auto& part : parts) EXPECT_THAT(result.output, HasSubstr(part));
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
  }
  /// Files under final names in the default run folder.
  std::vector<std::string> written() {
    std::vector<std::string> names;
    std::error_code error;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "out", error)) {
      if (entry.is_regular_file()) names.push_back(entry.path().filename().string());
    }
    return names;
  }

  fs::path folder_;
  static constexpr const char* kShort =
      "--set scans=1 --set laser.scan_duration_s=2 --set 'map.cells=[33,33,17]' -q ";
};

TEST_F(CommandLine, UnknownKey) {
  const auto episode = file("e.yaml", "scans: 3\nscnas: 4\n");
  expect_error(vantage("run " + episode), 2, {"e.yaml:2", "scnas", "scans"});
}

TEST_F(CommandLine, DuplicateKey) {
  const auto episode = file("e.yaml", "scans: 3\nseed: 1\nscans: 4\n");
  expect_error(vantage("run " + episode), 2, {"e.yaml:3", "scans", "duplicate"});
}

TEST_F(CommandLine, WrongType) {
  const auto episode = file("e.yaml", "scans: many\n");
  expect_error(vantage("run " + episode), 2, {"e.yaml:1", "scans", "many"});
}

TEST_F(CommandLine, Infinity) {
  const auto episode = file("e.yaml", "laser:\n  noise_sigma_m: .inf\n");
  expect_error(vantage("run " + episode), 2, {"e.yaml:2", "laser.noise_sigma_m", ".inf"});
}

TEST_F(CommandLine, UnknownGain) {
  expect_error(vantage("run --set gain=adaptiv"), 2, {"gain", "adaptiv", "adaptive"});
}

TEST_F(CommandLine, MissingFile) { expect_error(vantage("run nowhere.yaml"), 3, {"nowhere.yaml"}); }

TEST_F(CommandLine, MissingScene) {
  const auto episode = file("e.yaml", "scans: 1\nscene: no/such.xml\n");
  expect_error(vantage("run " + episode), 3, {"e.yaml:2", "scene", "no/such.xml"});
}

TEST_F(CommandLine, MalformedScene) {
  const auto scene =
      file("broken.xml", "<mujoco>\n  <worldbody>\n    <geom type='bix'/>\n</mujoco>");
  expect_error(vantage("run -q --set scene=" + scene), 3, {"broken.xml"});
  EXPECT_EQ(vantage("validate " + scene).exit_code, 3);
}

TEST_F(CommandLine, SceneWithoutTable) {
  const auto scene = file(
      "bare.xml", "<mujoco><worldbody><geom type='plane' size='5 5 .1'/></worldbody></mujoco>");
  expect_error(vantage(std::string("run ") + kShort + "--set scene=" + scene), 3,
               {"bare.xml", "no table"});
  EXPECT_THAT(written(), testing::Not(testing::Contains("metrics.json")));
  const auto episode = file("e.yaml", "scene: bare.xml\n");
  expect_error(vantage("validate " + episode), 3, {"e.yaml", "bare.xml", "no table"});
}

TEST_F(CommandLine, DivergedEpisodeIsARecordedResult) {
  // A spring that pushes away from rest: the ball runs off exponentially.
  const auto scene = file("unstable.xml", R"(<mujoco><worldbody>
    <geom type="plane" size="5 5 .1"/>
    <geom type="box" size=".5 .5 .02" pos="0 0 .7"/>
    <body pos="3 3 1"><joint type="slide" axis="1 0 0" stiffness="-30" springref="-0.01"/>
      <geom size=".05" mass="1" contype="0" conaffinity="0"/></body>
  </worldbody></mujoco>)");
  const Result result = vantage(std::string("run ") + kShort + "--set scene=" + scene);
  EXPECT_EQ(result.exit_code, 4) << result.output;
  EXPECT_THAT(result.output, HasSubstr("the simulation diverged at"));
  const Result metrics = shell("cat '" + folder_.string() + "'/out/*/metrics.json");
  EXPECT_THAT(metrics.output, HasSubstr("\"status\": \"diverged\""));
  EXPECT_THAT(written(), testing::IsSupersetOf({"states.bin", "actions.csv", "report.html"}));
}

TEST_F(CommandLine, EmptyMap) {
  const auto map = file("empty.bt", "");
  expect_error(vantage("validate " + map), 3, {"empty.bt"});
}

TEST_F(CommandLine, OutputNotADirectory) {
  const auto blocker = file("blocker", "x");
  expect_error(vantage(std::string("run ") + kShort + "--out " + blocker + "/run"), 5, {"blocker"});
}

TEST_F(CommandLine, FullDisk) {
  // A file size limit fails the write as a full disk does.
  const Result result =
      shell("cd '" + folder_.string() +
            "' && trap '' XFSZ && ulimit -f 8 && " VANTAGE_BINARY " run " + kShort);
  EXPECT_EQ(result.exit_code, 5) << result.output;
  EXPECT_THAT(result.output, HasSubstr("cannot write"));
  const auto left = written();
  for (const auto& name : left) EXPECT_THAT(name, testing::Not(HasSubstr(".part")));
  EXPECT_THAT(left, testing::Not(testing::Contains("metrics.json")));
}

TEST_F(CommandLine, SecondRunNeedsOverwrite) {
  const std::string run = std::string("run ") + kShort;
  ASSERT_EQ(vantage(run).exit_code, 0);
  expect_error(vantage(run), 2, {"--overwrite"});
  EXPECT_EQ(vantage(run + "--overwrite").exit_code, 0);
}

TEST_F(CommandLine, InterruptedRunWritesWhatThereIs) {
  const Result result =
      shell("cd '" + folder_.string() +
            "' && timeout --preserve-status -s INT 4 " VANTAGE_BINARY " run -q --json");
  EXPECT_EQ(result.exit_code, 130) << result.output;
  EXPECT_THAT(result.output, HasSubstr("\"status\": \"interrupted\""));
  EXPECT_THAT(written(), testing::IsSupersetOf({"metrics.json", "report.html", "states.bin"}));
}

TEST_F(CommandLine, InterruptedScanIsNotFinished) {
  // An hour of scanning: no machine is through with it after four seconds.
  const Result result = shell("cd '" + folder_.string() +
                              "' && timeout --preserve-status -s INT 4 " VANTAGE_BINARY
                              " run -q --json --set laser.scan_duration_s=3600 --out run");
  EXPECT_EQ(result.exit_code, 130) << result.output;
  EXPECT_THAT(result.output, HasSubstr("\"scans\": []"));
  EXPECT_EQ(vantage("replay run").exit_code, 0);
  EXPECT_EQ(vantage("report run").exit_code, 0);
}

TEST_F(CommandLine, TerminatedRunEndsIn143) {
  const Result result = shell("cd '" + folder_.string() +
                              "' && timeout --preserve-status -s TERM 4 " VANTAGE_BINARY " run -q");
  EXPECT_EQ(result.exit_code, 143) << result.output;
  EXPECT_THAT(written(), testing::Contains("metrics.json"));
}

TEST_F(CommandLine, FullStdoutIsAnOutputError) {
  EXPECT_EQ(vantage("list gains >/dev/full").exit_code, 5);
}

TEST_F(CommandLine, FailedOverwriteKeepsTheOldRun) {
  const std::string run = std::string("run ") + kShort;
  ASSERT_EQ(vantage(run).exit_code, 0);
  EXPECT_EQ(vantage(run + "--overwrite --set scene=no.xml").exit_code, 3);
  EXPECT_THAT(written(), testing::Contains("metrics.json"));
}

TEST_F(CommandLine, SceneBesideTheEpisodeIsReplayed) {
  fs::copy(fs::path(VANTAGE_SOURCE_DIR) / "models/scenes/tabletop_4", folder_ / "mine",
           fs::copy_options::recursive);
  file("mine/e.yaml", "scene: scene.xml\n");
  ASSERT_EQ(vantage(std::string("run mine/e.yaml ") + kShort + "--out run").exit_code, 0);
  EXPECT_EQ(vantage("replay run").exit_code, 0);
}

TEST_F(CommandLine, DryRunSeesOverrides) {
  expect_error(vantage("run -q --dry-run --set scans=0 "), 2, {"scans"});
  const auto scene = file("broken.xml", "<mujoco><nonsense/></mujoco>");
  EXPECT_EQ(vantage("run --dry-run --set scene=" + scene).exit_code, 3);
}

TEST_F(CommandLine, RefusesAStartWithoutRoom) {
  for (const char* when : {"--dry-run ", ""}) {
    const std::string run = std::string("run -q ") + when;
    expect_error(vantage(run + "--set candidates.radius_m=0.6"), 2,
                 {"candidates.radius_m 0.6", "region of the map"});
    const auto scene = file("post.xml", R"(<mujoco><worldbody>
      <geom type="plane" size="5 5 .1"/>
      <geom type="box" size=".5 .5 .02" pos="0 0 .7"/>
      <geom name="post" type="box" size=".05 .05 .5" pos="1.3 .5 .5"/>
    </worldbody></mujoco>)");
    expect_error(vantage(run + "--set scene=" + scene), 2, {"robot.start_view 0", "'post'"});
    expect_error(vantage(run + "--set candidates.height_m=3"), 2, {"candidates.height_m", "reach"});
    expect_error(vantage(run + "--set laser.tilt_min_rad=-1.4"), 2, {"tilt_min_rad", "joint"});
  }
  EXPECT_THAT(written(), IsEmpty());
}

TEST_F(CommandLine, RefusesWhatNoMemoryHolds) {
  const std::pair<const char*, std::vector<std::string>> cases[] = {
      {"floor_map.cell_m=1e-6", {"floor_map", "cell_m", "half_size_m", "2^26"}},
      {"floor_map.half_size_m=1e300", {"floor_map", "cell_m", "half_size_m", "2^26"}},
      {"laser.step_rad=1e-9", {"laser", "step_rad", "10^7"}},
      {"base_scanner.step_rad=1e-9", {"base_scanner", "step_rad", "10^7"}},
      {"map.cells=[4096,4096,4096]", {"map", "cells", "2^26"}},
      {"candidates.positions=90000", {"map.cells", "candidates.positions", "2^31"}},
  };
  for (const auto& [assignment, parts] : cases) {
    expect_error(vantage("run --dry-run --set " + std::string(assignment)), 2, parts);
  }
}

TEST_F(CommandLine, PrintConfigIsReadBack) {
  const Result first = vantage("run --set scans=4 --set gain.weight_rate=1 --print-config");
  EXPECT_EQ(first.exit_code, 2);  // no such key in any gain
  const Result config = vantage("run --set scans=4 --print-config");
  ASSERT_EQ(config.exit_code, 0) << config.output;
  const auto copy = file("copy.yaml", config.output);
  EXPECT_EQ(vantage("run " + copy + " --print-config").output, config.output);
}

TEST_F(CommandLine, UsageErrorsEndInTwo) {
  EXPECT_EQ(vantage("rnu").exit_code, 2);
  EXPECT_EQ(vantage("run --sede 1").exit_code, 2);
  EXPECT_EQ(vantage("").exit_code, 2);
  EXPECT_EQ(vantage("--help").exit_code, 0);
}

TEST_F(CommandLine, ValidateNamesEveryProblem) {
  const auto episode = file("e.yaml", "scans: 0\nseed: -1\nfoo: 1\n");
  const Result result = vantage("validate " + episode);
  EXPECT_EQ(result.exit_code, 2);
  for (const char* part : {"e.yaml:1", "e.yaml:2", "e.yaml:3"}) {
    EXPECT_THAT(result.output, HasSubstr(part));
  }
}

TEST_F(CommandLine, ListsWhatThereIs) {
  EXPECT_THAT(vantage("list gains").output, HasSubstr("adaptive\n"));
  EXPECT_THAT(vantage("list scenes").output, HasSubstr("tabletop_25"));
  EXPECT_EQ(vantage("list nothing").exit_code, 2);
}

TEST_F(CommandLine, DoctorFindsTheRenderer) {
  const Result result = vantage("doctor");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("H.264 in MP4 works"));
}

}  // namespace
}  // namespace vantage
