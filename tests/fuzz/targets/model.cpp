// A recognition model, made ready to recognise with.
#include "tests/fuzz/fuzz_target.hpp"
#include "vantage/recognition/lean_recogniser.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder& folder) {
  load_lean_recogniser(folder.put("objects.model", bytes), {});
}

}  // namespace vantage::fuzz
