#include "vantage/planners/travel/cost_queue.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <queue>
#include <vector>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

using Entry = CostQueue::Entry;

/// As a search does: what it adds costs no less than what it took out last, often as much, now and
/// then far more.
TEST(CostQueue, GivesWhatAHeapOfAllGives) {
  Rng rng = Rng::stream(1, "costs");
  for (int trial = 0; trial < 50; ++trial) {
    CostQueue queue(0.05);
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> wanted;
    const auto push = [&](float cost) {
      const auto node = static_cast<std::uint32_t>(rng.uniform_index(1000));
      queue.push(cost, node);
      wanted.emplace(cost, node);
    };
    push(static_cast<float>(rng.uniform(0.0, 1.0)));
    for (int taken = 0; !wanted.empty(); ++taken) {
      const std::optional<Entry> first = queue.pop();
      ASSERT_TRUE(first);
      ASSERT_EQ(*first, wanted.top());
      wanted.pop();
      const std::size_t more = taken < 500 ? rng.uniform_index(4) : 0;
      for (std::size_t i = 0; i < more; ++i) {
        const double steps = static_cast<double>(rng.uniform_index(5)) * rng.uniform(0.9, 1.0);
        const double far = rng.uniform_index(20) == 0 ? 7.0 : 0.0;
        push(first->first + static_cast<float>(0.025 * steps + far));
      }
    }
    EXPECT_FALSE(queue.pop());
  }
}

TEST(CostQueue, TakesMoreWhenItIsEmpty) {
  CostQueue queue(1.0);
  EXPECT_FALSE(queue.pop());
  queue.push(3.5F, 7);
  queue.push(3.5F, 6);
  EXPECT_EQ(queue.pop(), (Entry{3.5F, 6}));
  EXPECT_EQ(queue.pop(), (Entry{3.5F, 7}));
  EXPECT_FALSE(queue.pop());
  queue.push(3.7F, 8);
  EXPECT_EQ(queue.pop(), (Entry{3.7F, 8}));
}

TEST(CostQueue, HoldsWhatCostsFarMoreThanItsBuckets) {
  CostQueue queue(0.05);
  for (const float cost : {3e30F, 1.0F, 1e12F, 2e12F}) queue.push(cost, 5);
  EXPECT_EQ(queue.pop(), (Entry{1.0F, 5}));
  EXPECT_EQ(queue.pop(), (Entry{1e12F, 5}));
  queue.push(1.5e12F, 6);
  for (const Entry& next : {Entry{1.5e12F, 6}, Entry{2e12F, 5}, Entry{3e30F, 5}}) {
    EXPECT_EQ(queue.pop(), next);
  }
  EXPECT_FALSE(queue.pop());
}

}  // namespace
}  // namespace vantage
