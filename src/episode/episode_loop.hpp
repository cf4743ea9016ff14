/// The loop of every task: the dissertation's figure, one part a line.
#pragma once

#include "src/episode/interrupt.hpp"

namespace vantage {

enum class EpisodeStatus { completed, diverged, interrupted };

/// Runs `parts` until it says it is finished or the user interrupts; an interrupted step is
/// finished first. A task (next best view, recognition, trajectory) is a type with these eight
/// members.
template <class Parts>
EpisodeStatus run_episode(Parts& parts) {
  while (true) {
    const auto observation = parts.observe();
    parts.update(observation);
    parts.record();
    if (parts.finished()) return EpisodeStatus::completed;
    if (interrupt_signal() != 0) return EpisodeStatus::interrupted;
    auto candidates = parts.propose();
    parts.score(candidates);
    parts.act(candidates[parts.choose(candidates)]);
  }
}

}  // namespace vantage
