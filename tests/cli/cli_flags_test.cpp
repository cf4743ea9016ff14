// The flags that are the same for every command.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <sstream>
#include <utility>

#include "tests/cli/command_line.hpp"

namespace vantage {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Not;

class CommonFlags : public CommandLine {
 protected:
  /// The commands below that one; itself if there are none.
  std::vector<std::string> leaves(const std::string& command) {
    const std::string& text = help(command);
    const std::string heading = "\nSubcommands:\n";
    const auto at = text.find(heading);
    if (at == std::string::npos) return {command};
    std::vector<std::string> found;
    std::istringstream lines(text.substr(at + heading.size()));
    for (std::string line; std::getline(lines, line) && line.starts_with("  ");) {
      if (line[2] == ' ') continue;  // a long text goes on
      const std::string name = line.substr(2, line.find(' ', 2) - 2);
      for (const std::string& leaf : leaves(fmt::format("{} {}", command, name)))
        found.push_back(leaf);
    }
    return found;
  }
  nlohmann::json json_of(const std::string& command, int exit_code = 0) {
    const Result result = vantage(command + " --json -q");
    EXPECT_EQ(result.exit_code, exit_code) << result.output;
    EXPECT_TRUE(nlohmann::json::accept(result.output)) << result.output;
    return nlohmann::json::parse(result.output, nullptr, false);
  }
};

TEST_F(CommonFlags, AreTakenByEveryCommand) {
  const auto commands = leaves("");
  EXPECT_THAT(commands, AllOf(Contains(" run"), Contains(" sweep collect"), Contains(" doctor"),
                              Contains(" dataset contact-sheet"), Not(Contains(" sweep"))));
  for (const std::string& command : commands) {
    const std::string& text = help(command);
    EXPECT_THAT(text, AllOf(HasSubstr(" -q,--quiet "), HasSubstr(" -v,--verbose "))) << command;
    if (command != " view") {  // its result is a window
      EXPECT_THAT(text, HasSubstr(" --json ")) << command;
    }
  }
}

TEST_F(CommonFlags, TakeNoValueAndExcludeEachOther) {
  EXPECT_EQ(vantage("list gains -q").exit_code, 0);
  EXPECT_EQ(vantage("list gains -v").exit_code, 0);
  const Result both = vantage("list gains -q -v");
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.output, AllOf(HasSubstr("--quiet"), HasSubstr("--verbose")));
  EXPECT_EQ(vantage("list gains --quiet=false").exit_code, 2);
  EXPECT_EQ(vantage("list gains --json=false").exit_code, 2);
}

TEST_F(CommonFlags, GoWithNumbersThatAreFinite) {
  for (const char* command :
       {"compare a b --tolerance", "export a --mcap a.mcap --image-period",
        "view --screenshot a.png --at", "scene from-mesh a.obj --out a.xml --floor",
        "scene from-mesh a.obj --out a.xml --cell", "recognise a b --model m --depth-unit-m",
        "recognise a b --model m --motion-deg", "dataset contact-sheet a --out a.png --yaw-deg"}) {
    const Result result = vantage(command + std::string(" nan"));
    EXPECT_EQ(result.exit_code, 2) << command;
    EXPECT_THAT(result.output, HasSubstr("nan is not a finite number")) << command;
  }
}

TEST_F(CommonFlags, QuietLeavesWarningsAndErrors) {
  expect_error(vantage("validate -q nowhere.yaml"), 3, {"nowhere.yaml"});
  EXPECT_THAT(vantage(std::string("run ") + kShort + "--out run").output, Not(HasSubstr("info")));
}

TEST_F(CommonFlags, QuietPrintsResultsOnly) {
  const std::string run = std::string("run ") + kShort + "--out run --overwrite ";
  EXPECT_EQ(vantage(run + ">result 2>told").exit_code, 0);
  EXPECT_EQ(shell("cat '" + (folder_ / "told").string() + "'").output, "");
  EXPECT_THAT(shell("cat '" + (folder_ / "result").string() + "'").output,
              HasSubstr("\nended by: limit of 1 scans\n"));
}

TEST_F(CommonFlags, JsonIsOneObject) {
  EXPECT_THAT(json_of("list gains")["gains"], Contains("adaptive"));
  EXPECT_TRUE(json_of("list").contains("scenes"));
  const auto gains = nlohmann::json::parse(vantage("list -v gains --json").output)["gains"];
  EXPECT_THAT(gains.at(0)["text"].get<std::string>(), HasSubstr("unobserved cells"));
  EXPECT_TRUE(json_of("doctor").contains("mujoco"));
  const auto files = json_of("validate nowhere.yaml", 3)["files"];
  EXPECT_EQ(files.at(0)["problems"].size(), 1U);
  ASSERT_EQ(vantage(std::string("run ") + kShort + "--out run").exit_code, 0);
  EXPECT_EQ(json_of("report run"), nlohmann::json({{"report", "run/report.html"}}));
  const auto replayed = json_of("replay run");
  EXPECT_TRUE(replayed["first_difference"].is_null());
  EXPECT_EQ(replayed["state_hash"].get<std::string>().size(), 16U);
  EXPECT_THAT(json_of("sweep plan assets/studies/smoke.yaml")["episodes"], Not(IsEmpty()));
}

struct OptionEnds {
  const char* option;
  const char* least;
  const char* most;
  std::vector<const char*> refused;
};

/// At both ends it is taken, and only the files are missing.
TEST_F(CommonFlags, NumbersHaveTheirRanges) {
  const std::pair<std::string, std::vector<OptionEnds>> commands[] = {
      {"scene from-mesh absent.obj --out a.xml",
       {{"--scale", "1e-6", "1e6", {"9e-7", "1.1e6"}},
        {"--height", "2", "100", {"1.9", "101"}},
        {"--cell", "0.005", "1", {"0.0049", "1.1"}},
        {"--clearance", "0.05", "10", {"0.049", "10.1"}},
        {"--max-geoms", "1", "100000", {"0", "100001"}}}},
      {"recognise a b --model none",
       {{"--elevation-deg", "-90", "90", {"-91", "91"}},
        {"--focal-px", "10", "1e5", {"9.9", "100001"}},
        {"--depth-unit-m", "0", "1", {"-0.1", "1.1"}},
        {"--farthest-m", "0", "1e6", {"-0.1"}},
        {"--top", "1", "1000000", {"0", "1000001"}}}},
      {"dataset import nowhere --out x",
       {{"--focal-px", "10", "1e5", {"9.9", "100001"}},
        {"--elevation-deg", "-90", "90", {"-91", "91"}},
        {"--bins", "2", "3600", {"1", "3601"}},
        {"--jobs", "1", "1024", {"0", "1025"}}}},
      {"dataset check nowhere", {{"--bins", "2", "3600", {"1", "3601"}}}},
      {"dataset contact-sheet nowhere --out a.png",
       {{"--cell", "16", "640", {"15", "641"}},
        {"--columns", "1", "200", {"0", "201"}},
        {"--video", "1", "4", {"0", "3", "5"}}}},
      {"compare a b", {{"--tolerance", "0", "1", {"-0.1", "1.1"}}}},
      {"sweep run nowhere", {{"--jobs", "1", "1024", {"0", "1025"}}}},
      {"sweep submit nowhere", {{"--array", "1", "100000", {"0", "100001"}}}},
      {"arena run nowhere", {{"--jobs", "1", "1024", {"0", "1025"}}}},
      {"branch nowhere --scan 1", {{"--then", "0", "10000", {"-1", "10001"}}}},
      {"train nowhere --out model", {{"--jobs", "1", "1024", {"0", "1025"}}}},
      {"view nowhere --screenshot a.png", {{"--at", "0", "1e6", {"-0.1"}}}},
      {"view nowhere",
       {{"--size", "64x8192", "8192x64", {"63x64", "64x63", "8193x64", "64x8193", "64", "64x"}}}}};
  const auto expect_code = [&](int code, const std::string& command, const char* option,
                               const char* value) {
    const std::string line = fmt::format("{} {}={}", command, option, value);
    EXPECT_EQ(vantage(line).exit_code, code) << line;
  };
  for (const auto& [command, options] : commands) {
    for (const OptionEnds& ends : options) {
      expect_code(3, command, ends.option, ends.least);
      expect_code(3, command, ends.option, ends.most);
      for (const char* value : ends.refused) expect_code(2, command, ends.option, value);
    }
  }
}

TEST_F(CommonFlags, TimeoutsUnitsAndYawsAreWhatTheyCanBe) {
  const auto expect_code = [&](int code, const std::string& before,
                               const std::vector<std::string>& values, const char* after = "") {
    for (const std::string& value : values) {
      EXPECT_EQ(vantage(before + value + after).exit_code, code) << before << value;
    }
  };
  const std::string add = "arena add nowhere mine --timeout=";
  expect_code(3, add, {"0.01", "86400"}, " -- sh");
  expect_code(2, add, {"0.009", "86401"}, " -- sh");
  const std::string take_in = "dataset import nowhere --out x ";
  expect_code(3, take_in + "--depth-unit=", {"auto", "mm", "m", "1", "0.0001"});
  expect_code(2, take_in + "--depth-unit=", {"0", "-1", "1.01", "1x", "cm"});
  expect_code(3, take_in + "--view-yaw=", {"front=10", "a=b=3", "top=-7.5"});
  expect_code(2, "run --dry-run --seed=", {"abc", "-1", "1.5", "1e3", "99999999999999999999"});
  expect_code(2, take_in + "--view-yaw=", {"front", "=3", "front=", "front=left"});
}

TEST_F(CommonFlags, WhatIsGivenIsNotEmpty) {
  const std::pair<std::string, std::vector<std::string>> commands[] = {
      {"run", {"--seed", "--out"}},
      {"view", {"--seed", "--out", "--screenshot"}},
      {"dataset render d", {"--objects", "--step-deg", "--seed", "--models"}},
      {"dataset contact-sheet d", {"--out"}},
      {"dataset import d", {"--out"}},
      {"train d", {"--out"}},
      {"evaluate d --model m", {"--out"}},
      {"export r", {"--mcap"}},
      {"arena run s", {"--out"}},
      {"sweep run s", {"--out"}},
      {"sweep submit s", {"--partition", "--time"}},
      {"branch r --scan 1", {"--out"}},
      {"score-views --map m", {"--views", "--sensor", "--gain", "--seed", "--write-views"}}};
  for (const auto& [command, options] : commands) {
    for (const std::string& option : options) {
      const Result result = vantage(fmt::format("{} {} ''", command, option));
      EXPECT_EQ(result.exit_code, 2) << command << " " << option;
      EXPECT_THAT(result.output, HasSubstr(option + ": is empty")) << command;
    }
  }
}

TEST_F(CommonFlags, WhatIsMissingIsNamed) {
  const std::pair<const char*, const char*> commands[] = {
      {"dataset render", "out"},
      {"dataset import --out x", "folder"},
      {"dataset import d", "--out"},
      {"dataset check", "root"},
      {"dataset info", "root"},
      {"dataset contact-sheet --out a.png", "root"},
      {"dataset contact-sheet d", "--out"},
      {"train d", "--out"},
      {"evaluate --model m --out t", "dataset"},
      {"evaluate d --out t", "--model"},
      {"evaluate d --model m", "--out"},
      {"recognise --model m", "files"},
      {"recognise a b", "--model"},
      {"export --mcap a.mcap", "dir"},
      {"export r", "--mcap"},
      {"replay", "dir"},
      {"report", "dir"},
      {"bound", "dir"},
      {"branch --scan 1", "dir"},
      {"compare a", "second"},
      {"validate", "files"},
      {"schema", "kind"},
      {"sweep run", "study"},
      {"arena add", "dir"},
      {"arena add a", "name"},
      {"score-views", "--map"},
      {"scene from-mesh --out a.xml", "mesh"},
      {"scene from-mesh a.obj", "--out"}};
  for (const auto& [command, missing] : commands) {
    const Result result = vantage(command);
    EXPECT_EQ(result.exit_code, 2) << command;
    EXPECT_THAT(result.output, HasSubstr(fmt::format("error: {} is required\n", missing)))
        << command;
  }
}

/// What follows the value of an option is the command's own: what is missing is that, no value.
TEST_F(CommonFlags, OptionsTakeOneValueAtATime) {
  const std::pair<const char*, int> commands[] = {
      {"run --dry-run --set seed=1 nowhere.yaml", 3},
      {"view --set seed=1 nowhere.yaml", 3},
      {"validate --set seed=1 nowhere.yaml", 3},
      {"sweep plan --set seed=1 nowhere.yaml", 3},
      {"sweep submit --sbatch-arg=--mem=2G nowhere.yaml", 3},
      {"arena run --set seed=1 nowhere.yaml", 3},
      {"train --out model --set videos=[1] nowhere", 3},
      {"evaluate --model none --out tables --set starts=4 nowhere", 3},
      {"recognise --model none --set seed=1 a b", 3},
      {"recognise --model none --view-names front a b", 3},
      {"recognise --model none --motion-deg 5 a b", 3},
      {"dataset import --out x --view-yaw front=10 nowhere", 3},
      {"dataset render --set seed=1 blocker/d", 5}};
  file("blocker", "");
  for (const auto& [command, exit_code] : commands) {
    const Result result = vantage(command + std::string(" -q"));
    EXPECT_EQ(result.exit_code, exit_code) << command << "\n" << result.output;
  }
}

TEST_F(CommonFlags, ASeedIsAWholeNumber) {
  for (const char* seed : {"0", "9", "1234567890"}) {
    EXPECT_EQ(vantage(std::string("run --dry-run --seed=") + seed).exit_code, 0) << seed;
  }
  for (const std::string seed : {"-1", "1.5", "12a", ":", "/"}) {
    const Result result = vantage("run --dry-run --seed=" + seed);
    EXPECT_EQ(result.exit_code, 2) << seed;
    EXPECT_THAT(result.output, HasSubstr("expected a whole number >= 0, got '" + seed + "'"));
  }
}

TEST_F(CommonFlags, ACommandIsOneAndHasOneVerb) {
  EXPECT_THAT(vantage("").output, HasSubstr("Subcommands:"));
  for (const char* command : {"arena", "dataset", "scene", "sweep", "list gains doctor"}) {
    const Result result = vantage(command);
    EXPECT_EQ(result.exit_code, 2) << command << ": " << result.output;
  }
}

/// It is asked to render where nothing can be written.
TEST_F(CommonFlags, ObjectsAreRenderedByAThousandProcessesAtMost) {
  file("blocker", "");
  for (const auto& [jobs, exit_code] : {std::pair("1", 5), {"1024", 5}, {"0", 2}, {"1025", 2}}) {
    const Result result = vantage(fmt::format("dataset render blocker/d -q --jobs {}", jobs));
    EXPECT_EQ(result.exit_code, exit_code) << jobs << ": " << result.output;
  }
}

}  // namespace
}  // namespace vantage
