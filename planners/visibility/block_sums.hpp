/// What a sweep sees of blocks of cells.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace vantage {

/// A grid's cells in blocks of `edge` cells along each axis, the last ones smaller.
struct CellBlocks {
  Eigen::Array3i cells;
  Eigen::Array3i edge;

  [[nodiscard]] Eigen::Array3i blocks() const { return (cells + edge - 1) / edge; }
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(blocks().cast<std::ptrdiff_t>().prod());
  }
  /// Of the block that holds the cell, x fastest.
  [[nodiscard]] std::size_t index_of_cell(const Eigen::Array3i& cell) const {
    const Eigen::Array3i block = cell / edge;
    const Eigen::Array3i count = blocks();
    return static_cast<std::size_t>(
        (static_cast<std::ptrdiff_t>(block.z()) * count.y() + block.y()) * count.x() + block.x());
  }
};

/// Sums per block, row of cells by row of cells.
class BlockSums {
 public:
  explicit BlockSums(const CellBlocks& blocks);

  /// Adds utility[i] of the cells in a row along `axis`, from `first` (i = first[axis]) to
  /// first[axis] = end.
  void add(const float* utility, int axis, const Eigen::Array3i& first, int end);
  [[nodiscard]] const std::vector<float>& sums() const { return sums_; }

 private:
  CellBlocks blocks_;
  Eigen::Array3i stride_;  ///< in `sums_`, from block to block along each axis
  std::vector<float> sums_;
};

}  // namespace vantage
