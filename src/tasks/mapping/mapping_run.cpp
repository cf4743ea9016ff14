#include "vantage/tasks/mapping/mapping_run.hpp"

namespace vantage {

WindowContent mapping_window(const MappingOptions& options) {
  const Eigen::AlignedBox3d box = options.map.frame().box();
  return {.overview_m = {box.min().head<2>(), box.max().head<2>()},
          .map = options.map.frame(),
          .scans = static_cast<std::size_t>(options.scans),
          .gain_unit = std::string(unit_of(options.gain))};
}

TaskExtent mapping_extent(const MappingOptions& options) {
  return {"scans", "scans", static_cast<std::size_t>(options.scans)};
}

ReportSections mapping_report() {
  return {.figures = "mapping",
          .steps = "scans",
          .step_word = "scan",
          .map = true,
          .view_heading = "The map, scan by scan"};
}

}  // namespace vantage
