#include "vantage/view/link.hpp"

#include <utility>

namespace vantage {

void ViewLink::tell(const StoryEvent& event) {
  const std::lock_guard lock(mutex_);
  story_.push_back(event);
}

std::size_t ViewLink::events() const {
  const std::lock_guard lock(mutex_);
  return story_.size();
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
  work.new_events.assign(story_.begin() + static_cast<std::ptrdiff_t>(told_), story_.end());
  told_ = story_.size();
  return work;
}

void ViewLink::deliver(ViewPicture picture) {
  const std::lock_guard lock(mutex_);
  picture_ = std::move(picture);
}

void ViewLink::set_controls(ViewControls controls) {
  {
    const std::lock_guard lock(mutex_);
    controls_ = std::move(controls);
    drawn_ = false;
  }
  changed_.notify_all();
}

std::optional<ViewPicture> ViewLink::take_picture() {
  const std::lock_guard lock(mutex_);
  return std::exchange(picture_, std::nullopt);
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
