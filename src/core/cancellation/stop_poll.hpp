/// Work of seconds asks now and then whether it shall go on. Who answers is not the work's concern.
#pragma once

#include <functional>

namespace vantage {

/// As long as it lives, poll_stop() in the thread that made it calls `ask`, which throws to end the
/// work. The one made last counts.
class StopPoll {
 public:
  explicit StopPoll(std::function<void()> ask);
  StopPoll(const StopPoll&) = delete;
  StopPoll& operator=(const StopPoll&) = delete;
  ~StopPoll();

 private:
  std::function<void()> ask_;
  const std::function<void()>* before_;
};

/// Once a few milliseconds of work, changes no result; nothing where no StopPoll is. @throws what
/// it throws
void poll_stop();

}  // namespace vantage
