// What a program that is not ours is given, how its end is told, and that nothing of it is left.
#include "vantage/runtime/process/isolated_process.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <thread>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr double kEndsWithin_s = 30.0;

class IsolatedProcesses : public testing::Test {
 protected:
  [[nodiscard]] ProgramToRun shell(const std::string& script) const {
    return {.command = {"/bin/sh", "-c", script},
            .working_directory = folder_.path(),
            .environment = {"PATH=/usr/bin:/bin", "COLOUR=blue"}};
  }
  [[nodiscard]] std::string end_of(const std::string& script) const {
    IsolatedProcess process(shell(script));
    return process.wait_for_end(kEndsWithin_s).value_or("none");
  }
  static std::string start_refusal(const ProgramToRun& program) {
    try {
      const IsolatedProcess process(program);
    } catch (const OutputError& error) {
      return error.what();
    }
    return "";
  }
  support::TemporaryDirectory folder_;
};

/// Everything up to the end.
std::string everything_from(int from) {
  std::string text;
  std::array<char, 256> room{};
  for (pollfd end{from, POLLIN, 0}; ::poll(&end, 1, 30000) > 0;) {
    const ssize_t got = ::read(from, room.data(), room.size());
    if (got <= 0) break;
    text.append(room.data(), static_cast<std::size_t>(got));
  }
  return text;
}

TEST_F(IsolatedProcesses, TellHowTheyEnd) {
  EXPECT_EQ(end_of("exit 0"), "exit code 0");
  EXPECT_EQ(end_of("exit 7"), "exit code 7");
  EXPECT_EQ(end_of("exit 128"), "exit code 128");
  EXPECT_EQ(end_of("exit 129"), "signal 1 (Hangup)") << "as shells tell a signal";
  EXPECT_EQ(end_of("exit 200"), "exit code 200");
  EXPECT_EQ(end_of("kill -TERM $$; sleep 100"), "signal 15 (Terminated)");
  EXPECT_EQ(end_of("kill -KILL $$; sleep 100"), "signal 9 (Killed)");
}

TEST_F(IsolatedProcesses, RunUntilTheyEnd) {
  IsolatedProcess process(shell("read line; exit 4"));
  EXPECT_FALSE(process.wait_for_end(0.0));
  EXPECT_FALSE(process.wait_for_end(0.1));
  ASSERT_EQ(::write(process.input(), "x\n", 2), 2);
  EXPECT_EQ(process.wait_for_end(kEndsWithin_s), "exit code 4");
  EXPECT_EQ(process.wait_for_end(0.0), "exit code 4") << "asked again";
}

TEST_F(IsolatedProcesses, HaveThreePipesThatDoNotBlock) {
  IsolatedProcess process(shell("echo to whom >&2; cat; exit 5"));
  EXPECT_GT(process.input(), STDERR_FILENO);
  EXPECT_GT(process.output(), STDERR_FILENO);
  EXPECT_GT(process.errors(), STDERR_FILENO);
  char byte = 0;
  EXPECT_EQ(::read(process.output(), &byte, 1), -1);
  EXPECT_EQ(errno, EAGAIN);
  ASSERT_EQ(::write(process.input(), "abc", 3), 3);
  process.close_input();
  EXPECT_EQ(process.input(), -1);
  EXPECT_EQ(everything_from(process.output()), "abc");
  EXPECT_EQ(everything_from(process.errors()), "to whom\n");
  EXPECT_EQ(process.wait_for_end(kEndsWithin_s), "exit code 5");
}

TEST_F(IsolatedProcesses, HaveTheEnvironmentAndTheFolderThatTheyAreGiven) {
  ::setenv("VANTAGE_OF_OURS", "1", 1);
  IsolatedProcess process(shell("echo \"$COLOUR$VANTAGE_OF_OURS\"; echo x > made"));
  EXPECT_EQ(everything_from(process.output()), "blue\n");
  EXPECT_EQ(process.wait_for_end(kEndsWithin_s), "exit code 0");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "made"));
  ::unsetenv("VANTAGE_OF_OURS");
}

TEST_F(IsolatedProcesses, HoldNoOpenFileOfOurs) {
  const int ours = ::open("/dev/null", O_RDONLY);
  ASSERT_GT(ours, STDERR_FILENO);
  const int also_ours = ::open("/dev/null", O_RDONLY);
  IsolatedProcess process(
      shell("for f in 3 4 5 6 7 8 9 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25; do "
            "if [ -e /proc/self/fd/$f ]; then echo $f; fi; done; echo end"));
  EXPECT_EQ(everything_from(process.output()), "end\n");
  ::close(also_ours);
  ::close(ours);
}

TEST_F(IsolatedProcesses, WhatCannotBeStartedIsAnErrorThatSaysWhy) {
  EXPECT_EQ(start_refusal({.command = {"/no/such/program"},
                           .working_directory = folder_.path(),
                           .environment = {}}),
            "cannot run /no/such/program: No such file or directory");
  ProgramToRun astray = shell("exit 0");
  astray.working_directory = folder_ / "nowhere";
  EXPECT_EQ(start_refusal(astray), "cannot run /bin/sh: No such file or directory");
}

TEST_F(IsolatedProcesses, AreGoneWithTheObject) {
  pid_t pid = 0;
  {
    IsolatedProcess process(
        shell("read pid rest < /proc/self/stat; echo $pid; exec >&-; trap '' TERM; sleep 100"));
    pid = static_cast<pid_t>(std::stoi(everything_from(process.output())));
    ASSERT_GT(pid, 1);
    EXPECT_EQ(::kill(pid, 0), 0);
  }
  for (int i = 0; i < 200 && ::kill(pid, 0) == 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_EQ(::kill(pid, 0), -1);
}

TEST_F(IsolatedProcesses, HeedTheSignalsThatWeDoNot) {
  sigset_t term;
  ::sigemptyset(&term);
  ::sigaddset(&term, SIGTERM);
  ::pthread_sigmask(SIG_BLOCK, &term, nullptr);
  const auto before = ::signal(SIGPIPE, SIG_IGN);
  EXPECT_EQ(end_of("kill -TERM $$; exit 5"), "signal 15 (Terminated)");
  EXPECT_EQ(end_of("kill -PIPE $$; exit 5"), "signal 13 (Broken pipe)");
  ::signal(SIGPIPE, before);
  ::pthread_sigmask(SIG_UNBLOCK, &term, nullptr);
}

TEST_F(IsolatedProcesses, LeaveNoCoreGainNoRightsAndAreAGroupOfTheirOwn) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_CORE, &before), 0);
  const rlimit as_large_as_it_may{before.rlim_max, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_CORE, &as_large_as_it_may), 0);
  IsolatedProcess process(
      shell("ulimit -c; ulimit -Hc; while read key value; do if [ \"$key\" = NoNewPrivs: ]; then "
            "echo $value; fi; done < /proc/self/status"));
  EXPECT_EQ(everything_from(process.output()), "0\n0\n1\n");
  ::setrlimit(RLIMIT_CORE, &before);
  IsolatedProcess grouped(
      shell("read pid name state parent group rest < /proc/self/stat; echo $group"));
  const std::string group = everything_from(grouped.output());
  ASSERT_FALSE(group.empty());
  EXPECT_NE(std::stoi(group), ::getpgrp());
}

}  // namespace
}  // namespace vantage
