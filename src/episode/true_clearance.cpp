#include "src/episode/true_clearance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/mesh_surface.hpp"

namespace vantage {

TrueClearance::TrueClearance(const World& world) : TrueClearance(collision_surfaces(world)) {}

TrueClearance::TrueClearance(CollisionSurfaces surfaces)
    : robot_(std::move(surfaces.robot)),
      planes_(std::move(surfaces.planes)),
      scene_(std::move(surfaces.scene_world_m)) {}

void TrueClearance::update(const World& world) {
  const mjData& now = world.snapshot();
  int geom = -1;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (const SurfacePoint& point : robot_) {
    if (point.geom_id != geom) T = T_world_geom(now, geom = point.geom_id);
    least_m_ = std::min(least_m_, distance_m(T * point.p_geom_m));
  }
}

/// No more than what is the least already.
double TrueClearance::distance_m(const Eigen::Vector3d& p_world_m) const {
  double nearest_m = least_m_;
  for (const SolidPlane& plane : planes_) {
    nearest_m = std::min(nearest_m, (p_world_m - plane.p_world_m).dot(plane.normal));
  }
  if (nearest_m <= 0.0) return 0.0;
  const auto found = scene_.nearest(p_world_m.cast<float>(), nearest_m);
  return found ? std::sqrt(static_cast<double>(found->distance2_m2)) : nearest_m;
}

}  // namespace vantage
