/// The gain of a view as peers compute it: one OctoMap castRay per beam of the sensor, then a look
/// at every node along the ray.
#pragma once

#include <memory>

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/geometry/field_of_view.hpp"
#include "vantage/geometry/pose.hpp"

namespace vantage::bench {

class CastrayGain {
 public:
  explicit CastrayGain(const OccupancyGrid& grid);
  ~CastrayGain();

  /// Sum over the beams of a line scanner, `step_rad` apart, of the unobserved cells before each
  /// beam's first occupied one. Several threads may ask at once.
  [[nodiscard]] double of_view(const Pose& T_world_sensor, const FieldOfView& field,
                               double azimuth_step_rad, double tilt_step_rad) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace vantage::bench
