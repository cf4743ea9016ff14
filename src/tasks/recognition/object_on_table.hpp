/// What stands on the table in an episode of recognition. Truth: for the scene and the metrics.
#pragma once

#include <string>
#include <vector>

#include "vantage/sim/world/scene.hpp"
#include "vantage/tasks/scenario.hpp"

namespace vantage {

struct ObjectOnTable {
  std::string object;    ///< "mug_3"; empty: there is nothing
  std::string category;  ///< "mug"
  double yaw_rad = 0.0;  ///< counter-clockwise seen from above, world, [0, 2 pi)
  Eigen::Vector2d offset_m = Eigen::Vector2d::Zero();  ///< from the table's middle
};

/// By the episode's seed: each property from a stream of its own, so that naming the object leaves
/// it where it was. If the task is to detect a change, what the scenario has made of what was
/// expected.
/// @throws ConfigError if `recognition.object` is none of the database's, InputError as
/// object_names().
ObjectOnTable draw_object_on_table(const Episode& episode);

/// What the map says, where the task is to detect a change: it stands in the table's middle.
/// @throws as draw_object_on_table()
ObjectOnTable draw_expected_object(const Episode& episode);

/// The files that put it there: object.xml, which the scene includes, with its mesh and texture.
/// @throws InputError as make_turntable_object()
std::vector<MemoryFile> object_files(const Episode& episode, const ObjectOnTable& object);

}  // namespace vantage
