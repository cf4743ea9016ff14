/// Which views are proposed.
#pragma once

#include <Eigen/Core>

#include <numbers>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/planners/candidate.hpp"

namespace vantage {

/// Views from a circle round the region of interest.  [Potthast2016, 3.3.1]
struct RingOfViews {
  int positions = 10;
  double radius_m = 1.2;
  double height_m = 1.05;
  double start_angle_rad = 0.0;
  std::vector<double> yaw_offsets_rad = {-std::numbers::pi / 12.0, 0.0, std::numbers::pi / 12.0};
  void fields(auto&& f) {
    f("positions", positions,
      "number of positions on the ring, evenly spaced; more take longer to score",
      between(1, 100000));
    f("radius_m", radius_m, "radius of the ring; higher sees more of the region, less finely",
      above(0.0));
    f("height_m", height_m, "height of the sensor above the floor; higher looks over objects",
      above(0.0));
    f("start_angle_rad", start_angle_rad,
      "bearing from the centre to the first position, in the world frame");
    f("yaw_offsets_rad", yaw_offsets_rad,
      "turns of the view away from the centre, positive to the left; one view for each position "
      "and offset",
      between(-std::numbers::pi, std::numbers::pi));
  }
  void check() const;  ///< at least one offset
};

/// Level sensor poses (x forward, z up; world frame) that face the axis through `centre_m` plus a
/// yaw offset. Ids count up position by position, offset by offset. Of the centre only x and y
/// matter: the height is above the floor, world z = 0.
/// @throws ConfigError if the options are out of range.
std::vector<Candidate> ring_of_views(const RingOfViews& ring, const Eigen::Vector3d& centre_m);

}  // namespace vantage
