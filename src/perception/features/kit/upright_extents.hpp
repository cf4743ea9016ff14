/// How far points reach upwards and to the sides.
#pragma once

#include <Eigen/Core>

namespace vantage {

/// Along a level axis.
struct LevelExtent {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< unit length, camera frame
  Eigen::Vector2d ends_m = Eigen::Vector2d::Zero();
};

struct UprightExtents {
  double bottom_m = 0.0;  ///< along `up` from the camera
  double top_m = 0.0;
  double greater_m = 0.0;  ///< of the two along the principal axes of the points seen from above
  double smaller_m = 0.0;
  LevelExtent greater = {};
  LevelExtent smaller = {};
};

/// Each between the quantiles `low` and `high` of the points' coordinates.
/// @param points m, camera frame, 3 x n, n > 0
/// @param up unit length, camera frame
UprightExtents upright_extents(const Eigen::Matrix3Xd& points, const Eigen::Vector3d& up,
                               double low, double high);

}  // namespace vantage
