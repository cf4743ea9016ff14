#include "vantage/core/parallel_for.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace vantage {
namespace {

TEST(ParallelFor, DoesEachOnce) {
  for (const int threads : {1, 2, 5}) {
    std::vector<std::atomic<int>> done(100);
    parallel_for(done.size(), threads, [&](std::size_t i) { ++done[i]; });
    for (const auto& times : done) EXPECT_EQ(times, 1) << threads;
  }
}

TEST(ParallelFor, ThrowsHereWhatAnyThreadThrew) {
  for (const int threads : {1, 2, 5}) {
    std::atomic<int> begun{0};
    EXPECT_THROW(parallel_for(1000, threads,
                              [&](std::size_t) {
                                ++begun;
                                throw std::runtime_error("no memory");
                              }),
                 std::runtime_error);
    EXPECT_LE(begun, threads);
  }
}

TEST(ParallelFor, HasNoMoreThreadsThanItIsGiven) {
  for (const int threads : {1, 2, 4}) {
    std::atomic<int> busy{0};
    std::atomic<int> most{0};
    parallel_for(200, threads, [&](std::size_t) {
      const int now = ++busy;
      int before = most;
      while (before < now && !most.compare_exchange_weak(before, now)) {
      }
      std::this_thread::yield();
      --busy;
    });
    EXPECT_LE(most, threads);
  }
  parallel_for(0, 3, [](std::size_t) { ADD_FAILURE() << "there is nothing to do"; });
}

TEST(ParallelFor, RunsTwoAtOnceOnTwoThreads) {
  std::atomic<int> met{0};
  parallel_for(2, 2, [&](std::size_t) {
    ++met;
    for (int i = 0; i < 20000 && met < 2; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(met, 2) << "each waits for the other";
  });
}

}  // namespace
}  // namespace vantage
