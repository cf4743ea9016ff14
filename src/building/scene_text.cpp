#include "vantage/building/scene_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "vantage/belief/map/floor_detail.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/core/yaml.hpp"

namespace vantage {
namespace {

constexpr std::string_view kHead = R"(  <compiler angle="radian"/>
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
    </default>
  </default>
)";

constexpr std::string_view kLights =
    R"(    <light directional="true" castshadow="false" pos="0 0 5" dir="-0.45 0.3 -1" diffuse="0.42 0.42 0.40" specular="0.1 0.1 0.1"/>
    <light directional="true" castshadow="false" pos="0 0 5" dir="0.5 -0.55 -0.6" diffuse="0.22 0.22 0.24" specular="0 0 0"/>
)";

/// Six digits, no negative zero.
std::string number(double value) {
  const double rounded = std::round(1e6 * value) / 1e6;
  return fmt::format("{:.7g}", rounded == 0.0 ? 0.0 : rounded);
}

std::string numbers(const Eigen::Vector3d& p) {
  return number(p.x()) + " " + number(p.y()) + " " + number(p.z());
}

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  for (auto at = text.find(what); at != text.npos; at = text.find(what, at + by.size())) {
    text.replace(at, what.size(), by);
  }
  return text;
}

/// As the value of an attribute.
std::string xml_escaped(const std::string& text) {
  std::string escaped = replaced(replaced(text, "&", "&amp;"), "<", "&lt;");
  return replaced(replaced(std::move(escaped), ">", "&gt;"), "\"", "&quot;");
}

/// In a comment, which ends at two hyphens.
std::string xml_comment(const std::string& text) {
  return fmt::format("<!-- {} -->", replaced(replaced(text, "--", "- -"), "--", "- -"));
}

std::string yaml_text(const std::string& text) {
  std::string yaml = to_yaml(detail::write_value(text));
  yaml.pop_back();  // the end of its line
  return yaml;
}

std::string colour(const Eigen::Vector3f& c) {
  return fmt::format("{:.2f} {:.2f} {:.2f} 1", c.x(), c.y(), c.z());
}

std::string box_geom(const BoxShape& shape) {
  const Eigen::Isometry3d& T = shape.box.T_mesh_box;
  std::string turn;
  if (!T.linear().isIdentity(1e-6)) {
    const Eigen::Quaterniond q(T.linear());
    turn = fmt::format(" quat=\"{} {} {} {}\"", number(q.w()), number(q.x()), number(q.y()),
                       number(q.z()));
  }
  return fmt::format("      <geom type=\"box\" pos=\"{}\" size=\"{}\"{} rgba=\"{}\"/>\n",
                     numbers(T.translation()), numbers(shape.box.half_m), turn,
                     colour(shape.colour));
}

std::string hull_assets(const BuildingScene& scene) {
  std::string text;
  for (std::size_t i = 0; i < scene.hulls.size(); ++i) {
    text += fmt::format("    <mesh name=\"hull_{}\" vertex=\"", i);
    for (const Eigen::Vector3d& p_m : scene.hulls[i].corners_m) text += numbers(p_m) + "  ";
    text += "\"/>\n";
  }
  return text.empty() ? text : "  <asset>\n" + text + "  </asset>\n";
}

double rounded_up(double value, double step) { return step * std::ceil(value / step - 1e-9); }

/// More than an exploration needs that ends by itself.
int scans_for(const BuildingMap& map) {
  constexpr double kMostScans = 10000.0;
  return static_cast<int>(std::lround(std::clamp(0.4 * map.size_m.prod(), 20.0, kMostScans)));
}

/// Where the finer map of the floor would have too many cells of the usual size: from 136 m on.
std::optional<double> larger_floor_cell_m(const BuildingMap& map) {
  const double parts = FloorDetailOptions{}.parts;
  const double most_cells = std::floor(std::sqrt(kMaxFloorCells) / parts);
  const double cell_m = rounded_up(2.0 * map.half_size_m / most_cells, 0.005);
  return cell_m > FloorMapOptions{}.cell_m ? std::optional(cell_m) : std::nullopt;
}

}  // namespace

BuildingMap map_of(const BuildingScene& scene) {
  constexpr double kMargin_m = 0.25;
  constexpr double kLarge_m2 = 250.0;  // layers of 3 cm below, of 6 cm above
  constexpr double kMostColumns = 70000.0;
  constexpr double kFinest_m = 0.0584;  // as in our small offices
  constexpr double kCoarsest_m = 0.1;   // unless the grid would be too large for that
  constexpr double kMostCells = 67108864.0;
  BuildingMap map;
  for (int axis = 0; axis < 2; ++axis) {
    map.size_m[axis] = rounded_up(scene.extent_m.sizes()[axis] + kMargin_m, 0.5);
  }
  const double area_m2 = map.size_m.prod();
  const int layers = area_m2 <= kLarge_m2 ? 65 : 33;
  const double cell_m =
      std::max(std::clamp(std::sqrt(area_m2 / kMostColumns), kFinest_m, kCoarsest_m),
               std::sqrt(area_m2 * layers / kMostCells));
  const Eigen::Array2d columns = (map.size_m.array() / cell_m).ceil();
  map.cells = {static_cast<int>(columns.x()), static_cast<int>(columns.y()), layers};
  map.half_size_m = rounded_up(0.5 * map.size_m.maxCoeff() + kMargin_m, 0.5);
  return map;
}

std::string to_mjcf(const BuildingScene& scene, const std::string& name,
                    const std::string& made_by) {
  const Pose2& start = scene.floor.start;
  std::string text =
      fmt::format("{}\n<mujoco model=\"{}\">\n{}{}  <worldbody>\n{}", xml_comment(made_by),
                  xml_escaped(name), kHead, hull_assets(scene), kLights);
  text += fmt::format(
      "    <site name=\"start_0\" pos=\"{} {} 0\" euler=\"0 0 {}\" size=\"0.05\" group=\"4\"/>\n",
      number(start.x_m), number(start.y_m), number(start.yaw_rad));
  text += "    <body name=\"building\" childclass=\"still\">\n";
  if (scene.laid_floor) {
    text += fmt::format(
        "      <geom type=\"plane\" size=\"{} {} 0.1\" rgba=\"0.55 0.53 0.50 1\"/>\n",
        number(scene.extent_m.sizes().x() + 2.0), number(scene.extent_m.sizes().y() + 2.0));
  }
  for (const BoxShape& shape : scene.boxes) text += box_geom(shape);
  for (std::size_t i = 0; i < scene.hulls.size(); ++i) {
    text += fmt::format("      <geom type=\"mesh\" mesh=\"hull_{}\" rgba=\"{}\"/>\n", i,
                        colour(scene.hulls[i].colour));
  }
  for (const BoxShape& shape : scene.cell_boxes) text += box_geom(shape);
  return text + "    </body>\n  </worldbody>\n</mujoco>\n";
}

std::vector<std::string> episode_overrides(const BuildingScene& scene) {
  const BuildingMap map = map_of(scene);
  std::vector<std::string> keys{
      fmt::format("scans={}", scans_for(map)),
      fmt::format("map.size_m=[{}, {}, 2]", number(map.size_m.x()), number(map.size_m.y())),
      fmt::format("map.cells=[{}, {}, {}]", map.cells.x(), map.cells.y(), map.cells.z()),
      fmt::format("floor_map.half_size_m={}", number(map.half_size_m))};
  if (const auto cell_m = larger_floor_cell_m(map)) {
    keys.push_back("floor_map.cell_m=" + number(*cell_m));
  }
  return keys;
}

std::string to_episode(const BuildingScene& scene, const std::string& scene_file) {
  const BuildingMap map = map_of(scene);
  const auto cell_m = larger_floor_cell_m(map);
  return fmt::format(
      R"(# A PR2-like robot explores {0}. As the small office's episode but for scene, scans and map.
task: exploration
scene: {0}
scans: {1}
robot: {{start_site: start_0}}
map: {{centre_m: [0, 0, 1], size_m: [{2}, {3}, 2], cells: [{4}, {5}, {6}]}}
base_scanner: {{step_rad: 0.004363323129985824, range_max_m: 30}}    # 0.25 deg, and the far walls in sight
registration: {{normals: {{radius_m: 0.25}}}}
floor_map: {{half_size_m: {7}{8}}}
simulation: {{timestep_s: 0.005}}    # nothing is touched
forecast: {{calibrate: true}}
gain: adaptive
choice: greedy
)",
      yaml_text(scene_file), scans_for(map), number(map.size_m.x()), number(map.size_m.y()),
      map.cells.x(), map.cells.y(), map.cells.z(), number(map.half_size_m),
      cell_m ? ", cell_m: " + number(*cell_m) : "");
}

}  // namespace vantage
