#pragma once

#include <vector>

#include "planners/cell_tables.hpp"
#include "src/geometry/grid_frame.hpp"

namespace vantage {

inline constexpr float kOpaque = 64.0F;  ///< optical depth from which on a cell stops all light

/// The tables of an attenuated ray as the sweep reads them: each row of cells contiguous, along x
/// and, a second time, along y.
struct SweepTables {
  struct Layout {
    std::vector<float> optical_depth;  ///< -ln(transmission), per cell entered
    std::vector<float> weight;         ///< worth of seeing the cell, bits
  };
  GridFrame frame;
  Layout x_fastest;  ///< order of `frame.index`
  Layout y_fastest;  ///< x and y change places

  /// @param tables transmission and worth of every cell
  SweepTables(const GridFrame& frame, const CellTables& tables);
};

}  // namespace vantage
