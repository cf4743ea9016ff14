#include "vantage/view/link.hpp"

#include <utility>

namespace vantage {

void ViewLink::tell(const EpisodeEvent& event) {
  const std::lock_guard lock(mutex_);
  event_log_.push_back(event);
}

std::size_t ViewLink::events() const {
  const std::lock_guard lock(mutex_);
  return event_log_.size();
}

void ViewLink::show(std::vector<double> state, std::size_t events, bool still) {
  {
    const std::lock_guard lock(mutex_);
    moment_ = {std::move(state), events, still};
    drawn_ = false;
  }
  changed_.notify_all();
}

std::optional<ViewLink::Work> ViewLink::wait_for_work() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return closed_ || (!drawn_ && !moment_.state.empty()); });
  if (closed_) return std::nullopt;
  drawn_ = true;
  Work work{moment_, controls_, {}};
  work.new_events.assign(event_log_.begin() + static_cast<std::ptrdiff_t>(told_), event_log_.end());
  told_ = event_log_.size();
  return work;
}

void ViewLink::deliver(ViewFrame frame) {
  const std::lock_guard lock(mutex_);
  frame_ = std::move(frame);
}

void ViewLink::set_controls(ViewControls controls) {
  {
    const std::lock_guard lock(mutex_);
    controls_ = std::move(controls);
    drawn_ = false;
  }
  changed_.notify_all();
}

std::optional<ViewFrame> ViewLink::take_frame() {
  const std::lock_guard lock(mutex_);
  return std::exchange(frame_, std::nullopt);
}

void ViewLink::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

void ViewLink::fail(std::exception_ptr error) {
  const std::lock_guard lock(mutex_);
  if (!error_) error_ = std::move(error);
}

void ViewLink::rethrow() {
  const std::lock_guard lock(mutex_);
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

}  // namespace vantage
