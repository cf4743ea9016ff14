/// What bindings that take grids share.
#pragma once

#include <pybind11/numpy.h>

#include <array>
#include <string>
#include <vector>

#include "vantage/belief/map/occupancy_grid.hpp"

namespace vantage::python {

namespace py = pybind11;

/// (nx, ny, nz)
std::vector<py::ssize_t> shape_of(const GridFrame& frame);
/// (3, bx, by, bz): the shares of free, unobserved and occupied cells in each block of a division
/// of the grid into about equal blocks. @throws ConfigError if it has fewer cells than blocks
py::array_t<float> shares(const OccupancyGrid& grid, const std::array<int, 3>& blocks);
/// Their memory may be written to from Python. @throws ConfigError if a cell is NaN
void require_cells(const OccupancyGrid& grid, const std::string& argument);

}  // namespace vantage::python
