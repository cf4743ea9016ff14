#pragma once

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <vector>

namespace vantage {

/// An evenly spread sample of cells that a view sees partly, of at most `max_cells` cells.
class PartlySeen {
 public:
  struct Cell {
    std::size_t order = 0;
    Eigen::Array3i cell;
    float visible = 0.0F;
    float weight = 0.0F;
  };
  explicit PartlySeen(int max_cells) : max_cells_(static_cast<std::size_t>(max_cells)) {}

  /// Offers a row of `count` cells, of which it asks for every stride-th by `take(i) -> Cell`;
  /// those without weight are skipped. Each row starts the stride elsewhere: cells of neighbouring
  /// rows are alike.
  template <class Take>
  void offer(int count, Take&& take) {
    if (max_cells_ == 0) return;
    phase_ = (phase_ + 0x9E3779B9U) & 0xFFFFFFFFU;  // the golden ratio of 2^32
    const std::size_t start = phase_ >> 12U;
    for (std::size_t i = -start & (stride_ - 1); i < static_cast<std::size_t>(count);
         i += stride_) {
      Cell cell = take(static_cast<int>(i));
      if (cell.weight <= 0.0F || !divides(stride_, start + i)) continue;
      cell.order = start + i;
      cells_.push_back(cell);
      if (cells_.size() > max_cells_) thin();
    }
  }
  /// Sum of `error(cell)` over the cells offered, from as much of the sample as it takes for a
  /// standard error of at most `tolerance`.
  template <class Error>
  [[nodiscard]] double sum_errors(double tolerance, Error&& error) const {
    constexpr std::size_t kCoarsest = 16;
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t share = kCoarsest; share >= 1; share /= 2) {
      const std::size_t stride = share * stride_;
      for (const Cell& cell : cells_) {
        const bool done_before = share < kCoarsest && divides(2 * stride, cell.order);
        if (!divides(stride, cell.order) || done_before) continue;
        const double e = error(cell);
        sum += e;
        squares += e * e;
      }
      const auto weight = static_cast<double>(stride);
      if (share == 1 || weight * std::sqrt(squares) <= tolerance) return weight * sum;
    }
    return 0.0;
  }

 private:
  /// Strides are powers of two.
  static constexpr bool divides(std::size_t stride, std::size_t order) {
    return (order & (stride - 1)) == 0;
  }
  void thin() {
    stride_ *= 2;
    std::erase_if(cells_, [&](const Cell& cell) { return !divides(stride_, cell.order); });
  }

  std::size_t max_cells_;
  std::size_t stride_ = 1;
  std::size_t phase_ = 0;
  std::vector<Cell> cells_;
};

}  // namespace vantage
