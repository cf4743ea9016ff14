// branches.json of a run, to which another decision is added.
#include "tests/fuzz/fuzz_target.hpp"
#include "vantage/hindsight/branch_record.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder& folder) {
  folder.put("branches.json", bytes);
  keep_branches(folder.path(), {{.scan = 1, .then = 0, .gain_unit = "cells", .branches = {}}});
}

}  // namespace vantage::fuzz
