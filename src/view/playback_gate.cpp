#include "vantage/view/playback_gate.hpp"

#include <algorithm>
#include <utility>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

/// How far behind its pace the episode may fall and still catch up.
constexpr std::chrono::milliseconds kSlack{100};

}  // namespace

WallTime next_due(WallTime last, WallTime now, double tick_s, double speed) {
  const std::chrono::duration<double> wait_s(tick_s / speed);
  const WallTime due = last + std::chrono::duration_cast<WallTime::duration>(wait_s);
  return std::max(due, now - kSlack);
}

bool PlaybackGate::wait(double tick_s) {
  std::unique_lock lock(mutex_);
  while (!closed_ && !seek_s_) {
    if (steps_ > 0) {
      --steps_;
      return true;
    }
    if (paused_) {
      changed_.wait(lock);
      continue;
    }
    const WallTime now = std::chrono::steady_clock::now();
    const WallTime due = next_due(last_due_, now, tick_s, speed_);
    if (due <= now) {
      last_due_ = due;
      return true;
    }
    changed_.wait_until(lock, due);
  }
  return !closed_;
}

std::optional<double> PlaybackGate::take_seek() {
  const std::lock_guard lock(mutex_);
  return std::exchange(seek_s_, std::nullopt);
}

template <class Change>
void PlaybackGate::change(Change&& apply) {
  {
    const std::lock_guard lock(mutex_);
    apply();
  }
  changed_.notify_all();
}

void PlaybackGate::pause() {
  change([this] { paused_ = true; });
}

void PlaybackGate::toggle_pause() {
  change([this] {
    paused_ = !paused_;
    steps_ = 0;
  });
}

void PlaybackGate::step() {
  change([this] {
    paused_ = true;
    ++steps_;
  });
}

void PlaybackGate::set_speed(double speed) {
  expects(speed > 0.0, "speed above 0");
  change([this, speed] { speed_ = speed; });
}

void PlaybackGate::seek(double time_s) {
  change([this, time_s] { seek_s_ = time_s; });
}

void PlaybackGate::close() {
  change([this] { closed_ = true; });
}

bool PlaybackGate::paused() const {
  const std::lock_guard lock(mutex_);
  return paused_;
}

double PlaybackGate::speed() const {
  const std::lock_guard lock(mutex_);
  return speed_;
}

}  // namespace vantage
