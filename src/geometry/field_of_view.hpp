/// What a range sensor sweeps while it stands still, in its own frame (x forward, y left, z up).
#pragma once

#include <Eigen/Geometry>

#include "vantage/core/fields.hpp"

namespace vantage {

/// A direction as a tilting line scanner makes it: the scan plane is tilted by `tilt_rad` about y
/// (positive looks down), the beam turned by `azimuth_rad` inside that plane.
struct BeamAngles {
  double azimuth_rad = 0.0;
  double tilt_rad = 0.0;
};
/// Unit vector (cos t cos a, sin a, -sin t cos a).
Eigen::Vector3d beam_direction(const BeamAngles& angles);
/// The pair of angles with |azimuth| <= pi / 2.
BeamAngles beam_angles(const Eigen::Vector3d& p_sensor);
/// Angle below the horizon, [-pi / 2, pi / 2].
double depression_rad(const Eigen::Vector3d& p_sensor);
/// The other pair with the same direction: a scanner wider than pi sees behind itself through it.
BeamAngles turned_over(const BeamAngles& angles);

/// Sector of a tilting laser, or what a camera sees that a head pans all round.
struct FieldOfView {
  double half_width_rad = 0.1309;
  double tilt_min_rad = -0.30;
  double tilt_max_rad = 0.75;
  double range_min_m = 0.08;
  double range_max_m = 10.0;
  bool panorama = false;
  void fields(auto&& f) {
    f("half_width_rad", half_width_rad,
      "half of the horizontal field of view; higher sees more at once", Range{0.0, 3.1416, true});
    f("tilt_min_rad", tilt_min_rad, "tilt of the highest line of sight; negative looks up",
      between(-1.5, 1.5));
    f("tilt_max_rad", tilt_max_rad, "tilt of the lowest line of sight; positive looks down",
      between(-1.5, 1.5));
    f("range_min_m", range_min_m, "least range; nearer surfaces give no return", at_least(0.0));
    f("range_max_m", range_max_m, "greatest range; farther surfaces give no return", above(0.0));
    f("panorama", panorama,
      "true: the sensor pans all round before it tilts, so that tilt is the angle below the "
      "horizon in any direction and `half_width_rad` is ignored");
  }
  void check() const;  ///< minima below maxima

  [[nodiscard]] bool contains(const Eigen::Vector3d& p_sensor) const;
  /// Sensor frame; holds all that it contains.
  [[nodiscard]] Eigen::AlignedBox3d box_m() const;
};

}  // namespace vantage
