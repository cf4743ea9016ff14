#include "vantage/tasks/model_source.hpp"

#include "vantage/tasks/recognition/object_on_table.hpp"
#include "vantage/tasks/trajectory/flight_layout.hpp"

namespace vantage {

ModelSource model_source(const ResolvedEpisode& resolved) {
  ModelSource source{resolved.scene, resolved.robot};
  if (resolved.episode.flies_trajectory()) {
    source.files =
        object_files(resolved.episode.trajectory.database, draw_flight_objects(resolved));
  } else if (resolved.episode.flies()) {
    source.files = object_files(resolved.episode, draw_object_on_table(resolved.episode));
  }
  return source;
}

std::vector<ObjectOnSupport> draw_flight_objects(const ResolvedEpisode& resolved) {
  const TrajectoryTask& task = resolved.episode.trajectory;
  return draw_objects(task.database, read_flight_layout(resolved.scene).supports_m,
                      task.placement_m, resolved.episode.seed);
}

}  // namespace vantage
