/// Someone who watches an episode run.
#pragma once

#include <functional>
#include <string_view>

#include "vantage/runtime/log/event_log.hpp"

namespace vantage {

class World;

/// Called in the thread of the episode, which waits for them. Any may be empty.
struct Spectator {
  /// With the world as it begins, then after each control tick; then it may throw Interrupted.
  std::function<void(const World&)> on_tick;
  std::function<void(const EpisodeEvent&)> on_event;
  /// With a row of steps.csv as it is recorded, and the names of its columns.
  std::function<void(std::string_view columns, std::string_view row)> on_step;
};

}  // namespace vantage
