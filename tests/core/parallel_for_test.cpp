#include "vantage/core/parallel_for.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <thread>
#include <vector>

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

BackgroundWork::Parts parts_of(std::size_t count, const std::function<void(std::size_t)>& work) {
  BackgroundWork::Parts parts;
  for (std::size_t i = 0; i < count; ++i) parts.emplace_back([=] { work(i); });
  return parts;
}

TEST(BackgroundWork, DoesEachPartOnce) {
  for (const bool in_background : {false, true}) {
    std::vector<std::atomic<int>> done(100);
    BackgroundWork work(parts_of(done.size(), [&](std::size_t i) { ++done[i]; }), in_background);
    work.finish();
    work.finish();
    for (const auto& times : done) EXPECT_EQ(times, 1) << in_background;
  }
  BackgroundWork().finish();
}

TEST(BackgroundWork, InFrontOnlyBeginsWhenItIsToBeFinished) {
  std::vector<std::size_t> done;
  BackgroundWork work(parts_of(3, [&](std::size_t i) { done.push_back(i); }), false);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_TRUE(done.empty());
  work.finish();
  EXPECT_EQ(done, (std::vector<std::size_t>{0, 1, 2}));
}

void wait_until(const std::atomic<int>& number, int least) {
  for (int i = 0; i < 20000 && number < least; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_GE(number, least);
}

TEST(BackgroundWork, BeginsByItself) {
  std::atomic<int> done{0};
  BackgroundWork work(parts_of(2, [&](std::size_t) { ++done; }), true);
  wait_until(done, 2);
}

TEST(BackgroundWork, WhoeverAsksWorksAlong) {
  std::atomic<int> met{0};
  const auto meet = [&](std::size_t) {
    ++met;
    wait_until(met, 2);  // each waits for the other
  };
  BackgroundWork work(parts_of(2, meet), true);
  work.finish();
}

TEST(BackgroundWork, BeginsNothingAfterItWasStopped) {
  std::atomic<int> begun{0};
  std::atomic<int> ended{0};
  std::atomic<int> stopping{0};
  const auto last = [&](std::size_t) {
    ++begun;
    wait_until(stopping, 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ++ended;
  };
  BackgroundWork work(parts_of(1000, last), true);
  wait_until(begun, 1);
  stopping = 1;
  work.stop();
  EXPECT_EQ(ended, begun) << "none is under way";
  EXPECT_LT(begun, 1000);
  work.finish();
  EXPECT_EQ(ended, begun);
}

TEST(BackgroundWork, BeginsNothingAfterItsEnd) {
  std::atomic<int> begun{0};
  const auto slow = [&](std::size_t) {
    ++begun;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  {
    const BackgroundWork work(parts_of(1000, slow), true);
    wait_until(begun, 1);
  }
  EXPECT_LT(begun, 1000);
}

TEST(BackgroundWork, ThrowsWhereItIsAskedFor) {
  for (const bool in_background : {false, true}) {
    std::atomic<int> begun{0};
    const auto fail = [&](std::size_t) {
      ++begun;
      throw std::runtime_error("no memory");
    };
    BackgroundWork work(parts_of(1000, fail), in_background);
    EXPECT_THROW(work.finish(), std::runtime_error);
    EXPECT_LE(begun, 2);
  }
}

/// Each waits a while for one that must not come.
TEST(ParallelFor, OnOneThreadBeginsNothingBeforeTheLastIsDone) {
  for (const std::size_t count : {2U, 3U}) {
    std::atomic<int> busy{0};
    parallel_for(count, 1, [&](std::size_t) {
      ++busy;
      for (int i = 0; i < 20; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        EXPECT_EQ(busy, 1);
      }
      --busy;
    });
  }
}

TEST(BackgroundWork, BeginsNothingAfterAPartHasFailed) {
  int begun = 0;
  const auto fail = [&](std::size_t) {
    ++begun;
    throw std::runtime_error("no memory");
  };
  BackgroundWork work(parts_of(3, fail), false);
  EXPECT_THROW(work.finish(), std::runtime_error);
  EXPECT_NO_THROW(work.finish());
  EXPECT_EQ(begun, 1);
}

TEST(BackgroundWork, ThrowsWhatTheOtherThreadThrew) {
  std::atomic<int> begun{0};
  const auto fail = [&](std::size_t) {
    ++begun;
    throw std::runtime_error("no memory");
  };
  BackgroundWork work(parts_of(1, fail), true);
  wait_until(begun, 1);
  EXPECT_THROW(work.finish(), std::runtime_error);
}

TEST(BackgroundWork, IsFinishedOnceTheOtherThreadIs) {
  std::atomic<int> begun{0};
  std::atomic<int> ended{0};
  const auto slow = [&](std::size_t) {
    ++begun;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ++ended;
  };
  BackgroundWork work(parts_of(1, slow), true);
  wait_until(begun, 1);
  work.finish();
  EXPECT_EQ(ended, 1);
}

}  // namespace
}  // namespace vantage
