// Processes that are this very program.
#include "vantage/study/sweep/child_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

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

TEST(ChildProcesses, NeedAFileForTheirOutput) {
  const support::TemporaryDirectory folder;
  EXPECT_THROW(start_self({"self", "--gtest_list_tests"}, folder / "nowhere/output.txt"),
               OutputError);
  EXPECT_FALSE(poll_child());
}

}  // namespace
}  // namespace vantage
