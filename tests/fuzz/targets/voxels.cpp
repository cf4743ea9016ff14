// voxels.bin, packed for a page.
#include "tests/fuzz/fuzz_target.hpp"
#include "vantage/report/report_data.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder& folder) {
  pack_voxels(read_voxels(folder.put("voxels.bin", bytes)), 1000);
}

}  // namespace vantage::fuzz
