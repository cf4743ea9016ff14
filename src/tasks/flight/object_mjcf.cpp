#include "vantage/tasks/flight/object_mjcf.hpp"

#include <fmt/format.h>

#include <cmath>

#include "vantage/core/data_root.hpp"

namespace vantage {
namespace {

constexpr std::string_view kAssets = R"(    <mesh name="{name}" file="{name}.obj"/>
    <texture name="{name}" type="2d" file="{name}.png"/>
    <material name="{name}" texture="{name}" specular="{specular}" shininess="{shininess}"/>
)";

constexpr std::string_view kBody =
    R"(    <body name="{name}" pos="{x} {y} {z}" quat="{qw} 0 0 {qz}">
      <geom name="{name}" type="mesh" mesh="{name}" material="{name}" pos="{at_x} {at_y} {at_z}"/>
    </body>
)";

}  // namespace

ObjectMjcf object_mjcf(const std::string& name, const TurntableObject& object,
                       const ObjectPlace& place) {
  using namespace fmt::literals;
  const Eigen::Vector3d middle = object.box_m.center();
  return {
      fmt::format(kAssets, "name"_a = name, "specular"_a = object.specular,
                  "shininess"_a = 0.3 + 0.5 * object.specular),
      fmt::format(kBody, "name"_a = name, "x"_a = place.p_world_m.x(), "y"_a = place.p_world_m.y(),
                  "z"_a = place.p_world_m.z(), "qw"_a = std::cos(0.5 * place.yaw_rad),
                  "qz"_a = std::sin(0.5 * place.yaw_rad), "at_x"_a = -middle.x(),
                  "at_y"_a = -middle.y(), "at_z"_a = -object.box_m.min().z())};
}

std::string mjcf_file(const std::string& assets, const std::string& bodies) {
  return fmt::format(
      "<mujoco>\n  <asset>\n{}  </asset>\n  <worldbody>\n{}  </worldbody>\n</mujoco>\n", assets,
      bodies);
}

DatasetOptions dataset_of(const ObjectDatabaseOptions& database) {
  DatasetOptions options;
  options.seed = database.seed;
  options.objects = database.objects;
  options.models = database.models;
  if (options.models.empty()) return options;
  options.models = find_input(database.models, {}, "database.models").string();
  return options;
}

}  // namespace vantage
