// NumPy's arrays.
#include "vantage/perception/images/npy.hpp"

#include "tests/fuzz/fuzz_target.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder& folder) {
  read_npy(folder.put("depth.npy", bytes));
}

}  // namespace vantage::fuzz
