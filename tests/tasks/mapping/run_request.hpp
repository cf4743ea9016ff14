/// What a session of an episode that maps is asked to run.
#pragma once

#include <string>
#include <utility>

#include "vantage/runtime/episode_run.hpp"
#include "vantage/tasks/episode.hpp"

namespace vantage::support {

/// The episode must outlive it. @param task as metrics.json calls it
inline RunRequest mapping_request(const ResolvedEpisode& episode, RunOptions options,
                                  std::string task = "next_best_view") {
  return {.setup = episode.setup,
          .task = std::move(task),
          .method = method_name(episode.task),
          .config = episode_yaml(episode),
          .inputs = {},
          .options = std::move(options)};
}

}  // namespace vantage::support
