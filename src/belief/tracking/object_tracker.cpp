#include "vantage/belief/tracking/object_tracker.hpp"

#include <algorithm>
#include <limits>

namespace vantage {
namespace {

double level_distance_m(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return (a - b).head<2>().norm();
}

/// Weighted mean of two, over what either was measured with.
void join(TrackedObject& object, const TrackedObject& more) {
  const double share = more.weight / (object.weight + more.weight);
  object.p_world_object_m += share * (more.p_world_object_m - object.p_world_object_m);
  object.support_z_m += share * (more.support_z_m - object.support_z_m);
  object.radius_m += share * (more.radius_m - object.radius_m);
  object.height_m += share * (more.height_m - object.height_m);
  object.weight += more.weight;
  object.detections += more.detections;
  object.whole_detections += more.whole_detections;
  object.confirmed = object.confirmed || more.confirmed;
}

/// Errors of depth grow with its square, so their variance with its fourth power; below a metre
/// other errors outweigh them.
double weight_of(const ObjectDetection& detection, double partial_weight) {
  const double d2 = std::max(1.0, detection.distance_m * detection.distance_m);
  return (detection.whole ? 1.0 : partial_weight) / (d2 * d2);
}

}  // namespace

ObjectTracker::ObjectTracker(const ObjectTrackerOptions& options) : options_(options) {
  check_options(options_, "object tracker");
}

std::vector<int> ObjectTracker::update(std::span<const ObjectDetection> detections) {
  std::vector<int> ids;
  for (const ObjectDetection& detection : detections) {
    TrackedObject seen{.p_world_object_m = detection.p_world_object_m,
                       .support_z_m = detection.support_z_m,
                       .radius_m = detection.radius_m,
                       .height_m = detection.height_m,
                       .detections = 1,
                       .whole_detections = detection.whole ? 1 : 0,
                       .weight = weight_of(detection, options_.partial_weight),
                       .confirmed = options_.min_detections == 1};
    ids.push_back(take(std::move(seen)));
  }
  merge_neighbours(ids);
  return ids;
}

int ObjectTracker::take(TrackedObject seen) {
  TrackedObject* nearest = nullptr;
  double min_m = options_.gate_m;
  for (TrackedObject& object : objects_) {
    const double off_m = level_distance_m(object.p_world_object_m, seen.p_world_object_m);
    if (off_m < min_m) {
      min_m = off_m;
      nearest = &object;
    }
  }
  if (nearest == nullptr) {
    seen.id = next_id_++;
    objects_.push_back(seen);
    return seen.id;
  }
  join(*nearest, seen);
  confirm(*nearest);
  return nearest->id;
}

std::optional<std::pair<std::size_t, std::size_t>> ObjectTracker::neighbours() const {
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    for (std::size_t j = objects_.size(); --j > i;) {
      const double off_m =
          level_distance_m(objects_[i].p_world_object_m, objects_[j].p_world_object_m);
      if (off_m <= 0.5 * options_.gate_m) return std::pair(i, j);
    }
  }
  return std::nullopt;
}

/// Two that their means have brought together were one, cut differently by the frame. The one that
/// is confirmed stays, since it may have been looked at; of two such the first.
void ObjectTracker::merge_neighbours(std::vector<int>& ids) {
  while (const auto pair = neighbours()) {
    auto [kept, gone] = *pair;
    if (objects_[gone].confirmed && !objects_[kept].confirmed) std::swap(kept, gone);
    std::ranges::replace(ids, objects_[gone].id, objects_[kept].id);
    join(objects_[kept], objects_[gone]);
    confirm(objects_[kept]);
    objects_.erase(objects_.begin() + static_cast<std::ptrdiff_t>(gone));
  }
}

void ObjectTracker::confirm(TrackedObject& object) const {
  object.confirmed = object.confirmed || object.detections >= options_.min_detections;
}

std::vector<TrackedObject> ObjectTracker::confirmed() const {
  std::vector<TrackedObject> sure;
  std::ranges::copy_if(objects_, std::back_inserter(sure), &TrackedObject::confirmed);
  return sure;
}

const TrackedObject* ObjectTracker::find(int id) const {
  const auto found = std::ranges::find(objects_, id, &TrackedObject::id);
  return found == objects_.end() ? nullptr : &*found;
}

}  // namespace vantage
