/// The states in a run folder, as `replay` and `view` find them.
#pragma once

#include <filesystem>

#include "vantage/runtime/log/state_log.hpp"

namespace vantage {

class World;

/// The states in a run folder; at least one.
/// @throws InputError if they are missing, damaged, or not those of such a world.
RecordedStates load_states(const std::filesystem::path& run_dir, const World& world);

}  // namespace vantage
