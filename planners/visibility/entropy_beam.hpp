/// A beam that sums the entropy of the cells it meets, each weighted by the probability that the
/// beam gets there: sum V_i H(o_i), V_i = prod_{j<i} (1 - o_j).  [Isler2016]
#pragma once

#include <cstddef>

#include "vantage/planners/visibility/cell_tables.hpp"

namespace vantage {

class EntropyBeam {
 public:
  explicit EntropyBeam(const CellTables& tables)
      : transmission_(tables.transmission.data()), entropy_bits_(tables.entropy_bits.data()) {}

  void start() {
    p_visible_ = 1.0;
    sum_bits_ = 0.0;
  }
  bool enter(std::size_t cell) {
    sum_bits_ += p_visible_ * static_cast<double>(entropy_bits_[cell]);
    p_visible_ *= static_cast<double>(transmission_[cell]);
    return p_visible_ > 0.0;
  }
  [[nodiscard]] double total() const { return sum_bits_; }

 private:
  const float* transmission_;
  const float* entropy_bits_;
  double p_visible_ = 1.0;
  double sum_bits_ = 0.0;
};

}  // namespace vantage
