#include "vantage/models/catalogue/flight/flight_mjcf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "vantage/core/atomic_file.hpp"
#include "vantage/models/catalogue/flight/flight_looks.hpp"
#include "vantage/models/catalogue/shapes/mjcf_kit.hpp"

namespace vantage {
namespace {

using Eigen::Vector3d;

/// The vehicle takes a lamp along, as the turntable of datasets has one beside its camera: the
/// headlight. Above is another; faces are on average as bright as on the turntable.
constexpr std::string_view kHead =
    R"(<compiler angle="radian" convexhull="true"/>
  <statistic extent="1" center="0 0 0.9"/>
  <visual>
    <map znear="0.05" zfar="25"/>
    <global offwidth="1920" offheight="1080"/>
    <quality shadowsize="0" offsamples="0"/>
    <headlight ambient="0.42 0.42 0.42" diffuse="0.52 0.52 0.52" specular="0 0 0"/>
  </visual>
  <asset>
    <texture name="sky" type="skybox" builtin="gradient" rgb1="0.75 0.82 0.9" rgb2="0.45 0.5 0.6" width="64" height="384"/>
    <texture name="floor" type="2d" builtin="checker" rgb1="0.46 0.44 0.41" rgb2="0.42 0.40 0.38" width="256" height="256"/>
    <material name="floor" texture="floor" texrepeat="5 5" texuniform="false" specular="0.05"/>
    <material name="wall" rgba="0.84 0.82 0.77 1" specular="0"/>
    <material name="top" rgba="0.62 0.62 0.62 1" specular="0.1"/>
    <material name="pedestal" rgba="0.48 0.47 0.45 1" specular="0.05"/>
    <material name="legs" rgba="0.35 0.35 0.37 1" specular="0.3"/>
    <material name="column" rgba="0.73 0.70 0.66 1" specular="0"/>
    <material name="wood" rgba="0.55 0.40 0.27 1" specular="0.1"/>
)";

constexpr std::string_view kLamp =
    R"(    <light name="ceiling" directional="true" castshadow="false" pos="0 0 3" dir="0 0 -1" diffuse="0.18 0.18 0.18" specular="0.25 0.25 0.25"/>
)";

std::string geom(std::string_view name, std::string_view type, const Vector3d& p_m,
                 std::string_view size, std::string_view material) {
  return fmt::format(
      "      <geom name=\"{}\" type=\"{}\" pos=\"{:.5g} {:.5g} {:.5g}\" size=\"{}\" "
      "material=\"{}\"/>\n",
      name, type, p_m.x(), p_m.y(), p_m.z(), size, material);
}

std::string box(std::string_view name, const Vector3d& p_m, const Vector3d& half_m,
                std::string_view material) {
  return geom(name, "box", p_m,
              fmt::format("{:.5g} {:.5g} {:.5g}", half_m.x(), half_m.y(), half_m.z()), material);
}

std::string cylinder(std::string_view name, double z_m, double radius_m, double half_m,
                     std::string_view material) {
  return geom(name, "cylinder", {0.0, 0.0, z_m}, fmt::format("{:.5g} {:.5g}", radius_m, half_m),
              material);
}

std::string body(const std::string& name, const Eigen::Vector2d& p_m, double yaw_rad,
                 const std::string& geoms) {
  return fmt::format(
      "    <body name=\"{}\" pos=\"{:.5g} {:.5g} 0\" euler=\"0 0 {:.5g}\">\n{}    </body>\n", name,
      p_m.x(), p_m.y(), yaw_rad, geoms);
}

std::string room(const Eigen::Vector2d& size_m) {
  constexpr double kHalfThick_m = 0.05;
  const Eigen::Vector2d half = 0.5 * size_m;
  const double z = 0.5 * kFlightWallHeight_m;
  const double x = half.x() + kHalfThick_m;
  const double y = half.y() + kHalfThick_m;
  std::string text = fmt::format(
      "      <geom name=\"room/floor\" type=\"plane\" size=\"{:.5g} {:.5g} 0.1\" "
      "material=\"floor\"/>\n",
      x + kHalfThick_m, y + kHalfThick_m);
  const Vector3d along_y(kHalfThick_m, y + kHalfThick_m, z);
  const Vector3d along_x(half.x(), kHalfThick_m, z);
  text += box("room/wall_east", {x, 0.0, z}, along_y, "wall");
  text += box("room/wall_west", {-x, 0.0, z}, along_y, "wall");
  text += box("room/wall_north", {0.0, y, z}, along_x, "wall");
  text += box("room/wall_south", {0.0, -y, z}, along_x, "wall");
  return body("room", Eigen::Vector2d::Zero(), 0.0, text);
}

std::string support_body(const FlightSupport& support_surface, std::size_t index) {
  constexpr double kHalfTop_m = 0.02;
  constexpr double kHalfFoot_m = 0.01;
  const std::string name = fmt::format("stand_{}", index);
  const double below_m = support_surface.top_m - 2.0 * kHalfTop_m;
  const double top_z = support_surface.top_m - kHalfTop_m;
  std::string geoms;
  if (support_surface.round) {
    geoms += cylinder(name + "/top", top_z, kRoundTableRadius_m, kHalfTop_m, "top");
    geoms += cylinder(name + "/leg", 0.5 * below_m, 0.035, 0.5 * below_m, "legs");
    geoms += cylinder(name + "/foot", kHalfFoot_m, 0.2, kHalfFoot_m, "legs");
  } else {
    constexpr double kInset_m = 0.02;
    const double half = kPedestalHalf_m - kInset_m;
    geoms += box(name + "/top", {0.0, 0.0, top_z}, {kPedestalHalf_m, kPedestalHalf_m, kHalfTop_m},
                 "top");
    geoms +=
        box(name + "/body", {0.0, 0.0, 0.5 * below_m}, {half, half, 0.5 * below_m}, "pedestal");
  }
  return body(name, support_surface.p_world_m, support_surface.yaw_rad, geoms);
}

std::string obstacle_body(const FlightObstacle& obstacle, int index) {
  const std::string name = fmt::format("{}_{}", obstacle.kind, index);
  const Vector3d half = 0.5 * obstacle.size_m;
  const std::string geoms = obstacle.kind == "column"
                                ? cylinder(name + "/shaft", half.z(), half.x(), half.z(), "column")
                                : box(name + "/body", {0.0, 0.0, half.z()}, half, "wood");
  return body(name, obstacle.p_world_m, obstacle.yaw_rad, geoms);
}

/// So far from the middle of the room that a picture of 8 : 9, as half of a video is, holds all of
/// it; beyond two walls, which pictures for people leave out.
Vector3d overview_eye(const FlightScene& scene, const Vector3d& target_m, double fovy_deg) {
  const Vector3d back = Vector3d(0.62, -1.0, 1.02).normalized();
  const Vector3d right = Vector3d::UnitZ().cross(back).normalized();
  const Vector3d up = back.cross(right);
  const double half = std::tan(0.5 * fovy_deg * std::numbers::pi / 180.0);
  double distance_m = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d p_m((corner & 1) != 0 ? 0.5 * scene.room_m.x() : -0.5 * scene.room_m.x(),
                       (corner & 2) != 0 ? 0.5 * scene.room_m.y() : -0.5 * scene.room_m.y(),
                       (corner & 4) != 0 ? kFlightWallHeight_m : 0.0);
    const Vector3d off_m = p_m - target_m;
    const double aside_m =
        std::max(std::abs(off_m.dot(right)) * 9.0 / 8.0, std::abs(off_m.dot(up)));
    distance_m = std::max(distance_m, off_m.dot(back) + aside_m / half);
  }
  return target_m + distance_m * back;
}

std::string cameras(const FlightScene& scene) {
  constexpr double kFovy_deg = 50.0;
  constexpr double kOverviewFovy_deg = 64.0;  // from near enough for the far plane
  const Eigen::Vector2d half = 0.5 * scene.room_m + Eigen::Vector2d::Constant(0.4);
  const double reach = std::max(half.y(), 0.75 * half.x());  // images are 4 : 3
  const double height =
      kFlightWallHeight_m + reach / std::tan(0.5 * kFovy_deg * std::numbers::pi / 180.0);
  const Vector3d target_m(0.0, 0.0, 0.7);
  return mjcf_camera("overview", overview_eye(scene, target_m, kOverviewFovy_deg), target_m,
                     Vector3d::UnitZ(), kOverviewFovy_deg) +
         mjcf_camera("top", {0, 0, height}, Vector3d::Zero(), Vector3d::UnitY(), kFovy_deg);
}

std::string stand_ins(const FlightScene& scene) {
  std::string text =
      "<!-- Stand-ins. An episode puts objects of its database in the place of this file: bodies "
      "and\n     geoms called object_0, object_1 ... -->\n<mujoco>\n  <worldbody>\n";
  for (std::size_t i = 0; i < scene.support_surfaces.size(); ++i) {
    const FlightSupport& support_surface = scene.support_surfaces[i];
    text += fmt::format(
        "    <body name=\"object_{0}\" pos=\"{1:.5g} {2:.5g} {3:.5g}\">\n      <geom "
        "name=\"object_{0}\" type=\"box\" pos=\"0 0 0.06\" size=\"0.04 0.03 0.06\" rgba=\"0.75 0.3 "
        "0.2 1\"/>\n    </body>\n",
        i, support_surface.p_world_m.x(), support_surface.p_world_m.y(), support_surface.top_m);
  }
  return text + "  </worldbody>\n</mujoco>\n";
}

std::string csv_row(const Eigen::Vector2d& p_m, double z_m, double yaw_rad) {
  return fmt::format("{:.4f},{:.4f},{:.4f},{:.4f}\n", p_m.x(), p_m.y(), z_m, yaw_rad);
}

constexpr std::string_view kCsvHeader = "x_m,y_m,z_m,yaw_rad\n";

}  // namespace

std::string to_mjcf(const FlightScene& scene) {
  std::string text = fmt::format(
      "<!-- {}; written by vantage_make_scenes, see ../README.md -->\n"
      "<mujoco model=\"{}\">\n  ",
      scene.about, scene.name);
  text += kHead;
  text += looks_assets();
  text += "  </asset>\n";
  text += looks_class();
  text += "  <worldbody>\n";
  text += kLamp;
  text += cameras(scene);
  text += room(scene.room_m);
  for (std::size_t i = 0; i < scene.support_surfaces.size(); ++i)
    text += support_body(scene.support_surfaces[i], i);
  std::map<std::string_view, int> count;
  for (const FlightObstacle& obstacle : scene.obstacles) {
    text += obstacle_body(obstacle, count[obstacle.kind]++);
  }
  text += looks_bodies(scene);
  return text + "  </worldbody>\n  <include file=\"objects.xml\"/>\n</mujoco>\n";
}

void write_scene(const FlightScene& scene, const std::filesystem::path& directory) {
  make_writable_directory(directory);
  write_file(directory / "scene.xml", to_mjcf(scene));
  write_file(directory / "objects.xml", stand_ins(scene));
  std::string path(kCsvHeader);
  for (const PathPoint& point : flight_path_points(scene)) {
    path += csv_row(point.p_world_m, kPathHeight_m, point.yaw_rad);
  }
  write_file(directory / "path.csv", path);
  std::string support_surfaces(kCsvHeader);
  for (const FlightSupport& support_surface : scene.support_surfaces) {
    support_surfaces +=
        csv_row(support_surface.p_world_m, support_surface.top_m, support_surface.yaw_rad);
  }
  write_file(directory / "stands.csv", support_surfaces);
}

}  // namespace vantage
