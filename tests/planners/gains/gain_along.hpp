#pragma once

#include <string_view>

#include "tests/planners/gains/ascii_ray.hpp"
#include "vantage/planners/exact_gain.hpp"

namespace vantage {

/// So narrow that a fan is one beam.
inline FieldOfView straight_ahead() {
  return {.half_width_rad = 0.001,
          .tilt_min_rad = -0.001,
          .tilt_max_rad = 0.001,
          .range_min_m = 0.08,
          .range_max_m = 1000.0};
}

/// Gain of looking along a row of unit cells from just in front of it.
inline double along(const Gain& gain, const OccupancyGrid& row, double transmission = 0.5) {
  const BlockField field = uniform_field(row.frame.cells, transmission);
  return exact_gain_bits(gain, {row, &field}, make_pose({-0.5, 0.0, 0.0}, 0.0), straight_ahead());
}
inline double along(const Gain& gain, std::string_view cells, double transmission = 0.5) {
  return along(gain, row_of_cells(cells), transmission);
}

}  // namespace vantage
