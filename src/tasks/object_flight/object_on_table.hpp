/// What may stand on the table, and how it gets there.
#pragma once

#include <Eigen/Core>

#include <span>
#include <string>
#include <vector>

#include "vantage/dataset/object_source.hpp"
#include "vantage/sim/world/model_source.hpp"
#include "vantage/tasks/object_flight/object_flight.hpp"

namespace vantage {

struct ObjectOnTable {
  std::string object;    ///< "mug_3"; empty: there is nothing
  std::string category;  ///< "mug"
  double yaw_rad = 0.0;  ///< counter-clockwise seen from above, world, [0, 2 pi)
  Eigen::Vector2d offset_m = Eigen::Vector2d::Zero();  ///< from the table's middle
  Eigen::Vector2d told_m = Eigen::Vector2d::Zero();    ///< the same, as the robot is told
};

/// The objects of the database. @throws InputError as object_names()
std::vector<ObjectName> known_objects(const ObjectFlight& task);

/// The one of that name, or if that is empty one drawn from the stream.
/// @throws ConfigError naming `key` if there is none of that name.
const ObjectName& named_or_drawn(const std::vector<ObjectName>& names, const std::string& object,
                                 const char* key, Rng stream);

/// Each property is drawn from a stream of its own, so that naming one leaves the others.
double drawn_yaw_rad(std::uint64_t seed, const char* stream);
Eigen::Vector2d drawn_offset_m(std::uint64_t seed, double placement_m);
double wrap_turn(double angle_rad);  ///< to [0, 2 pi)

/// An object under the name of its body and geom.
struct NamedObject {
  std::string name;
  ObjectOnTable object;
};

/// The name of the body of the i-th object that is looked at.
std::string body_of_target(std::size_t i);

/// The files that put it there: object.xml, which the scene includes, with its mesh and texture.
/// @throws InputError as make_turntable_object()
std::vector<MemoryFile> object_files(const ObjectFlight& task, const ObjectOnTable& object);
/// The same for several.
/// @param more_bodies MJCF, put beside them
std::vector<MemoryFile> object_files(const ObjectFlight& task, std::span<const NamedObject> objects,
                                     const std::string& more_bodies);

}  // namespace vantage
