// explain, list -v, and comments of --print-config: everything that has a name has a text.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>
#include <sstream>

#include "tests/cli/command_line.hpp"

namespace vantage {
namespace {

using nlohmann::json;
using testing::AllOf;

/// Dotted keys of a JSON configuration; elements of a list are key[].
void collect_keys(const json& node, const std::string& prefix, std::set<std::string>& keys) {
  if (node.is_array()) {
    for (const json& item : node) {
      if (item.is_object()) collect_keys(item, fmt::format("{}[]", prefix), keys);
    }
    return;
  }
  for (const auto& [name, child] : node.items()) {
    std::string path = prefix;
    if (!prefix.empty()) path += '.';
    path += name;
    if (name != "name") keys.insert(path);
    if (child.is_structured()) collect_keys(child, path, keys);
  }
}

TEST_F(CommandLine, EveryKeyOfEveryTaskIsExplained) {
  for (const char* task :
       {"tabletop", "office_small", "recognition", "change_detection", "trajectory"}) {
    const Result config =
        vantage(fmt::format("run assets/episodes/{}.yaml --print-config --json", task));
    ASSERT_EQ(config.exit_code, 0) << config.output;
    std::set<std::string> keys;
    collect_keys(json::parse(config.output), "", keys);
    ASSERT_GT(keys.size(), 40U);
    const Result explained = vantage(fmt::format("explain {} --json", fmt::join(keys, " ")));
    ASSERT_EQ(explained.exit_code, 0) << explained.output;
    const json explanation = json::parse(explained.output);
    for (const json& entry : explanation["entries"]) {
      EXPECT_FALSE(entry["text"].get<std::string>().empty()) << entry;
    }
  }
}

TEST_F(CommandLine, ExplainSaysWhatThereIsToKnow) {
  EXPECT_THAT(vantage("explain gain.a").output,
              AllOf(HasSubstr("gain.a (episode): number, default 0.995, [0, 1]\n"),
                    HasSubstr("gain: beer_lambert")));
  EXPECT_THAT(vantage("explain fsmi").output, AllOf(HasSubstr("P(e_j)"), HasSubstr("[Zhang2020]")));
  EXPECT_THAT(vantage("explain 4").output, HasSubstr("diverged"));
  EXPECT_THAT(
      vantage("explain 'exit codes'").output,
      AllOf(HasSubstr("4 (exit codes)"), HasSubstr("diverged"), HasSubstr("OpenGL context")));
  expect_error(vantage("explain gian.a"), 2, {"nothing is called 'gian.a'", "gain.a"});
  expect_error(vantage("explain"), 2, {"explain gain.a"});
  EXPECT_THAT(vantage("explain share_left").output,
              AllOf(HasSubstr("share_left (curves)"), HasSubstr("lower is better")));
  EXPECT_THAT(vantage("explain episode_defaults").output, HasSubstr("(robot.yaml): section"));
}

TEST_F(CommandLine, ExplainSaysWhatItKnowsBesideWhatItDoesNot) {
  const Result both = vantage("explain nonsense gain.a");
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.output, AllOf(HasSubstr("gain.a (episode)"),
                                 HasSubstr("error: explain: nothing is called 'nonsense'")));
  const Result only = vantage("explain gain.a nonsense --json 2>told");
  EXPECT_EQ(only.exit_code, 2);
  EXPECT_FALSE(json::parse(only.output)["entries"].empty());
}

TEST_F(CommandLine, ExplainTakesBeginningsGroupsAndCommands) {
  EXPECT_THAT(vantage("explain simulation.time").output,
              HasSubstr("simulation.timestep_s (episode)"));
  EXPECT_THAT(vantage("explain navigat").output,
              AllOf(HasSubstr("navigation (episode): section"),
                    HasSubstr("keys: navigation.footprint_radius_m, ")));
  expect_error(vantage("explain gai"), 2, {" begin with 'gai': gain, gain_over_distance"});
  EXPECT_THAT(vantage("explain map").output,
              HasSubstr("keys: map.centre_m, map.size_m, map.cells"));
  EXPECT_THAT(vantage("explain sweep").output,
              AllOf(HasSubstr("sweep (command)\n  run a study"), HasSubstr("  collect: merge")));
  EXPECT_THAT(vantage("explain 'sweep run'").output,
              AllOf(HasSubstr("sweep run (command)"), HasSubstr("  --keep-states: ")));
}

TEST_F(CommandLine, ListExplainsIfAsked) {
  const std::string gains = vantage("list gains -v").output;
  for (const char* name : {"adaptive", "fsmi", "rear_side_voxel"}) {
    EXPECT_THAT(gains, HasSubstr(name));
  }
  EXPECT_THAT(gains, HasSubstr("sum of a^n H(o)"));
  EXPECT_THAT(gains, HasSubstr("opacity_unobserved (number"));
  EXPECT_EQ(vantage("list choices").output.substr(0, 14), "random\ngreedy\n");
}

TEST_F(CommandLine, PrintedConfigurationSaysWhatItsKeysMean) {
  const std::string config = vantage("run --print-config").output;
  EXPECT_THAT(config, HasSubstr("\n# "));
  const auto copy = file("copy.yaml", config);
  EXPECT_EQ(vantage("run " + copy + " --print-config").output, config);
}

TEST_F(CommandLine, ThePagesOfTheReferenceAreThoseOfTheCode) {
  ASSERT_EQ(vantage("explain --pages pages").exit_code, 0);
  for (const char* page : {"keys.md", "strategies.md", "files.md"}) {
    EXPECT_EQ(shell("diff '" + (folder_ / "pages" / page).string() +
                    "' '" VANTAGE_SOURCE_DIR "/docs/reference/" + page + "'")
                  .output,
              "")
        << "vantage explain --pages docs/reference writes them anew";
  }
}

TEST_F(CommandLine, AListOfAllHasATitleATopic) {
  const auto all = nlohmann::ordered_json::parse(vantage("list --json").output);
  std::string text;
  for (const auto& [topic, entries] : all.items()) {
    text += topic + ":\n";
    for (const auto& entry : entries) text += "  " + entry.get<std::string>() + "\n";
  }
  EXPECT_EQ(vantage("list").output, text);
  std::string optimisers;
  for (const auto& entry : all["optimisers"]) optimisers += entry.get<std::string>() + "\n";
  EXPECT_EQ(vantage("list optimisers").output, optimisers);
  const auto scenes = nlohmann::ordered_json::parse(vantage("list scenes --json").output);
  EXPECT_EQ(scenes.size(), 1U);
  EXPECT_EQ(scenes["scenes"], all["scenes"]);
}

/// In order, of the folders as they are.
TEST_F(CommandLine, WhatIsListedIsThere) {
  const json all = json::parse(vantage("list --json").output);
  const fs::path root = VANTAGE_SOURCE_DIR;
  const auto there = [&](const fs::path& folder, const std::string& file) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(root / folder)) {
      const fs::path name = folder / entry.path().filename();
      const bool is = file.empty() ? name.extension() == ".yaml" : fs::exists(root / name / file);
      if (is) names.insert(name.string() + (file == "scene.xml" ? "/scene.xml" : ""));
    }
    return json(std::vector<std::string>(names.begin(), names.end()));
  };
  EXPECT_EQ(all["scenes"], there("models/scenes", "scene.xml"));
  EXPECT_EQ(all["robots"], there("models/robots", "robot.yaml"));
  EXPECT_EQ(all["episodes"], there("assets/episodes", ""));
  EXPECT_EQ(all["studies"], there("assets/studies", ""));
}

/// As bench/results has them; a network was not measured.
TEST_F(CommandLine, FeaturesAreListedWithDimensionsAndTimes) {
  const json figures =
      json::parse(shell("cat '" VANTAGE_SOURCE_DIR "/bench/results/features.json'").output)
          .at("figures");
  const auto line = [&](const char* name, int dimensions, const char* figure) {
    return fmt::format("{:<16}{:>5} dimensions{:>8.2f} ms\n", name, dimensions,
                       figures.at(figure).get<double>());
  };
  const std::string features = vantage("list features").output;
  for (const std::string& part :
       {line("colour", 144, "colour_ms"), line("bounding_box", 3, "bbox_ms"),
        line("sift", 1000, "sift_ms"), line("vfh", 308, "vfh_ms"),
        line("depth_lbp", 1000, "kernel_depth_lbp_ms"), line("size", 1000, "kernel_size_ms"),
        fmt::format("\n{:<16}{:>5} dimensions\n", "onnx", 256)}) {
    EXPECT_THAT(features, HasSubstr(part));
  }
}

/// All of them if they are no more than twenty.
TEST_F(CommandLine, OfNamesThatBeginAlikeTwentyAreTold) {
  for (const std::string begin : {"m", "ma"}) {
    const std::string text = vantage("explain " + begin).output;
    const std::string head = "error: explain: ";
    ASSERT_THAT(text, testing::StartsWith(head));
    const std::size_t all = std::stoul(text.substr(head.size()));
    const bool cut = text.ends_with(", ...\n");
    EXPECT_EQ(cut, all > 20) << text;
    const auto commas = static_cast<std::size_t>(std::ranges::count(text, ','));
    EXPECT_EQ(commas + (cut ? 0 : 1), std::min<std::size_t>(all, 20)) << text;
  }
  expect_error(vantage("explain zzzzzzzzzzzz"), 2, {"'zzzzzzzzzzzz'; vantage list and"});
  const std::string near = vantage("explain gian.a").output;
  EXPECT_THAT(near, HasSubstr("near it: gain.a, "));
  EXPECT_EQ(std::ranges::count(near, ','), 2) << near;
}

TEST_F(CommandLine, AnExplanationInJsonHasAllThatIsKnown) {
  const json told = json::parse(vantage("explain beer_lambert sensor.range_max_m --json").output);
  ASSERT_EQ(told["entries"].size(), 2U);
  const json& gain = told["entries"][0];
  EXPECT_EQ(gain["name"], "beer_lambert");
  EXPECT_EQ(gain["place"], "gain");
  EXPECT_EQ(gain["unit"], "bits");
  EXPECT_THAT(gain["formula"].get<std::string>(), HasSubstr("a^n H(o)"));
  ASSERT_EQ(gain["parameters"].size(), 1U);
  const json& a = gain["parameters"][0];
  EXPECT_THAT(a["text"].get<std::string>(), HasSubstr("a beam passes"));
  EXPECT_EQ(a["name"], "a");
  EXPECT_EQ(a["type"], "number");
  EXPECT_EQ(a["unit"], "");
  EXPECT_EQ(a["default"], "0.995");
  EXPECT_EQ(a["range"], "[0, 1]");
  EXPECT_EQ(told["entries"][1], json({{"name", "sensor.range_max_m"},
                                      {"place", "score-views"},
                                      {"type", "number"},
                                      {"unit", "m"},
                                      {"default", "3.5"},
                                      {"range", "> 0"},
                                      {"text", "greatest range; farther surfaces give no return"},
                                      {"formula", ""},
                                      {"source", ""},
                                      {"parameters", json::array()},
                                      {"applies", json::array()},
                                      {"keys", json::array()}}));
}

TEST_F(CommandLine, AnExplanationInWordsHasTypeUnitDefaultAndRange) {
  EXPECT_EQ(vantage("explain sensor.range_max_m").output,
            "sensor.range_max_m (score-views): number, m, default 3.5, > 0\n"
            "  greatest range; farther surfaces give no return\n");
  EXPECT_THAT(vantage("explain beer_lambert").output,
              AllOf(testing::StartsWith("beer_lambert (gain): bits\n  Entropy of "),
                    HasSubstr("\n  a (number, default 0.995, [0, 1]): probability that a beam ")));
}

TEST_F(CommandLine, WithoutMeasurementsFeaturesHaveNoTimes) {
  fs::create_directories(folder_ / "bench/results");
  const auto listed = [&] {
    return shell("cd '" + folder_.string() +
                 "' && VANTAGE_DATA=$PWD " VANTAGE_BINARY " list features");
  };
  for (const char* results : {"", "[1]", "{}", R"({"figures": {"sift_ms": 2.5}})"}) {
    if (*results != '\0') file("bench/results/features.json", results);
    const Result told = listed();
    EXPECT_EQ(told.exit_code, 0) << told.output;
    EXPECT_THAT(told.output, HasSubstr(fmt::format("{:<16}{:>5} dimensions\n", "colour", 144)));
  }
  EXPECT_THAT(listed().output,
              HasSubstr(fmt::format("{:<16}{:>5} dimensions    2.50 ms\n", "sift", 1000)));
}

TEST_F(CommandLine, WhatIsExplainedComesBeforeWhatIsNot) {
  const std::string both = vantage("explain nonsense gain.a gain").output;
  EXPECT_LT(both.find("gain.a (episode)"), both.find("error: explain")) << both;
  EXPECT_THAT(both, testing::Not(HasSubstr("keys: gain."))) << "it is no section";
  EXPECT_EQ(vantage("explain nonsense --json 2>/dev/null").output, "");
}

TEST_F(CommandLine, FilesAreWrittenOneKindAtATime) {
  for (const char* option : {"--manual", "--completion"}) {
    const Result result = vantage(fmt::format("explain {} {}", option, option + 2));
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_TRUE(fs::exists(folder_ / (option + 2))) << option;
  }
}

/// Of a text that has a line as long as can be, and one that is a letter short of its next word.
TEST_F(CommandLine, LinesAreFilledUpToAHundredCharacters) {
  std::istringstream text(vantage("explain gaze.worth").output);
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("  ")) lines.push_back(line);
  }
  ASSERT_GE(lines.size(), 3U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LE(lines[i].size(), 100U);
    const std::string next = lines[i + 1].substr(2, lines[i + 1].find(' ', 2) - 2);
    EXPECT_GT(lines[i].size() + 1 + next.size(), 100U) << lines[i];
  }
}

}  // namespace
}  // namespace vantage
