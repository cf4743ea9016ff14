/// A beam that every cell weakens by its transmission (Beer-Lambert); what is left of it in the
/// last cell is the probability that this cell is seen.
#pragma once

#include <cstddef>

#include "planners/cell_tables.hpp"

namespace vantage {

class AttenuatedRay {
 public:
  explicit AttenuatedRay(const CellTables& tables)
      : transmission_(tables.transmission.data()), worth_(tables.worth.data()) {}

  void start() { p_visible_ = 1.0; }
  bool pass(std::size_t cell) {
    p_visible_ *= static_cast<double>(transmission_[cell]);
    return p_visible_ > 0.0;
  }
  [[nodiscard]] double worth(std::size_t cell) const {
    return p_visible_ * static_cast<double>(worth_[cell]);
  }

 private:
  const float* transmission_;
  const float* worth_;
  double p_visible_ = 1.0;
};

}  // namespace vantage
