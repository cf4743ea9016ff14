// Point clouds in PLY.
#include "vantage/perception/clouds/ply.hpp"

#include "tests/fuzz/fuzz_target.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder& folder) {
  read_ply(folder.put("cloud.ply", bytes));
}

}  // namespace vantage::fuzz
