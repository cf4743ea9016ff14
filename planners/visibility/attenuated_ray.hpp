/// Attenuation along a ray, cell by cell (Beer-Lambert): the transmittance up to the last cell of a
/// ray is the probability that this cell is seen.
#pragma once

#include <concepts>
#include <cstddef>

#include "vantage/planners/visibility/cell_tables.hpp"

namespace vantage {

/// Transmittance and utility of cells. Free cells transmit everything, occupied ones nothing;
/// seeing either has no utility.
struct Attenuation {
  BlockField transmission;  ///< of the unobserved cells
  double utility = 1.0;     ///< of an unobserved cell, in the gain's unit
  bool by_entropy = true;   ///< times its entropy in bits

  [[nodiscard]] float utility_of_cell(float log_odds) const {
    if (classify(log_odds) != CellState::unobserved) return 0.0F;
    if (!by_entropy || log_odds == 0.0F) return static_cast<float>(utility);
    return utility_by_entropy(log_odds);
  }

 private:
  [[nodiscard]] float utility_by_entropy(float log_odds) const;
};

class AttenuatedRay {
 public:
  explicit AttenuatedRay(const CellTables& tables)
      : transmission_(tables.transmission.data()), utility_(tables.utility.data()) {}

  void start() { p_visible_ = 1.0; }
  bool pass(std::size_t cell) {
    p_visible_ *= static_cast<double>(transmission_[cell]);
    return p_visible_ > 0.0;
  }
  [[nodiscard]] double utility(std::size_t cell) const {
    return p_visible_ * static_cast<double>(utility_[cell]);
  }

 private:
  const float* transmission_;
  const float* utility_;
  double p_visible_ = 1.0;
};

/// State, utility and transmission of every cell.
CellTables attenuation_tables(const OccupancyGrid& grid, const Attenuation& attenuation);

/// A gain that is a sum over the unobserved cells of transmittance times utility.
template <class G>
concept AttenuationGain = requires(const G& gain, const GainContext& context) {
  { gain.attenuation(context) } -> std::same_as<Attenuation>;
};

}  // namespace vantage
