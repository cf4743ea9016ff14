// What the command line says about a configuration before anything runs.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command_line.hpp"

namespace vantage {
namespace {

TEST_F(CommandLine, UnknownKey) {
  const auto episode = file("e.yaml", "scans: 3\nscnas: 4\n");
  expect_error(vantage("run " + episode), 2, {"e.yaml:2", "scnas", "scans"});
}

TEST_F(CommandLine, AMistypedCommandSuggestsTheNearest) {
  for (const auto& [typed, meant] : {std::pair("rnu", "did you mean run?"),
                                     {"sweep rn x.yaml", "did you mean run?"},
                                     {"sweep -q colect", "did you mean collect?"},
                                     {"dataset contact", "known: render, import, check, info"},
                                     {"valdiate x.yaml", "did you mean validate?"}}) {
    const Result result = vantage(typed);
    EXPECT_EQ(result.exit_code, 2) << typed;
    EXPECT_THAT(result.output, HasSubstr(meant)) << typed;
  }
  EXPECT_THAT(vantage("rnu").output,
              HasSubstr("error: unknown command 'rnu'; did you mean run?\n"));
}

TEST_F(CommandLine, WhatIsNoEpisodeSaysWhatTakesIt) {
  const auto study = file("s.yaml", "episode: assets/episodes/tabletop.yaml\nseeds: 1..2\n");
  expect_error(vantage("run " + study), 2, {"this is a study: use vantage sweep run", "--out DIR"});
  const auto scene = file("room.xml", "<mujoco/>");
  expect_error(vantage("run " + scene), 2, {"this is a scene; an episode is", "--set scene="});
  expect_error(vantage("run ."), 3, {"this is a folder"});
  const auto episode = file("e.yaml", "scans: 3\n");
  expect_error(vantage("sweep run " + episode), 2, {"this is an episode: use vantage run"});
  expect_error(vantage("sweep run " + scene), 2, {"room.xml: this is a scene; a study is a YAML"});
}

TEST_F(CommandLine, AFolderThatIsNotTheirsIsNamed) {
  fs::create_directories(folder_ / "empty");
  fs::create_directories(folder_ / "study");
  file("study/study.yaml", "seeds: 1..2\n");
  fs::create_directories(folder_ / "run");
  file("run/config.yaml", "scans: 2\n");
  for (const char* command : {"view ", "replay "}) {
    expect_error(vantage(command + std::string("empty")), 3, {"empty: not a run folder", "config"});
    expect_error(vantage(command + std::string("study")), 3, {"study: the folder of a study"});
  }
  for (const char* command : {"sweep collect ", "sweep status "}) {
    expect_error(vantage(command + std::string("empty")), 3, {"not the folder of a study"});
    expect_error(vantage(command + std::string("run")), 3, {"run: the folder of a run, not of a"});
  }
  expect_error(vantage("report empty"), 3, {"empty: the folder of neither a run nor a study"});
  expect_error(vantage("report nowhere"), 3, {"nowhere: no such folder"});
  expect_error(vantage("compare run empty"), 3, {"empty: the folder of neither"});
}

TEST_F(CommandLine, WhatIsMistypedIsSuggested) {
  expect_error(vantage("run --set gian=simple"), 2, {"'gian'; did you mean gain? known here: "});
  expect_error(vantage("list gain"), 2, {"unknown topic 'gain'; did you mean gains? known: tasks"});
  expect_error(vantage("run --set gain=simple --set gain.a=1"), 2,
               {"gain simple has no key 'a'; it has none; it belongs to"});
  expect_error(vantage("run --set 'map.size_m=[1, 2]'"), 2, {"expected a list of 3, got 2"});
}

TEST_F(CommandLine, ASetTakesSeveralAssignments) {
  const Result plan = vantage("run --dry-run --set seed=7 scans=2");
  EXPECT_EQ(plan.exit_code, 0) << plan.output;
  EXPECT_THAT(plan.output, testing::AllOf(HasSubstr("2 scans"), HasSubstr("seed 7")));
  EXPECT_EQ(vantage("run --set seed=7 assets/episodes/tabletop.yaml --dry-run").exit_code, 0);
  EXPECT_EQ(vantage("run --dry-run --set seed=7 faults.gust_N=0").exit_code, 0);
}

TEST_F(CommandLine, ARobotThatIsNoneIsNamedByItsKey) {
  const auto model = file("x.xml", "<mujoco/>");
  expect_error(vantage("run --dry-run --set robot.model=" + model), 3,
               {"--set: robot.model: ", "x.xml: no robot.yaml beside it: a robot is a folder"});
}

TEST_F(CommandLine, ValidateListsEveryErrorOfAStudy) {
  const auto study = file("s.yaml",
                          "episode: assets/episodes/tabletop.yaml\nset: {scnas: 1}\n"
                          "factors: {m: {a: {gian: simple}, b: {scans: many}}}\n"
                          "report: {compare: n, curves: [aera]}\n");
  const Result result = vantage("validate " + study);
  EXPECT_EQ(result.exit_code, 2);
  for (const char* part : {"scnas", "gian", "many", "unknown factor 'n'", "aera"}) {
    EXPECT_THAT(result.output, HasSubstr(part));
  }
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

TEST_F(CommandLine, DryRunSeesOverrides) {
  expect_error(vantage("run -q --dry-run --set scans=0 "), 2, {"scans"});
  const Result both = vantage("run -q --dry-run --set scasn=1 --set threads=0");
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.output, testing::AllOf(HasSubstr("scasn"), HasSubstr("threads")));
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
    expect_error(vantage(fmt::format("{}--set scene={}", run, scene)), 2,
                 {"robot.start_view 0", "'post'"});
    expect_error(vantage(run + "--set candidates.height_m=3"), 2, {"candidates.height_m", "reach"});
    expect_error(vantage(run + "--set laser.tilt_min_rad=-1.4"), 2, {"tilt_min_rad", "joint"});
  }
  EXPECT_THAT(written(), IsEmpty());
}

TEST_F(CommandLine, OverridesAreNamedInErrors) {
  const auto named = [&](const std::string& assignment, const std::vector<std::string>& parts) {
    const Result result = vantage("run --dry-run --set " + assignment);
    expect_error(result, 2, parts);
    EXPECT_THAT(result.output, testing::Not(HasSubstr("yaml"))) << assignment;
    EXPECT_EQ(result.output.find("--set"), result.output.rfind("--set")) << result.output;
  };
  named("robot.start_view=40", {"--set robot.start_view: ", "candidates.positions"});
  named("laser.tilt_min_rad=1 ", {"--set laser.tilt_min_rad: laser: ", "tilt_max_rad"});
  named("metrics.predictors=[simple,fsmi]", {"metrics: predictors: 'fsmi'", "beer_lambert"});
  named("gain=[1]", {"--set: gain: expected a name"});
  named("gain.a=0.5", {"--set: gain.a: gain adaptive has no key 'a'; it has ", "beer_lambert"});
}

TEST_F(CommandLine, JsonIsJson) {
  const auto config =
      vantage("run --print-config --json --set scans=4 --set scene=" +
              std::string(VANTAGE_SOURCE_DIR "/models/scenes/tabletop_4/scene.xml"));
  const auto parsed = nlohmann::json::parse(config.output, nullptr, false);
  ASSERT_TRUE(parsed.is_object()) << config.output;
  EXPECT_EQ(parsed["scans"], 4);
  EXPECT_EQ(parsed["gain"]["name"], "adaptive");
  const auto flight = nlohmann::json::parse(
      vantage("run assets/episodes/recognition.yaml --print-config --json").output, nullptr, false);
  EXPECT_EQ(flight["tracking"]["gusts"], nlohmann::json::array());
  const auto plan = nlohmann::json::parse(vantage("run --dry-run --json").output, nullptr, false);
  ASSERT_TRUE(plan.is_object());
  EXPECT_EQ(plan["method"], "adaptive");
}

TEST_F(CommandLine, ValidateKnowsWhatCannotRun) {
  expect_error(vantage("validate " + file("empty.yaml", "# nothing\n")), 2, {"empty.yaml: empty"});
  expect_error(vantage("validate ."), 3, {"directory"});
  const std::string floor = "<geom type='plane' size='5 5 .1'/>";
  const auto reserved = file("reserved.xml", "<mujoco><worldbody>" + floor +
                                                 "<body name='robot/x'/></worldbody></mujoco>");
  expect_error(vantage("validate " + reserved), 3, {"reserved.xml", "robot/x"});
  expect_error(vantage("validate " + file("half.model", "vantage recog")), 3, {"half.model"});
  EXPECT_THAT(vantage("validate '" VANTAGE_SOURCE_DIR "/assets/models/flight.model'").output,
              HasSubstr("flight.model: good"));
  expect_error(vantage("validate " + file("a.txt", "x")), 3, {"unknown kind", ".ot, .model"});
  const auto bare = file("bare.xml", "<mujoco><worldbody>" + floor + "</worldbody></mujoco>");
  const Result good = vantage("validate " + bare);
  EXPECT_EQ(good.exit_code, 0);
  EXPECT_THAT(good.output,
              testing::AllOf(HasSubstr("note: no table"), HasSubstr("bare.xml: good")));
}

TEST_F(CommandLine, ValidateReadsRecipesAndSensorsAsWhatTheyAre) {
  for (const std::string good : {"assets/models/flight.yaml", "assets/sensors/rgbd.yaml"}) {
    EXPECT_THAT(vantage("validate '" VANTAGE_SOURCE_DIR "/" + good + "'").output,
                HasSubstr(good + ": good"));
  }
  expect_error(vantage("validate " + file("r.yaml", "recordings:\n  - {session: -1}\n")), 2,
               {"r.yaml:2", "session", "-1"});
  expect_error(vantage("validate " + file("s.yaml", "range_max_m: -3\n")), 2,
               {"s.yaml:1", "range_max_m", "-3"});
  expect_error(vantage("validate " + file("t.yaml", "range_max_m: 3\nrange_m: 2\n")), 2,
               {"t.yaml:2", "unknown key 'range_m'"});
  expect_error(vantage("validate --set a=1 " + file("u.yaml", "range_max_m: 3\n")), 2,
               {"--set is for episodes"});
}

/// A table with nothing to localise by: good, with a note.
std::string open_scene() {
  return "<mujoco><worldbody><geom type='plane' size='5 5 .1'/><geom type='box' pos='0 0 .7' "
         "size='.5 .5 .02'/><geom type='box' pos='0 0 .34' size='.08 .08 .34'/></worldbody>"
         "</mujoco>";
}

TEST_F(CommandLine, DryRunAndValidateSayTheSame) {
  const auto scene = file("open.xml", open_scene());
  const auto episode = file("e.yaml", "scene: open.xml\n");
  const std::string note = "e.yaml: note: registration: from the start";
  EXPECT_THAT(vantage("validate " + episode).output, HasSubstr(note));
  EXPECT_THAT(vantage("run --dry-run " + episode).output, HasSubstr(note));
  const auto plan =
      nlohmann::json::parse(vantage("run --dry-run --json " + episode).output, nullptr, false);
  ASSERT_TRUE(plan.is_object());
  EXPECT_EQ(plan["notes"].size(), 1U);
  for (const std::string command : {"validate ", "run --dry-run "}) {
    expect_error(vantage(command + episode + " --set scnas=1"), 2, {"scnas", "scans"});
    expect_error(vantage(command + episode + " --set table.min_height_m=0.8"), 3,
                 {"open.xml: no table", "below table.min_height_m 0.8"});
  }
  const Result set = vantage("validate --set table.min_height_m=0.8 " + scene);
  EXPECT_EQ(set.exit_code, 0);
  EXPECT_THAT(set.output, HasSubstr("note: no table: the nearest to one"));
  const auto study = file("s.yaml", "episode: e.yaml\nseeds: 1..2\n");
  expect_error(vantage("validate --set scans=3 " + study), 2, {"s.yaml: --set is for episodes"});
}

TEST_F(CommandLine, RefusesWhatNoMemoryHolds) {
  const std::pair<const char*, std::vector<std::string>> cases[] = {
      {"floor_map.cell_m=1e-6", {"floor_map", "cell_m", "half_size_m", "2^26"}},
      {"floor_map.half_size_m=1e300", {"floor_map", "cell_m", "half_size_m", "2^26"}},
      {"floor_map.half_size_m=1e-12", {"floor_map", "cell_m", "half_size_m 1e-12", "not one"}},
      {"task=exploration floor_map.half_size_m=200 floor_detail.parts=15",
       {"floor_map.half_size_m 200", "floor_detail.parts 15", "1.44e+10 cells", "2^26"}},
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

TEST_F(CommandLine, PrintConfigShowsTheTaskFirstAndItsKeys) {
  const auto printed = [&](const std::string& episode) {
    const Result result = vantage("run --print-config assets/episodes/" + episode);
    EXPECT_EQ(result.exit_code, 0) << result.output;
    return result.output;
  };
  const std::string tabletop = printed("tabletop.yaml");
  EXPECT_THAT(tabletop, testing::ContainsRegex("^(#[^\n]*\n)*task: tabletop\n"));
  EXPECT_THAT(tabletop, testing::AllOf(HasSubstr("\ncandidates:"), HasSubstr("\nscans: 10\n")));
  EXPECT_THAT(tabletop, testing::Not(testing::ContainsRegex("\n(frontiers|horizon|bearings):")));
  const std::string office = printed("office_small.yaml");
  EXPECT_THAT(office, testing::ContainsRegex("^(#[^\n]*\n)*task: exploration\n"));
  EXPECT_THAT(office, testing::AllOf(HasSubstr("\nfrontiers:"), HasSubstr("\nscans: 60\n")));
  EXPECT_THAT(office, testing::Not(testing::ContainsRegex("\n(candidates|horizon|bearings):")));
  const std::string flight = printed("trajectory.yaml");
  EXPECT_THAT(flight, testing::ContainsRegex("^(#[^\n]*\n)*task: trajectory\n"));
  EXPECT_THAT(flight, HasSubstr("\nhorizon: 10\n"));
  EXPECT_THAT(flight, testing::Not(testing::ContainsRegex("\n(scans|candidates|bearings):")));
}

TEST_F(CommandLine, AKeyOfAnotherTaskNamesThatTask) {
  expect_error(vantage("run assets/episodes/office_small.yaml --set candidates.positions=8"), 2,
               {"--set", "candidates", "it belongs to tabletop"});
  const auto episode = file("e.yaml", "task: tabletop\nscans: 2\nhorizon: 5\n");
  expect_error(vantage("run " + episode), 2, {"e.yaml:3", "horizon", "it belongs to trajectory"});
  expect_error(vantage("run --set task=flying"), 2, {"task", "'flying'", "trajectory"});
}

TEST_F(CommandLine, FormerKeysSayWhatToWrite) {
  const auto office = file("e.yaml", "scene: s.xml\nsetting: office\n");
  expect_error(vantage("run " + office), 2, {"e.yaml:2", "setting", "write 'task: exploration'"});
  expect_error(vantage("run --set task=next_best_view"), 2,
               {"--set", "task: tabletop", "task: exploration"});
  expect_error(vantage("validate " + file("f.yaml", "recognition:\n  max_views: 3\n")), 2,
               {"f.yaml:1", "write max_views in place of recognition.max_views"});
  expect_error(vantage("run --set most_views=3"), 2, {"--set", "most_views", "'max_views'"});
}

TEST_F(CommandLine, UsageErrorsEndInTwo) {
  EXPECT_EQ(vantage("rnu").exit_code, 2);
  EXPECT_EQ(vantage("run --sede 1").exit_code, 2);
  EXPECT_EQ(vantage("run --dry-run --video=3").exit_code, 2);
  EXPECT_EQ(vantage("run --dry-run --out ''").exit_code, 2);
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

TEST_F(CommandLine, ByItsSchemaAStudyHasNoEmptyLists) {
  auto properties = nlohmann::json::parse(vantage("schema study").output)["properties"];
  EXPECT_EQ(properties["report"]["properties"]["groups"]["additionalProperties"]["minItems"], 1);
  EXPECT_EQ(properties["splits"]["minProperties"], 1);
  EXPECT_EQ(properties["splits"]["additionalProperties"]["additionalProperties"]["minItems"], 1);
  EXPECT_EQ(properties["seeds"]["anyOf"][1]["minItems"], 1);
  EXPECT_TRUE(properties["seeds"]["anyOf"][1]["uniqueItems"].get<bool>());
}

TEST_F(CommandLine, ByItsSchemaAnAngleMayBeNegativeAndASeedMayNot) {
  auto sensor = nlohmann::json::parse(vantage("schema sensor").output)["properties"];
  EXPECT_EQ(sensor["tilt_min_rad"]["minimum"], -1.5);
  auto dataset = nlohmann::json::parse(vantage("schema dataset").output)["properties"];
  EXPECT_EQ(dataset["seed"]["minimum"], 0.0);
}

}  // namespace
}  // namespace vantage
