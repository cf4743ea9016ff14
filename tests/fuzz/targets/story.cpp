// story.bin, shown.
#include "tests/fuzz/fuzz_target.hpp"
#include "vantage/runtime/log/event_log.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder& folder) {
  const GridFrame frame = make_grid_frame({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {9, 9, 9});
  const auto events = read_event_log(folder.put("story.bin", bytes), frame.size());
  EventReplay replay(frame);
  replay.go_to(events, events.size());
}

}  // namespace vantage::fuzz
