/// What a search for cheapest ways is to look at next.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace vantage {

/// Nodes in order of cost, ties by number. Those of the first bucket of costs are a heap; the
/// others lie in the buckets after it, in no order, so that the heap stays small. No cost is below
/// one that was taken out.
class CostQueue {
 public:
  using Entry = std::pair<float, std::uint32_t>;

  explicit CostQueue(double bucket) : per_cost_(static_cast<float>(1.0 / bucket)) {}

  void push(float cost, std::uint32_t node) {
    const auto bucket = static_cast<std::size_t>(std::min(cost * per_cost_, kLastBucket));
    if (bucket <= current_) {
      heap_.emplace_back(cost, node);
      std::ranges::push_heap(heap_, std::greater<>());
      return;
    }
    if (bucket >= last_.size()) last_.resize(bucket + 1, kNone);
    waiting_.push_back({{cost, node}, std::exchange(last_[bucket], waiting_.size())});
  }

  std::optional<Entry> pop() {
    while (heap_.empty()) {
      if (++current_ >= last_.size()) return std::nullopt;
      for (std::size_t i = last_[current_]; i != kNone; i = waiting_[i].before) {
        heap_.push_back(waiting_[i].entry);
      }
      std::ranges::make_heap(heap_, std::greater<>());
    }
    std::ranges::pop_heap(heap_, std::greater<>());
    const Entry first = heap_.back();
    heap_.pop_back();
    return first;
  }

 private:
  /// Holds all that costs more, too.
  static constexpr float kLastBucket = 1 << 20;
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  struct Waiting {
    Entry entry;
    std::size_t before;  ///< in the same bucket
  };
  float per_cost_;
  std::size_t current_ = 0;
  std::vector<Entry> heap_;
  std::vector<std::size_t> last_;  ///< of each bucket, in `waiting_`
  std::vector<Waiting> waiting_;
};

}  // namespace vantage
