#include "vantage/models/catalogue/table/scene_mjcf.hpp"

#include <fmt/format.h>

#include <array>

#include "vantage/core/atomic_file.hpp"
#include "vantage/models/catalogue/shapes/mjcf_kit.hpp"
#include "vantage/models/catalogue/shapes/obj.hpp"
#include "vantage/models/catalogue/shapes/patterns.hpp"

namespace vantage {
namespace {

using Eigen::Vector3d;

constexpr std::string_view kHead =
    R"(<compiler angle="radian" meshdir="meshes" texturedir="textures"/>
  <statistic extent="1" center="0 0 0.9"/>
  <visual>
    <map znear="0.05" zfar="20"/>
    <global offwidth="1280" offheight="960"/>
    <quality shadowsize="0" offsamples="0"/>
    <headlight ambient="0.35 0.35 0.35" diffuse="0.25 0.25 0.25" specular="0.05 0.05 0.05"/>
  </visual>
)";

constexpr std::string_view kRoomAssets =
    R"(    <texture name="sky" type="skybox" builtin="gradient" rgb1="0.75 0.82 0.9" rgb2="0.45 0.5 0.6" width="64" height="384"/>
    <texture name="wood" type="cube" file="wood.png"/>
    <texture name="floor" type="2d" file="floor.png"/>
    <material name="wood" texture="wood" specular="0.1" shininess="0.2"/>
    <material name="dark_wood" texture="wood" rgba="0.62 0.5 0.42 1" specular="0.1" shininess="0.2"/>
    <material name="floor" texture="floor" texrepeat="1 1" texuniform="true" specular="0.05"/>
    <material name="wall" rgba="0.86 0.84 0.79 1" specular="0"/>
    <material name="fabric" rgba="0.30 0.42 0.55 1" specular="0"/>
)";

constexpr std::string_view kRoom =
    R"(    <light name="lamp" directional="true" castshadow="false" pos="0 0 3" dir="-0.4 0.3 -1" diffuse="0.55 0.55 0.52" specular="0.2 0.2 0.2"/>
    <body name="room">
      <geom name="room/floor" type="plane" size="3.1 3.1 0.1" material="floor"/>
      <geom name="room/wall_east" type="box" pos="3.05 0 1.25" size="0.05 3.1 1.25" material="wall"/>
      <geom name="room/wall_west" type="box" pos="-3.05 0 1.25" size="0.05 3.1 1.25" material="wall"/>
      <geom name="room/wall_north" type="box" pos="0 3.05 1.25" size="3 0.05 1.25" material="wall"/>
      <geom name="room/wall_south" type="box" pos="0 -3.05 1.25" size="3 0.05 1.25" material="wall"/>
    </body>
)";

constexpr std::string_view kBoxAssets =
    R"(    <material name="pine" texture="wood" rgba="1 0.93 0.8 1" specular="0.1" shininess="0.2"/>
    <material name="cardboard" rgba="0.72 0.56 0.38 1" specular="0"/>
)";

std::string table_body(double top_m) {
  constexpr double kHalfThickness_m = 0.02;
  std::string text = fmt::format(
      "    <body name=\"table\">\n      <geom name=\"table/top\" type=\"box\" pos=\"0 0 {:.4g}\" "
      "size=\"0.5 0.5 {}\" material=\"wood\"/>\n",
      top_m - kHalfThickness_m, kHalfThickness_m);
  const double half_leg_m = 0.5 * top_m - kHalfThickness_m;
  for (int leg = 0; leg < 4; ++leg) {
    text += fmt::format(
        "      <geom name=\"table/leg_{}\" type=\"box\" pos=\"{} {} {:.4g}\" "
        "size=\"0.025 0.025 {:.4g}\" material=\"wood\"/>\n",
        leg, leg == 0 || leg == 3 ? 0.455 : -0.455, leg < 2 ? 0.455 : -0.455, half_leg_m,
        half_leg_m);
  }
  return text + "    </body>\n";
}

std::vector<Board> boards(Furniture::Kind kind) {
  using enum Furniture::Kind;
  switch (kind) {
    case shelf:
      return {{"back", {-0.165, 0, 0.8}, {0.005, 0.45, 0.8}},
              {"left", {0, 0.44, 0.8}, {0.16, 0.01, 0.8}},
              {"right", {0, -0.44, 0.8}, {0.16, 0.01, 0.8}},
              {"board_0", {0, 0, 0.06}, {0.16, 0.43, 0.01}},
              {"board_1", {0, 0, 0.55}, {0.16, 0.43, 0.01}},
              {"board_2", {0, 0, 1.05}, {0.16, 0.43, 0.01}},
              {"board_3", {0, 0, 1.59}, {0.16, 0.43, 0.01}}};
    case chair:
      return {{"seat", {0, 0, 0.45}, {0.22, 0.22, 0.02}, "fabric"},
              {"rest", {-0.2, 0, 0.75}, {0.02, 0.2, 0.14}, "fabric"},
              {"post_0", {-0.2, 0.2, 0.445}, {0.02, 0.02, 0.445}},
              {"post_1", {-0.2, -0.2, 0.445}, {0.02, 0.02, 0.445}},
              {"leg_0", {0.2, 0.2, 0.215}, {0.02, 0.02, 0.215}},
              {"leg_1", {0.2, -0.2, 0.215}, {0.02, 0.02, 0.215}}};
    case crate:
      return {{"bottom", {0, 0, 0.01}, {0.2, 0.28, 0.01}},
              {"front", {0.19, 0, 0.18}, {0.01, 0.28, 0.16}},
              {"back", {-0.19, 0, 0.18}, {0.01, 0.28, 0.16}},
              {"left", {0, 0.27, 0.18}, {0.18, 0.01, 0.16}},
              {"right", {0, -0.27, 0.18}, {0.18, 0.01, 0.16}}};
  }
  return {};
}

std::string_view kind_name(Furniture::Kind kind) {
  constexpr std::array<std::string_view, 3> names{"shelf", "chair", "crate"};
  return names[static_cast<std::size_t>(kind)];
}

std::string body_of_boards(const std::string& name, const Pose2& pose, const std::string& z_m,
                           const std::vector<Board>& boards) {
  std::string text =
      fmt::format("    <body name=\"{}\" pos=\"{:.4f} {:.4f} {}\" euler=\"0 0 {:.4f}\">\n", name,
                  pose.x_m, pose.y_m, z_m, pose.yaw_rad);
  for (const Board& board : boards) {
    text += fmt::format(
        "      <geom name=\"{}/{}\" type=\"box\" pos=\"{:.6g} {:.6g} {:.6g}\" "
        "size=\"{:.6g} {:.6g} {:.6g}\" material=\"{}\"/>\n",
        name, board.name, board.centre_m.x(), board.centre_m.y(), board.centre_m.z(),
        board.half_m.x(), board.half_m.y(), board.half_m.z(), board.material);
  }
  return text + "    </body>\n";
}

std::string furniture_body(const Furniture& furniture, std::size_t index) {
  return body_of_boards(fmt::format("{}_{:02}", kind_name(furniture.kind), index),
                        furniture.T_world_furniture, "0", boards(furniture.kind));
}

std::string box_body(const OpenBox& box, std::size_t index, double top_m) {
  return body_of_boards(fmt::format("open_{}_{:02}", kind_name(box.kind), index), box.T_world_box,
                        fmt::format("{}", top_m), boards(box));
}

std::string object_assets(const PlacedObject& placed) {
  return fmt::format(R"(    <mesh name="{0}" file="{0}.obj"/>
    <texture name="{0}" type="2d" file="{0}.png"/>
    <material name="{0}" texture="{0}" specular="{1:.2f}" shininess="{2:.2f}"/>
)",
                     placed.spec.name, placed.object.specular, 0.3 + 0.5 * placed.object.specular);
}

std::string object_body(const PlacedObject& placed) {
  const Pose2& pose = placed.T_world_object;
  return fmt::format(R"(    <body name="{0}" pos="{1:.5f} {2:.5f} {3:.5f}" euler="0 0 {4:.5f}">
      <geom name="{0}/mesh" type="mesh" mesh="{0}" material="{0}" mass="{5:.3f}"/>
    </body>
)",
                     placed.spec.name, pose.x_m, pose.y_m, placed.z_m, pose.yaw_rad,
                     placed.object.mass_kg);
}

void write_room_textures(const std::filesystem::path& directory) {
  Rng rng = Rng::stream(0, "room");
  Image table(256, 256, RgbColour::Zero());
  paint(table, UvRect{}, wood(RgbColour(0.78, 0.58, 0.38), RgbColour(0.50, 0.32, 0.17), 4, rng));
  write_png(table, directory / "wood.png");
  Image floor(256, 256, RgbColour::Zero());
  paint(floor, UvRect{},
        tiles(RgbColour(0.70, 0.68, 0.64), RgbColour(0.42, 0.41, 0.40), 3, 3, rng));
  write_png(floor, directory / "floor.png");
}

}  // namespace

std::string to_mjcf(const TableScene& scene) {
  std::string text = fmt::format(
      "<!-- {} objects, seed {}; written by vantage_make_scenes, see ../README.md -->\n"
      "<mujoco model=\"{}\">\n  ",
      scene.objects.size(), scene.seed, scene.name);
  text += kHead;
  text += "  <asset>\n";
  text += kRoomAssets;
  if (!scene.boxes.empty()) text += kBoxAssets;
  for (const PlacedObject& placed : scene.objects) text += object_assets(placed);
  text += "  </asset>\n  <worldbody>\n";
  text += kRoom;
  text += table_body(scene.top_m);
  text += mjcf_camera("overview", {2.95, -2.95, 3.4}, {0.0, 0.0, 0.45}, Vector3d::UnitZ(), 44.0);
  text += mjcf_camera("top", {0.0, 0.0, 4.8}, Vector3d::Zero(), Vector3d::UnitY(), 45.0);
  for (std::size_t i = 0; i < scene.furniture.size(); ++i) {
    text += furniture_body(scene.furniture[i], i);
  }
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    text += box_body(scene.boxes[i], i, scene.top_m);
  }
  for (const PlacedObject& placed : scene.objects) text += object_body(placed);
  return text + "  </worldbody>\n</mujoco>\n";
}

void write_scene(const TableScene& scene, const std::filesystem::path& directory) {
  const auto [meshes, textures] = empty_asset_folders(directory);
  for (const PlacedObject& placed : scene.objects) {
    write_obj(placed.object.mesh, meshes / (placed.spec.name + ".obj"));
    write_png(placed.object.texture, textures / (placed.spec.name + ".png"));
  }
  write_room_textures(textures);
  write_file(directory / "scene.xml", to_mjcf(scene));
}

}  // namespace vantage
