/// Maps that a belief allows, drawn at a coarser resolution.
#pragma once

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/planners/visibility/attenuated_ray.hpp"

namespace vantage {

/// A belief with cells of several cells. What is unobserved may be anything: each unobserved cell
/// is opaque with the probability that a beam straight through it does not pass.
class DrawableMap {
 public:
  /// A coarse cell is occupied if a cell in it is, else unobserved if half of its cells are.
  /// @param map with `transmission` @param edge cells of the map along each axis, at least 1
  DrawableMap(const GainContext& map, int edge);

  [[nodiscard]] const OccupancyGrid& grid() const { return grid_; }
  /// A drawn map: each unobserved cell lets through all or nothing. Its utility is the number of
  /// cells in it, known ones included.
  [[nodiscard]] Attenuation draw(Rng& rng) const;

 private:
  OccupancyGrid grid_;
  std::vector<float> p_opaque_;  ///< per cell; 0 where it is known
  double cells_in_each_;
};

}  // namespace vantage
