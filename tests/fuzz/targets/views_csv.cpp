// Views in CSV, written again.
#include "tests/fuzz/fuzz_target.hpp"
#include "vantage/planners/views/view_list.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder& folder) {
  const auto views = read_views(folder.put("views.csv", bytes));
  read_views(folder.put("again.csv", views_csv(views)));
}

}  // namespace vantage::fuzz
