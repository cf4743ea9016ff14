/// Someone who watches an episode run.
#pragma once

#include <functional>

#include "vantage/runtime/log/event_log.hpp"

namespace vantage {

class World;

/// Called in the thread of the episode, which waits for them. Either may be empty.
struct Spectator {
  /// With the world as it begins, then after each control tick; then it may throw Interrupted.
  std::function<void(const World&)> on_tick;
  std::function<void(const EpisodeEvent&)> on_event;
};

}  // namespace vantage
