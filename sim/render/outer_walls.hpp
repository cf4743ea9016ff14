/// The outer walls of a scene and its ceiling, which stand between its room and a camera that looks
/// in from outside.
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <vector>

struct mjModel_;
using mjModel = mjModel_;

namespace vantage {

struct OuterWalls {
  static constexpr int kSides = 5;  ///< -x, +x, -y, +y, above

  Eigen::AlignedBox3d extent_m;  ///< of all that stands still, floors aside; world
  /// The wall on that side and what hangs on it; nothing where there is no wall.
  std::array<std::vector<int>, kSides> geoms;

  /// Ids, ascending, of what is on the sides that `eye_m` is beyond.
  [[nodiscard]] std::vector<int> before(const Eigen::Vector3d& eye_m) const;
};

/// A side has a wall if what is thin, high and at its edge is most of its length; a ceiling is as
/// high above the lowest thing, and most of the area.
OuterWalls outer_walls(const mjModel& model);

}  // namespace vantage
