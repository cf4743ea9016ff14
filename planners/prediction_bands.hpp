/// What a view was to show and what it showed, by the distance from the sensor.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "vantage/geometry/field_of_view.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/planners/visibility/attenuated_ray.hpp"

namespace vantage {

/// Cells whose centres are [from_m, to_m) from the sensor.
struct PredictionBand {
  double from_m = 0.0;
  double to_m = 0.0;
  double predicted_cells = 0.0;
  std::size_t actual_cells = 0;   ///< newly observed ones
  std::size_t outside_cells = 0;  ///< of these, outside the field of view that was predicted for
};

/// Whether a scan looks at what is there, in the sensor's frame; none: it looks at its whole field.
using InSight = std::function<bool(const Eigen::Vector3d& p_sensor)>;

/// Bands of `width_m`, > 0, from the sensor to the greatest range of `field` or the grid's end,
/// filled in with the cells that the view is expected to show. All bands share one sweep.
std::vector<PredictionBand> predict_by_distance(const Attenuation& attenuation,
                                                const OccupancyGrid& grid,
                                                const Pose& T_world_sensor,
                                                const FieldOfView& field, double width_m,
                                                int threads, const InSight& in_sight = {});

/// Counts the cells that `before` did not know and `after` does, in the bands; those beyond the
/// last one go into a band of their own, without end. Both grids have one frame.
void count_new_cells(const OccupancyGrid& before, const OccupancyGrid& after,
                     const Pose& T_world_sensor, const FieldOfView& field,
                     std::vector<PredictionBand>& bands, const InSight& in_sight = {});

}  // namespace vantage
