/// Is this the place? A scan held against what was seen of a place, from a pose that may be far
/// off.
#pragma once

#include <cstddef>

#include "vantage/perception/clouds/point_cloud.hpp"

namespace vantage {

/// How far from the guess the pose may be, to all sides.
struct SearchWindow {
  double shift_m = 0.0;
  double turn_rad = 0.0;
};

/// The pose at which most points of the scan fall on surfaces of the place, on a grid of poses
/// within the window; of poses that fit alike the one nearest to the guess [Olson2009].
Pose2 search_pose(const PointCloud& scan, const PointCloud& place, const Pose2& T_place_scan_guess,
                  const SearchWindow& window);

struct Agreement {
  std::size_t near = 0;    ///< points of the scan on a surface, where one of the place is known
  std::size_t facing = 0;  ///< of those, whose surface faces the same way
  double share = 0.0;  ///< of those near, the share on one that lies there and faces the same way
};

Agreement agreement(const PointCloud& scan, const PointCloud& place, const Pose2& T_place_scan);

}  // namespace vantage
