#include "vantage/runtime/recording.hpp"

#include <fmt/format.h>

#include "vantage/runtime/manifest.hpp"

namespace vantage {

ResolvedEpisode load_recorded(const std::filesystem::path& run_dir) {
  try {
    return load_episode(run_dir / "config.yaml", {});
  } catch (const ConfigError& error) {
    throw InputError(
        fmt::format("{}: not a configuration of this version, {}; manifest.json names "
                    "the one that recorded it",
                    error.what(), version_text()));
  }
}

RecordedStates load_states(const std::filesystem::path& run_dir, const World& world) {
  const auto path = run_dir / "states.bin";
  RecordedStates recorded = read_states(path);
  if (recorded.state_size != world.state().size() ||
      recorded.actuators != world.controls().size()) {
    throw InputError(fmt::format("{}: recorded with another scene or robot than {}", path.string(),
                                 world.source().scene.string()));
  }
  if (recorded.count() == 0) throw InputError(path.string() + ": holds no state");
  return recorded;
}

}  // namespace vantage
