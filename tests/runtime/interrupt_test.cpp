#include "vantage/runtime/interrupt.hpp"

#include <gtest/gtest.h>

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
  for (const auto pause : {300ms, 1100ms}) {
    EXPECT_EXIT(raise_twice(SIGINT, pause, 1), testing::ExitedWithCode(130), "stopping");
    EXPECT_EXIT(raise_twice(SIGTERM, pause, 1), testing::ExitedWithCode(143), "stopping");
  }
}

TEST(Interrupt, QuietIsQuiet) {
  const auto quiet = [] {
    set_verbosity(Verbosity::quiet);
    raise_twice(SIGINT, {});
  };
  EXPECT_EXIT(quiet(), testing::ExitedWithCode(130), "^$");
}

}  // namespace
}  // namespace vantage
