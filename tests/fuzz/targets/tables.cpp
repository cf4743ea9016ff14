// steps.csv and the trajectories of a run.
#include "tests/fuzz/fuzz_target.hpp"
#include "vantage/core/error.hpp"
#include "vantage/report/former_run.hpp"
#include "vantage/report/report_data.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder& folder) {
  const auto file = folder.put("table", bytes);
  try {
    read_tum(file);
  } catch (const Error&) {
  }
  CsvTable steps = read_csv(file);
  bring_up_to_date(steps);
}

}  // namespace vantage::fuzz
