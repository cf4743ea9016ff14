/// Light that fades cell by cell (Beer-Lambert): what is left of it in the last cell of a ray is
/// the probability that this cell is seen.
#pragma once

#include <concepts>
#include <cstddef>

#include "vantage/planners/visibility/cell_tables.hpp"

namespace vantage {

/// How light fades and what it is worth where it arrives. Free cells let it pass, occupied ones
/// stop it; seeing either is worth nothing.
struct Fading {
  BlockField transmission;  ///< of the unobserved cells
  double worth = 1.0;       ///< of an unobserved cell, in the gain's unit
  bool by_entropy = true;   ///< times its entropy in bits

  [[nodiscard]] float worth_of_cell(float log_odds) const {
    if (classify(log_odds) != CellState::unobserved) return 0.0F;
    if (!by_entropy || log_odds == 0.0F) return static_cast<float>(worth);
    return worth_by_entropy(log_odds);
  }

 private:
  [[nodiscard]] float worth_by_entropy(float log_odds) const;
};

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

/// state, worth and transmission of every cell.
CellTables fading_tables(const OccupancyGrid& grid, const Fading& fading);

/// A gain that is a sum over the unobserved cells of (light that arrives) x (worth).
template <class G>
concept FadingGain = requires(const G& gain, const GainContext& context) {
  { gain.fading(context) } -> std::same_as<Fading>;
};

}  // namespace vantage
