#include "vantage/core/cancellation/stop_poll.hpp"

#include <utility>

namespace vantage {
namespace {

thread_local const std::function<void()>* asked = nullptr;

}  // namespace

StopPoll::StopPoll(std::function<void()> ask)
    : ask_(std::move(ask)), before_(std::exchange(asked, &ask_)) {}

StopPoll::~StopPoll() { asked = before_; }

void poll_stop() {
  if (asked != nullptr) (*asked)();
}

}  // namespace vantage
