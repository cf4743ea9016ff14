/// A grid of cells whose sides lie in the planes that a building is made of.
#pragma once

#include <cstddef>

#include "vantage/building/building_mesh.hpp"

namespace vantage {

/// Cells between lines along x, y and z, which need not be evenly spaced.
struct FittedGrid {
  std::array<std::vector<double>, 3> lines_m;  ///< ascending
  double cell_m = 0.0;                         ///< edge of the largest cells

  [[nodiscard]] int cells(int axis) const {
    return static_cast<int>(lines_m[static_cast<std::size_t>(axis)].size()) - 1;
  }
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(cells(0)) * static_cast<std::size_t>(cells(1)) *
           static_cast<std::size_t>(cells(2));
  }
  /// x fastest
  [[nodiscard]] std::size_t index(int x, int y, int z) const {
    const auto nx = static_cast<std::size_t>(cells(0));
    const auto ny = static_cast<std::size_t>(cells(1));
    return (static_cast<std::size_t>(z) * ny + static_cast<std::size_t>(y)) * nx +
           static_cast<std::size_t>(x);
  }
  [[nodiscard]] double line_m(int axis, int i) const {
    return lines_m[static_cast<std::size_t>(axis)][static_cast<std::size_t>(i)];
  }
  [[nodiscard]] std::vector<double> centres_m(int axis) const;
  /// Of the cell that holds `at_m`, clamped to the grid.
  [[nodiscard]] int cell_at(int axis, double at_m) const;
};

/// Lines that are no nearer to each other than this share of a cell.
inline constexpr double kNearestLines = 0.1;
/// Surfaces within this share of a cell of the floor are taken for it: scanned floors are rough.
inline constexpr double kFloorCells = 0.5;

/// Lines at the planes of the largest faces across each axis within `box_m`, and between them no
/// farther apart than `cell_m`. One lies at z = 0, the floor, with none within half a cell of it,
/// and one cell is added all round.
/// @throws ConfigError if there would be too many cells to work on.
FittedGrid fit_grid(const BuildingMesh& mesh, const Eigen::AlignedBox3d& box_m, double cell_m);

}  // namespace vantage
