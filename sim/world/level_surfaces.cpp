#include "vantage/sim/world/level_surfaces.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "vantage/sim/world/mesh_surface.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage {
namespace {

/// Triangles of a geom that lie level at about the same height.
struct Face {
  double height_m = 0.0;
  double area_m2 = 0.0;
  Eigen::AlignedBox2d extent_m;
};

std::string name_of(const mjModel& model, int geom) {
  const std::string name = model_name(model, ModelObject::geom, geom);
  return name.empty() ? model_name(model, ModelObject::body, model.geom_bodyid[geom]) : name;
}

SurfaceMesh triangles_of(const mjModel& model, int geom) {
  constexpr double kEdge_m = 0.1;
  if (model.geom_type[geom] != mjGEOM_PLANE) return geom_triangles(model, geom, kEdge_m);
  const double x = model.geom_size[3 * geom];
  const double y = model.geom_size[3 * geom + 1];
  return {.vertices_m = {{-x, -y, 0.0}, {x, -y, 0.0}, {x, y, 0.0}, {-x, y, 0.0}},
          .triangles = {{0, 1, 2}, {0, 2, 3}}};
}

void add_triangle(std::vector<Face>& faces, const std::array<Eigen::Vector3d, 3>& p,
                  const LevelSurfaceOptions& options) {
  const Eigen::Vector3d twice_area = (p[1] - p[0]).cross(p[2] - p[0]);
  const double area_m2 = 0.5 * twice_area.norm();
  const double height_m = (p[0].z() + p[1].z() + p[2].z()) / 3.0;
  if (!(area_m2 > 0.0) ||
      std::abs(twice_area.z()) < 2.0 * area_m2 * std::cos(options.max_tilt_rad) ||
      height_m < options.min_height_m || height_m > options.max_height_m) {
    return;
  }
  auto face = std::ranges::find_if(faces, [&](const Face& other) {
    return std::abs(other.height_m - height_m) < options.height_step_m;
  });
  if (face == faces.end()) face = faces.insert(face, Face{height_m, 0.0, {}});
  face->area_m2 += area_m2;
  for (const Eigen::Vector3d& corner : p) face->extent_m.extend(corner.head<2>());
}

/// The highest of the large level faces of a geom: of a board its upper side.
std::optional<Face> top_of(const mjModel& model, const mjData& data, int geom,
                           const LevelSurfaceOptions& options) {
  const SurfaceMesh mesh = triangles_of(model, geom);
  const Eigen::Isometry3d T_world_geom_now = T_world_geom(data, geom);
  std::vector<Face> faces;
  for (const auto& triangle : mesh.triangles) {
    std::array<Eigen::Vector3d, 3> p;
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = T_world_geom_now * mesh.vertices_m[static_cast<std::size_t>(triangle[i])];
    }
    add_triangle(faces, p, options);
  }
  if (faces.empty()) return std::nullopt;
  const double largest_m2 = std::ranges::max(faces, {}, &Face::area_m2).area_m2;
  std::erase_if(faces, [&](const Face& face) { return face.area_m2 < 0.5 * largest_m2; });
  return std::ranges::max(faces, {}, &Face::height_m);
}

bool meet(const LevelSurface& a, const LevelSurface& b, const LevelSurfaceOptions& options) {
  return std::abs(a.height_m - b.height_m) < options.height_step_m &&
         a.extent_m.exteriorDistance(b.extent_m) <= options.gap_m;
}

/// Joins surfaces that meet, until none do.
void join(std::vector<LevelSurface>& surfaces, const LevelSurfaceOptions& options) {
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    for (std::size_t j = i + 1; j < surfaces.size();) {
      if (!meet(surfaces[i], surfaces[j], options)) {
        ++j;
        continue;
      }
      LevelSurface& kept = surfaces[i];
      const LevelSurface& more = surfaces[j];
      kept.extent_m.extend(more.extent_m);
      kept.area_m2 += more.area_m2;
      surfaces.erase(surfaces.begin() + static_cast<std::ptrdiff_t>(j));
      j = i + 1;  // it may reach others now
    }
  }
}

}  // namespace

std::vector<LevelSurface> level_surfaces(const mjModel& model, const mjData& data,
                                         const LevelSurfaceOptions& options) {
  std::vector<LevelSurface> surfaces;
  for (const int geom : solid_geoms(model, kWithoutRobot)) {
    const auto top = top_of(model, data, geom, options);
    if (top) surfaces.push_back({top->extent_m, top->height_m, top->area_m2, name_of(model, geom)});
  }
  const auto by_area = [](const LevelSurface& a, const LevelSurface& b) {
    return a.area_m2 > b.area_m2;
  };
  std::ranges::stable_sort(surfaces, by_area);
  join(surfaces, options);
  std::erase_if(surfaces,
                [&](const LevelSurface& surface) { return surface.area_m2 < options.min_area_m2; });
  std::ranges::stable_sort(surfaces, by_area);
  return surfaces;
}

}  // namespace vantage
