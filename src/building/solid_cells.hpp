/// Which cells of a grid a building fills.
#pragma once

#include <cstdint>

#include "vantage/building/fitted_grid.hpp"
#include "vantage/building/mesh_parts.hpp"

namespace vantage {

/// 1 for each cell that is solid, in the order of `grid.index`. A cell is if lines along two of
/// three axes have its centre inside: behind more surfaces that they enter than leave, of lines
/// that leave as many as they enter. Surfaces with nothing solid behind them, sheets, fill the cell
/// that they pass through, or between two cells the one that they turn their back to. So every line
/// along an axis that meets a surface meets a solid cell beside it, and no surface is farther from
/// the side of its cells than a cell. A sheet within half a cell of z = 0 is the floor: the cell
/// below.
std::vector<std::uint8_t> solid_cells(const BuildingMesh& mesh,
                                      const std::vector<Triangle>& triangles,
                                      const FittedGrid& grid);

}  // namespace vantage
