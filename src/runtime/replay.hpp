/// Runs the recorded commands again and compares every state.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace vantage {

class World;

struct ReplayResult {
  std::uint64_t ticks = 0;                        ///< compared
  std::uint64_t state_hash = 0;                   ///< of the replayed states
  std::optional<std::uint64_t> first_difference;  ///< step (control tick) that differs
  double time_s = 0.0;                            ///< simulated, of that step
  std::string what;                               ///< how it differs
  std::vector<std::string> changed_files;         ///< of scene and robot, since the recording
};

/// Files that changed are named, but only the states decide whether the replay differs.
/// @param world as the episode began it
/// @param assets hash of each file the episode is made of now, see asset_hashes()
/// @throws InputError if the folder lacks a file or one is damaged.
ReplayResult replay(const std::filesystem::path& run_dir, World& world,
                    const std::map<std::string, std::string>& assets);

}  // namespace vantage
