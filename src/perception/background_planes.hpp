/// Planes behind and under the object of a picture: table, floor, walls.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "vantage/perception/object_view.hpp"

namespace vantage {

/// A plane in the camera frame; its normal points to the camera's side.
struct BackgroundPlane {
  Eigen::Vector3d normal{0.0, 0.0, -1.0};
  double offset_m = 0.0;  ///< of the camera above it
  double share = 0.0;     ///< of the measured pixels that are on it

  [[nodiscard]] double height_above(const Eigen::Vector3d& p) const {
    return normal.dot(p) + offset_m;
  }
};

/// How far from a plane a depth camera may measure what is on it: noise and steps of its depth grow
/// with the square of the distance.
inline double plane_tolerance_m(double z_m) { return 0.006 + 0.003 * z_m * z_m; }

/// The large planes [FischlerBolles1981] that reach the picture's border and have something before
/// them near its middle; at most four, the largest first. A flat side of the object has nothing
/// before it. The same picture gives the same planes.
/// @param view depth and intrinsics count; a mask does not
std::vector<BackgroundPlane> background_planes(const ObjectView& view);

/// Elevation of a camera that stands over the most level of these planes, within 20 deg of no roll;
/// negative if none of them is a support surface.
double elevation_over(const std::vector<BackgroundPlane>& planes);

}  // namespace vantage
