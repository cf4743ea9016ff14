/// A box of a grid's cells, for work that leaves the rest of a large one alone.
#pragma once

#include <Eigen/Geometry>

#include <cstddef>

#include "vantage/geometry/grid_frame.hpp"

namespace vantage {

/// Cells are numbered as in the grid; the linear index is that of the part alone, x fastest.
struct GridPart {
  Eigen::Array3i begin = Eigen::Array3i::Zero();
  Eigen::Array3i count = Eigen::Array3i::Zero();  ///< along each axis; all 0 if there are none

  [[nodiscard]] Eigen::Array3i end() const { return begin + count; }
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(count.x()) * static_cast<std::size_t>(count.y()) *
           static_cast<std::size_t>(count.z());
  }
  [[nodiscard]] std::size_t index(const Eigen::Array3i& cell) const {
    const Eigen::Array3i at = cell - begin;
    return (static_cast<std::size_t>(at.z()) * static_cast<std::size_t>(count.y()) +
            static_cast<std::size_t>(at.y())) *
               static_cast<std::size_t>(count.x()) +
           static_cast<std::size_t>(at.x());
  }
};

/// All of it.
GridPart whole(const GridFrame& frame);

/// The cells of the grid that `box_m`, world, meets, and two more all round: what rounding may add
/// to them.
GridPart cells_about(const GridFrame& frame, const Eigen::AlignedBox3d& box_m);

}  // namespace vantage
