#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace vantage {

/// An evenly spread sample of cells that a view sees partly, of at most `most` cells.
class PartlySeen {
 public:
  struct Cell {
    std::size_t order = 0;
    Eigen::Array3i cell;
    float visible = 0.0F;
    float weight = 0.0F;
  };
  explicit PartlySeen(int most) : most_(static_cast<std::size_t>(most)) {}

  /// Offers a row of `count` cells, of which it asks for every stride-th by `take(i) -> Cell`;
  /// those without weight are skipped. Each row starts the stride elsewhere: cells of neighbouring
  /// rows are alike.
  template <class Take>
  void offer(int count, Take&& take) {
    if (most_ == 0) return;
    phase_ = (phase_ + 0x9E3779B9U) & 0xFFFFFFFFU;  // the golden ratio of 2^32
    const std::size_t start = phase_ >> 12U;
    for (std::size_t i = (stride_ - start % stride_) % stride_; i < static_cast<std::size_t>(count);
         i += stride_) {
      Cell cell = take(static_cast<int>(i));
      if (cell.weight <= 0.0F || (start + i) % stride_ != 0) continue;
      cell.order = start + i;
      cells_.push_back(cell);
      if (cells_.size() > most_) thin();
    }
  }
  [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }
  /// Cells that each of the sample stands for.
  [[nodiscard]] double stride() const { return static_cast<double>(stride_); }

 private:
  void thin() {
    stride_ *= 2;
    std::erase_if(cells_, [&](const Cell& cell) { return cell.order % stride_ != 0; });
  }

  std::size_t most_;
  std::size_t stride_ = 1;
  std::size_t phase_ = 0;
  std::vector<Cell> cells_;
};

}  // namespace vantage
