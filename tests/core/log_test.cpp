#include "vantage/core/log.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <string>

#include "tests/support/temporary_directory.hpp"
#include "tests/support/terminal.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

class Log : public testing::Test {
 protected:
  ~Log() override {
    log_to_file({});
    set_verbosity(Verbosity::normal);
  }
  support::TemporaryDirectory directory;
};

TEST_F(Log, VerbosityDecidesWhatTheConsoleShows) {
  const auto shown = [](Verbosity verbosity) {
    set_verbosity(verbosity);
    testing::internal::CaptureStderr();
    log_debug("d");
    log_info("i");
    log_warning("w");
    log_error("e");
    const std::string text = testing::internal::GetCapturedStderr();
    return std::count(text.begin(), text.end(), '\n');
  };
  EXPECT_EQ(shown(Verbosity::quiet), 2);
  EXPECT_EQ(shown(Verbosity::normal), 3);
  EXPECT_EQ(shown(Verbosity::verbose), 4);
}

TEST_F(Log, TheFileGetsEveryLineUntilStopped) {
  const auto path = directory / "log.txt";
  set_verbosity(Verbosity::quiet);
  log_to_file(path);
  log_debug("detail {not a format}");
  log_to_file({});
  log_info("not in the file");
  const std::string text = read_file(path);
  EXPECT_NE(text.find("debug: detail {not a format}"), std::string::npos);
  EXPECT_EQ(text.find("not in the file"), std::string::npos);
}

TEST_F(Log, AFileThatCannotBeMadeIsAnOutputError) {
  std::ofstream(directory / "file") << "x";
  EXPECT_THROW(log_to_file(directory / "file" / "log.txt"), OutputError);
}

TEST_F(Log, ProgressIsLinesWithoutATerminal) {
  testing::internal::CaptureStderr();
  {
    Progress progress("scan", 4.0);
    progress.update(1.0);
    progress.update(2.0);  // too soon after the first
    progress.update(4.0, "done");
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "scan: 25 % \nscan: 100 % done\n");
}

TEST_F(Log, ProgressOfManyThingsIsNotManyLines) {
  testing::internal::CaptureStderr();
  for (int i = 0; i < 20; ++i) {
    Progress progress("work", 2.0);
    progress.update(1.0);
    progress.update(2.0);
    progress.update(2.0);
  }
  const std::string text = testing::internal::GetCapturedStderr();
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 2) << text;
}

/// What progress shows on a terminal.
std::string shown_on_terminal() {
  Progress progress("scan", 1000.0);
  double done = 0.0;
  return support::shown_progress([&] { progress.update(++done); }, 0);
}

TEST_F(Log, ProgressOnATerminalIsABarUnlessNoColorIsSet) {
  if (!support::has_terminals()) GTEST_SKIP() << "no /dev/pts here";
  constexpr auto kErase = "\x1b[K";
  ::unsetenv("NO_COLOR");
  EXPECT_NE(shown_on_terminal().find(kErase), std::string::npos);
  ::setenv("NO_COLOR", "", 1);
  EXPECT_NE(shown_on_terminal().find(kErase), std::string::npos);
  ::setenv("NO_COLOR", "1", 1);
  const std::string text = shown_on_terminal();
  EXPECT_EQ(text.find('\x1b'), std::string::npos) << text;
  EXPECT_EQ(text.rfind("scan: ", 0), 0U) << text;
  ::unsetenv("NO_COLOR");
}

TEST_F(Log, ProgressIsSilentWhenQuiet) {
  set_verbosity(Verbosity::quiet);
  testing::internal::CaptureStderr();
  Progress("scan", 4.0).update(1.0);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(Log, TheFileHoldsNothingOfAnEarlierRun) {
  const auto path = directory / "log.txt";
  std::ofstream(part_name(path)) << "cut short\n";
  log_to_file(path);
  log_debug("begun anew");
  log_to_file({});
  EXPECT_EQ(read_file(path).find("cut short"), std::string::npos);
  EXPECT_NE(read_file(path).find("begun anew"), std::string::npos);
}

/// In colour or not.
TEST_F(Log, ALineOfTheConsoleIsItsLevelAndItsMessage) {
  set_verbosity(Verbosity::verbose);
  testing::internal::CaptureStderr();
  log_debug("d {not a format}");
  log_info("i");
  log_warning("w");
  log_error("e");
  const std::string text = testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::regex_replace(text, std::regex("\x1b\\[[0-9;]*m"), ""),
            "debug: d {not a format}\ninfo: i\nwarning: w\nerror: e\n");
}

}  // namespace
}  // namespace vantage
