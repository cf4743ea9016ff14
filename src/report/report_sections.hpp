/// Which sections the report page of a run has.
#pragma once

#include <string_view>

namespace vantage {

/// Figures of a flight along a path, which collections of studies draw too.
inline constexpr std::string_view kFlightFigures = "flight";

/// How the report page of a run shows the task: what assets/report knows under these names.
struct ReportSections {
  std::string_view figures = {};    ///< "mapping", "recognition", "change", "flight"
  std::string_view steps = {};      ///< list of metrics.json that the page steps through; or empty
  std::string_view step_word = {};  ///< what it calls one of them
  bool map = false;                 ///< voxels.bin is there unless the run was lean
  bool scene = false;               ///< scene.bin and voxels.bin are shown where they are there
  std::string_view view_heading = {};  ///< of the 3-D view
};

}  // namespace vantage
