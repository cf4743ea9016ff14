/// What stands on the table when it is to be recognised. For the scene and for evaluators alone.
#pragma once

#include "vantage/tasks/object_flight/object_on_table.hpp"
#include "vantage/tasks/recognition/recognition_task.hpp"

namespace vantage {

/// Drawn by the seed, or `object`.
/// @throws ConfigError if `object` is none of the database's, InputError as known_objects().
ObjectOnTable draw_object(const RecognitionTask& task, std::uint64_t seed);

}  // namespace vantage
