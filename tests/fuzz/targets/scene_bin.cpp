// scene.bin of a run.
#include "tests/fuzz/fuzz_target.hpp"
#include "vantage/report/drawn_scene.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder& folder) {
  write_drawn_scene(folder.path() / "again.bin", read_drawn_scene(folder.put("scene.bin", bytes)));
}

}  // namespace vantage::fuzz
