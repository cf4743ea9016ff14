// The flags that are the same for every command.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <sstream>

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

}  // namespace
}  // namespace vantage
