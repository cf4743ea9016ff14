/// The command line as a user meets it, in a folder of its own.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "tests/cli/program_inside.hpp"
#include "tests/support/shell.hpp"

namespace vantage {
namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

using support::shell;
using Result = support::ShellResult;

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
#ifdef VANTAGE_INSIDE  // of tests that have the program in them
    if (auto result = support::run_inside(folder_, arguments)) return *result;
#endif
    return shell("cd '" + folder_.string() + "' && " VANTAGE_BINARY " " + arguments);
  }
  /// What it says to --help; each is asked once.
  const std::string& help(const std::string& command) {
    static std::map<std::string, std::string> texts;
    const auto [text, is_new] = texts.try_emplace(command);
    if (is_new) {
      const Result result = vantage(command + " --help");
      EXPECT_EQ(result.exit_code, 0) << command;
      text->second = result.output;
    }
    return text->second;
  }
  /// Runs it until the shell's condition `awaited` holds, its output in the file told, then sends
  /// it the signal.
  Result interrupted(const std::string& arguments, const std::string& awaited,
                     const std::string& signal) {
    return shell("cd '" + folder_.string() + "' && (env --default-signal=INT " VANTAGE_BINARY " " +
                 arguments + " >told 2>&1 & pid=$!; until " + awaited +
                 " || ! kill -0 $pid; do sleep .1; done; kill -" + signal +
                 " $pid; wait $pid; code=$?; cat told; exit $code)");
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

}  // namespace vantage
