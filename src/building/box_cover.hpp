/// Cells as few boxes.
#pragma once

#include <cstdint>

#include "vantage/building/fitted_grid.hpp"

namespace vantage {

/// Cells from `first` on and before `end`, along each axis.
struct CellBox {
  std::array<int, 3> first{};
  std::array<int, 3> end{};
};

/// Boxes of solid cells, each as large as it can be, that hold every solid cell and no other. They
/// may overlap. Each begins at the first cell that none before it holds and grows along the axes in
/// the order that takes in most.
std::vector<CellBox> cover_with_boxes(const FittedGrid& grid,
                                      const std::vector<std::uint8_t>& solid);

Eigen::AlignedBox3d box_m(const FittedGrid& grid, const CellBox& box);

}  // namespace vantage
