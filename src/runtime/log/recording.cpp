#include "vantage/runtime/log/recording.hpp"

#include <fmt/format.h>

#include "vantage/core/error.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage {

RecordedStates load_states(const std::filesystem::path& run_dir, const World& world) {
  const auto path = run_dir / "states.bin";
  std::error_code error;
  if (!std::filesystem::exists(path, error) &&
      std::filesystem::exists(run_dir / "config.yaml", error)) {
    throw InputError(
        fmt::format("{}: missing, as of lean runs; `vantage run {} --out {} --overwrite` records "
                    "the run in full "
                    "(all of a study: vantage sweep run --keep-states)",
                    path.string(), (run_dir / "config.yaml").string(), run_dir.string()));
  }
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
