#include "vantage/core/cancellation/stop_poll.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>

#include "vantage/core/parallel_for.hpp"

namespace vantage {
namespace {

TEST(StopPoll, AsksTheOneMadeLast) {
  poll_stop();  // nobody
  int outer = 0;
  int inner = 0;
  const StopPoll first([&] { ++outer; });
  {
    const StopPoll second([&] { ++inner; });
    poll_stop();
  }
  poll_stop();
  poll_stop();
  EXPECT_EQ(inner, 1);
  EXPECT_EQ(outer, 2);
}

TEST(StopPoll, AsksOfItsOwnThreadAlone) {
  int asked = 0;
  const StopPoll poll([&] { ++asked; });
  std::jthread(poll_stop).join();
  EXPECT_EQ(asked, 0);
}

TEST(StopPoll, EndsALoopOfSeveralThreads) {
  for (const int threads : {1, 3}) {
    const StopPoll poll([] { throw std::runtime_error("stop"); });
    std::atomic<int> begun{0};
    EXPECT_THROW(parallel_for(100'000, threads,
                              [&](std::size_t) {
                                ++begun;
                                std::this_thread::yield();
                                poll_stop();
                              }),
                 std::runtime_error);
    EXPECT_LT(begun, 100'000) << threads;
  }
}

}  // namespace
}  // namespace vantage
