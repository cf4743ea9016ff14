#include "vantage/sim/render/scene_surfaces.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "vantage/sim/world/mesh_surface.hpp"

namespace vantage {
namespace {

constexpr int kShownGroup = 2;                ///< and those below, as renderers draw them
constexpr double kFacet_m = 0.12;             ///< of round things
constexpr std::size_t kMostTriangles = 4000;  ///< of a mesh
constexpr double kInfinitePlane_m = 10.0;     ///< half of it

using Rgb = Eigen::Array3d;

Rgb mean_of_texture(const mjModel& model, int texture) {
  const mjtByte* pixels = model.tex_rgb + model.tex_adr[texture];
  const int count = model.tex_width[texture] * model.tex_height[texture];
  Rgb sum = Rgb::Zero();
  for (int i = 0; i < count; ++i) {
    sum += Rgb(pixels[3 * i], pixels[3 * i + 1], pixels[3 * i + 2]);
  }
  return sum / (255.0 * std::max(count, 1));
}

Rgb texel(const mjModel& model, int texture, const float* uv) {
  const int width = model.tex_width[texture];
  const int height = model.tex_height[texture];
  const auto at = [](float share, int size) {
    const float inside = share - std::floor(share);
    return std::clamp(static_cast<int>(inside * static_cast<float>(size)), 0, size - 1);
  };
  const mjtByte* pixel =
      model.tex_rgb + model.tex_adr[texture] + 3 * (at(uv[1], height) * width + at(uv[0], width));
  return Rgb(pixel[0], pixel[1], pixel[2]) / 255.0;
}

int texture_of(const mjModel& model, int geom) {
  const int material = model.geom_matid[geom];
  const int texture = material < 0 ? -1 : model.mat_texid[material];
  return texture >= 0 && model.tex_type[texture] == mjTEXTURE_2D ? texture : -1;
}

Rgb plain_colour(const mjModel& model, int geom) {
  const int material = model.geom_matid[geom];
  const float* rgba = material < 0 ? model.geom_rgba + 4 * geom : model.mat_rgba + 4 * material;
  return Rgb(rgba[0], rgba[1], rgba[2]);
}

std::vector<Rgb> vertex_colours(const mjModel& model, int geom, std::size_t vertices) {
  const int texture = texture_of(model, geom);
  const int mesh = model.geom_type[geom] == mjGEOM_MESH ? model.geom_dataid[geom] : -1;
  Rgb colour = plain_colour(model, geom);
  if (texture >= 0 && (mesh < 0 || model.mesh_texcoordadr[mesh] < 0)) {
    colour *= mean_of_texture(model, texture);
  }
  std::vector<Rgb> colours(vertices, colour);
  if (texture < 0 || mesh < 0 || model.mesh_texcoordadr[mesh] < 0) return colours;
  const float* uv = model.mesh_texcoord + 2 * model.mesh_texcoordadr[mesh];
  for (std::size_t i = 0; i < vertices; ++i) colours[i] *= texel(model, texture, uv + 2 * i);
  return colours;
}

SurfaceMesh plane(const mjModel& model, int geom) {
  const auto half_m = [&](int axis) {
    const double size_m = model.geom_size[3 * geom + axis];
    return size_m > 0.0 ? size_m : kInfinitePlane_m;
  };
  SurfaceMesh mesh;
  for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
    mesh.vertices_m.emplace_back(x * half_m(0), y * half_m(1), 0.0);
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// A mesh whose vertices each have a colour.
struct Tinted {
  SurfaceMesh mesh;
  std::vector<Rgb> colours;
};

/// Vertices of one cell of a lattice become their mean.
Tinted joined(const Tinted& fine, double cell_m) {
  std::map<std::array<int, 3>, int> number_of;
  std::vector<int> number;
  std::vector<int> count;
  Tinted coarse;
  for (std::size_t i = 0; i < fine.colours.size(); ++i) {
    const Eigen::Array3i c = (fine.mesh.vertices_m[i].array() / cell_m).floor().cast<int>();
    const auto [found, is_new] = number_of.try_emplace({c.x(), c.y(), c.z()}, std::ssize(count));
    number.push_back(found->second);
    if (is_new) {
      count.push_back(0);
      coarse.mesh.vertices_m.emplace_back(Eigen::Vector3d::Zero());
      coarse.colours.emplace_back(Rgb::Zero());
    }
    const auto at = static_cast<std::size_t>(found->second);
    ++count[at];
    coarse.mesh.vertices_m[at] += fine.mesh.vertices_m[i];
    coarse.colours[at] += fine.colours[i];
  }
  for (std::size_t i = 0; i < count.size(); ++i) {
    coarse.mesh.vertices_m[i] /= count[i];
    coarse.colours[i] /= count[i];
  }
  for (const auto& [a, b, c] : fine.mesh.triangles) {
    const std::array<int, 3> t{number[static_cast<std::size_t>(a)],
                               number[static_cast<std::size_t>(b)],
                               number[static_cast<std::size_t>(c)]};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) coarse.mesh.triangles.push_back(t);
  }
  return coarse;
}

Tinted tinted(const mjModel& model, int geom) {
  Tinted fine{model.geom_type[geom] == mjGEOM_PLANE ? plane(model, geom)
                                                    : geom_triangles(model, geom, kFacet_m),
              {}};
  fine.colours = vertex_colours(model, geom, fine.mesh.vertices_m.size());
  Tinted shown = fine;
  for (double cell_m = 0.008; shown.mesh.triangles.size() > kMostTriangles; cell_m *= 1.5) {
    shown = joined(fine, cell_m);
  }
  return shown;
}

void add(SceneSurfaces& scene, const Tinted& shape, const Eigen::Isometry3d& T, std::size_t part) {
  const auto first = static_cast<std::uint32_t>(scene.vertices_m.size());
  for (std::size_t i = 0; i < shape.colours.size(); ++i) {
    scene.vertices_m.emplace_back((T * shape.mesh.vertices_m[i]).cast<float>());
    auto& colour = scene.colours.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const double value = std::clamp(255.0 * shape.colours[i][k], 0.0, 255.0);
      colour[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(std::lround(value));
    }
  }
  for (const auto& [a, b, c] : shape.mesh.triangles) {
    scene.triangles[part].push_back({first + static_cast<std::uint32_t>(a),
                                     first + static_cast<std::uint32_t>(b),
                                     first + static_cast<std::uint32_t>(c)});
  }
}

}  // namespace

SceneSurfaces scene_surfaces(const mjModel& model, const mjData& data) {
  const OuterWalls walls = outer_walls(model);
  const auto part_of = [&](int geom) {
    for (std::size_t side = 0; side < walls.geoms.size(); ++side) {
      if (std::ranges::binary_search(walls.geoms[side], geom)) return side + 1;
    }
    return std::size_t{0};
  };
  SceneSurfaces scene;
  scene.extent_m = walls.extent_m;
  for (const int geom :
       solid_geoms(model, {.exclude_body_prefix = "robot/", .max_group = kLooksGroup})) {
    const int group = model.geom_group[geom];
    if (group > kShownGroup && group != kLooksGroup) continue;
    add(scene, tinted(model, geom), T_world_geom(data, geom), part_of(geom));
  }
  return scene;
}

}  // namespace vantage
