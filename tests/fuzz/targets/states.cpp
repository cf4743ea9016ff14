// states.bin of a run.
#include <tuple>

#include "tests/fuzz/fuzz_target.hpp"
#include "vantage/runtime/log/state_log.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder& folder) {
  const RecordedStates states = read_states(folder.put("states.bin", bytes));
  if (states.count() > 0) std::ignore = states.controls(states.count() - 1);
}

}  // namespace vantage::fuzz
