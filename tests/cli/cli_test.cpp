// The command line as a user meets it: exit codes, one clear line, nothing half-written.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <set>

#include "tests/cli/command_line.hpp"
#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace {

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
    <body pos="3 3 1"><joint type="slide" axis="1 0 0" stiffness="-300" springref="-0.01"/>
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
#ifdef __SANITIZE_THREAD__
  // The sanitizer puts a file of its own there, which is beyond the limit.
  const std::string environment = "TMPDIR=/nowhere ";
#else
  const std::string environment;
#endif
  const Result result = shell("cd '" + folder_.string() + "' && trap '' XFSZ && ulimit -f 16 && " +
                              environment + VANTAGE_BINARY " run " + kShort);
  EXPECT_EQ(result.exit_code, 5) << result.output;
  EXPECT_THAT(result.output, HasSubstr("cannot write"));
  const auto left = written();
  for (const auto& name : left) EXPECT_THAT(name, testing::Not(HasSubstr(".part")));
  EXPECT_THAT(left, testing::Not(testing::Contains("metrics.json")));
  EXPECT_THAT(shell("cat '" + folder_.string() + "'/out/*/log.txt").output,
              HasSubstr("cannot write"));
}

TEST_F(CommandLine, SecondRunNeedsOverwrite) {
  const std::string run = std::string("run ") + kShort;
  ASSERT_EQ(vantage(run).exit_code, 0);
  expect_error(vantage(run), 2, {"--out out/tabletop-1: holds", "; --overwrite replaces it"});
  EXPECT_EQ(vantage(run + "--overwrite").exit_code, 0);
}

TEST_F(CommandLine, InterruptedRunWritesWhatThereIs) {
  const Result result = interrupted("run --json", "grep -q 'scan 1' told", "INT");
  EXPECT_EQ(result.exit_code, 130) << result.output;
  EXPECT_THAT(result.output, HasSubstr("\"status\": \"interrupted\""));
  EXPECT_THAT(written(), testing::IsSupersetOf({"metrics.json", "report.html", "states.bin"}));
}

TEST_F(CommandLine, InterruptedScanIsNotFinished) {
  // An hour of scanning: no machine is through with it when it is told to stop.
  const Result result =
      interrupted("run --json --set laser.scan_duration_s=3600 --out run",
                  "[ $(stat -c %s run/states.part.bin || echo 0) -gt 100000 ]", "INT");
  EXPECT_EQ(result.exit_code, 130) << result.output;
  EXPECT_THAT(result.output, HasSubstr("\"scans\": []"));
  EXPECT_THAT(result.output, HasSubstr("\"precision\": null")) << "of a map of nothing";
  EXPECT_EQ(vantage("replay run").exit_code, 0);
  EXPECT_EQ(vantage("report run").exit_code, 0);
}

TEST_F(CommandLine, TerminatedRunEndsIn143) {
  const Result result = interrupted("run", "grep -q 'scan 1' told", "TERM");
  EXPECT_EQ(result.exit_code, 143) << result.output;
  EXPECT_THAT(written(), testing::Contains("metrics.json"));
}

TEST_F(CommandLine, FullStdoutIsAnOutputError) {
  // Of more than a buffer's size, too: it fails while it is printed.
  for (const char* command :
       {"list gains", "schema episode", "--help", "run --help", "--version"}) {
    expect_error(vantage(command + std::string(" >/dev/full")), 5, {"stdout: cannot write"});
  }
}

TEST_F(CommandLine, FullStderrCostsNoRun) {
  std::string run = std::string("run ") + kShort;
  run.replace(run.find("-q"), 2, "2>/dev/full");
  EXPECT_EQ(vantage(run).exit_code, 0);
}

TEST_F(CommandLine, APlaceThatCannotBeIsOneClearLine) {
  const std::string long_name(300, 'x');
  const std::string run = std::string("run ") + kShort;
  expect_error(vantage(run + "--out " + long_name), 5, {long_name, "File name too long"});
  expect_error(vantage("view -q " + long_name), 3, {long_name});
  expect_error(vantage("scene from-mesh " + long_name + ".obj --out a.xml -q"), 3, {long_name});
  const std::string here = "cd '" + folder_.string() + "' && ";
  expect_error(shell(here + "TMPDIR=/no/such " VANTAGE_BINARY " " + run), 5, {"TMPDIR: /no/such"});
  EXPECT_THAT(shell(here + "TMPDIR=/no/such " VANTAGE_BINARY " doctor").output,
              HasSubstr("does NOT work: TMPDIR"));
  expect_error(shell(here + "mkdir gone && cd gone && rmdir ../gone && " VANTAGE_BINARY
                            " train data --out model -q"),
               5, {"model: No such file or directory"});
}

TEST_F(CommandLine, FailedOverwriteKeepsTheOldRun) {
  const std::string run = std::string("run ") + kShort;
  ASSERT_EQ(vantage(run).exit_code, 0);
  EXPECT_EQ(vantage(run + "--overwrite --set scene=no.xml").exit_code, 3);
  const auto before = written();
  fs::create_directory(folder_ / "out/tabletop-1/steps.part.csv");
  expect_error(vantage(run + "--overwrite"), 5, {"steps.csv: cannot write"});
  EXPECT_THAT(written(), testing::UnorderedElementsAreArray(before));
  EXPECT_THAT(before, testing::IsSupersetOf({"metrics.json", "log.txt"}));
}

TEST_F(CommandLine, SceneBesideTheEpisodeIsReplayed) {
  fs::copy(fs::path(VANTAGE_SOURCE_DIR) / "models/scenes/tabletop_4", folder_ / "mine",
           fs::copy_options::recursive);
  file("mine/e.yaml", "scene: scene.xml\n");
  ASSERT_EQ(vantage(std::string("run mine/e.yaml ") + kShort + "--out run").exit_code, 0);
  EXPECT_EQ(vantage("replay run").exit_code, 0);
}

TEST_F(CommandLine, WhatRanInTheScenesOwnFolderHasNotChanged) {
  fs::copy(fs::path(VANTAGE_SOURCE_DIR) / "models/scenes/tabletop_4", folder_,
           fs::copy_options::recursive);
  file("e.yaml", "scene: scene.xml\n");
  ASSERT_EQ(vantage(std::string("run e.yaml ") + kShort + "--out run").exit_code, 0);
  const Result result = vantage("replay run");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.output, testing::Not(HasSubstr("changed")));
}

TEST_F(CommandLine, ListsWhatThereIs) {
  EXPECT_THAT(vantage("list gains").output, HasSubstr("adaptive\n"));
  EXPECT_THAT(vantage("list scenes").output, HasSubstr("tabletop_25"));
  EXPECT_THAT(vantage("list features").output,
              testing::AllOf(testing::ContainsRegex("colour +144 dimensions +[0-9.]+ ms\n"),
                             testing::ContainsRegex("sift +1000 dimensions"), HasSubstr("onnx")));
  EXPECT_EQ(vantage("list tasks").output,
            "tabletop\nexploration\nrecognition\nchange_detection\ntrajectory\n");
  EXPECT_EQ(vantage("list nothing").exit_code, 2);
}

TEST_F(CommandLine, DoctorFindsTheRenderer) {
  const Result result = vantage("doctor");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("H.264 in MP4 works"));
}

TEST_F(CommandLine, DoctorSaysInWordsWhatItSaysInJson) {
  const auto found =
      nlohmann::ordered_json::parse(vantage("doctor --json 2>/dev/null").output, nullptr, false);
  ASSERT_TRUE(found.is_object());
  std::vector<std::string> names;
  std::string words;
  for (const auto& [what, text] : found.items()) {
    names.push_back(what);
    words += fmt::format("{:<10} {}\n", what, text.get<std::string>());
  }
  EXPECT_THAT(names, testing::ElementsAre("vantage", "mujoco", "renderer", "window", "opencv",
                                          "video", "data", "threads"));
  EXPECT_EQ(vantage("doctor 2>/dev/null").output, words);
  const std::string here = folder_.string();
  EXPECT_THAT(shell("cd '" + here + "' && VANTAGE_DATA=$PWD " VANTAGE_BINARY " doctor").output,
              HasSubstr("\ndata       does NOT work: no models in " + here + "; set VANTAGE_DATA"));
}

TEST_F(CommandLine, ImagesOfAnExportAreOfAPeriodAndAHeightThatCanBe) {
  const auto exit_code = [&](const std::string& option) {
    return vantage("export nowhere --mcap a.mcap " + option).exit_code;
  };
  for (const char* taken :
       {"--image-period=0", "--image-period=1000000", "--image-height=60", "--image-height=2160"}) {
    EXPECT_EQ(exit_code(taken), 3) << taken << ": only the run is missing";
  }
  for (const char* refused : {"--image-period=-1", "--image-period=1000001", "--image-height=59",
                              "--image-height=2161"}) {
    EXPECT_EQ(exit_code(refused), 2) << refused;
  }
}

TEST_F(CommandLine, TheOutcomeInWordsEndsAsTheMetricsDo) {
  const auto told = [&](const std::string& options) {
    const Result run = vantage(std::string("run ") + kShort + options + " 2>/dev/null");
    EXPECT_EQ(run.exit_code, 0);
    return run.output;
  };
  const auto metrics_in = [&](const std::string& run) {
    return shell("cat '" + (folder_ / run / "metrics.json").string() + "'").output;
  };
  const std::string whole = told("--out run");
  const auto metrics = nlohmann::json::parse(metrics_in("run"));
  const std::string end = "\nended by: " + metrics["reason"].get<std::string>() + "\nstate hash " +
                          metrics["state_hash"].get<std::string>() + "\n";
  EXPECT_THAT(whole, testing::EndsWith(end + "report run/report.html\n"));
  const auto manifest = nlohmann::json::parse(read_file(folder_ / "run/manifest.json"));
  EXPECT_EQ(manifest["command"].at(1), "run");
  EXPECT_THAT(told("--out lean --lean"), testing::EndsWith(end));
  const std::string as_json = told("--out again --json");
  EXPECT_EQ(as_json, metrics_in("again"));
}

TEST_F(CommandLine, APlanSaysWhatWouldRun) {
  const std::string scene = VANTAGE_SOURCE_DIR "/models/scenes/tabletop_8/scene.xml";
  EXPECT_EQ(nlohmann::json::parse(vantage("run --dry-run --json --seed 5").output),
            nlohmann::json({{"episode", "tabletop"},
                            {"scans", 10},
                            {"scene", scene},
                            {"method", "adaptive"},
                            {"seed", 5},
                            {"notes", nlohmann::json::array()}}));
  EXPECT_EQ(vantage("run --dry-run").output,
            "tabletop: 10 scans in " + scene + " by adaptive, seed 1\n");
}

/// A comment changes the file and nothing in the scene.
TEST_F(CommandLine, WhatIsExportedAndReplayedIsTold) {
  fs::copy(fs::path(VANTAGE_SOURCE_DIR) / "models/scenes/tabletop_4", folder_,
           fs::copy_options::recursive);
  file("e.yaml", "scene: scene.xml\n");
  ASSERT_EQ(vantage(std::string("run e.yaml ") + kShort + "--out run").exit_code, 0);
  const std::string to_mcap = "export run --mcap a.mcap --image-period=0 -q ";
  const auto told = nlohmann::json::parse(vantage(to_mcap + "--json 2>/dev/null").output);
  const auto bytes = fs::file_size(folder_ / "a.mcap");
  EXPECT_EQ(told["file"], "a.mcap");
  EXPECT_EQ(told["bytes"], bytes);
  EXPECT_GT(told["messages"], told["channels"]);
  const auto metrics =
      nlohmann::json::parse(shell("cat '" + (folder_ / "run/metrics.json").string() + "'").output);
  EXPECT_NEAR(told["simulated_time_s"].get<double>(), metrics["simulated_time_s"].get<double>(),
              0.1);
  expect_error(vantage(to_mcap), 2, {"--mcap a.mcap", "--overwrite"});
  const auto number = [&](const char* key) { return std::to_string(told[key].get<int>()); };
  const std::string words = vantage(to_mcap + "--overwrite").output;
  EXPECT_THAT(words, testing::StartsWith("a.mcap: " + number("messages") + " messages in " +
                                         number("channels") + " channels, "));
  shell("echo '<!-- as it was -->' >>'" + (folder_ / "scene.xml").string() + "'");
  const Result changed = vantage("replay run");
  EXPECT_EQ(changed.exit_code, 0) << changed.output;
  EXPECT_THAT(changed.output,
              testing::AllOf(HasSubstr("changed since the recording: scene.xml\n"),
                             HasSubstr(" steps, every state the same, state hash " +
                                       metrics["state_hash"].get<std::string>() + "\n")));
  const auto replayed = nlohmann::json::parse(vantage("replay run --json 2>/dev/null").output);
  EXPECT_EQ(replayed["directory"], "run");
  EXPECT_EQ(replayed["state_hash"], metrics["state_hash"]);
  EXPECT_EQ(replayed["changed_files"], nlohmann::json::array({"scene.xml"}));
  EXPECT_TRUE(replayed["first_difference"].is_null());
  shell("sed -i 's/\"state_hash\": \"[0-9a-f]*/&0/' '" + (folder_ / "run/metrics.json").string() +
        "'");
  const Result other = vantage("replay run --json 2>/dev/null");
  EXPECT_EQ(other.exit_code, 1);
  const auto difference = nlohmann::json::parse(other.output)["first_difference"];
  EXPECT_EQ(difference["step"], replayed["steps"]) << "after the last one";
  EXPECT_NEAR(difference["time_s"].get<double>(), told["simulated_time_s"].get<double>(), 0.1);
  const Result in_words = vantage("replay run 2>/dev/null");
  EXPECT_EQ(in_words.exit_code, 1);
  EXPECT_EQ(
      in_words.output,
      fmt::format("run: differs first at step {} ({:.3f} s): {}\n", difference["step"].get<int>(),
                  difference["time_s"].get<double>(), difference["what"].get<std::string>()));
}

/// Large enough that it is not 0.0 MB.
TEST_F(CommandLine, AnExportIsToldWithItsTimeAndSize) {
  ASSERT_EQ(vantage(std::string("run ") + kShort + "--out run").exit_code, 0);
  const std::string to_mcap = "export run --mcap a.mcap --overwrite -q ";
  const auto told = nlohmann::json::parse(vantage(to_mcap + "--json 2>/dev/null").output);
  const auto bytes = told["bytes"].get<double>();
  ASSERT_GT(bytes, 5e4);
  EXPECT_THAT(vantage(to_mcap).output,
              HasSubstr(fmt::format(" channels, {:.1f} s, {:.1f} MB\n",
                                    told["simulated_time_s"].get<double>(), 1e-6 * bytes)));
}

/// Of two scans, so that there is a decision.
TEST_F(CommandLine, APictureOfARunShowsWhatIsAskedFor) {
  const Result run = vantage(
      "run --set scans=2 --set laser.scan_duration_s=2 --set 'map.cells=[33,33,17]' -q --out run");
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const std::vector<std::string> asked{"",      "--at 0", "--camera follow", "--camera robot",
                                       "--map", "--gains"};
  std::set<std::string> pictures;
  for (const std::string& options : asked) {
    const std::string shot = "view run --size 200x150 --screenshot shot.png " + options;
    const Result told = vantage(shot + " --overwrite 2>/dev/null");
    EXPECT_EQ(told.exit_code, 0) << options;
    EXPECT_EQ(told.output, "shot.png\n") << options;
    expect_error(vantage(shot), 2, {"--screenshot shot.png", "--overwrite"});
    pictures.insert(read_file(folder_ / "shot.png"));
  }
  EXPECT_EQ(pictures.size(), asked.size()) << "no two are the same";
  for (const std::string option : {"--set", "--seed", "--out"}) {
    expect_error(vantage("view run " + option + (option == "--set" ? " seed=3" : " 3")), 2,
                 {option + ": run is a run folder, it has happened already"});
  }
}

TEST_F(CommandLine, AViewedEpisodeIsTheOneThatWasAskedFor) {
  const Result told = vantage(
      "view --seed 7 --set scans=1 --size 64x64 --at 0 --screenshot a.png --out run 2>/dev/null");
  EXPECT_EQ(told.exit_code, 0);
  EXPECT_EQ(told.output, "a.png\n");
  EXPECT_THAT(read_file(folder_ / "run/config.yaml"),
              testing::AllOf(HasSubstr("\nseed: 7\n"), HasSubstr("\nscans: 1\n")));
  const auto manifest = nlohmann::json::parse(read_file(folder_ / "run/manifest.json"));
  EXPECT_EQ(manifest["command"][1], "view");
  EXPECT_EQ(manifest["command"].back(), "run");
  EXPECT_EQ(vantage("view nowhere --at 3").exit_code, 2) << "of no screenshot";
  EXPECT_EQ(vantage("view nowhere --camera front").exit_code, 2);
  EXPECT_EQ(vantage("view nowhere --camera robot").exit_code, 3) << "the episode is missing";
  expect_error(vantage("view --screenshot shot.jpg"), 2,
               {"--screenshot: shot.jpg: expected a file name that ends in .png"});
}

TEST_F(CommandLine, WhatTheWindDidIsReplayed) {
  const Result run = vantage(
      "run assets/episodes/recognition.yaml --set max_views=1 --set faults.gust_N=4 "
      "--set faults.gust_every_s=0.5 -q --out run");
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const Result replayed = vantage("replay run");
  EXPECT_EQ(replayed.exit_code, 0) << replayed.output;
}

}  // namespace
}  // namespace vantage
