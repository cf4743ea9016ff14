#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace vantage {

/// Calls work(0) ... work(count - 1), spread over the threads as they get free. After an exception
/// no call begins any more; the first one is thrown here, once all threads have ended.
template <class Work>
void parallel_for(std::size_t count, int threads, Work&& work) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  const auto worker = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++) work(i);
    } catch (...) {
      next = count;
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    const auto wanted = std::min(count, static_cast<std::size_t>(threads));
    for (std::size_t i = 1; i < wanted; ++i) others.emplace_back(worker);
    worker();
  }
  if (failure) std::rethrow_exception(failure);
}

/// Parts of work that do not touch each other, begun in their order by a thread of its own, and by
/// whoever asks for them to be finished.
class BackgroundWork {
 public:
  using Parts = std::vector<std::function<void()>>;

  BackgroundWork() = default;
  /// @param in_background false: all is done in finish()
  BackgroundWork(Parts parts, bool in_background) : shared_(std::make_shared<Shared>()) {
    shared_->parts = std::move(parts);
    if (!in_background) return;
    other_ = std::async(std::launch::async, [shared = shared_] { shared->work(); });
  }
  BackgroundWork(BackgroundWork&&) = default;
  BackgroundWork& operator=(BackgroundWork&&) = default;
  ~BackgroundWork() { stop(); }

  /// Returns once all parts are done. After an exception none begins any more. @throws the first
  /// one, of the calling thread's before the other's
  void finish() {
    if (shared_) shared_->work();
    if (other_.valid()) other_.get();
  }
  /// No part begins any more, and none is under way.
  void stop() {
    if (shared_) shared_->next = shared_->parts.size();
    if (other_.valid()) other_.wait();
  }

 private:
  struct Shared {
    Parts parts;
    std::atomic<std::size_t> next{0};

    void work() {
      try {
        for (std::size_t i = next++; i < parts.size(); i = next++) parts[i]();
      } catch (...) {
        next = parts.size();
        throw;
      }
    }
  };
  std::shared_ptr<Shared> shared_;
  std::future<void> other_;
};

}  // namespace vantage
