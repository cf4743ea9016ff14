/// An object of a database as part of a scene.
#pragma once

#include <string>

#include "vantage/dataset/object_source.hpp"
#include "vantage/tasks/flight/object_database_options.hpp"

namespace vantage {

/// Where an object stands: below the middle of its box, yaw counter-clockwise seen from above.
struct ObjectPlace {
  Eigen::Vector3d p_world_m = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;
};

/// The parts of an MJCF file; a body and a geom called `name`, of the mesh `name`.obj with the
/// texture `name`.png.
struct ObjectMjcf {
  std::string assets;
  std::string body;
};
ObjectMjcf object_mjcf(const std::string& name, const TurntableObject& object,
                       const ObjectPlace& place);

/// MJCF of those parts.
std::string mjcf_file(const std::string& assets, const std::string& bodies);

DatasetOptions dataset_of(const ObjectDatabaseOptions& database);

}  // namespace vantage
