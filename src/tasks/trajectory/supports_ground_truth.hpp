/// The objects on the support surfaces of a scene to fly through. Ground truth: for the scene and
/// the metrics.
#pragma once

#include <Eigen/Core>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "vantage/sim/world/model_source.hpp"
#include "vantage/tasks/flight/object_database_options.hpp"

namespace vantage {

class World;

struct ObjectOnSupport {
  std::string object;    ///< "mug_3"
  std::string category;  ///< "mug"
  double yaw_rad = 0.0;  ///< counter-clockwise seen from above, world, [0, 2 pi)
  Eigen::Vector3d p_world_m =
      Eigen::Vector3d::Zero();  ///< below its middle, on the support surface
};

/// The middles of the support surfaces' tops, world, of stands.csv beside `scene`. Not known to
/// the vehicle.
/// @throws InputError naming file, line and column if it is missing, malformed or has no row.
std::vector<Eigen::Vector3d> read_support_surfaces(const std::filesystem::path& scene);

/// A different object of the database for each support surface, yaw and place on it, by `seed`.
/// @param placement_m largest offset from the middle of the surface
/// @throws ConfigError if there are more support surfaces than objects, InputError as
/// object_names().
std::vector<ObjectOnSupport> draw_objects(const ObjectDatabaseOptions& database,
                                          std::span<const Eigen::Vector3d> supports_m,
                                          double placement_m, std::uint64_t seed);

/// The files that put them there: objects.xml, which the scene includes, with meshes and textures.
/// Bodies and geoms are called object_0, object_1 ... in the order given.
/// @throws InputError as make_turntable_object()
std::vector<MemoryFile> object_files(const ObjectDatabaseOptions& database,
                                     std::span<const ObjectOnSupport> objects);

/// Where they stand by now: a fault may have moved one.
void follow_moved(const World& world, std::span<ObjectOnSupport> objects);

struct TrajectoryFlight;
struct EpisodeSetup;

/// What stands about in a flight.
/// @throws as read_support_surfaces() and draw_objects()
std::vector<ObjectOnSupport> draw_flight_objects(const TrajectoryFlight& task,
                                                 const EpisodeSetup& setup);

}  // namespace vantage
