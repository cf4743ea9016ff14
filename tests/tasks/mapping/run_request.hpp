/// What a session of an episode that maps is asked to run.
#pragma once

#include "vantage/runtime/episode_run.hpp"
#include "vantage/tasks/episode.hpp"

namespace vantage::support {

/// The episode must outlive it.
inline RunRequest mapping_request(const ResolvedEpisode& episode, RunOptions options) {
  return {.setup = episode.setup,
          .task = "next_best_view",
          .method = method_name(episode.task),
          .config = episode_yaml(episode),
          .inputs = {},
          .options = std::move(options)};
}

}  // namespace vantage::support
