// What passes between the program and the processes that render for it.
#include "tests/fuzz/fuzz_target.hpp"
#include "vantage/dataset/render_worker.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder&) {
  std::string received(bytes);
  while (const auto message = take_message(received)) parse_answer(*message);
}

}  // namespace vantage::fuzz
