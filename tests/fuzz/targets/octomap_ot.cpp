// OctoMap's .ot.
#include "tests/fuzz/fuzz_target.hpp"
#include "vantage/belief/map/octomap_io.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder& folder) {
  const auto file = folder.put("map.ot", bytes);
  read_octomap(file);
  read_octomap_grid(file);
}

}  // namespace vantage::fuzz
