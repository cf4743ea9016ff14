#include "vantage/core/log.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <string>
#include <thread>

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
    EXPECT_EQ(text.find('\r'), std::string::npos) << "there is no bar in its way";
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

TEST_F(Log, TheFileGetsAllHoweverQuietTheConsoleBecomes) {
  const auto path = directory / "log.txt";
  log_to_file(path);
  set_verbosity(Verbosity::quiet);
  testing::internal::CaptureStderr();
  log_debug("detail");
  log_info("notice");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  log_to_file({});
  const std::string text = read_file(path);
  EXPECT_NE(text.find("debug: detail\n"), std::string::npos) << text;
  EXPECT_NE(text.find("info: notice\n"), std::string::npos) << text;
}

TEST_F(Log, WithoutAFileNoneIsMade) {
  const std::filesystem::path none = part_name({});
  std::filesystem::remove(none);
  log_to_file({});
  EXPECT_FALSE(std::filesystem::exists(none));
}

/// The bar of a job that is half done, on a terminal as wide as that; 0: it does not tell.
std::string half_done(const std::string& label, unsigned short columns) {
  Progress progress(label, 4.0);
  return support::shown_progress([&] { progress.update(2.0); }, columns);
}

TEST_F(Log, ABarHasThirtyPartsAndNoMoreThanALine) {
  if (!support::has_terminals()) GTEST_SKIP() << "no /dev/pts here";
  ::unsetenv("NO_COLOR");
  const std::string bar = "scan [" + std::string(15, '#') + std::string(15, '.') + "]  50 % ";
  EXPECT_EQ(half_done("scan", 250), "\r" + bar + "\x1b[K");
  EXPECT_EQ(half_done("scan", 20), "\r" + bar.substr(0, 19) + "\x1b[K");
  EXPECT_EQ(half_done(std::string(100, 'x'), 0), "\r" + std::string(79, 'x') + "\x1b[K");
  EXPECT_EQ(half_done(std::string(100, 'x'), 90), "\r" + std::string(89, 'x') + "\x1b[K");
}

/// What is not shown takes no bar away.
TEST_F(Log, ALineTakesThePlaceOfTheBar) {
  if (!support::has_terminals()) GTEST_SKIP() << "no /dev/pts here";
  ::unsetenv("NO_COLOR");
  Progress progress("scan", 4.0);
  const std::string shown = support::shown_progress([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(110));  // until one is due
    progress.update(2.0);
    log_debug("hidden");
    log_info("told");
    log_info("again");
  });
  std::string text = std::regex_replace(shown, std::regex("\x1b\\[[0-9;]*m"), "");
  text = std::regex_replace(text, std::regex("\r\n"), "\n");
  EXPECT_NE(text.find("50 % \x1b[K\r\x1b[Kinfo: told\ninfo: again\n"), std::string::npos) << text;
}

/// And what shows no bar ends none.
TEST_F(Log, ABarEndsItsLineOnce) {
  if (!support::has_terminals()) GTEST_SKIP() << "no /dev/pts here";
  ::unsetenv("NO_COLOR");
  const std::string shown = support::shown_progress([] {
    std::this_thread::sleep_for(std::chrono::milliseconds(110));  // until one is due
    Progress("scan", 4.0).update(2.0);
    const Progress none("none", 4.0);
  });
  EXPECT_EQ(std::regex_replace(shown, std::regex("\r\n"), "\n"),
            "\rscan [" + std::string(15, '#') + std::string(15, '.') + "]  50 % \x1b[K\n");
}

}  // namespace
}  // namespace vantage
