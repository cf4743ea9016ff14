// explain, list -v, and comments of --print-config: everything that has a name has a text.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <set>

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

}  // namespace
}  // namespace vantage
