#include "vantage/planners/gains/fsmi_gain.hpp"

#include <cmath>

namespace vantage {

double odds_update_bits(double d, double odds) {
  if (std::isinf(odds)) return 0.0;  // the limit: what is certain, no update changes
  return std::log2((odds + 1.0) / (odds + 1.0 / d)) - std::log2(d) / (odds * d + 1.0);
}

FsmiGain::Tables FsmiGain::prepare(const GainContext& context) const {
  const OccupancyGrid& grid = context.grid;
  const auto utility = [this](double odds) {
    return Cell{.hit_bits = static_cast<float>(odds_update_bits(d_occ, odds)),
                .pass_bits = static_cast<float>(odds_update_bits(d_emp, odds))};
  };
  const std::vector<float> p_hit = cell_opacities(grid, opacity_unobserved);
  Tables tables(grid.size(), utility(1.0));  // most cells have never been measured
  for (std::size_t cell = 0; cell < tables.size(); ++cell) {
    if (grid.log_odds[cell] != 0.0F) {
      tables[cell] = utility(std::exp(static_cast<double>(grid.log_odds[cell])));
    }
    tables[cell].p_hit = p_hit[cell];
  }
  return tables;
}

}  // namespace vantage
