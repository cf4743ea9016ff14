#include "vantage/runtime/interrupt.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "vantage/core/log.hpp"

namespace vantage {
namespace {

/// @param otherwise exit code where the second one did not end the process
void raise_twice(int second_signal, std::chrono::milliseconds pause, int otherwise = 0) {
  catch_interrupts();
  std::raise(SIGINT);
  std::this_thread::sleep_for(pause);
  std::raise(second_signal);
  try {
    throw_if_interrupted();
  } catch (const Interrupted& error) {
    std::_Exit(otherwise != 0 ? otherwise : static_cast<int>(error.code()));
  }
}

TEST(Interrupt, NothingHappensWithoutASignal) { EXPECT_NO_THROW(throw_if_interrupted()); }

TEST(Interrupt, AnEchoOfTheFirstIsNotASecond) {
  EXPECT_EXIT(raise_twice(SIGINT, {}), testing::ExitedWithCode(130), "stopping");
}

TEST(Interrupt, ASecondOneEndsTheProcess) {
  using namespace std::chrono_literals;
  for (const auto pause : {200ms, 1100ms}) {
    EXPECT_EXIT(raise_twice(SIGINT, pause, 1), testing::ExitedWithCode(130), "stopping");
    EXPECT_EXIT(raise_twice(SIGTERM, pause, 1), testing::ExitedWithCode(143), "stopping");
  }
}

TEST(Interrupt, AReaderThatGoesAwayEndsNothing) {
  const auto unread = [] {
    catch_interrupts();
    std::raise(SIGPIPE);
    std::_Exit(7);
  };
  EXPECT_EXIT(unread(), testing::ExitedWithCode(7), "");
}

TEST(Interrupt, QuietIsQuiet) {
  const auto quiet = [] {
    set_verbosity(Verbosity::quiet);
    raise_twice(SIGINT, {});
  };
  EXPECT_EXIT(quiet(), testing::ExitedWithCode(130), "^$");
}

/// A process may be kept from running for longer than an echo takes, but not again and again.
TEST(Interrupt, AnEchoOfTheFirstEndsNothing) {
  int code = 0;
  for (int attempt = 0; attempt < 5 && code != 7; ++attempt) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      set_verbosity(Verbosity::quiet);
      raise_twice(SIGINT, {}, 7);
      std::_Exit(1);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  EXPECT_EQ(code, 7);
}

}  // namespace
}  // namespace vantage
