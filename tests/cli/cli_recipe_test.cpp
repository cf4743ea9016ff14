// `vantage train --recipe`: from a file that says how a model is made to its bytes.
#include <algorithm>

#include "tests/cli/command_line.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/hash.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/recipe/make_model.hpp"
#include "vantage/sim/render/renderer.hpp"

namespace vantage {
namespace {

/// Two recordings of six objects in few and small views.
constexpr auto kRecipe = R"(render: {objects: 6, step_deg: 45, videos: [1, 2], supersampling: 1}
recordings:
  - {session: 1, distance_m: 0.85}
  - {session: 2, distance_m: 1.1}
train:
  videos: [1, 2]
  features: [soft_colour, sift]
  costs_s: [0.001, 0.002]
  feature_views: 20
)";

class Recipe : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    file("recipe.yaml", kRecipe);
  }
  Result make(const std::string& model, const std::string& more) {
    return vantage("train --recipe recipe.yaml --out " + model + " " + more);
  }
  std::string bytes(const std::string& model) { return read_file(folder_ / model); }
};

TEST_F(Recipe, MakesTheSameModelWithAnyNumberOfJobs) {
  const Result first = make("one.model", "--cache one --jobs 1 -q");
  ASSERT_EQ(first.exit_code, 0) << first.output;
  EXPECT_THAT(first.output, HasSubstr("6 objects"));
  EXPECT_THAT(first.output, HasSubstr(", 192 views\n")) << "8 of 2 videos of both recordings";
  ASSERT_EQ(make("three.model", "--cache three --jobs 3 -q").exit_code, 0);
  EXPECT_TRUE(bytes("one.model") == bytes("three.model"));
}

TEST_F(Recipe, GoesOnWhereItWasInterrupted) {
  ASSERT_EQ(make("whole.model", "--cache whole --jobs 2 -q").exit_code, 0);
  const Result stopped =
      interrupted("train --recipe recipe.yaml --out parts.model --cache parts --jobs 2 -q",
                  "ls -d parts/recordings/*/mug/mug_1 2>/dev/null", "INT");
  EXPECT_EQ(stopped.exit_code, 130) << stopped.output;
  EXPECT_FALSE(fs::exists(folder_ / "parts.model"));
  const auto first = *fs::recursive_directory_iterator(folder_ / "parts" / "recordings");
  const auto made = fs::last_write_time(first.path() / "mug" / "mug_1");
  const Result resumed = make("parts.model", "--cache parts --jobs 3 -q");
  ASSERT_EQ(resumed.exit_code, 0) << resumed.output;
  EXPECT_EQ(fs::last_write_time(first.path() / "mug" / "mug_1"), made) << "was rendered again";
  EXPECT_TRUE(bytes("whole.model") == bytes("parts.model"));
}

TEST_F(Recipe, TellsHowFarItIsAndWhere) {
  const Result result = make("told.model", "--cache told --set render.objects=2");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("told/recordings"));
}

/// 8 ms to render each of 8 views, then 1.5 ms to train on each: of 76 ms the first object is 32.
TEST_F(Recipe, SaysHowMuchOfTheWholeIsDone) {
  const std::string small = "--cache told --set render.objects=1 render.step_deg=180";
  const std::string begun = make("told.model", small).output;
  EXPECT_THAT(begun, HasSubstr("making the model: 42 % recording 1 of 2, mug_1"));
  const std::string rendered = make("told.model", "--overwrite " + small).output;
  EXPECT_THAT(rendered, HasSubstr("making the model: 0 % recording 1 of 2, mug_1"));
}

/// Else all that users have rendered would be rendered anew.
TEST_F(Recipe, WhatTheFirstVersionRenderedIsWhereItIsLookedFor) {
  DatasetOptions options;
  options.session = 3;
  const std::string made_with =
      "version 1, " + renderer_name() + "\n" + to_yaml(write_node(options));
  EXPECT_EQ(recording_folder("cache", options),
            fs::path("cache/recordings") / ("session_3-" + hash_text(hash_bytes(made_with))));
}

TEST_F(Recipe, TheUsersCacheIsTheDefault) {
  const Result result = shell("cd '" + folder_.string() +
                              "' && XDG_CACHE_HOME=$PWD/mine " VANTAGE_BINARY
                              " train --recipe recipe.yaml --out model -q --set render.objects=2");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_TRUE(fs::exists(folder_ / "mine/vantage/recordings"));
}

/// Recordings are named by what they show, not by where it lies.
TEST_F(Recipe, OtherScansAreOtherRecordings) {
  DatasetOptions options;
  options.models = (folder_ / "scans").string();
  const auto scan = [&](const std::string& name, const std::string& texture) {
    fs::create_directories(folder_ / "scans" / name);
    write_file(folder_ / "scans" / name / "model.obj", "v 0 0 0\nv 1 0 0\nv 0 1 2\nf 1 2 3\n");
    write_file(folder_ / "scans" / name / "texture.png", texture);
  };
  scan("duck", "yellow");
  const fs::path yellow = recording_folder("cache", options);
  EXPECT_EQ(recording_folder("cache", options), yellow);
  scan("duck", "green");
  const fs::path green = recording_folder("cache", options);
  EXPECT_NE(green, yellow);
  scan("mug", "green");
  EXPECT_NE(recording_folder("cache", options), green);
  fs::remove_all(folder_ / "scans" / "mug");
  EXPECT_EQ(recording_folder("cache", options), green);
}

TEST_F(Recipe, WhatIsWrongIsNamed) {
  const auto with = [&](const std::string& set) {
    return make("model", "--cache none -q --set '" + set + "'");
  };
  expect_error(with("render.objcts=2"), 2, {"--set", "objcts", "objects"});
  expect_error(with("train.costs_s=[1]"), 2, {"costs_s", "1", "2"});
  expect_error(with("render.videos=[1]"), 2, {"train.videos", "2", "session 1"});
  expect_error(with("recordings=[{session: 1}, {session: 1}]"), 2, {"recordings", "session 1"});
  expect_error(with("recordings=[]"), 2, {"recordings"});
  expect_error(with("render.models=nowhere"), 3, {"models", "nowhere"});
  file("recipe.yaml", "recordings:\n  - {session: 1, distance_m: 9}\n");
  expect_error(make("model", "-q"), 2, {"recipe.yaml:2", "distance_m", "9"});
  expect_error(vantage("train --out model -q"), 2, {"--recipe"});
  const std::string beside = "train --recipe recipe.yaml --out model -q ";
  for (const std::string other : {"--add-to m", "--config c.yaml", "--skip-bad"}) {
    expect_error(vantage(beside + other), 2,
                 {"--recipe says what is trained on; no " + other.substr(0, other.find(' '))});
  }
  expect_error(vantage(beside + "data"), 2, {"--recipe says what is trained on; no datasets"});
  expect_error(vantage("train --recipe none.yaml --out model -q"), 3, {"none.yaml"});
  EXPECT_FALSE(fs::exists(folder_ / "model"));
}

TEST_F(Recipe, AnIncompleteRecordingIsNoRecording) {
  const std::string render = "dataset render d -q --set objects=4 step_deg=60 supersampling=1";
  ASSERT_EQ(vantage(render).exit_code, 0);
  fs::remove_all(folder_ / "d" / "mug" / "mug_2");
  const std::string train = "train d --out model -q --set 'features=[soft_colour]' ";
  expect_error(vantage(train), 3, {"d: ", "mug_2", "dataset render", "--skip-bad"});
  EXPECT_FALSE(fs::exists(folder_ / "model"));
  const Result without = vantage(train + "--skip-bad");
  EXPECT_EQ(without.exit_code, 0) << without.output;
  EXPECT_THAT(without.output, HasSubstr("mug_2"));
  ASSERT_EQ(vantage(render).exit_code, 0);
  EXPECT_EQ(vantage(train + "--overwrite").exit_code, 0);
}

/// Of recordings of which nothing is there but what they should show.
TEST_F(Recipe, OfMissingObjectsFiveAreNamed) {
  fs::create_directories(folder_ / "d");
  for (const int objects : {1, 5, 6}) {
    file("d/dataset.yaml", "objects: " + std::to_string(objects) + "\n");
    const Result result = vantage("train d --out model -q");
    EXPECT_EQ(result.exit_code, 3);
    const std::string head = objects == 1 ? "d: rendering was broken off, an object is missing: "
                                          : "d: rendering was broken off, " +
                                                std::to_string(objects) + " objects are missing: ";
    const auto from = result.output.find(head);
    ASSERT_NE(from, std::string::npos) << result.output;
    const std::string told = result.output.substr(from + head.size());
    const std::string names = told.substr(0, told.find(';'));
    EXPECT_EQ(std::ranges::count(names, ','), std::min(objects, 5) - (objects > 5 ? 0 : 1))
        << names;
    EXPECT_EQ(names.ends_with(", ..."), objects > 5) << names;
  }
}

TEST_F(Recipe, ABrokenOffRenderingTellsWhatIsThere) {
  const Result stopped = interrupted("dataset render d --jobs 1 --step-deg 60 -q",
                                     "ls -d d/*/*_1 >listed 2>&1", "TERM");
  EXPECT_EQ(stopped.exit_code, 143) << stopped.output;
  EXPECT_THAT(stopped.output, HasSubstr(" objects complete, "));
}

}  // namespace
}  // namespace vantage
