/// One layer of cells of the visibility sweep.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "vantage/core/rounding.hpp"

namespace vantage {

/// Cells [begin, end) of a row or column.
struct CellSpan {
  int begin = 0;
  int end = 0;
  /// Those of the cells 0, 1, ... count - 1 that lie in [from, to].
  static CellSpan between(double from, double to, int count) {
    return {ceil_int(std::clamp(from, 0.0, static_cast<double>(count))),
            floor_int(std::clamp(to, -1.0, count - 1.0)) + 1};
  }
  [[nodiscard]] bool empty() const { return begin >= end; }
  void include(const CellSpan& other) {
    if (other.empty()) return;
    *this = empty() ? other : CellSpan{std::min(begin, other.begin), std::max(end, other.end)};
  }
  [[nodiscard]] CellSpan cut(const CellSpan& other) const {
    return {std::max(begin, other.begin), std::min(end, other.end)};
  }
};

/// Transmittance up to one layer of cells; there is no obstacle outside the grid.
class TransmittanceLayer {
 public:
  /// Cells outside the grid that a layer holds: rays come in from at most 6 outside, and row loops
  /// go on for up to 7.
  static constexpr int kPadding = 16;

  TransmittanceLayer(int columns, int rows)
      : columns_(columns),
        rows_(rows),
        stride_(static_cast<std::size_t>(columns) + 2 * kPadding),
        transmittance_(stride_ * (static_cast<std::size_t>(rows) + 2 * kPadding), 1.0F) {}

  /// `row(v)[u]` is cell (u, v); -kPadding <= u < columns + kPadding, v likewise.
  [[nodiscard]] float* row(int v) {
    return transmittance_.data() + static_cast<std::size_t>(v + kPadding) * stride_ + kPadding;
  }
  [[nodiscard]] const CellSpan& columns() const { return u_; }
  void set_known(CellSpan u, CellSpan v) {
    u_ = u;
    v_ = v;
  }

  /// Gives the cells of u x v that were not worked out a value: 1 outside the grid, else that of
  /// the nearest one worked out.
  void extend(CellSpan u, CellSpan v) {
    if (u_.empty() || v_.empty()) {
      for (int j = v.begin; j < v.end; ++j) std::fill(row(j) + u.begin, row(j) + u.end, 1.0F);
      return;
    }
    for (int j = v_.begin; j < v_.end; ++j) extend_row(j, u);
    const CellSpan whole{std::min(u.begin, u_.begin), std::max(u.end, u_.end)};
    for (int j = v_.begin - 1; j >= v.begin; --j) copy_row(j, j + 1, whole);
    for (int j = v_.end; j < v.end; ++j) copy_row(j, j - 1, whole);
  }

 private:
  void extend_row(int j, CellSpan u) {
    float* cells = row(j);
    for (int i = u_.begin - 1; i >= u.begin; --i) cells[i] = i < 0 ? 1.0F : cells[i + 1];
    for (int i = u_.end; i < u.end; ++i) cells[i] = i >= columns_ ? 1.0F : cells[i - 1];
  }
  void copy_row(int to, int from, CellSpan u) {
    if (to < 0 || to >= rows_) {
      std::fill(row(to) + u.begin, row(to) + u.end, 1.0F);
    } else {
      std::copy(row(from) + u.begin, row(from) + u.end, row(to) + u.begin);
    }
  }

  int columns_;
  int rows_;
  std::size_t stride_;
  std::vector<float> transmittance_;
  CellSpan u_;
  CellSpan v_;
};

}  // namespace vantage
