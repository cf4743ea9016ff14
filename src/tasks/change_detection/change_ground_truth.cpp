#include "vantage/tasks/change_detection/change_ground_truth.hpp"

#include <fmt/format.h>

#include <numbers>
#include <utility>

namespace vantage {
namespace {

/// Somehow else by more than half an eighth of a turn, as a map would tell it.
double turned_yaw_rad(const ChangeDetectionTask& task, std::uint64_t seed, double expected_rad) {
  constexpr double kMin_rad = std::numbers::pi / 8.0;
  Rng turn = Rng::stream(seed, "object turned");
  const double turned_rad =
      task.turned_rad.value_or(turn.uniform(kMin_rad, 2.0 * std::numbers::pi - kMin_rad));
  return wrap_turn(expected_rad + turned_rad);
}

ObjectOnTable another_object(const ChangeDetectionTask& task, std::uint64_t seed,
                             std::vector<ObjectName> names, const std::string& expected) {
  if (task.object == expected) {
    throw ConfigError(fmt::format(
        "object: '{}' is what is expected there, so nothing would change; say expected_object, or "
        "take another seed",
        expected));
  }
  std::erase_if(names, [&](const ObjectName& name) { return name.object == expected; });
  if (names.empty()) throw ConfigError("scenario: object: the database has no other object");
  const ObjectName& name =
      named_or_drawn(names, task.object, "object", Rng::stream(seed, "other object"));
  return {name.object, name.category, drawn_yaw_rad(seed, "other object yaw")};
}

}  // namespace

ObjectOnTable draw_object(const ChangeDetectionTask& task, std::uint64_t seed) {
  ObjectOnTable there = draw_expected_object(task, seed);
  switch (change_named(task.scenario).value()) {
    case Change::none: break;
    case Change::object:
      there = another_object(task, seed, known_objects(task), there.object);
      break;
    case Change::pose: there.yaw_rad = turned_yaw_rad(task, seed, there.yaw_rad); break;
    case Change::removed: return {};
  }
  there.offset_m = drawn_offset_m(seed, task.placement_m);
  return there;
}

}  // namespace vantage
