#include "vantage/planners/visibility/attenuated_ray.hpp"

#include "vantage/core/error.hpp"
#include "vantage/information/discrete.hpp"

namespace vantage {

float Fading::worth_by_entropy(float log_odds) const {
  return static_cast<float>(worth *
                            binary_entropy_bits(probability_of(static_cast<double>(log_odds))));
}

CellTables fading_tables(const OccupancyGrid& grid, const Fading& fading) {
  CellTables tables;
  tables.state = cell_states(grid);
  tables.transmission = cell_transmissions(grid, fading.transmission);
  tables.worth.reserve(grid.size());
  for (const float log_odds : grid.log_odds) tables.worth.push_back(fading.worth_of_cell(log_odds));
  return tables;
}

}  // namespace vantage
