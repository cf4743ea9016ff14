/// The loop of every task: the dissertation's figure, one part a line.
#pragma once

#include <string>

#include "vantage/core/error.hpp"
#include "vantage/runtime/interrupt.hpp"

namespace vantage {

enum class EpisodeStatus { completed, failed, diverged, interrupted };

/// Ends an episode that cannot be completed: a recorded result, and a goal that was missed.
struct EpisodeFailed : Error {
  explicit EpisodeFailed(const std::string& why) : Error(ExitCode::goal_failed, why) {}
};

/// Runs `parts` until it says why it is finished: a limit that was hit, a stop that fired, the end
/// of its path. A task (next best view, recognition, trajectory) is a type with these eight
/// members; `finished()` is empty as long as the episode goes on.
/// @return what finished() said
/// @throws Interrupted, DivergedError, EpisodeFailed
template <class Parts>
std::string run_episode(Parts& parts) {
  while (true) {
    const auto observation = parts.observe();
    parts.update(observation);
    parts.record();
    if (std::string reason = parts.finished(); !reason.empty()) return reason;
    throw_if_interrupted();
    auto candidates = parts.propose();
    parts.score(candidates);
    throw_if_interrupted();
    parts.act(candidates[parts.choose(candidates)]);
  }
}

}  // namespace vantage
