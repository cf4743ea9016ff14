#include "vantage/belief/map/obstacle_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vantage/core/parallel_for.hpp"
#include "vantage/core/rounding.hpp"

namespace vantage {
namespace {

using Cells = std::vector<std::uint8_t>;

/// A walk may pass beside the cells of the line, by rounding, and the ball ends a cell before it.
constexpr int kMargin_cells = 2;
/// Crossings nearer than this, in cells, could come in the other order in walk_ray.
constexpr double kTie_cells = 1e-6;

/// near[i] <- min(near[i], max(away, from[i]))
void pull(std::uint8_t* near, const std::uint8_t* from, std::uint8_t away, int count) {
  for (int i = 0; i < count; ++i) near[i] = std::min(near[i], std::max(away, from[i]));
}

/// Along x: from 0 where occupied.
void spread_along_row(const float* log_odds, std::uint8_t* near, int count) {
  int last = -ObstacleDistance::kMax_cells;
  for (int x = 0; x < count; ++x) {
    if (log_odds[x] >= kOccupiedLogOdds) last = x;
    near[x] = static_cast<std::uint8_t>(std::min(x - last, ObstacleDistance::kMax_cells));
  }
  for (int x = count - 2; x >= 0; --x) {
    near[x] = std::min(near[x], static_cast<std::uint8_t>(near[x + 1] + 1));
  }
}

/// Across: each line of `width` cells, `stride` apart, from its neighbours up to the limit away.
void spread_across(const std::uint8_t* from, std::uint8_t* near, int lines, int line,
                   std::size_t stride, int width) {
  std::copy_n(from, width, near);
  for (int away = 1; away < ObstacleDistance::kMax_cells; ++away) {
    const std::size_t offset = static_cast<std::size_t>(away) * stride;
    if (line >= away) pull(near, from - offset, static_cast<std::uint8_t>(away), width);
    if (line + away < lines) pull(near, from + offset, static_cast<std::uint8_t>(away), width);
  }
}

Cells spread(const OccupancyGrid& grid, const GridPart& reach, int threads) {
  const int nx = reach.count.x();
  const int ny = reach.count.y();
  const auto nz = static_cast<std::size_t>(reach.count.z());
  const auto row = static_cast<std::size_t>(nx);
  const std::size_t slice = row * static_cast<std::size_t>(ny);
  Cells along_x(reach.size());
  Cells along_y(reach.size());
  parallel_for(nz, threads, [&](std::size_t z) {
    for (int y = 0; y < ny; ++y) {
      const Eigen::Array3i first = reach.begin + Eigen::Array3i(0, y, static_cast<int>(z));
      const float* log_odds = &grid.log_odds[grid.frame.index(first)];
      spread_along_row(log_odds, &along_x[reach.index(first)], nx);
    }
    for (int y = 0; y < ny; ++y) {
      const std::size_t at = z * slice + static_cast<std::size_t>(y) * row;
      spread_across(&along_x[at], &along_y[at], ny, y, row, nx);
    }
  });
  parallel_for(nz, threads, [&](std::size_t z) {
    const auto slices = static_cast<int>(nz);
    for (std::size_t at = z * slice; at < (z + 1) * slice; at += row) {
      spread_across(&along_y[at], &along_x[at], slices, static_cast<int>(z), slice, nx);
    }
  });
  return along_x;
}

}  // namespace

/// The segment in units of cells.
struct ObstacleDistance::Line {
  Eigen::Array3d start;
  Eigen::Array3d along;
  Eigen::Array3d per_cell;  ///< of the segment, a cell of each axis
  double most_cells;        ///< along the axis it crosses most of

  Line(const GridFrame& frame, const Eigen::Vector3d& p_from, const Eigen::Vector3d& p_to)
      : start((p_from - frame.min_corner_m).array() / frame.cell_size_m.array()),
        along((p_to - p_from).array() / frame.cell_size_m.array()),
        per_cell(along.inverse()),
        most_cells(along.abs().maxCoeff()) {}

  [[nodiscard]] Eigen::Array3i cell(const GridFrame& frame, double t) const {
    Eigen::Array3i cell;
    for (int axis = 0; axis < 3; ++axis) {
      const int at = floor_int(start[axis] + t * along[axis]);
      cell[axis] = std::clamp(at, 0, frame.cells[axis] - 1);
    }
    return cell;
  }
};

ObstacleDistance::ObstacleDistance(const OccupancyGrid& grid, int threads)
    : ObstacleDistance(grid, whole(grid.frame), threads) {}

ObstacleDistance::ObstacleDistance(const OccupancyGrid& grid, const GridPart& reach, int threads)
    : frame_(grid.frame), reach_(reach), cells_(spread(grid, reach, threads)) {}

bool ObstacleDistance::walk_is_clear(const Eigen::Vector3d& p_from,
                                     const Eigen::Vector3d& p_to) const {
  return walk_ray(frame_, p_from, p_to,
                  [&](std::size_t, const Eigen::Array3i& cell) { return cells(cell) != 0; });
}

/// Cell by cell until there is room to leap. `cell` is where the walk is then, `t` where it came
/// in.
ObstacleDistance::Meets ObstacleDistance::walk_beside(const Line& line, Eigen::Array3i& cell,
                                                      double& t) const {
  std::array<int, 3> step{};
  std::array<double, 3> t_next{};
  std::array<double, 3> t_delta{};
  for (int axis = 0; axis < 3; ++axis) {
    step[axis] = line.along[axis] > 0.0 ? 1 : -1;
    t_delta[axis] = std::abs(line.per_cell[axis]);
    t_next[axis] =
        line.along[axis] == 0.0
            ? std::numeric_limits<double>::infinity()
            : (cell[axis] + (step[axis] > 0 ? 1 : 0) - line.start[axis]) * line.per_cell[axis];
  }
  const double tie = kTie_cells / line.most_cells;
  while (true) {
    const int room = cells(cell);
    if (room == 0) return Meets::occupied;
    if (room > kMargin_cells) return Meets::open;
    int axis = t_next[0] < t_next[1] ? 0 : 1;
    if (t_next[2] < t_next[axis]) axis = 2;
    t = t_next[axis];
    for (int other = 0; other < 3; ++other) {
      if (other != axis && t_next[other] - t < tie) return Meets::unsure;
    }
    if (std::abs(t - 1.0) < tie) return Meets::unsure;
    if (t > 1.0) return Meets::nothing;
    cell[axis] += step[axis];
    t_next[axis] += t_delta[axis];
  }
}

bool ObstacleDistance::is_clear(const Eigen::Vector3d& p_from, const Eigen::Vector3d& p_to) const {
  const Line line(frame_, p_from, p_to);
  if (!frame_.contains(frame_.cell_at(p_to)) || line.most_cells <= 1.0) {
    return walk_is_clear(p_from, p_to);
  }
  Eigen::Array3i cell = frame_.cell_at(p_from);
  double t = 0.0;
  if (!frame_.contains(cell)) {  // in from where walk_ray starts
    t = clip_segment(frame_.box(), p_from, p_to).enter;
    cell = frame_.cell_at(p_from + t * (p_to - p_from)).max(0).min(frame_.cells - 1);
  }
  while (true) {
    const int room = cells(cell);
    if (room > kMargin_cells) {
      t += (room - kMargin_cells) / line.most_cells;
      if (t >= 1.0) return true;
      cell = line.cell(frame_, t);
      continue;
    }
    switch (walk_beside(line, cell, t)) {
      case Meets::nothing: return true;
      case Meets::occupied: return false;
      case Meets::unsure: return walk_is_clear(p_from, p_to);
      case Meets::open: break;
    }
  }
}

}  // namespace vantage
