#include "vantage/belief/map/occupancy_grid.hpp"

#include <algorithm>
#include <cmath>

namespace vantage {

double log_odds_of(double p_occupied) { return std::log(p_occupied / (1.0 - p_occupied)); }

double probability_of(double log_odds) { return 1.0 / (1.0 + std::exp(-log_odds)); }

double OccupancyGrid::p_occupied(std::size_t cell) const { return probability_of(log_odds[cell]); }

std::size_t OccupancyGrid::count(CellState state) const {
  return static_cast<std::size_t>(
      std::ranges::count_if(log_odds, [&](float cell) { return classify(cell) == state; }));
}

}  // namespace vantage
