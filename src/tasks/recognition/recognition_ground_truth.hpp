/// What stands on the table when it is to be recognised. For the scene and for evaluators alone.
#pragma once

#include <string>
#include <vector>

#include "vantage/tasks/object_flight/object_on_table.hpp"
#include "vantage/tasks/recognition/recognition_task.hpp"
#include "vantage/tasks/recognition/table_obstacles.hpp"

namespace vantage {

/// Drawn by the seed, or `object`.
/// @throws ConfigError if `object` is none of the database's, InputError as known_objects().
ObjectOnTable draw_object(const RecognitionTask& task, std::uint64_t seed);

struct TableGroundTruth {
  std::vector<ObjectOnTable> targets;  ///< the first is that of draw_object(), but for its place
  std::vector<ObjectOnTable> others;   ///< that stand round them
  std::vector<Post> posts;
  std::vector<Screen> screens;  ///< of the first targets, in their order
};

/// All of them, no two nearer than `clutter.spacing_m`. What stands round the targets is drawn from
/// streams of its own: more of it moves none of the targets.
/// @throws ConfigError if the database has too few objects or the table no room for them; as
/// draw_object().
TableGroundTruth draw_table(const RecognitionTask& task, std::uint64_t seed);

/// The files that put it there, see object_files(). The targets are called object, object_1 ...
std::vector<MemoryFile> table_files(const RecognitionTask& task, const TableGroundTruth& table);

}  // namespace vantage
