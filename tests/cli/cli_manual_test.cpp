// Pages of the manual and completion say what --help says: every command, every flag.
#include <fmt/format.h>

#include <regex>
#include <set>

#include "tests/cli/command_line.hpp"
#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace {

std::vector<std::string> matches(const std::string& text, const char* pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), regex); it != std::sregex_iterator();
       ++it) {
    found.push_back((*it)[1]);
  }
  return found;
}

/// The names that the section of a help text lists.
std::vector<std::string> listed(const std::string& help, const std::string& section) {
  const auto begin = help.find("\n" + section + ":\n");
  if (begin == std::string::npos) return {};
  const auto end = std::min(help.find("\n\n", begin + 1), help.size());
  return matches(help.substr(begin, end - begin), R"(\n  ([a-z][a-z-]*))");
}

std::string plain(std::string roff) {
  for (auto at = roff.find("\\-"); at != std::string::npos; at = roff.find("\\-", at)) {
    roff.erase(at, 1);
  }
  return roff;
}

class Manual : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    const Result made = vantage("explain --manual pages --completion completion");
    ASSERT_EQ(made.exit_code, 0) << made.output;
  }
  std::string page(const std::string& command) {
    return plain(read_file(folder_ / "pages" / ("vantage-" + command + ".1")));
  }
  /// What bash offers for the last of the words.
  std::set<std::string> offered(const std::string& words) {
    const Result told =
        shell("cd '" + folder_.string() + "' && bash -c '. ./completion; COMP_WORDS=(" + words +
              "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _vantage; "
              "printf \"%s\\n\" \"${COMPREPLY[@]}\"'");
    const auto names = matches(told.output, "([^\n]+)\n");
    return {names.begin(), names.end()};
  }
};

TEST_F(Manual, HasEveryCommandAndFlag) {
  const auto commands = listed(help(""), "Subcommands");
  ASSERT_GT(commands.size(), 14U);
  const std::string program = plain(read_file(folder_ / "pages/vantage.1"));
  std::size_t flags = 0;
  for (const std::string& command : commands) {
    EXPECT_THAT(program, HasSubstr("\\fB" + command + "\\fR"));
    EXPECT_TRUE(offered("vantage \"\"").contains(command)) << command;
    std::vector<std::string> paths{command};
    for (const auto& part : listed(help(command), "Subcommands"))
      paths.push_back(fmt::format("{} {}", command, part));
    for (const std::string& path : paths) {
      const std::string last = path.substr(path.rfind(' ') + 1);
      if (path != command) {
        EXPECT_TRUE(offered(fmt::format("vantage {} \"\"", command)).contains(last)) << path;
      }
      const auto offers = offered("vantage " + path + " -");
      for (const std::string& flag : matches(help(path), R"(\n  (?:-[a-z],)?(--[a-z-]+))")) {
        EXPECT_THAT(page(command), testing::ContainsRegex(flag + "[ \\\\]")) << path;
        EXPECT_TRUE(offers.contains(flag)) << path << " " << flag;
        ++flags;
      }
    }
  }
  EXPECT_GT(flags, 150U);
}

TEST_F(Manual, PagesAreWellFormed) {
  if (shell("command -v groff").exit_code != 0) GTEST_SKIP() << "without groff";
  const Result told = shell("cd '" + folder_.string() + "/pages' && groff -man -ww -z -Tutf8 *.1");
  EXPECT_EQ(told.exit_code, 0);
  EXPECT_EQ(told.output, "");
}

TEST_F(Manual, PagesShowWhatIsTyped) {
  if (shell("command -v groff").exit_code != 0) GTEST_SKIP() << "without groff";
  const Result told =
      shell("cd '" + folder_.string() + "/pages' && groff -man -Tascii -P-cbu vantage-run.1");
  EXPECT_THAT(told.output, testing::AllOf(HasSubstr("vantage run [OPTIONS] [episode]"),
                                          HasSubstr("--set key=value"), HasSubstr("EXIT STATUS"),
                                          HasSubstr("(default: assets/episodes/tabletop.yaml)")));
}

TEST_F(Manual, CompletesValues) {
  EXPECT_THAT(offered("vantage run --set gain.a_"), IsEmpty());
  EXPECT_TRUE(offered("vantage run --set gain.").contains("gain.a="));
  EXPECT_TRUE(offered("vantage sweep run --set choice = gre").contains("greedy"));
  EXPECT_TRUE(offered("vantage run --set gain =").contains("beer_lambert"));
  EXPECT_TRUE(offered("vantage list ch").contains("choices"));
  EXPECT_TRUE(offered("vantage schema \"\"").contains("study"));
  EXPECT_EQ(offered("vantage view --camera f"), std::set<std::string>{"follow"});
  EXPECT_THAT(offered("vantage run --out \"\""), IsEmpty());  // a file: left to bash
}

TEST_F(Manual, HasTheNotesOfItsCommands) {
  EXPECT_THAT(page("view"), HasSubstr("In the window: space pauses"));
  EXPECT_THAT(page("bound"), HasSubstr("Writes bound.json into the folder"));
  for (const char* command : {"train", "evaluate", "recognise", "score-views", "dataset"}) {
    EXPECT_THAT(page(command), HasSubstr("Keys of --set with their defaults")) << command;
  }
}

TEST_F(Manual, TellsWhatIsTakenIfNothingIsGiven) {
  EXPECT_THAT(page("view"),
              testing::AllOf(HasSubstr("(default: 1280x720)"), HasSubstr("(default: overview)")));
}

TEST_F(Manual, OnlyWhatTakesAValueHasOne) {
  const std::string run = page("run");
  for (const char* item : {"-q, --quiet", "--lean", "--json", "--seed SEED", "--set key=value"}) {
    EXPECT_THAT(run, HasSubstr(fmt::format("\n\\fB{}\\fR\n", item)));
  }
  EXPECT_THAT(run, HasSubstr(".B vantage run [OPTIONS] [episode]\n"));
  EXPECT_THAT(page("explain"), HasSubstr(".B vantage explain [OPTIONS] [names ...]\n"));
  EXPECT_THAT(page("compare"), HasSubstr(".B vantage compare [OPTIONS] first second\n"));
}

TEST_F(Manual, HasTheDefaultsOfItsOptions) {
  const std::pair<const char*, std::vector<const char*>> pages[] = {
      {"run", {"\\fBepisode\\fR: assets/episodes/tabletop.yaml"}},
      {"view",
       {"\\fBepisode\\fR: assets/episodes/tabletop.yaml", "--size SIZE\\fR: 1280x720",
        "--camera CAMERA\\fR: overview"}},
      {"arena",
       {"\\fBstudy\\fR: assets/studies/arena.yaml", "--timeout TIMEOUT\\fR: 10",
        "--jobs JOBS\\fR: all cores"}},
      {"compare", {"--tolerance TOLERANCE\\fR: 0"}},
      {"sweep", {"--shard SHARD\\fR: 1/1", "--jobs JOBS\\fR: all cores", "--array ARRAY\\fR: 16"}},
      {"dataset",
       {"--jobs JOBS\\fR: all cores", "--depth-unit DEPTH-UNIT\\fR: auto", "--cut CUT\\fR: auto",
        "--video VIDEO\\fR: 2", "--yaw-deg YAW-DEG\\fR: 300", "--cell CELL\\fR: 96",
        "--columns COLUMNS\\fR: 20"}},
      {"export", {"--image-period IMAGE-PERIOD\\fR: 1", "--image-height IMAGE-HEIGHT\\fR: 240"}},
      {"recognise",
       {"--depth-unit-m DEPTH-UNIT-M\\fR: 0", "--cut CUT\\fR: auto",
        "--farthest-m FARTHEST-M\\fR: 0", "--top TOP\\fR: 5"}},
      {"train", {"--jobs JOBS\\fR: all cores"}},
      {"evaluate", {"--jobs JOBS\\fR: all cores"}},
      {"scene",
       {"--scale SCALE\\fR: 1", "--up UP\\fR: auto", "--height HEIGHT\\fR: 3",
        "--cell CELL\\fR: 0.05", "--clearance CLEARANCE\\fR: 0.6",
        "--max-geoms MAX-GEOMS\\fR: 3000"}}};
  for (const auto& [command, options] : pages) {
    const std::string text = page(command);
    for (const std::string option : options) {
      const auto colon = option.rfind(": ");
      const std::string head = option.substr(0, colon) + "\n";
      const auto at = text.find(head);
      ASSERT_NE(at, text.npos) << command << ": " << head;
      const auto begin = at + head.size();
      EXPECT_THAT(text.substr(begin, text.find('\n', begin) - begin),
                  testing::EndsWith(" (default: " + option.substr(colon + 2) + ")"))
          << command << ": " << option;
    }
  }
}

TEST_F(Manual, HasTheExitStatusOfEveryCommand) {
  const std::string run = page("run");
  EXPECT_THAT(matches(run.substr(run.find(".SH EXIT STATUS\n")), R"(\n\.TP\n\\fB(\d+)\\fR\n)"),
              testing::ElementsAre("0", "1", "2", "3", "4", "5", "6", "70", "130", "143"));
  EXPECT_THAT(run, HasSubstr("\n\\fB5\\fR\noutput could not be written\n"));
}

}  // namespace
}  // namespace vantage
