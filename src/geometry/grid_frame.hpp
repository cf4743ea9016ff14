/// Where the cells of a regular 3-D grid lie in the world, and the walk of a ray through them.
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "vantage/core/error.hpp"

namespace vantage {

/// A box of cells, axis-aligned in the world. Cells need not be cubes. Linear index: x fastest.
struct GridFrame {
  Eigen::Vector3d min_corner_m = Eigen::Vector3d::Zero();  ///< world
  Eigen::Vector3d cell_size_m = Eigen::Vector3d::Ones();
  Eigen::Array3i cells = Eigen::Array3i::Ones();

  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(cells.x()) * static_cast<std::size_t>(cells.y()) *
           static_cast<std::size_t>(cells.z());
  }
  [[nodiscard]] bool contains(const Eigen::Array3i& cell) const {
    return (cell >= 0).all() && (cell < cells).all();
  }
  [[nodiscard]] std::size_t index(const Eigen::Array3i& cell) const {
    return (static_cast<std::size_t>(cell.z()) * static_cast<std::size_t>(cells.y()) +
            static_cast<std::size_t>(cell.y())) *
               static_cast<std::size_t>(cells.x()) +
           static_cast<std::size_t>(cell.x());
  }
  [[nodiscard]] Eigen::Array3i cell(std::size_t index) const {
    const auto nx = static_cast<std::size_t>(cells.x());
    const auto ny = static_cast<std::size_t>(cells.y());
    return {static_cast<int>(index % nx), static_cast<int>(index / nx % ny),
            static_cast<int>(index / (nx * ny))};
  }
  /// The cell a world point lies in; may be outside the grid.
  [[nodiscard]] Eigen::Array3i cell_at(const Eigen::Vector3d& p_world) const {
    return ((p_world - min_corner_m).array() / cell_size_m.array()).floor().cast<int>();
  }
  [[nodiscard]] Eigen::Vector3d centre(const Eigen::Array3i& cell) const {
    return min_corner_m + ((cell.cast<double>() + 0.5) * cell_size_m.array()).matrix();
  }
  [[nodiscard]] Eigen::AlignedBox3d box() const {
    return {min_corner_m, min_corner_m + (cells.cast<double>() * cell_size_m.array()).matrix()};
  }
};

/// The grid of `cells` that fills the box round `centre_m` with edge lengths `size_m`.
GridFrame make_grid_frame(const std::array<double, 3>& centre_m,
                          const std::array<double, 3>& size_m, const std::array<int, 3>& cells);

/// The part [enter, leave] of the segment p0 + t (p1 - p0), t in [0, 1], inside `box`; empty if
/// enter > leave.
struct SegmentClip {
  double enter = 0.0;
  double leave = 1.0;
  [[nodiscard]] bool empty() const { return enter > leave; }
};
SegmentClip clip_segment(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& p0,
                         const Eigen::Vector3d& p1);

/// Where a walk along a ray is on one axis.
struct AxisWalk {
  int cell = 0;
  int goal = 0;
  int step = 0;
  std::ptrdiff_t stride = 0;                                ///< of the index, of a step
  double t_next = std::numeric_limits<double>::infinity();  ///< of the next boundary
  double t_delta = 0.0;

  /// @return what the index changes by. Without a branch: which axis is next is hard to foretell.
  std::ptrdiff_t advance(bool taken) {
    cell += taken ? step : 0;
    const double after = cell == goal ? std::numeric_limits<double>::infinity() : t_next + t_delta;
    t_next = taken ? after : t_next;
    return taken ? stride : 0;
  }
};

/// Calls `visit(cell index)`, or `visit(cell index, cell)`, for each grid cell the segment from
/// `p_from` to `p_to` passes, in order, the cell of `p_to` included; stops early when `visit`
/// returns false. Parts of the segment outside the grid are skipped. [AmanatidesWoo1987]
/// @return false if `visit` stopped the walk.
template <class Visit>
bool walk_ray(const GridFrame& grid, const Eigen::Vector3d& p_from, const Eigen::Vector3d& p_to,
              Visit&& visit) {
  const auto go_on = [&](std::ptrdiff_t index, const Eigen::Array3i& cell) {
    if constexpr (std::is_invocable_v<Visit&, std::size_t, const Eigen::Array3i&>) {
      return visit(static_cast<std::size_t>(index), cell);
    } else {
      return visit(static_cast<std::size_t>(index));
    }
  };
  const SegmentClip clip = clip_segment(grid.box(), p_from, p_to);
  if (clip.empty()) return true;
  const Eigen::Vector3d d = p_to - p_from;
  const Eigen::Vector3d p_start = p_from + clip.enter * d;
  // Not p_from + d: rounding could end the walk in a neighbour of the cell of p_to.
  const Eigen::Vector3d p_end = clip.leave < 1.0 ? Eigen::Vector3d(p_from + clip.leave * d) : p_to;
  const Eigen::Array3i last_cell = grid.cells - 1;
  Eigen::Array3i cell = grid.cell_at(p_start).max(0).min(last_cell);
  const Eigen::Array3i goal = grid.cell_at(p_end).max(0).min(last_cell);

  const std::array<std::ptrdiff_t, 3> stride{1, grid.cells.x(),
                                             std::ptrdiff_t{grid.cells.x()} * grid.cells.y()};
  std::array<AxisWalk, 3> walk;
  int remaining = 0;
  for (int axis = 0; axis < 3; ++axis) {
    AxisWalk& along = walk[static_cast<std::size_t>(axis)];
    along.cell = cell[axis];
    along.goal = goal[axis];
    along.step = goal[axis] > cell[axis] ? 1 : (goal[axis] < cell[axis] ? -1 : 0);
    along.stride = along.step * stride[static_cast<std::size_t>(axis)];
    remaining += std::abs(goal[axis] - cell[axis]);
    if (along.step == 0) continue;
    const double boundary =
        grid.min_corner_m[axis] + (cell[axis] + (along.step > 0 ? 1 : 0)) * grid.cell_size_m[axis];
    along.t_next = (boundary - p_from[axis]) / d[axis];
    along.t_delta = grid.cell_size_m[axis] / std::abs(d[axis]);
  }
  auto [x, y, z] = walk;
  auto index = static_cast<std::ptrdiff_t>(grid.index(cell));
  for (; remaining > 0; --remaining) {
    if (!go_on(index, {x.cell, y.cell, z.cell})) return false;
    const bool x_first = x.t_next < y.t_next;
    const bool step_z = z.t_next < (x_first ? x.t_next : y.t_next);
    index += x.advance(x_first && !step_z);
    index += y.advance(!x_first && !step_z);
    index += z.advance(step_z);
  }
  return go_on(index, {x.cell, y.cell, z.cell});
}

}  // namespace vantage
