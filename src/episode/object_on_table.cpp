#include "src/episode/object_on_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/episode/object_mjcf.hpp"

namespace vantage {
namespace {

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
  const Eigen::Vector3d p_world_m(task.table_m[0] + object.offset_m.x(),
                                  task.table_m[1] + object.offset_m.y(), task.table_m[2]);
  const ObjectMjcf mjcf = object_mjcf("object", made, {p_world_m, object.yaw_rad});
  return {{"object.xml", mjcf_file(mjcf.assets, mjcf.body)},
          {"object.obj", made.obj},
          {"object.png", made.png}};
}

}  // namespace vantage
