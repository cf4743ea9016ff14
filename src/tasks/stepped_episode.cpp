#include "vantage/tasks/stepped_episode.hpp"

#include <csignal>
#include <utility>

#include "vantage/runtime/interrupt.hpp"

namespace vantage {

SteppedEpisode::SteppedEpisode(ResolvedEpisode resolved, std::string name, RunOptions options) {
  options.outside = {
      .name = std::move(name),
      .decide = [this](const DecisionRequest& request) { return ask(request); },
      .ended = [this](const MapSituation& situation, bool limit) { say_ended(situation, limit); },
      .blind = false};
  options.spectator.on_tick = [this, before = options.spectator.on_tick](const World& world) {
    if (interrupted_) throw Interrupted(SIGINT);
    if (before) before(world);
  };
  thread_ = std::thread([this, resolved = std::move(resolved), options = std::move(options)] {
    run_to_end(resolved, options);
  });
}

SteppedEpisode::~SteppedEpisode() {
  interrupt();
  thread_.join();
}

void SteppedEpisode::run_to_end(const ResolvedEpisode& resolved, const RunOptions& options) {
  RunOutcome outcome;
  std::exception_ptr failure;
  try {
    outcome = run(resolved, options);
  } catch (...) {
    failure = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  outcome_ = std::move(outcome);
  failure_ = failure;
  state_ = State::over;
  changed_.notify_all();
}

/// Until the caller lets it go on. @throws Interrupted
void SteppedEpisode::stop_at(State state, std::unique_lock<std::mutex>& lock) {
  state_ = state;
  changed_.notify_all();
  changed_.wait(lock, [this] { return state_ == State::runs || interrupted_; });
  state_ = State::runs;
  request_ = nullptr;
  situation_ = nullptr;
  if (interrupted_) throw Interrupted(SIGINT);
}

OutsideDecision SteppedEpisode::ask(const DecisionRequest& request) {
  std::unique_lock lock(mutex_);
  request_ = &request;
  stop_at(State::asks, lock);
  return *std::exchange(answer_, std::nullopt);
}

void SteppedEpisode::say_ended(const MapSituation& situation, bool at_limit) {
  std::unique_lock lock(mutex_);
  situation_ = &situation;
  at_limit_ = at_limit;
  stop_at(State::ended, lock);
}

SteppedEpisode::State SteppedEpisode::wait(std::chrono::milliseconds at_most) {
  std::unique_lock lock(mutex_);
  const auto stopped = [this] {
    return interrupted_ ? state_ == State::over : state_ != State::runs;
  };
  if (at_most == std::chrono::milliseconds::max()) {
    changed_.wait(lock, stopped);
  } else {
    changed_.wait_for(lock, at_most, stopped);
  }
  return state_;
}

const DecisionRequest& SteppedEpisode::request() const {
  const std::lock_guard lock(mutex_);
  expects(state_ == State::asks, "an episode that asks");
  return *request_;
}

void SteppedEpisode::answer(const OutsideDecision& decision) {
  check_decision(decision, request());
  const std::lock_guard lock(mutex_);
  answer_ = decision;
  state_ = State::runs;
  changed_.notify_all();
}

const MapSituation& SteppedEpisode::last_situation() const {
  const std::lock_guard lock(mutex_);
  expects(state_ == State::ended, "an episode that has taken its last view");
  return *situation_;
}

bool SteppedEpisode::at_limit() const {
  const std::lock_guard lock(mutex_);
  expects(state_ == State::ended, "an episode that has taken its last view");
  return at_limit_;
}

void SteppedEpisode::let_go() {
  const std::lock_guard lock(mutex_);
  expects(state_ == State::ended, "an episode that has taken its last view");
  state_ = State::runs;
  changed_.notify_all();
}

const RunOutcome& SteppedEpisode::outcome() const {
  const std::lock_guard lock(mutex_);
  expects(state_ == State::over, "an episode that is over");
  if (failure_) std::rethrow_exception(failure_);
  return outcome_;
}

void SteppedEpisode::interrupt() {
  const std::lock_guard lock(mutex_);
  interrupted_ = true;
  changed_.notify_all();
}

}  // namespace vantage
