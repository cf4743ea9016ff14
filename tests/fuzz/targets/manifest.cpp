// manifest.json of a run.
#include "tests/fuzz/fuzz_target.hpp"
#include "vantage/hindsight/recorded_run.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder& folder) {
  static const bool once = [&] {
    folder.put("run/config.yaml", "scans: 2\n");
    folder.put("run/metrics.json",
               R"({"method": "adaptive", "state_hash": "0", "status": "completed",
                   "observable_cells": 1, "scans": []})");
    return true;
  }();
  folder.put("run/manifest.json", bytes);
  if (once) read_recorded_run(folder.path() / "run");
}

}  // namespace vantage::fuzz
