/// An episode that stops at each of its decisions, for callers that want the loop to be theirs.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "vantage/tasks/run.hpp"

namespace vantage {

/// Runs an episode in a thread of its own, one step of it at a time: while it waits for a decision
/// nothing of it moves, and what it asks may be looked at. Its results do not depend on how long it
/// waits. Destroyed before its end it is interrupted: what there is by then is written.
///
///   SteppedEpisode episode(load_episode(path, {}), "mine", {});
///   while (episode.wait() == SteppedEpisode::State::asks)
///   episode.answer(choice_of(episode.request()));
class SteppedEpisode {
 public:
  enum class State {
    runs,
    asks,   ///< request() waits for an answer()
    ended,  ///< no further view is taken; last_situation() may be looked at until let_go()
    over    ///< outcome() is there
  };

  /// @param name of the method, for the metrics
  /// @param options whose `outside` is set here
  SteppedEpisode(ResolvedEpisode resolved, std::string name, RunOptions options);
  SteppedEpisode(const SteppedEpisode&) = delete;
  SteppedEpisode& operator=(const SteppedEpisode&) = delete;
  ~SteppedEpisode();

  /// Until it no longer runs, or that long.
  State wait(std::chrono::milliseconds at_most = std::chrono::milliseconds::max());

  /// @pre the state is `asks`, until answer()
  [[nodiscard]] const DecisionRequest& request() const;
  /// @throws BadDecision if it cannot be carried out; the request is open still
  void answer(const OutsideDecision& decision);

  /// @pre the state is `ended`, until let_go()
  [[nodiscard]] const MapSituation& last_situation() const;
  /// Whether scans or budget were used up. @pre as last_situation()
  [[nodiscard]] bool at_limit() const;
  void let_go();

  /// @pre the state is `over` @throws what run() threw
  [[nodiscard]] const RunOutcome& outcome() const;

  /// Ends it at its next tick, as an interruption; wait() for it.
  void interrupt();

 private:
  OutsideDecision ask(const DecisionRequest& request);
  void say_ended(const MapSituation& situation, bool at_limit);
  void stop_at(State state, std::unique_lock<std::mutex>& lock);
  void run_to_end(const ResolvedEpisode& resolved, const RunOptions& options);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  State state_ = State::runs;
  const DecisionRequest* request_ = nullptr;
  const MapSituation* situation_ = nullptr;
  bool at_limit_ = false;
  std::optional<OutsideDecision> answer_;
  std::atomic<bool> interrupted_ = false;
  RunOutcome outcome_;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace vantage
