#include "vantage/building/building_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "vantage/building/box_cover.hpp"
#include "vantage/building/building_frame.hpp"
#include "vantage/building/solid_cells.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

const Eigen::Vector3f kWallColour(0.86F, 0.85F, 0.82F);
const Eigen::Vector3f kFloorColour(0.55F, 0.53F, 0.50F);
/// Obstacles for what drives, and what its map may hold.
constexpr double kLowest_m = 0.05;
constexpr double kHighest_m = 2.0;

Eigen::AlignedBox3d extent_of(const BuildingMesh& mesh, const std::vector<Triangle>& triangles) {
  Eigen::AlignedBox3d extent_m;
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) extent_m.extend(mesh.corner(t, i));
  }
  return extent_m;
}

/// From above, of all triangles that reach into the band of heights; of all if none does.
Eigen::AlignedBox2d standing_extent(const BuildingMesh& mesh) {
  Eigen::AlignedBox2d extent_m;
  for (const Triangle& t : mesh.triangles) {
    const Eigen::AlignedBox3d box_m = extent_of(mesh, {t});
    if (box_m.max().z() < kLowest_m || box_m.min().z() > kHighest_m) continue;
    extent_m.extend(Eigen::Vector2d(box_m.min().head<2>()));
    extent_m.extend(Eigen::Vector2d(box_m.max().head<2>()));
  }
  if (!extent_m.isEmpty()) return extent_m;
  const Eigen::AlignedBox3d all_m = extent_of(mesh, mesh.triangles);
  return {all_m.min().head<2>(), all_m.max().head<2>()};
}

/// Moves the mesh into the scene's frame. @return T_scene_mesh
Eigen::Isometry3d put_up(BuildingMesh& mesh, const BuildingOptions& options,
                         const std::string& name) {
  Eigen::Isometry3d T_scene_mesh(
      Eigen::AngleAxisd(-wall_heading_rad(mesh), Eigen::Vector3d::UnitZ()));
  transform(mesh, T_scene_mesh);
  const auto floor_m = options.floor_m ? options.floor_m : floor_height_m(mesh);
  if (!floor_m) throw InputError(fmt::format("{}: no floor: nowhere 1.5 m of air above it", name));
  const Eigen::Isometry3d down(Eigen::Translation3d(0.0, 0.0, -*floor_m));
  transform(mesh, down);
  const Eigen::Vector2d middle_m = standing_extent(mesh).center();
  const Eigen::Isometry3d aside(Eigen::Translation3d(-middle_m.x(), -middle_m.y(), 0.0));
  transform(mesh, aside);
  T_scene_mesh = aside * down * T_scene_mesh;
  return T_scene_mesh;
}

/// What of the mesh the scene holds.
bool is_within(const Eigen::AlignedBox3d& part_m, const BuildingOptions& options) {
  return part_m.max().z() > -kBelowFloor_m && part_m.min().z() < options.height_m;
}

/// Of a part that the file gives none: by what it is, and of furniture in turn, so that people can
/// tell one from another.
Eigen::Vector3f colour_of(const MeshPart& part, const Eigen::AlignedBox3d& extent_m,
                          std::size_t number) {
  constexpr double kFurniture_m = 2.05;
  constexpr std::array<std::array<float, 3>, 4> kTints{
      {{0.63F, 0.47F, 0.33F}, {0.42F, 0.50F, 0.56F}, {0.55F, 0.58F, 0.45F}, {0.72F, 0.62F, 0.50F}}};
  if (part.colour.minCoeff() >= 0.0F) return part.colour;
  if (extent_m.max().z() < 0.01) return kFloorColour;
  if (extent_m.max().z() > kFurniture_m) return kWallColour;
  return Eigen::Vector3f(kTints[number % kTints.size()].data());
}

/// Sorts the parts into those that are their own shape and the triangles of the rest.
std::vector<Triangle> take_convex(const BuildingMesh& mesh, const std::vector<MeshPart>& parts,
                                  const BuildingOptions& options, BuildingScene& scene) {
  std::vector<Triangle> rest;
  for (const MeshPart& part : parts) {
    const Eigen::AlignedBox3d extent_m = extent_of(mesh, part.triangles);
    if (!is_within(extent_m, options)) continue;
    const Eigen::Vector3f colour =
        colour_of(part, extent_m, scene.boxes.size() + scene.hulls.size());
    OrientedBox box;
    if (!is_convex(mesh, part)) {
      rest.insert(rest.end(), part.triangles.begin(), part.triangles.end());
    } else if (is_box(mesh, part, box)) {
      scene.boxes.push_back({box, colour});
    } else {
      scene.hulls.push_back({corners_of(mesh, part), colour});
    }
  }
  return rest;
}

void add_cell_boxes(const FittedGrid& grid, const std::vector<std::uint8_t>& solid,
                    BuildingScene& scene) {
  for (const CellBox& cells : cover_with_boxes(grid, solid)) {
    const Eigen::AlignedBox3d extent_m = box_m(grid, cells);
    OrientedBox box;
    box.T_mesh_box.translation() = extent_m.center();
    box.half_m = 0.5 * extent_m.sizes();
    scene.cell_boxes.push_back({box, extent_m.max().z() < 0.01 ? kFloorColour : kWallColour});
  }
}

/// @param top_m of all there is: of a solid block its roof is the floor, and nothing is above
void check_geoms(const BuildingScene& scene, const BuildingOptions& options, double top_m,
                 const std::string& name) {
  if (scene.geoms() == (scene.laid_floor ? 1U : 0U) || top_m < options.cell_m) {
    throw InputError(fmt::format(
        "{}: nothing stands on the floor at {:.3g} m (--floor), below {:g} m (--height)", name,
        -scene.T_scene_mesh.translation().z(), options.height_m));
  }
  if (scene.geoms() <= static_cast<std::size_t>(options.max_geoms)) return;
  const std::string needs =
      fmt::format("--max-geoms {}: {} would need {}", options.max_geoms, name, scene.geoms());
  if (scene.geoms() - scene.cell_boxes.size() > static_cast<std::size_t>(options.max_geoms)) {
    throw ConfigError(needs + ", most of them parts of the mesh as it has them");
  }
  throw ConfigError(fmt::format("{}, {} of them boxes of cells; --cell {:g} makes larger ones",
                                needs, scene.cell_boxes.size(), 2.0 * options.cell_m));
}

void find_start(const FittedGrid& grid, const std::vector<std::uint8_t>& solid,
                const BuildingOptions& options, const std::string& name, BuildingScene& scene) {
  FreeFloorOptions wanted{.clearance_m = options.clearance_m, .standing_m = scene.extent_m};
  auto floor = find_free_floor(grid, solid, wanted);
  if (!floor && options.floor_m) {
    scene.laid_floor = wanted.floor_everywhere = true;
    floor = find_free_floor(grid, solid, wanted);
  }
  const double floor_m = -scene.T_scene_mesh.translation().z();
  if (!floor) {
    throw InputError(fmt::format(
        "{}: no floor at {:.3g} m; --floor HEIGHT says where it is, or lays one", name, floor_m));
  }
  if (floor->area_m2 == 0.0) {
    throw InputError(
        fmt::format("{}: no free start: nowhere on the floor at {:.3g} m is {:g} m clear all round "
                    "(--clearance); "
                    "--floor HEIGHT says where the floor is, or lays one",
                    name, floor_m, options.clearance_m));
  }
  scene.floor = *floor;
}

}  // namespace

BuildingScene make_building_scene(BuildingMesh mesh, const BuildingOptions& options,
                                  const std::string& name,
                                  const std::function<void(std::string_view)>& step) {
  BuildingScene scene;
  scene.cell_m = options.cell_m;
  step("parts");
  const std::vector<MeshPart> parts = mesh_parts(mesh);
  mesh.triangles.clear();  // wound anew
  for (const MeshPart& part : parts) {
    mesh.triangles.insert(mesh.triangles.end(), part.triangles.begin(), part.triangles.end());
  }
  step("floor and walls");
  scene.T_scene_mesh = put_up(mesh, options, name);
  const std::vector<Triangle> rest = take_convex(mesh, parts, options, scene);
  Eigen::AlignedBox3d extent_m = extent_of(mesh, mesh.triangles);
  extent_m.min().z() = std::max(extent_m.min().z(), -kBelowFloor_m);
  extent_m.max().z() = std::min(extent_m.max().z(), options.height_m);
  const FittedGrid grid = fit_grid(mesh, extent_m, options.cell_m);
  step("solid cells");
  std::vector<std::uint8_t> solid = solid_cells(mesh, mesh.triangles, grid);
  scene.extent_m = standing_extent(mesh);
  find_start(grid, solid, options, name, scene);
  step("boxes");
  if (!rest.empty()) {
    if (rest.size() != mesh.triangles.size()) solid = solid_cells(mesh, rest, grid);
    add_cell_boxes(grid, solid, scene);
  }
  check_geoms(scene, options, extent_m.max().z(), name);
  return scene;
}

}  // namespace vantage
