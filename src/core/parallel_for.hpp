#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace vantage {

/// Calls work(0) ... work(count - 1), spread over the threads as they get free.
template <class Work>
void parallel_for(std::size_t count, int threads, Work&& work) {
  std::atomic<std::size_t> next{0};
  const auto worker = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::jthread> others;
  const auto wanted = std::min(count, static_cast<std::size_t>(threads));
  for (std::size_t i = 1; i < wanted; ++i) others.emplace_back(worker);
  worker();
}

}  // namespace vantage
