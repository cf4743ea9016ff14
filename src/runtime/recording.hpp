/// A run folder as `replay` and `view` find it.
#pragma once

#include <filesystem>

#include "vantage/runtime/state_log.hpp"
#include "vantage/sim/world/world.hpp"
#include "vantage/tasks/scenario.hpp"

namespace vantage {

/// The configuration in a run folder.
/// @throws InputError if it is missing or not one of this version.
ResolvedEpisode load_recorded(const std::filesystem::path& run_dir);

/// The states in a run folder; at least one.
/// @throws InputError if they are missing, damaged, or not those of such a world.
RecordedStates load_states(const std::filesystem::path& run_dir, const World& world);

}  // namespace vantage
