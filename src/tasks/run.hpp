/// `vantage run`: an episode from its file to its run folder.
#pragma once

#include "vantage/runtime/episode_run.hpp"
#include "vantage/tasks/episode.hpp"

namespace vantage {

/// A failure, a divergence and an interruption are outcomes, not exceptions.
/// @throws OutputError, InputError, RendererError
RunOutcome run(const ResolvedEpisode& resolved, const RunOptions& options);

/// A few lines on how it has ended, for people.
std::string outcome_text(const ResolvedEpisode& resolved, const RunOutcome& outcome);

}  // namespace vantage
