/// How far the next occupied cell is, for walks that need not look at every cell.
#pragma once

#include <cstdint>
#include <vector>

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/geometry/grid_part.hpp"

namespace vantage {

/// The chessboard distance, in cells, of each cell to the nearest occupied one, up to a limit. A
/// walk leaps over the free ball round it [Hart1996] and goes cell by cell only beside what is
/// occupied.
class ObstacleDistance {
 public:
  /// The distance is at most this; higher leaps farther and takes longer to make.
  static constexpr int kMax_cells = 15;

  /// Does not depend on `threads` (>= 1).
  explicit ObstacleDistance(const OccupancyGrid& grid, int threads = 1);
  /// The same for walks between points of `reach`: what is elsewhere is not looked at.
  ObstacleDistance(const OccupancyGrid& grid, const GridPart& reach, int threads);

  /// 0 where a cell, of those in reach, is occupied.
  [[nodiscard]] int cells(const Eigen::Array3i& cell) const { return cells_[reach_.index(cell)]; }

  /// Whether the walk of walk_ray between the points meets no occupied cell; the same answer, to
  /// the cell.
  [[nodiscard]] bool is_clear(const Eigen::Vector3d& p_from, const Eigen::Vector3d& p_to) const;

 private:
  struct Line;
  enum class Meets { nothing, occupied, open, unsure };
  [[nodiscard]] bool walk_is_clear(const Eigen::Vector3d& p_from,
                                   const Eigen::Vector3d& p_to) const;
  [[nodiscard]] Meets walk_beside(const Line& line, Eigen::Array3i& cell, double& t) const;

  GridFrame frame_;
  GridPart reach_;
  std::vector<std::uint8_t> cells_;
};

}  // namespace vantage
