/// The program that chooses the views of an episode.
#pragma once

#include <memory>

#include "vantage/tasks/episode.hpp"
#include "vantage/tasks/mapping/external/external_planner.hpp"

namespace vantage {

/// That of the choice `external`, not started yet; null: another choice.
/// @throws ConfigError if there is no such program
std::unique_ptr<ExternalPlanner> external_planner(const ResolvedEpisode& resolved);

}  // namespace vantage
