#include "vantage/tasks/recognition/object_on_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vantage/tasks/flight/object_mjcf.hpp"

namespace vantage {
namespace {

constexpr std::string_view kNothing = R"(<mujoco>
  <worldbody>
    <body name="object"/>
  </worldbody>
</mujoco>
)";

constexpr double kTurn_rad = 2.0 * std::numbers::pi;

/// The one of that name, or if that is empty one drawn from the stream.
const ObjectName& named_or_drawn(const std::vector<ObjectName>& names, const std::string& object,
                                 const char* key, Rng stream) {
  if (object.empty()) return names[stream.uniform_index(names.size())];
  const auto found = std::ranges::find(names, object, &ObjectName::object);
  if (found != names.end()) return *found;
  throw ConfigError(fmt::format("{}: '{}' is none of the {} objects from {} to {}", key, object,
                                names.size(), names.front().object, names.back().object));
}

double drawn_yaw_rad(const Episode& episode, const char* stream) {
  return Rng::stream(episode.seed, stream).uniform(0.0, kTurn_rad);
}

Eigen::Vector2d drawn_offset_m(const Episode& episode) {
  Rng place = Rng::stream(episode.seed, "object place");
  const double heading = place.uniform(0.0, kTurn_rad);
  const double distance_m = episode.recognition.placement_m * std::sqrt(place.uniform());
  return distance_m * Eigen::Vector2d(std::cos(heading), std::sin(heading));
}

double wrap_turn(double angle_rad) {
  return angle_rad - kTurn_rad * std::floor(angle_rad / kTurn_rad);
}

/// Somehow else by more than half a yaw bin, as a map would tell it.
double turned_yaw_rad(const Episode& episode, double expected_rad) {
  constexpr double kMin_rad = std::numbers::pi / 8.0;
  Rng turn = Rng::stream(episode.seed, "object turned");
  const double turned_rad =
      episode.change_detection.turned_rad.value_or(turn.uniform(kMin_rad, kTurn_rad - kMin_rad));
  return wrap_turn(expected_rad + turned_rad);
}

ObjectOnTable another_object(const Episode& episode, std::vector<ObjectName> names,
                             const std::string& expected) {
  std::erase_if(names, [&](const ObjectName& name) { return name.object == expected; });
  if (names.empty()) {
    throw ConfigError("change_detection.scenario: object: the database has no other object");
  }
  const ObjectName& name = named_or_drawn(names, episode.recognition.object, "recognition.object",
                                          Rng::stream(episode.seed, "other object"));
  return {name.object, name.category, drawn_yaw_rad(episode, "other object yaw")};
}

}  // namespace

ObjectOnTable draw_object_on_table(const Episode& episode) {
  const RecognitionTask& task = episode.recognition;
  const std::vector<ObjectName> names = object_names(dataset_of(task.database));
  if (!episode.detects_change()) {
    const ObjectName& name = named_or_drawn(names, task.object, "recognition.object",
                                            Rng::stream(episode.seed, "object"));
    return {name.object, name.category, drawn_yaw_rad(episode, "object yaw"),
            drawn_offset_m(episode)};
  }
  ObjectOnTable there = draw_expected_object(episode);
  switch (change_named(episode.change_detection.scenario).value()) {
    case Change::none: break;
    case Change::object: there = another_object(episode, names, there.object); break;
    case Change::pose: there.yaw_rad = turned_yaw_rad(episode, there.yaw_rad); break;
    case Change::removed: return {};
  }
  there.offset_m = drawn_offset_m(episode);
  return there;
}

ObjectOnTable draw_expected_object(const Episode& episode) {
  const std::vector<ObjectName> names = object_names(dataset_of(episode.recognition.database));
  const ChangeDetectionTask& task = episode.change_detection;
  const ObjectName& name =
      named_or_drawn(names, task.expected_object, "change_detection.expected_object",
                     Rng::stream(episode.seed, "object"));
  const double yaw_rad = task.expected_yaw_rad.value_or(drawn_yaw_rad(episode, "object yaw"));
  return {name.object, name.category, wrap_turn(yaw_rad)};
}

std::vector<MemoryFile> object_files(const Episode& episode, const ObjectOnTable& object) {
  if (object.object.empty()) return {{"object.xml", std::string(kNothing)}};
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
