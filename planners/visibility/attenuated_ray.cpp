#include "vantage/planners/visibility/attenuated_ray.hpp"

#include "vantage/core/error.hpp"
#include "vantage/information/discrete.hpp"

namespace vantage {

float Attenuation::utility_by_entropy(float log_odds) const {
  return static_cast<float>(utility *
                            binary_entropy_bits(probability_of(static_cast<double>(log_odds))));
}

CellTables attenuation_tables(const OccupancyGrid& grid, const Attenuation& attenuation) {
  CellTables tables;
  tables.state = cell_states(grid);
  tables.transmission = cell_transmissions(grid, attenuation.transmission);
  tables.utility.reserve(grid.size());
  for (const float log_odds : grid.log_odds)
    tables.utility.push_back(attenuation.utility_of_cell(log_odds));
  return tables;
}

}  // namespace vantage
