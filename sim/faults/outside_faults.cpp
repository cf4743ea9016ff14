#include "vantage/sim/faults/outside_faults.hpp"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/sim/faults/fault_schedule.hpp"

namespace vantage {
namespace {

constexpr double kReach_m = 0.5;

/// The body that the robot's others hang on; 0: there is none.
int robot_body(const mjModel& model) {
  for (int body = 1; body < model.nbody; ++body) {
    if (model_name(model, ModelObject::body, body).starts_with("robot/")) return body;
  }
  return 0;
}

/// To the world, and by its own pose: that of a mocap body is set elsewhere.
bool stands_fixed(const mjModel& model, int body) {
  return model.body_weldid[body] == 0 && model.body_mocapid[model.body_rootid[body]] < 0;
}

/// It has a shape, and all of that is near its origin.
bool is_small(const mjModel& model, int body) {
  const int first = model.body_geomadr[body];
  for (int geom = first; geom < first + model.body_geomnum[body]; ++geom) {
    const Eigen::Map<const Eigen::Vector3d> at(model.geom_pos + 3 * geom);
    const double reach_m = model.geom_rbound[geom];
    if (reach_m <= 0.0 || at.norm() + reach_m > kReach_m) return false;
  }
  return model.body_geomnum[body] > 0;
}

int drawn_object(const mjModel& model, Rng& draw) {
  std::vector<int> small;
  for (int body = 1; body < model.nbody; ++body) {
    if (model.body_parentid[body] == 0 && stands_fixed(model, body) && is_small(model, body)) {
      small.push_back(body);
    }
  }
  if (small.empty()) {
    throw ConfigError(
        "faults.moved_object: the scene has no body of its own within 0.5 m that could be moved: "
        "name one");
  }
  return small[draw.uniform_index(small.size())];
}

int named_object(const mjModel& model, const std::string& name) {
  const auto body = find_model_id(model, ModelObject::body, name);
  if (!body || *body == 0 || name.starts_with("robot/")) {
    throw ConfigError(fmt::format("faults.moved_object: the scene has no body '{}'", name));
  }
  if (!stands_fixed(model, *body)) {
    throw ConfigError(
        fmt::format("faults.moved_object: '{}' hangs on joints or is a mocap body: one that stands "
                    "fixed is moved",
                    name));
  }
  return *body;
}

}  // namespace

std::optional<MovedObject> moved_object(const World& world, const FaultOptions& options,
                                        std::uint64_t seed) {
  if (options.moved_object_m == 0.0) return std::nullopt;
  const mjModel& model = world.model();
  Rng draw = Rng::stream(seed, "fault moved object");
  const double heading_rad = draw.uniform(0.0, 2.0 * std::numbers::pi);
  MovedObject moved;
  moved.body_id = options.moved_object.empty() ? drawn_object(model, draw)
                                               : named_object(model, options.moved_object);
  moved.from_m = Eigen::Map<const Eigen::Vector3d>(model.body_pos + 3 * moved.body_id);
  moved.to_m = moved.from_m + options.moved_object_m * Eigen::Vector3d(std::cos(heading_rad),
                                                                       std::sin(heading_rad), 0.0);
  return moved;
}

void add_outside_faults(World& world, const FaultOptions& options, std::uint64_t seed) {
  if (options.gust_N > 0.0) {
    const Gusts gusts(seed, options.gust_N, options.gust_every_s, options.gust_duration_s);
    world.add_outside_force({robot_body(world.model()),
                             [gusts](double time_s) { return gusts.force_world_N(time_s); }});
  }
  if (const auto moved = moved_object(world, options, seed)) {
    const double at_s = options.moved_object_at_s;
    world.on_clock = [moved, at_s](World& at) {
      const bool is_there = at.time_s() >= at_s - kSameMoment_s;
      at.put_fixed_body(moved->body_id, is_there ? moved->to_m : moved->from_m);
    };
  }
}

}  // namespace vantage
