#include "vantage/runtime/process/command_files.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

using Command = std::vector<std::string>;

/// A folder of an episode, one of data, and a PATH of two folders.
class CommandFiles : public testing::Test {
 protected:
  CommandFiles() {
    if (const char* path = std::getenv("PATH"); path != nullptr) path_before_ = path;
    ::setenv("VANTAGE_DATA", (folder_ / "data").c_str(), 1);
    ::setenv("PATH", (named("first") + ":" + named("second")).c_str(), 1);
  }
  ~CommandFiles() override {
    ::unsetenv("VANTAGE_DATA");
    ::setenv("PATH", path_before_.c_str(), 1);
  }
  [[nodiscard]] std::string named(const std::string& name) const {
    return (folder_ / name).string();
  }
  std::string made(const std::string& name, mode_t mode = 0644) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    write_file(folder_ / name, "x");
    ::chmod(named(name).c_str(), mode);
    return named(name);
  }
  static std::string command_refusal(const Command& command) {
    try {
      static_cast<void>(runnable_command(command));
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  }
  support::TemporaryDirectory folder_;
  std::string path_before_;
};

TEST_F(CommandFiles, AreNamedSoThatTheyAreFoundAgain) {
  const std::string planner = made("episode/planner.py");
  made("episode/-planner.py");
  made("episode/run");
  made("episode/folder/inside");
  made("data/tools/weights.bin");
  const Command command{"run",  "planner.py", "-planner.py",      "",
                        "none", "folder",     "tools/weights.bin"};
  EXPECT_EQ(settled_command(command, folder_ / "episode"),
            (Command{"run", planner, "-planner.py", "", "none", "folder", "tools/weights.bin"}));
  EXPECT_EQ(settled_command({"./run", "x"}, folder_ / "episode"),
            (Command{named("episode/run"), "x"}))
      << "a program with a slash is a file";
}

TEST_F(CommandFiles, AreListedByTheirPlace) {
  const std::string planner = made("planner.py");
  const std::string weights = made("data/tools/weights.bin");
  made("data/python");
  const auto files = files_of_command({"python", planner, "-x", "tools/weights.bin", "none"});
  ASSERT_EQ(files.size(), 2U);
  EXPECT_EQ(files[0].first, 1U);
  EXPECT_EQ(files[0].second, planner);
  EXPECT_EQ(files[1].first, 3U);
  EXPECT_EQ(files[1].second, weights);
  ASSERT_EQ(files_of_command({planner}).size(), 1U);
  EXPECT_EQ(files_of_command({planner})[0].first, 0U);
}

TEST_F(CommandFiles, ProgramsAreThoseOfPath) {
  made("first/tool/inside");
  const std::string tool = made("second/tool", 0755);
  made("second/text");
  const std::string weights = made("data/tools/weights.bin");
  EXPECT_EQ(runnable_command({"tool", "-v", "tools/weights.bin"}), (Command{tool, "-v", weights}));
  EXPECT_EQ(runnable_command({tool}), Command{tool});
  EXPECT_EQ(command_refusal({"text"}), "choice.command: there is no program 'text' in PATH");
  EXPECT_EQ(command_refusal({named("second/text")}),
            "choice.command: '" + named("second/text") + "' is no program that can be run");
  EXPECT_EQ(command_refusal({"./nowhere"}),
            "choice.command: './nowhere' is no program that can be run");
}

TEST_F(CommandFiles, TheFirstProgramInPathCounts) {
  const std::string first = made("first/tool", 0755);
  made("second/tool", 0755);
  EXPECT_EQ(runnable_command({"tool"}), Command{first});
}

}  // namespace
}  // namespace vantage
