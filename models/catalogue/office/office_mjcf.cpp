#include "vantage/models/catalogue/office/office_mjcf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string_view>
#include <utility>

#include "vantage/core/atomic_file.hpp"
#include "vantage/models/catalogue/office/office_finish.hpp"
#include "vantage/models/catalogue/shapes/mjcf_kit.hpp"
#include "vantage/models/catalogue/shapes/obj.hpp"
#include "vantage/models/catalogue/shapes/patterns.hpp"
#include "vantage/models/catalogue/shapes/solid_pieces.hpp"

namespace vantage {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector3d;

constexpr std::string_view kHead =
    R"(<compiler angle="radian" meshdir="meshes" texturedir="textures"/>
  <statistic extent="1" center="0 0 0.8"/>
  <visual>
    <map znear="0.05" zfar="60"/>
    <global offwidth="1280" offheight="960"/>
    <quality shadowsize="0" offsamples="0"/>
    <headlight ambient="0.46 0.46 0.46" diffuse="0.22 0.22 0.22" specular="0.03 0.03 0.03"/>
  </visual>
  <default>
    <default class="still">
      <geom conaffinity="0"/>
      <default class="solid">
        <geom type="mesh" group="3" rgba="0 0 0 0"/>
      </default>
    </default>
  </default>
)";

constexpr std::string_view kSharedAssets =
    R"(    <texture name="sky" type="skybox" builtin="gradient" rgb1="0.80 0.84 0.88" rgb2="0.55 0.60 0.66" width="64" height="384"/>
    <texture name="carpet" type="2d" file="carpet.png"/>
    <texture name="plaster" type="2d" file="plaster.png"/>
    <texture name="furniture" type="2d" file="furniture.png"/>
    <material name="carpet" texture="carpet" texrepeat="1 1" texuniform="true" specular="0"/>
    <material name="outer_wall" texture="plaster" texrepeat="0.5 0.5" texuniform="true" rgba="1 0.98 0.93 1" specular="0"/>
    <material name="inner_wall" texture="plaster" texrepeat="0.5 0.5" texuniform="true" rgba="0.90 0.94 0.96 1" specular="0"/>
    <material name="pillar" rgba="0.80 0.79 0.76 1" specular="0"/>
    <material name="trim" rgba="0.36 0.30 0.26 1" specular="0.1" shininess="0.2"/>
    <material name="furniture" texture="furniture" specular="0.12" shininess="0.25"/>
)";

constexpr std::string_view kLights =
    R"(    <light name="lamp" directional="true" castshadow="false" pos="0 0 5" dir="-0.45 0.3 -1" diffuse="0.42 0.42 0.40" specular="0.1 0.1 0.1"/>
    <light name="fill" directional="true" castshadow="false" pos="0 0 5" dir="0.5 -0.55 -0.6" diffuse="0.22 0.22 0.24" specular="0 0 0"/>
)";

/// What stands in a square of that size makes one body.
constexpr double kTile_m = 2.2;
/// Longer walls are several geoms: MuJoCo looks for contacts in bounding spheres, and that of a
/// long wall is the whole room.
constexpr double kLongestWall_m = 1.7;
/// Contacts may be felt that far beyond a recess's edge. The robot keeps farther away.
constexpr double kContactSlack_m = 0.03;
constexpr std::string_view kLooks = " contype=\"0\"";
constexpr std::string_view kFurniture = "type=\"mesh\" material=\"furniture\"";
constexpr std::string_view kUnfeltFurniture = "type=\"mesh\" material=\"furniture\" contype=\"0\"";

/// A box on the floor, as high as the walls. MuJoCo projects textures along a geom's z, so that
/// axis is turned to point through the thinner direction.
std::string upright_box(std::string_view name, const AlignedBox2d& box_m, std::string_view material,
                        std::string_view contacts = "") {
  const Eigen::Vector2d centre = box_m.center();
  const Eigen::Vector2d half = 0.5 * box_m.sizes();
  const bool along_x = half.x() >= half.y();
  return fmt::format(
      "      <geom name=\"{}\" type=\"box\" pos=\"{:.5g} {:.5g} {}\" size=\"{:.5g} {} {:.5g}\" "
      "quat=\"{}\" material=\"{}\"{}/>\n",
      name, centre.x(), centre.y(), kWallHeight_m / 2, half.maxCoeff(), kWallHeight_m / 2,
      half.minCoeff(), along_x ? "0.70710678 0.70710678 0 0" : "0.5 0.5 0.5 0.5", material,
      contacts);
}

std::string mesh_name(OfficeItem item, int variant) {
  return fmt::format("{}_v{}", item_name(item), variant);
}

std::string mesh_asset(const std::string& name) {
  return fmt::format("    <mesh name=\"{0}\" file=\"{0}.obj\"/>\n", name);
}

std::set<std::pair<OfficeItem, int>> meshes_of(const OfficeScene& scene) {
  std::set<std::pair<OfficeItem, int>> meshes;
  for (const PlacedItem& placed : scene.furniture) meshes.emplace(placed.item, placed.variant);
  return meshes;
}

std::string solid_name(const std::string& name, std::size_t piece) {
  return fmt::format("{}_solid_{}", name, piece);
}

/// What is bumped into, if that is not the convex hull of the mesh.
std::vector<TriangleMesh> separate_solids(OfficeItem item, int variant) {
  if (hangs_on_wall(item)) return {};
  static std::map<std::pair<OfficeItem, int>, std::vector<TriangleMesh>> known;
  const auto [entry, is_new] = known.try_emplace({item, variant});
  if (is_new) {
    entry->second = solid_pieces(make_office_item(item, variant), kContactSlack_m);
    if (entry->second.size() == 1) entry->second.clear();
  }
  return entry->second;
}

std::string mesh_geom(const std::string& name, std::string_view how, const std::string& mesh,
                      const Pose2& pose) {
  return fmt::format(
      "      <geom name=\"{}\" {} mesh=\"{}\" pos=\"{:.4f} {:.4f} 0\" euler=\"0 0 {:.5f}\"/>\n",
      name, how, mesh, pose.x_m, pose.y_m, wrap_angle(pose.yaw_rad));
}

using Bodies = std::map<std::string, std::string>;  // geoms by the body's name

std::string tile_name(const Eigen::Vector2d& p_m, const FloorPlan& plan) {
  const Eigen::Vector2d tile = (p_m + 0.5 * plan.size_m) / kTile_m;
  return fmt::format("tile_{}_{}", static_cast<int>(tile.x()), static_cast<int>(tile.y()));
}

/// Equal parts along the longer side.
std::vector<AlignedBox2d> cut_up(const AlignedBox2d& wall_m) {
  const int axis = wall_m.sizes().x() >= wall_m.sizes().y() ? 0 : 1;
  const int count = static_cast<int>(std::ceil(wall_m.sizes()[axis] / kLongestWall_m));
  std::vector<AlignedBox2d> parts(static_cast<std::size_t>(count), wall_m);
  for (int i = 0; i < count; ++i) {
    AlignedBox2d& part = parts[static_cast<std::size_t>(i)];
    part.min()[axis] = wall_m.min()[axis] + wall_m.sizes()[axis] * i / count;
    part.max()[axis] = wall_m.min()[axis] + wall_m.sizes()[axis] * (i + 1) / count;
  }
  return parts;
}

void add_building(Bodies& bodies, const FloorPlan& plan) {
  int walls = 0;
  int posts = 0;
  int pillars = 0;
  for (std::size_t w = 0; w < plan.walls.size(); ++w) {
    for (const AlignedBox2d& piece : wall_pieces(plan.walls[w])) {
      for (const AlignedBox2d& part : cut_up(piece)) {
        bodies[tile_name(part.center(), plan)] +=
            upright_box(fmt::format("wall_{:02}", walls++), part,
                        w < kOuterWalls ? "outer_wall" : "inner_wall");
      }
    }
    for (const AlignedBox2d& post : door_posts(plan.walls[w])) {
      bodies["looks"] += upright_box(fmt::format("door_post_{:02}", posts++), post, "trim", kLooks);
    }
  }
  for (const AlignedBox2d& pillar : plan.pillars) {
    bodies[tile_name(pillar.center(), plan)] +=
        upright_box(fmt::format("pillar_{:02}", pillars++), pillar, "pillar");
  }
}

void add_furniture(Bodies& bodies, const PlacedItem& placed, const std::string& name,
                   const FloorPlan& plan) {
  const Pose2& pose = placed.T_world_item;
  const std::string mesh = mesh_name(placed.item, placed.variant);
  const std::size_t solids = separate_solids(placed.item, placed.variant).size();
  std::string& on_tile = bodies[tile_name({pose.x_m, pose.y_m}, plan)];
  const bool is_felt = solids == 0 && !hangs_on_wall(placed.item);
  (is_felt ? on_tile : bodies["looks"]) +=
      mesh_geom(name, is_felt ? kFurniture : kUnfeltFurniture, mesh, pose);
  for (std::size_t i = 0; i < solids; ++i) {
    on_tile += mesh_geom(solid_name(name, i), "class=\"solid\"", solid_name(mesh, i), pose);
  }
}

std::string static_bodies(const OfficeScene& scene) {
  Bodies bodies;
  add_building(bodies, scene.plan);
  const std::vector<std::string> names = furniture_names(scene);
  for (std::size_t i = 0; i < names.size(); ++i) {
    add_furniture(bodies, scene.furniture[i], names[i], scene.plan);
  }
  std::string text = fmt::format(
      "    <geom name=\"floor\" type=\"plane\" size=\"{} {} 0.1\" "
      "material=\"carpet\"/>\n",
      scene.plan.size_m.x() / 2, scene.plan.size_m.y() / 2);
  for (const auto& [name, geoms] : bodies) {
    if (geoms.empty()) continue;
    text +=
        fmt::format("    <body name=\"{}\" childclass=\"still\">\n{}    </body>\n", name, geoms);
  }
  return text;
}

std::string start_sites(const FloorPlan& plan) {
  std::string text;
  for (std::size_t i = 0; i < plan.T_world_starts.size(); ++i) {
    const Pose2& start = plan.T_world_starts[i];
    text += fmt::format(
        "    <site name=\"start_{}\" pos=\"{} {} 0\" euler=\"0 0 {}\" size=\"0.05\" "
        "group=\"4\"/>\n",
        i, start.x_m, start.y_m, start.yaw_rad);
  }
  return text;
}

std::string cameras(const FloorPlan& plan) {
  constexpr double kFovy_deg = 50.0;
  const Eigen::Vector2d half = 0.5 * plan.size_m + Eigen::Vector2d::Constant(0.6);
  const double reach = std::max(half.y(), 0.75 * half.x());  // images are 4 : 3
  const double height =
      kWallHeight_m + reach / std::tan(0.5 * kFovy_deg * std::numbers::pi / 180.0);
  return mjcf_camera("overview", {0.55 * half.x(), -1.5 * half.y(), 1.5 * reach}, {0, -0.5, 0},
                     Vector3d::UnitZ(), kFovy_deg) +
         mjcf_camera("top", {0, 0, height}, Vector3d::Zero(), Vector3d::UnitY(), kFovy_deg);
}

void write_textures(const std::filesystem::path& directory) {
  Rng rng = Rng::stream(0, "office rooms");
  Image carpet(128, 128, RgbColour::Zero());
  const Pattern pile = mottled(RgbColour(0.33, 0.36, 0.40), RgbColour(0.50, 0.52, 0.55), 40, rng);
  const Pattern tile = checks(RgbColour::Ones(), 0.94 * RgbColour::Ones(), 2, 2);
  paint(carpet, UvRect{},
        [&](double s, double t) -> RgbColour { return pile(s, t).cwiseProduct(tile(s, t)); });
  write_png(carpet, directory / "carpet.png");
  Image plaster(128, 128, RgbColour::Zero());
  paint(plaster, UvRect{},
        mottled(RgbColour(0.82, 0.81, 0.79), RgbColour(0.93, 0.92, 0.90), 9, rng));
  write_png(plaster, directory / "plaster.png");
  write_png(paint_finishes(), directory / "furniture.png");
}

}  // namespace

std::vector<std::string> furniture_names(const OfficeScene& scene) {
  std::map<OfficeItem, int> count;
  std::vector<std::string> names;
  for (const PlacedItem& placed : scene.furniture) {
    names.push_back(fmt::format("{}_{:02}", item_name(placed.item), count[placed.item]++));
  }
  return names;
}

std::string to_mjcf(const OfficeScene& scene) {
  std::string text = fmt::format(
      "<!-- clutter level {}, seed {}; written by vantage_make_scenes, see ../README.md -->\n"
      "<mujoco model=\"{}\">\n  ",
      scene.clutter, scene.seed, scene.name);
  text += kHead;
  text += "  <asset>\n";
  text += kSharedAssets;
  for (const auto& [item, variant] : meshes_of(scene)) {
    const std::string name = mesh_name(item, variant);
    text += mesh_asset(name);
    for (std::size_t i = 0; i < separate_solids(item, variant).size(); ++i) {
      text += mesh_asset(solid_name(name, i));
    }
  }
  text += "  </asset>\n  <worldbody>\n";
  text += kLights;
  text += cameras(scene.plan);
  text += start_sites(scene.plan);
  text += static_bodies(scene);
  return text + "  </worldbody>\n</mujoco>\n";
}

void write_scene(const OfficeScene& scene, const std::filesystem::path& directory) {
  const auto [meshes, textures] = empty_asset_folders(directory);
  for (const auto& [item, variant] : meshes_of(scene)) {
    const std::string name = mesh_name(item, variant);
    write_obj(make_office_item(item, variant), meshes / (name + ".obj"));
    const auto solids = separate_solids(item, variant);
    for (std::size_t i = 0; i < solids.size(); ++i) {
      write_obj(solids[i], meshes / (solid_name(name, i) + ".obj"));
    }
  }
  write_textures(textures);
  write_file(directory / "scene.xml", to_mjcf(scene));
}

}  // namespace vantage
