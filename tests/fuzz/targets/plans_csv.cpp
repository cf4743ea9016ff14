// plans.csv, as the page of a run has it.
#include <nlohmann/json.hpp>

#include "tests/fuzz/fuzz_target.hpp"
#include "vantage/report/run_plans.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder& folder) {
  plans_json(folder.put("plans.csv", bytes));
}

}  // namespace vantage::fuzz
