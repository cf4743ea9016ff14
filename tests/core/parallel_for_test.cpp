#include "vantage/core/parallel_for.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

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

}  // namespace
}  // namespace vantage
