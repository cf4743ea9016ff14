#include "vantage/tasks/object_flight/object_on_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "vantage/tasks/flight/full_turn.hpp"
#include "vantage/tasks/flight/object_mjcf.hpp"

namespace vantage {
namespace {

constexpr std::string_view kNothing = R"(<mujoco>
  <worldbody>
    <body name="object"/>
  </worldbody>
</mujoco>
)";

}  // namespace

std::vector<ObjectName> known_objects(const ObjectFlight& task) {
  return object_names(dataset_of(task.database));
}

const ObjectName& named_or_drawn(const std::vector<ObjectName>& names, const std::string& object,
                                 const char* key, Rng stream) {
  if (object.empty()) return names[stream.uniform_index(names.size())];
  const auto found = std::ranges::find(names, object, &ObjectName::object);
  if (found != names.end()) return *found;
  throw ConfigError(fmt::format("{}: '{}' is none of the {} objects from {} to {}", key, object,
                                names.size(), names.front().object, names.back().object));
}

double drawn_yaw_rad(std::uint64_t seed, const char* stream) {
  return Rng::stream(seed, stream).uniform(0.0, kTurn_rad);
}

Eigen::Vector2d drawn_offset_m(std::uint64_t seed, double placement_m) {
  Rng place = Rng::stream(seed, "object place");
  const double heading = place.uniform(0.0, kTurn_rad);
  const double distance_m = placement_m * std::sqrt(place.uniform());
  return distance_m * Eigen::Vector2d(std::cos(heading), std::sin(heading));
}

double wrap_turn(double angle_rad) {
  return angle_rad - kTurn_rad * std::floor(angle_rad / kTurn_rad);
}

std::string body_of_target(std::size_t i) {
  return i == 0 ? "object" : fmt::format("object_{}", i);
}

std::vector<MemoryFile> object_files(const ObjectFlight& task, const ObjectOnTable& object) {
  if (object.object.empty()) return {{"object.xml", std::string(kNothing)}};
  const NamedObject named{body_of_target(0), object};
  return object_files(task, {&named, 1}, "");
}

std::vector<MemoryFile> object_files(const ObjectFlight& task, std::span<const NamedObject> objects,
                                     const std::string& more_bodies) {
  std::vector<MemoryFile> files(1);
  std::string assets;
  std::string bodies;
  for (const auto& [name, object] : objects) {
    const TurntableObject made =
        make_turntable_object(dataset_of(task.database), {object.category, object.object});
    const Eigen::Vector3d p_world_m =
        task.p_world_table_m() + Eigen::Vector3d(object.offset_m.x(), object.offset_m.y(), 0.0);
    const ObjectMjcf mjcf = object_mjcf(name, made, {p_world_m, object.yaw_rad});
    assets += mjcf.assets;
    bodies += mjcf.body;
    files.push_back({name + ".obj", made.obj});
    files.push_back({name + ".png", made.png});
  }
  files.front() = {"object.xml", mjcf_file(assets, bodies + more_bodies)};
  return files;
}

}  // namespace vantage
