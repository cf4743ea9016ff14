/// The cells that share a face with one of a grid.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>

#include "vantage/geometry/grid_frame.hpp"

namespace vantage {

/// Whether `holds(cell index)` for one of the cells that share a face with cell `at`: six of them,
/// at the grid's edge fewer.
template <class Holds>
bool any_face_neighbour(const GridFrame& grid, const Eigen::Array3i& at, Holds&& holds) {
  const std::size_t cell = grid.index(at);
  const auto nx = static_cast<std::size_t>(grid.cells.x());
  const std::array<std::size_t, 3> strides{1, nx, nx * static_cast<std::size_t>(grid.cells.y())};
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t stride = strides[static_cast<std::size_t>(axis)];
    if (at[axis] > 0 && holds(cell - stride)) return true;
    if (at[axis] + 1 < grid.cells[axis] && holds(cell + stride)) return true;
  }
  return false;
}

}  // namespace vantage
