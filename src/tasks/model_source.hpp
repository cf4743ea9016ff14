/// The files that an episode's world is compiled from.
#pragma once

#include <vector>

#include "vantage/sim/world/scene.hpp"
#include "vantage/tasks/scenario.hpp"
#include "vantage/tasks/trajectory/objects_on_supports.hpp"

namespace vantage {

/// Scene and robot, and the objects that are drawn by the seed: in recognition what stands on the
/// table, in trajectory flight what stands on the stands.
/// @throws as draw_object_on_table(), draw_flight_objects() and object_files()
ModelSource model_source(const ResolvedEpisode& resolved);

/// What stands about in a trajectory flight. Truth: for the scene and the metrics.
/// @throws InputError as read_flight_layout(), and as draw_objects()
std::vector<ObjectOnSupport> draw_flight_objects(const ResolvedEpisode& resolved);

}  // namespace vantage
