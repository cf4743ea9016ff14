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

/// Calls `f` with the corners, world, of every triangle of a geom.
void for_each_triangle(const mjModel& model, const mjData& data, int geom, auto&& f) {
  const SurfaceMesh mesh = triangles_of(model, geom);
  const Eigen::Isometry3d T_world_geom_now = T_world_geom(data, geom);
  for (const auto& triangle : mesh.triangles) {
    std::array<Eigen::Vector3d, 3> p;
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = T_world_geom_now * mesh.vertices_m[static_cast<std::size_t>(triangle[i])];
    }
    f(p);
  }
}

/// The highest of the large level faces of a geom: of a board its upper side.
std::optional<Face> top_of(const mjModel& model, const mjData& data, int geom,
                           const LevelSurfaceOptions& options) {
  std::vector<Face> faces;
  for_each_triangle(model, data, geom, [&](const std::array<Eigen::Vector3d, 3>& p) {
    add_triangle(faces, p, options);
  });
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

/// A side of a geom: triangles in one plane.
struct Side {
  Eigen::Vector3d normal;  ///< unit, upwards
  double offset_m;         ///< of the plane from the origin, along the normal
  double area_m2 = 0.0;
  double moment_m3 = 0.0;  ///< area times height
};

void add_to_side(std::vector<Side>& sides, const std::array<Eigen::Vector3d, 3>& p,
                 double height_step_m) {
  constexpr double kSameTurn_rad = 0.01;
  Eigen::Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
  const double area_m2 = 0.5 * normal.norm();
  if (!(area_m2 > 0.0)) return;
  normal /= normal.z() < 0.0 ? -2.0 * area_m2 : 2.0 * area_m2;
  const double offset_m = normal.dot(p[0]);
  auto side = std::ranges::find_if(sides, [&](const Side& other) {
    return other.normal.dot(normal) > std::cos(kSameTurn_rad) &&
           std::abs(other.offset_m - offset_m) < height_step_m;
  });
  if (side == sides.end()) side = sides.insert(side, Side{normal, offset_m});
  side->area_m2 += area_m2;
  side->moment_m3 += area_m2 * (p[0].z() + p[1].z() + p[2].z()) / 3.0;
}

/// The largest side of a geom that leans by no more than `steepest_rad`; of a board the upper one.
std::optional<NearSurface> largest_side(const mjModel& model, const mjData& data, int geom,
                                        double steepest_rad, double height_step_m) {
  std::vector<Side> sides;
  for_each_triangle(model, data, geom, [&](const std::array<Eigen::Vector3d, 3>& p) {
    add_to_side(sides, p, height_step_m);
  });
  std::erase_if(sides, [&](const Side& side) { return side.normal.z() < std::cos(steepest_rad); });
  if (sides.empty()) return std::nullopt;
  const double largest_m2 = std::ranges::max(sides, {}, &Side::area_m2).area_m2;
  std::erase_if(sides, [&](const Side& side) { return side.area_m2 < 0.99 * largest_m2; });
  const Side& top = *std::ranges::max_element(sides, {}, &Side::offset_m);
  return NearSurface{top.moment_m3 / top.area_m2, top.area_m2,
                     std::acos(std::min(1.0, top.normal.z())), name_of(model, geom)};
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

std::optional<NearSurface> nearest_to_level(const mjModel& model, const mjData& data,
                                            const LevelSurfaceOptions& options) {
  constexpr double kLowest_m = 0.1;
  constexpr double kHighest_m = 2.0;
  constexpr double kSteepest_rad = 0.5;
  LevelSurfaceOptions wider = options;
  wider.min_height_m = std::min(kLowest_m, options.min_height_m);
  wider.max_height_m = std::max(kHighest_m, options.max_height_m);
  wider.min_area_m2 = 0.25 * options.min_area_m2;
  std::optional<NearSurface> nearest;
  if (const auto level = level_surfaces(model, data, wider); !level.empty()) {
    const LevelSurface& largest = level.front();
    nearest = {largest.height_m, largest.area_m2, 0.0, largest.name};
  }
  const double steepest_rad = std::max(kSteepest_rad, options.max_tilt_rad);
  for (const int geom : solid_geoms(model, kWithoutRobot)) {
    const auto side = largest_side(model, data, geom, steepest_rad, options.height_step_m);
    const bool within = side && side->tilt_rad > options.max_tilt_rad &&
                        side->height_m >= wider.min_height_m &&
                        side->height_m <= wider.max_height_m && side->area_m2 >= wider.min_area_m2;
    if (within && (!nearest || side->area_m2 > nearest->area_m2)) nearest = side;
  }
  return nearest;
}

}  // namespace vantage
