#include "src/episode/model_source.hpp"

#include "src/episode/object_on_table.hpp"

namespace vantage {

ModelSource model_source(const ResolvedEpisode& resolved) {
  ModelSource source{resolved.scene, resolved.robot};
  if (!resolved.episode.flies()) return source;
  source.files = object_files(resolved.episode, draw_object_on_table(resolved.episode));
  return source;
}

}  // namespace vantage
