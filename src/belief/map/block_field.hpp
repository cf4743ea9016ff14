/// Numbers that vary over a grid more slowly than its cells.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vantage {

/// How a grid is divided into blocks of cells, as even as whole cells allow.
struct BlockLayout {
  Eigen::Array3i cells = Eigen::Array3i::Ones();   ///< of the grid
  Eigen::Array3i blocks = Eigen::Array3i::Ones();  ///< along each axis

  [[nodiscard]] int block_of(int axis, int cell) const {
    return static_cast<int>(std::int64_t{cell} * blocks[axis] / cells[axis]);
  }
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(blocks.x()) * static_cast<std::size_t>(blocks.y()) *
           static_cast<std::size_t>(blocks.z());
  }
  /// Of a block, x fastest.
  [[nodiscard]] std::size_t index(int x, int y, int z) const {
    return static_cast<std::size_t>((std::int64_t{z} * blocks.y() + y) * blocks.x() + x);
  }
  [[nodiscard]] std::size_t index_of_cell(const Eigen::Array3i& cell) const {
    return index(block_of(0, cell.x()), block_of(1, cell.y()), block_of(2, cell.z()));
  }
};

/// One number per block.
struct BlockField {
  BlockLayout layout;
  std::vector<double> per_block;  ///< in the order of `layout.index`

  [[nodiscard]] double at_cell(const Eigen::Array3i& cell) const {
    return per_block[layout.index_of_cell(cell)];
  }
};

/// The same number in every cell.
BlockField uniform_field(const Eigen::Array3i& cells, double number);

/// Each block plus its neighbours along x and y, these weighted by exp(-d^2 / (2 sigma^2)) at a
/// distance of d blocks. With sigma 0 the field itself.
BlockField gather_neighbours(const BlockField& field, const Eigen::Array2d& sigma_blocks);

}  // namespace vantage
