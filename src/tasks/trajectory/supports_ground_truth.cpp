#include "vantage/tasks/trajectory/supports_ground_truth.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "vantage/planners/views/view_list.hpp"
#include "vantage/sim/world/world.hpp"
#include "vantage/tasks/flight/full_turn.hpp"
#include "vantage/tasks/flight/object_mjcf.hpp"
#include "vantage/tasks/trajectory/trajectory_flight.hpp"

namespace vantage {
namespace {

std::string body_of(std::size_t object) { return fmt::format("object_{}", object); }

}  // namespace

std::vector<Eigen::Vector3d> read_support_surfaces(const std::filesystem::path& scene) {
  std::vector<Eigen::Vector3d> tops_m;
  for (const Candidate& top : read_views(scene.parent_path() / "stands.csv")) {
    tops_m.emplace_back(top.T_world_sensor.translation());
  }
  return tops_m;
}

std::vector<ObjectOnSupport> draw_objects(const ObjectDatabaseOptions& database,
                                          std::span<const Eigen::Vector3d> supports_m,
                                          double placement_m, std::uint64_t seed) {
  std::vector<ObjectName> names = object_names(dataset_of(database));
  if (names.size() < supports_m.size()) {
    throw ConfigError(fmt::format("database.objects: {} objects for {} support surfaces",
                                  names.size(), supports_m.size()));
  }
  Rng which = Rng::stream(seed, "objects");
  Rng yaw = Rng::stream(seed, "object yaws");
  Rng place = Rng::stream(seed, "object places");
  std::vector<ObjectOnSupport> objects;
  for (std::size_t i = 0; i < supports_m.size(); ++i) {
    std::swap(names[i], names[i + which.uniform_index(names.size() - i)]);
    const double heading = place.uniform(0.0, kTurn_rad);
    const double distance_m = placement_m * std::sqrt(place.uniform());
    const Eigen::Vector3d offset_m(distance_m * std::cos(heading), distance_m * std::sin(heading),
                                   0.0);
    objects.push_back({names[i].object, names[i].category, yaw.uniform(0.0, kTurn_rad),
                       supports_m[i] + offset_m});
  }
  return objects;
}

std::vector<MemoryFile> object_files(const ObjectDatabaseOptions& database,
                                     std::span<const ObjectOnSupport> objects) {
  std::vector<MemoryFile> files(1);
  std::string assets;
  std::string bodies;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const ObjectOnSupport& object = objects[i];
    const TurntableObject made =
        make_turntable_object(dataset_of(database), {object.category, object.object});
    const std::string name = body_of(i);
    const ObjectMjcf mjcf = object_mjcf(name, made, {object.p_world_m, object.yaw_rad});
    assets += mjcf.assets;
    bodies += mjcf.body;
    files.push_back({name + ".obj", made.obj});
    files.push_back({name + ".png", made.png});
  }
  files.front() = {"objects.xml", mjcf_file(assets, bodies)};
  return files;
}

void follow_moved(const World& world, std::span<ObjectOnSupport> objects) {
  for (std::size_t i = 0; i < objects.size(); ++i) {
    objects[i].p_world_m += world.moved_m(body_of(i));
  }
}

std::vector<ObjectOnSupport> draw_flight_objects(const TrajectoryFlight& task,
                                                 const EpisodeSetup& setup) {
  return draw_objects(task.database, read_support_surfaces(setup.scene), task.placement_m,
                      setup.options.seed);
}

}  // namespace vantage
