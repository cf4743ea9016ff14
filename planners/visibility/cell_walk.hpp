/// The walk of a ray to one cell of the grid, for gains that send a ray to every cell in sight.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "vantage/geometry/grid_frame.hpp"

namespace vantage {
namespace detail {

/// When the ray crosses its next cell face across one axis, and how it goes on from there. Places
/// on the ray are whole numbers, kUnit at the target: comparing and adding them takes no branch.
struct AxisWalk {
  static constexpr double kUnit = 0x1.0p60;
  static constexpr double kNever = 0x1.0p62;
  std::int64_t next = static_cast<std::int64_t>(kNever);
  std::int64_t delta = 0;
  std::ptrdiff_t stride = 0;
  int steps = 0;

  AxisWalk(const GridFrame& grid, int axis, const Eigen::Vector3d& p_from, double d, int from,
           int to, std::ptrdiff_t cell_stride)
      : steps(std::abs(to - from)) {
    if (steps == 0) return;
    const bool up = to > from;
    const double face = grid.min_corner_m[axis] + (from + (up ? 1 : 0)) * grid.cell_size_m[axis];
    const double per_metre = kUnit / d;
    next = static_cast<std::int64_t>(std::clamp((face - p_from[axis]) * per_metre, 0.0, kUnit));
    delta = static_cast<std::int64_t>(
        std::min(grid.cell_size_m[axis] * std::abs(per_metre), 2.0 * kUnit));
    stride = up ? cell_stride : -cell_stride;
  }
};

}  // namespace detail

/// walk_ray for a ray that ends in the centre of `target`, several times faster: the target lies
/// half a cell from every face, so rounding cannot carry the walk past it and no step looks for the
/// end. Calls `pass(cell index)` for the grid cells in front of the target, in order.
/// [AmanatidesWoo1987]
/// @return false if `pass` did and so stopped the walk.
template <class Pass>
bool walk_to_cell(const GridFrame& grid, const Eigen::Vector3d& p_from,
                  const Eigen::Array3i& target, Pass&& pass) {
  const Eigen::Vector3d p_to = grid.centre(target);
  const Eigen::Vector3d d = p_to - p_from;
  const double enter = clip_segment(grid.box(), p_from, p_to).enter;
  const Eigen::Array3i first = grid.cell_at(p_from + enter * d).max(0).min(grid.cells - 1);
  const auto nx = static_cast<std::ptrdiff_t>(grid.cells.x());
  detail::AxisWalk x(grid, 0, p_from, d.x(), first.x(), target.x(), 1);
  detail::AxisWalk y(grid, 1, p_from, d.y(), first.y(), target.y(), nx);
  detail::AxisWalk z(grid, 2, p_from, d.z(), first.z(), target.z(), nx * grid.cells.y());

  auto index = static_cast<std::ptrdiff_t>(grid.index(first));
  for (int remaining = x.steps + y.steps + z.steps; remaining > 0; --remaining) {
    if (!pass(static_cast<std::size_t>(index))) return false;
    const bool y_before_x = y.next <= x.next;
    const bool step_z = z.next < (y_before_x ? y.next : x.next);
    const bool step_x = !y_before_x && !step_z;
    const bool step_y = y_before_x && !step_z;
    const std::ptrdiff_t in_layer = y_before_x ? y.stride : x.stride;
    index += step_z ? z.stride : in_layer;
    x.next += step_x ? x.delta : 0;
    y.next += step_y ? y.delta : 0;
    z.next += step_z ? z.delta : 0;
  }
  return true;
}

}  // namespace vantage
