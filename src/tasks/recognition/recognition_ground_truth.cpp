#include "vantage/tasks/recognition/recognition_ground_truth.hpp"

namespace vantage {

ObjectOnTable draw_object(const RecognitionTask& task, std::uint64_t seed) {
  const std::vector<ObjectName> names = known_objects(task);
  const ObjectName& name =
      named_or_drawn(names, task.object, "object", Rng::stream(seed, "object"));
  return {name.object, name.category, drawn_yaw_rad(seed, "object yaw"),
          drawn_offset_m(seed, task.placement_m)};
}

}  // namespace vantage
