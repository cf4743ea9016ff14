/// How near a robot came to anything, truly. For metrics.
#pragma once

#include "vantage/perception/clouds/kd_tree.hpp"
#include "vantage/sim/world/collision_surfaces.hpp"

namespace vantage {

/// The least distance from the robot's surface to any other that may collide with it, over all
/// moments that it was asked to look at. Surfaces are sampled so densely that at 0.3 m it is off by
/// less than 1 mm. Things other than the robot are taken to stand still; farther than 3 m is 3 m.
class TrueClearance {
 public:
  explicit TrueClearance(const World& world);

  void update(const World& world);
  /// It touched something: between two moments, or between two samples.
  void touched() { min_m_ = 0.0; }
  [[nodiscard]] double min_m() const { return min_m_; }

 private:
  explicit TrueClearance(CollisionSurfaces surfaces);
  [[nodiscard]] double distance_m(const Eigen::Vector3d& p_world_m, double max_m) const;

  std::vector<SurfacePoint> robot_;
  std::vector<SolidPlane> planes_;
  KdTree scene_;
  double min_m_ = 3.0;
};

}  // namespace vantage
