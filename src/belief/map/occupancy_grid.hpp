/// The probabilistic map: one occupancy probability per cell, kept as log odds.
#pragma once

#include <cstddef>
#include <vector>

#include "vantage/geometry/grid_frame.hpp"

namespace vantage {

/// Thresholds of the spec: U = { c : 0.4 < p(o) < 0.6 }.  [Potthast2016, 3.2.3]
inline constexpr double kFreeBelow = 0.4;
inline constexpr double kOccupiedAbove = 0.6;

/// The same thresholds as log odds, ln(0.4 / 0.6) and ln(0.6 / 0.4).
inline constexpr float kFreeLogOdds = -0.405465108F;
inline constexpr float kOccupiedLogOdds = 0.405465108F;

enum class CellState : unsigned char { free, unobserved, occupied };

constexpr CellState classify(float log_odds) {
  if (log_odds >= kOccupiedLogOdds) return CellState::occupied;
  return log_odds <= kFreeLogOdds ? CellState::free : CellState::unobserved;
}

/// p(o) in [0, 1]; 0.5 is a cell never measured.
struct OccupancyGrid {
  GridFrame frame;
  std::vector<float> log_odds;  ///< ln(p / (1 - p)), one per cell, `frame.index` order

  OccupancyGrid() = default;
  explicit OccupancyGrid(const GridFrame& f) : frame(f), log_odds(f.size(), 0.0F) {}

  [[nodiscard]] std::size_t size() const { return log_odds.size(); }
  [[nodiscard]] double p_occupied(std::size_t cell) const;
  [[nodiscard]] CellState state(std::size_t cell) const { return classify(log_odds[cell]); }
  [[nodiscard]] std::size_t count(CellState state) const;
};

double log_odds_of(double p_occupied);
double probability_of(double log_odds);

}  // namespace vantage
