#include "vantage/sim/world/collision_surfaces.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "vantage/sim/world/mesh_surface.hpp"

namespace vantage {
namespace {

bool is_robot(const mjModel& model, int geom) {
  return model_name(model, ModelObject::body, model.body_rootid[model.geom_bodyid[geom]])
      .starts_with("robot/");
}

bool collides(const mjModel& model, int geom) {
  return model.geom_contype[geom] != 0 || model.geom_conaffinity[geom] != 0;
}

/// A grid over each triangle, edges included, points that nearly coincide once.
void for_each_surface_point(const mjModel& model, int geom, double spacing_m, auto&& visit_new) {
  const SurfaceMesh mesh = geom_triangles(model, geom, spacing_m);
  std::set<std::array<int, 3>> known;
  const auto visit = [&](const Eigen::Vector3d& p) {
    const Eigen::Array3i cell = (p.array() / (0.1 * spacing_m)).round().cast<int>();
    if (known.insert({cell.x(), cell.y(), cell.z()}).second) visit_new(p);
  };
  const auto vertex = [&](int i) { return mesh.vertices_m[static_cast<std::size_t>(i)]; };
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d u = vertex(b) - vertex(a);
    const Eigen::Vector3d v = vertex(c) - vertex(a);
    const double longest_m = std::max({u.norm(), v.norm(), (u - v).norm()});
    const int steps = std::max(1, static_cast<int>(std::ceil(longest_m / spacing_m)));
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) visit(vertex(a) + u * i / steps + v * j / steps);
    }
  }
}

}  // namespace

CollisionSurfaces collision_surfaces(const World& world, const SurfaceSpacing& spacing) {
  CollisionSurfaces surfaces;
  const mjModel& model = world.model();
  const mjData& now = world.snapshot();
  for (int geom = 0; geom < model.ngeom; ++geom) {
    if (!collides(model, geom)) continue;
    const Eigen::Isometry3d T = T_world_geom(now, geom);
    if (model.geom_type[geom] == mjGEOM_PLANE) {
      surfaces.planes.push_back({T.translation(), T.linear().col(2)});
    } else if (is_robot(model, geom)) {
      for_each_surface_point(model, geom, spacing.robot_m, [&](const Eigen::Vector3d& p) {
        surfaces.robot.push_back({geom, p});
      });
    } else {
      for_each_surface_point(model, geom, spacing.scene_m, [&](const Eigen::Vector3d& p) {
        surfaces.scene_world_m.emplace_back((T * p).cast<float>());
      });
    }
  }
  return surfaces;
}

}  // namespace vantage
