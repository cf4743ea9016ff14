/// How far points reach upwards and to the sides.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace vantage {

/// @param share 0 .. 1, of the values that are below; of the nearest rank
double quantile(std::vector<double> values, double share);

struct UprightExtents {
  double bottom_m = 0.0;  ///< along `up` from the camera
  double top_m = 0.0;
  double greater_m = 0.0;  ///< of the two along the principal axes of the points seen from above
  double smaller_m = 0.0;
};

/// Each between the quantiles `low` and `high` of the points' coordinates.
/// @param points camera frame, a column each, at least one
/// @param up unit length, camera frame
UprightExtents upright_extents(const Eigen::Matrix3Xd& points, const Eigen::Vector3d& up,
                               double low, double high);

}  // namespace vantage
