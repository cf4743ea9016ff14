#include "vantage/runtime/interrupt.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

namespace vantage {
namespace {

void raise_twice(int second_signal, std::chrono::milliseconds pause) {
  catch_interrupts();
  std::raise(SIGINT);
  std::this_thread::sleep_for(pause);
  std::raise(second_signal);
  try {
    throw_if_interrupted();
  } catch (const Interrupted& error) {
    std::_Exit(static_cast<int>(error.code()));
  }
}

TEST(Interrupt, NothingHappensWithoutASignal) { EXPECT_NO_THROW(throw_if_interrupted()); }

TEST(Interrupt, AnEchoOfTheFirstIsNotASecond) {
  EXPECT_EXIT(raise_twice(SIGINT, {}), testing::ExitedWithCode(130), "stopping");
}

TEST(Interrupt, ASecondOneEndsTheProcess) {
  using namespace std::chrono_literals;
  EXPECT_EXIT(raise_twice(SIGINT, 1100ms), testing::KilledBySignal(SIGINT), "stopping");
  EXPECT_EXIT(raise_twice(SIGTERM, 1100ms), testing::KilledBySignal(SIGTERM), "stopping");
}

}  // namespace
}  // namespace vantage
