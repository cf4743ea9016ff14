/// Lets an episode, live or recorded, go on tick by tick at the pace that its viewer wants.
#pragma once

#include <chrono>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <optional>

namespace vantage {

using WallTime = std::chrono::steady_clock::time_point;

/// When the next tick is due if the last one was due at `last`. What was lost by thinking is not
/// made up for by haste.
WallTime next_due(WallTime last, WallTime now, double tick_s, double speed);

/// One thread waits before each tick; another says when it may go on.
class PlaybackGate {
 public:
  /// @param speed simulated seconds per second, > 0; infinity: no waiting
  explicit PlaybackGate(double speed = std::numeric_limits<double>::infinity()) : speed_(speed) {}

  /// Waits until a tick of `tick_s` may go on, or a seek is asked for.
  /// @return false once the gate is closed: there is to be no further tick
  bool wait(double tick_s);
  /// The simulated time to go to instead of going on, if one was asked for since the last call.
  std::optional<double> take_seek();

  void pause();
  void toggle_pause();
  void step();  ///< pauses after one more tick
  void set_speed(double speed);
  void seek(double time_s);
  void close();
  [[nodiscard]] bool paused() const;
  [[nodiscard]] double speed() const;

 private:
  template <class Change>
  void change(Change&& apply);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  double speed_;
  bool paused_ = false;
  bool closed_ = false;
  int steps_ = 0;
  std::optional<double> seek_s_;
  WallTime last_due_ = std::chrono::steady_clock::now();
};

}  // namespace vantage
