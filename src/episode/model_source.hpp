/// The files that an episode's world is compiled from.
#pragma once

#include "sim/scene.hpp"
#include "src/episode/scenario.hpp"

namespace vantage {

/// Scene and robot, and in recognition the object that stands on the table.
/// @throws as draw_object_on_table() and object_files()
ModelSource model_source(const ResolvedEpisode& resolved);

}  // namespace vantage
