#include "vantage/tasks/trajectory/true_clearance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "vantage/sim/world/mesh_surface.hpp"

namespace vantage {
namespace {

constexpr double kMaxDistance_m = 4.0;

}  // namespace

TrueClearance::TrueClearance(const World& world) : TrueClearance(collision_surfaces(world)) {}

TrueClearance::TrueClearance(CollisionSurfaces surfaces)
    : robot_(std::move(surfaces.robot)),
      planes_(std::move(surfaces.planes)),
      scene_(std::move(surfaces.scene_world_m)) {}

void TrueClearance::update(const World& world) {
  const mjData& now = world.snapshot();
  int geom = -1;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  std::vector<Eigen::Vector3d> points_m;
  for (const SurfacePoint& point : robot_) {
    if (point.geom_id != geom) T = T_world_geom(now, geom = point.geom_id);
    points_m.push_back(T * point.p_geom_m);
  }
  if (points_m.empty()) return;
  // What is so far from the middle is at least as far from a point, but for its way from there.
  const Eigen::Vector3d middle_m = points_m.front();
  const double from_middle_m = distance_m(middle_m, kMaxDistance_m);
  for (const Eigen::Vector3d& p : points_m) {
    if (from_middle_m - (p - middle_m).norm() >= min_m_) continue;
    min_m_ = std::min(min_m_, distance_m(p, min_m_));
  }
}

/// `max_m` if it is farther.
double TrueClearance::distance_m(const Eigen::Vector3d& p_world_m, double max_m) const {
  double nearest_m = max_m;
  for (const SolidPlane& plane : planes_) {
    nearest_m = std::min(nearest_m, (p_world_m - plane.p_world_m).dot(plane.normal));
  }
  if (nearest_m <= 0.0) return 0.0;
  const auto found = scene_.nearest(p_world_m.cast<float>(), nearest_m);
  return found ? std::sqrt(static_cast<double>(found->distance2_m2)) : nearest_m;
}

}  // namespace vantage
