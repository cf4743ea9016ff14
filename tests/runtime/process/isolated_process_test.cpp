// What a program that is not ours is given, how its end is told, and that nothing of it is left.
#include "vantage/runtime/process/isolated_process.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

#include "tests/runtime/process/refused_namespaces.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
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
  EXPECT_EQ(end_of("exit 192"), "signal 64 (Real-time signal 30)") << "the last there is";
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

std::ptrdiff_t open_files() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/fd"),
                       std::filesystem::directory_iterator());
}

/// Whether it is one that nobody has asked for yet how it ended, or is no more.
bool has_ended(pid_t pid) {
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string number;
  std::string name;
  std::string state;
  return !(stat >> number >> name >> state) || state == "Z" || state == "X";
}

/// Waits, no longer than it has to.
bool ends_soon(pid_t pid) {
  for (int i = 0; i < 1000 && !has_ended(pid); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return has_ended(pid);
}

TEST_F(IsolatedProcesses, LeaveNoFileOpenAndNoChildBehind) {
  const std::ptrdiff_t before = open_files();
  EXPECT_EQ(end_of("exit 3"), "exit code 3");
  EXPECT_NE(start_refusal({.command = {"/no/such/program"},
                           .working_directory = folder_.path(),
                           .environment = {}}),
            "");
  EXPECT_EQ(open_files(), before);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

/// Three pipes and one that tells of the start: ten files at most at a time.
TEST_F(IsolatedProcesses, AreRefusedWhereNoPipeCanBeMade) {
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &limit), 0);
  const ProgramToRun program = shell("exit 0");
  const std::ptrdiff_t before = open_files();
  const int lowest = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  ::close(lowest);
  for (int more = 1; more < 10; ++more) {
    const rlimit few{static_cast<rlim_t>(lowest + more), limit.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &few), 0);
    const std::string refusal = start_refusal(program);
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &limit), 0);
    EXPECT_EQ(refusal, "cannot make a pipe: Too many open files") << more;
    EXPECT_EQ(open_files(), before) << more;
  }
}

TEST_F(IsolatedProcesses, KeepTheirUserAndLeaveNoCoreOfAnySize) {
  IsolatedProcess process(
      shell("id -u; id -g; while read a b c d soft hard rest; do if [ \"$b\" = core ]; then "
            "echo $soft $hard; fi; done < /proc/self/limits"));
  EXPECT_EQ(everything_from(process.output()),
            std::to_string(::geteuid()) + "\n" + std::to_string(::getegid()) + "\n0 0\n");
}

TEST_F(IsolatedProcesses, EndWithTheProgramNotWithWhatItStarted) {
  EXPECT_EQ(end_of("(true &); sleep 0.05; exit 5"), "exit code 5");
}

TEST_F(IsolatedProcesses, AreGoneWithWhoStartedThem) {
  const auto start_and_die = [&] {
    const IsolatedProcess process(shell(
        "read pid rest < /proc/self/stat; echo $pid > pid; exec >&-; trap '' TERM; sleep 100"));
    static_cast<void>(everything_from(process.output()));
    std::_Exit(7);
  };
  EXPECT_EXIT(start_and_die(), testing::ExitedWithCode(7), "");
  const pid_t pid = std::stoi(read_file(folder_ / "pid"));
  ASSERT_GT(pid, 1);
  EXPECT_TRUE(ends_soon(pid));
}

TEST_F(IsolatedProcesses, DoWithoutAUserOfTheirOwnWhereItIsRefused) {
  const auto without = [&] {
    if (!test_process::refuse_namespaces(CLONE_NEWUSER)) std::_Exit(7);
    IsolatedProcess process(shell("kill -TERM $$; sleep 100"));
    const bool as_told = process.wait_for_end(kEndsWithin_s) == "signal 15 (Terminated)";
    const bool may_still = ::unshare(CLONE_NEWNET) == 0;  // as root may
    std::_Exit(as_told && process.is_isolated() == may_still ? 7 : 1);
  };
  EXPECT_EXIT(without(), testing::ExitedWithCode(7), "");
}

TEST_F(IsolatedProcesses, RunAllTheSameWhereNamespacesAreRefused) {
  const auto without = [&] {
    if (!test_process::refuse_namespaces(CLONE_NEWUSER | CLONE_NEWNET | CLONE_NEWPID)) {
      write_file(folder_ / "pid", "0");
      std::_Exit(7);
    }
    bool good = end_of("exit 5") == "exit code 5";
    good = good && end_of("kill -TERM $$; sleep 100") == "signal 15 (Terminated)";
    good = good && start_refusal({.command = {"/no/such/program"},
                                  .working_directory = folder_.path(),
                                  .environment = {}}) ==
                       "cannot run /no/such/program: No such file or directory";
    {
      IsolatedProcess process(shell("sleep 100 >&- & echo $! > pid; exit 0"));
      good = good && process.wait_for_end(kEndsWithin_s) == "exit code 0";
      good = good && !process.is_isolated() && process.refusal() == "Operation not permitted";
    }
    std::_Exit(good ? 7 : 1);
  };
  EXPECT_EXIT(without(), testing::ExitedWithCode(7), "");
  const pid_t left_behind = std::stoi(read_file(folder_ / "pid"));
  EXPECT_TRUE(left_behind == 0 || ends_soon(left_behind)) << "it is of the program's group";
}

}  // namespace
}  // namespace vantage
