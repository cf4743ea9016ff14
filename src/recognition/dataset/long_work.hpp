/// Long work on many items: over threads, with progress, and stoppable.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "vantage/core/log.hpp"
#include "vantage/core/parallel_for.hpp"

namespace vantage {

struct LongWork {
  int threads = 1;  ///< >= 1; results do not depend on it
  /// Called before each item, by any thread; ends the work by throwing.
  std::function<void()> poll = [] {};
  /// Where extracted features are kept for the next time, see FeatureCache; empty: nowhere. Results
  /// do not depend on it.
  std::filesystem::path feature_cache = {};
  /// Told how far a part of the work is, one call at a time; empty: each part has a bar of its own.
  std::function<void(const std::string& part, std::size_t done, std::size_t of)> tell = {};
};

/// Calls work(0) ... work(count - 1), each once, in any order. Of what they throw, one is rethrown
/// when all threads have ended.
template <class Work>
void work_through(std::size_t count, const LongWork& how, const std::string& label, Work&& work) {
  std::optional<Progress> bar;
  if (!how.tell) bar.emplace(label, static_cast<double>(count));
  std::mutex mutex;
  std::exception_ptr failure;
  std::atomic<bool> over = false;
  std::size_t done = 0;
  parallel_for(count, how.threads, [&](std::size_t i) {
    if (over) return;
    try {
      how.poll();
      work(i);
      const std::lock_guard lock(mutex);
      ++done;
      if (how.tell) how.tell(label, done, count);
      if (bar) bar->update(static_cast<double>(done));
    } catch (...) {
      over = true;
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
    }
  });
  if (failure) std::rethrow_exception(failure);
}

}  // namespace vantage
