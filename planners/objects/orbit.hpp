/// Places round an object, all looking at it.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "vantage/geometry/pose.hpp"

namespace vantage {

/// A level circle round `centre_m` (world). Bearings are directions from the centre to a place.
struct Orbit {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double radius_m = 1.0;
  double height_m = 1.0;  ///< above the centre

  /// At `distance_m` from the centre, seeing it `elevation_rad` below the horizon.
  static Orbit at_elevation(const Eigen::Vector3d& centre_m, double distance_m,
                            double elevation_rad);

  /// T_world_place: x axis level towards the centre's axis, z up.
  [[nodiscard]] Pose place(double bearing_rad) const;
  [[nodiscard]] double bearing_rad(const Eigen::Vector3d& p_world_m) const;
};

/// Places from one bearing to the other the short way round, evenly and at most `step_rad` apart,
/// without the first and with the last; at least one.
std::vector<Pose> orbit_arc(const Orbit& orbit, double from_bearing_rad, double to_bearing_rad,
                            double step_rad);

}  // namespace vantage
