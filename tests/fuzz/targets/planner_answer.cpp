// What a planner of somebody's says: its first line, and then its answers to one situation.
#include <string>
#include <utility>

#include "tests/fuzz/fuzz_target.hpp"
#include "tests/tasks/mapping/external/asked_planner.hpp"
#include "vantage/runtime/process/line_buffer.hpp"
#include "vantage/tasks/mapping/external/planner_protocol.hpp"

namespace vantage::fuzz {
namespace {

void take(const std::string& line, bool is_first) {
  static const support::AskedSituation situation;
  static const DecisionRequest request = situation.request();
  try {
    if (is_first) {
      read_introduction(line);
    } else {
      check_decision(read_answer(line), request);
    }
  } catch (const BadDecision& error) {
    for (const char* c = error.what(); *c != 0; ++c) {
      if (*c < 0x20 || *c > 0x7e) __builtin_trap();  // it goes to metrics.json and terminals
    }
  }
}

}  // namespace

/// In two pieces, as pipes hand it over.
void read_input(std::string_view bytes, const InputFolder&) {
  LineBuffer heard(4096);
  bool is_first = true;
  for (const std::string_view piece : parts_of(bytes, 2)) {
    if (!heard.add(piece)) return;
    while (const auto line = heard.take()) take(*line, std::exchange(is_first, false));
  }
}

}  // namespace vantage::fuzz
