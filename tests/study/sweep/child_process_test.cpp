// Processes that are this very program.
#include "vantage/study/sweep/child_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

TEST(ChildProcesses, AreThisProgramInAGroupOfTheirOwn) {
  const support::TemporaryDirectory folder;
  const pid_t child = start_self({"self", "--gtest_list_tests"}, folder / "output.txt");
  siginfo_t info{};
  ::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT);  // a zombie for now
  EXPECT_EQ(::getpgid(child), child) << "a signal for the sweep's group is not for it";
  const auto end = poll_child();
  ASSERT_TRUE(end);
  EXPECT_EQ(end->pid, child);
  EXPECT_EQ(end->exit_code, 0);
  EXPECT_FALSE(poll_child()) << "it was told already";
  EXPECT_THAT(read_file(folder / "output.txt"), testing::HasSubstr("\nChildProcesses.\n"));
}

/// As of a service, whose files are whatever numbers are free.
TEST(ChildProcesses, AreHeardWhereNoStandardStreamIsOpen) {
  for (const int closed : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    const support::TemporaryDirectory folder;
    std::fflush(nullptr);
    const int before = ::dup(closed);
    ::close(closed);
    const pid_t child = start_self({"self", "--gtest_list_tests"}, folder / "output.txt");
    ::dup2(before, closed);
    ::close(before);
    siginfo_t info{};
    ::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT);
    EXPECT_TRUE(poll_child());
    EXPECT_THAT(read_file(folder / "output.txt"), testing::HasSubstr("\nChildProcesses.\n"))
        << closed;
  }
}

TEST(ChildProcesses, NeedAFileForTheirOutput) {
  const support::TemporaryDirectory folder;
  EXPECT_THROW(start_self({"self", "--gtest_list_tests"}, folder / "nowhere/output.txt"),
               OutputError);
  EXPECT_FALSE(poll_child());
}

/// Memory that was used before is taken again, with what is left in it.
TEST(ChildProcesses, HaveNoArgumentBeyondTheirLast) {
  const support::TemporaryDirectory folder;
  const std::filesystem::path output = folder / "output.txt";
  const std::vector<std::string> arguments{"self", "--gtest_list_tests", "--gtest_brief=1"};
  for (int i = 0; i < 8; ++i) {
    const auto used = std::make_unique<volatile std::uintptr_t[]>(arguments.size() + 1);
    for (std::size_t k = 0; k <= arguments.size(); ++k) used[k] = UINTPTR_MAX;
  }
  const pid_t child = start_self(arguments, output);
  siginfo_t info{};
  ::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT);
  const auto end = poll_child();
  ASSERT_TRUE(end);
  EXPECT_EQ(end->exit_code, 0);
}

/// Everybody may read it and its owner write it, as far as the umask lets them.
TEST(ChildProcesses, WriteAFileThatOthersMayRead) {
  namespace fs = std::filesystem;
  const support::TemporaryDirectory folder;
  std::ofstream(folder / "plain") << "x";
  const auto open_files = [] {
    return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
  };
  const auto before = open_files();
  const pid_t child = start_self({"self", "--gtest_list_tests"}, folder / "output.txt");
  EXPECT_EQ(open_files(), before) << "it is the child's alone";
  EXPECT_EQ(fs::status(folder / "output.txt").permissions(),
            fs::status(folder / "plain").permissions() & static_cast<fs::perms>(0644));
  siginfo_t info{};
  ::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT);
  EXPECT_TRUE(poll_child());
}

TEST(ChildProcesses, HaveAnEndWhenTheyHaveEnded) {
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    ::pause();
    ::_exit(0);
  }
  EXPECT_FALSE(poll_child()) << "it waits";
  ::kill(child, SIGKILL);
  siginfo_t info{};
  ::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT);
  const auto end = poll_child();
  ASSERT_TRUE(end);
  EXPECT_EQ(end->pid, child);
  EXPECT_EQ(end->exit_code, 128 + SIGKILL);
  EXPECT_EQ(ChildEnd{}.pid, 0);
}

}  // namespace
}  // namespace vantage
