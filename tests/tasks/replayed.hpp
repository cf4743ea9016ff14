/// A run folder replayed, as `vantage replay` does it.
#pragma once

#include <filesystem>

#include "vantage/runtime/manifest.hpp"
#include "vantage/runtime/replay.hpp"
#include "vantage/sim/world/world.hpp"
#include "vantage/tasks/episode.hpp"

namespace vantage::support {

inline ReplayResult replayed(const std::filesystem::path& run_dir) {
  const ResolvedEpisode recorded = load_recorded(run_dir);
  World world(model_source(recorded), recorded.setup.options.simulation);
  add_outside_effects(recorded, world);
  return replay(run_dir, world, asset_hashes(recorded.setup, inputs(recorded.task)));
}

}  // namespace vantage::support
