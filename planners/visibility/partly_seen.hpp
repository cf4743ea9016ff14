#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <vector>

#include "vantage/core/error.hpp"
#include "vantage/planners/visibility/sampled_sum.hpp"

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
  /// Sums are tried with one in `first_share` of the sample first, a power of two.
  explicit PartlySeen(int max_cells, int first_share = 16)
      : max_cells_(static_cast<std::size_t>(max_cells)),
        first_share_(static_cast<std::size_t>(first_share)) {
    expects(std::has_single_bit(first_share_), "a first share that is a power of two");
  }

  /// Offers a row of `count` cells, of which it asks for every stride-th by `take(i) -> Cell`;
  /// those without weight are skipped. Each row starts the stride elsewhere: cells of neighbouring
  /// rows are alike.
  template <class Take>
  void offer(int count, Take&& take) {
    if (max_cells_ == 0) return;
    phase_ = (phase_ + 0x9E3779B9U) & 0xFFFFFFFFU;  // the golden ratio of 2^32
    const std::size_t start = phase_ >> 12U;
    for (std::size_t i = -start & (stride_ - 1); i < static_cast<std::size_t>(count);
         i += stride_ - ((start + i) & (stride_ - 1))) {  // also where thin() came between
      Cell cell = take(static_cast<int>(i));
      if (cell.weight <= 0.0F) continue;
      cell.order = start + i;
      cells_.push_back(cell);
      if (cells_.size() > max_cells_) thin();
    }
  }
  /// Sum of `error(cell)` over the cells offered, from as much of the sample as it takes for a
  /// standard error of at most `tolerance`. No error may be below -visible * weight.
  template <class Error>
  [[nodiscard]] SampledSum sum_errors(double tolerance, Error&& error) const {
    Tally all;
    std::array<Tally, 2> halves;
    for (std::size_t share = first_share_;; share /= 2) {
      const std::size_t stride = share * stride_;
      for (const Cell& cell : cells_) {
        const bool coarser = divides(2 * stride, cell.order);
        const bool done_before = share < first_share_ && coarser;
        if (!divides(stride, cell.order) || done_before) continue;
        const double e = error(cell);
        all.add(e);
        halves[coarser ? 0 : 1].add(e);
      }
      if (stride == 1) return SampledSum::exact(all.sum);
      const auto weight = static_cast<double>(stride);
      if (share == 1 || weight * std::sqrt(all.squares) <= tolerance) {
        return weighted(all, halves, weight);
      }
      halves = {halves[0] + halves[1], {}};
    }
  }

 private:
  struct Tally {
    double sum = 0.0;
    double squares = 0.0;
    void add(double e) {
      sum += e;
      squares += e * e;
    }
    friend Tally operator+(const Tally& a, const Tally& b) {
      return {a.sum + b.sum, a.squares + b.squares};
    }
  };

  /// One more error counts in each half's variance, as large as any can be: that a sample met none
  /// does not say that there is none.
  [[nodiscard]] SampledSum weighted(const Tally& all, const std::array<Tally, 2>& halves,
                                    double weight) const {
    double largest = 0.0;
    for (const Cell& cell : cells_) {
      largest = std::max(largest, static_cast<double>(cell.visible * cell.weight));
    }
    const auto estimate = [&](const Tally& half) -> SampledSum::Half {
      const double each = 2.0 * weight;
      return {each * half.sum, each * each * (half.squares + largest * largest)};
    };
    return {weight * all.sum, {estimate(halves[0]), estimate(halves[1])}};
  }

  /// Strides are powers of two.
  static constexpr bool divides(std::size_t stride, std::size_t order) {
    return (order & (stride - 1)) == 0;
  }
  void thin() {
    stride_ *= 2;
    std::erase_if(cells_, [&](const Cell& cell) { return !divides(stride_, cell.order); });
  }

  std::size_t max_cells_;
  std::size_t first_share_;
  std::size_t stride_ = 1;
  std::size_t phase_ = 0;
  std::vector<Cell> cells_;
};

}  // namespace vantage
