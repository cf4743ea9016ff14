/// A short run on a table top, recorded once for all tests of a program.
#pragma once

#include <string>
#include <vector>

#include "tests/support/overrides.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/log.hpp"
#include "vantage/hindsight/recorded_run.hpp"
#include "vantage/tasks/run.hpp"

namespace vantage::support {

inline RecordedRun short_run(const std::filesystem::path& folder,
                             const std::vector<std::string>& more) {
  set_verbosity(Verbosity::quiet);
  RunOptions options;
  options.directory = folder;
  options.lean = true;
  const auto overrides =
      overridden({"scans=5", "map.cells=[49,49,25]", "laser.scan_duration_s=2"}, more);
  run(load_episode(VANTAGE_SOURCE_DIR "/assets/episodes/tabletop.yaml", overrides), options);
  return read_recorded_run(folder);
}

}  // namespace vantage::support
