/// What may collide, as points on its surface. For metrics.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "vantage/sim/world/world.hpp"

namespace vantage {

struct SurfacePoint {
  int geom_id = 0;
  Eigen::Vector3d p_geom_m = Eigen::Vector3d::Zero();  ///< frame of the geom
};

/// An endless wall or floor; the normal points away from what is solid.
struct SolidPlane {
  Eigen::Vector3d p_world_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
};

struct CollisionSurfaces {
  std::vector<SurfacePoint> robot;
  std::vector<Eigen::Vector3f> scene_world_m;  ///< of everything else, as it stands now
  std::vector<SolidPlane> planes;              ///< likewise
};

struct SurfaceSpacing {
  double robot_m = 0.03;  ///< between neighbouring points at most
  double scene_m = 0.03;
};

/// Of geoms that take part in collisions; those of bodies `robot/...` are the robot. Of points
/// nearer to each other than a tenth of the spacing one is kept.
CollisionSurfaces collision_surfaces(const World& world, const SurfaceSpacing& spacing = {});

}  // namespace vantage
