#include "vantage/runtime/log/recording.hpp"

#include <fmt/format.h>

#include "vantage/core/error.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage {

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
