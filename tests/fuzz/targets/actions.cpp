// actions.csv of a run.
#include "tests/fuzz/fuzz_target.hpp"
#include "vantage/runtime/log/state_log.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder& folder) {
  const std::vector<std::string> names{"robot/x", "robot/y", "robot/yaw"};
  read_actions(folder.put("actions.csv", bytes), names);
}

}  // namespace vantage::fuzz
