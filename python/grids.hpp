/// What bindings that take grids share.
#pragma once

#include <pybind11/numpy.h>

#include <string>
#include <vector>

#include "vantage/belief/map/occupancy_grid.hpp"

namespace vantage::python {

namespace py = pybind11;

/// (nx, ny, nz)
std::vector<py::ssize_t> shape_of(const GridFrame& frame);
/// Their memory may be written to from Python. @throws ConfigError if a cell is NaN
void require_cells(const OccupancyGrid& grid, const std::string& argument);

}  // namespace vantage::python
