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

/// How to get from one place to another.
struct OrbitWay {
  bool long_way = false;  ///< round the other side
  double rise_m = 0.0;    ///< by how much it rises over both ends in between
};

/// The same from an orbit to another: the centre moves evenly from that of the one to that of the
/// other, while the bearing turns, so that the way keeps as far from what lies between as both do.
/// From an orbit to itself, the short way and level, it is orbit_arc().
std::vector<Pose> orbit_way(const Orbit& from, double from_bearing_rad, const Orbit& to,
                            double to_bearing_rad, double step_rad, const OrbitWay& how = {});

}  // namespace vantage
