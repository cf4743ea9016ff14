#include "src/episode/object_on_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/dataset/object_source.hpp"

namespace vantage {
namespace {

constexpr std::string_view kObject = R"(<mujoco>
  <asset>
    <mesh name="object" file="object.obj"/>
    <texture name="object" type="2d" file="object.png"/>
    <material name="object" texture="object" specular="{specular}" shininess="{shininess}"/>
  </asset>
  <worldbody>
    <body name="object" pos="{x} {y} {z}" quat="{qw} 0 0 {qz}">
      <geom name="object" type="mesh" mesh="object" material="object" pos="{at_x} {at_y} {at_z}"/>
    </body>
  </worldbody>
</mujoco>
)";

DatasetOptions dataset_of(const ObjectDatabaseOptions& database) {
  DatasetOptions options;
  options.seed = database.seed;
  options.objects = database.objects;
  options.models = database.models;
  return options;
}

const ObjectName& named(const std::vector<ObjectName>& names, const std::string& object) {
  const auto found = std::ranges::find(names, object, &ObjectName::object);
  if (found != names.end()) return *found;
  throw ConfigError(fmt::format("recognition.object: '{}' is none of the {} objects from {} to {}",
                                object, names.size(), names.front().object, names.back().object));
}

}  // namespace

ObjectOnTable draw_object_on_table(const Episode& episode) {
  const RecognitionTask& task = episode.recognition;
  const std::vector<ObjectName> names = object_names(dataset_of(task.database));
  Rng which = Rng::stream(episode.seed, "object");
  const ObjectName& name =
      task.object.empty() ? names[which.uniform_index(names.size())] : named(names, task.object);
  Rng yaw = Rng::stream(episode.seed, "object yaw");
  Rng place = Rng::stream(episode.seed, "object place");
  const double heading = place.uniform(0.0, 2.0 * std::numbers::pi);
  const double distance_m = task.placement_m * std::sqrt(place.uniform());
  return {name.object, name.category, yaw.uniform(0.0, 2.0 * std::numbers::pi),
          distance_m * Eigen::Vector2d(std::cos(heading), std::sin(heading))};
}

std::vector<MemoryFile> object_files(const Episode& episode, const ObjectOnTable& object) {
  const RecognitionTask& task = episode.recognition;
  const TurntableObject made =
      make_turntable_object(dataset_of(task.database), {object.category, object.object});
  const Eigen::Vector3d middle = made.box_m.center();
  using namespace fmt::literals;
  const std::string mjcf =
      fmt::format(kObject, "specular"_a = made.specular, "shininess"_a = 0.3 + 0.5 * made.specular,
                  "x"_a = task.table_m[0] + object.offset_m.x(),
                  "y"_a = task.table_m[1] + object.offset_m.y(), "z"_a = task.table_m[2],
                  "qw"_a = std::cos(0.5 * object.yaw_rad), "qz"_a = std::sin(0.5 * object.yaw_rad),
                  "at_x"_a = -middle.x(), "at_y"_a = -middle.y(), "at_z"_a = -made.box_m.min().z());
  return {{"object.xml", mjcf}, {"object.obj", made.obj}, {"object.png", made.png}};
}

}  // namespace vantage
