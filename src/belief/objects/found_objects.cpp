#include "vantage/belief/objects/found_objects.hpp"

#include <algorithm>
#include <limits>

namespace vantage {
namespace {

double level_distance_m(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return (a - b).head<2>().norm();
}

/// Weighted mean of two, over what either was measured with.
void join(FoundObject& object, const FoundObject& more) {
  const double share = more.weight / (object.weight + more.weight);
  object.p_world_object_m += share * (more.p_world_object_m - object.p_world_object_m);
  object.support_z_m += share * (more.support_z_m - object.support_z_m);
  object.radius_m += share * (more.radius_m - object.radius_m);
  object.height_m += share * (more.height_m - object.height_m);
  object.weight += more.weight;
  object.sightings += more.sightings;
  object.whole_sightings += more.whole_sightings;
  object.confirmed = object.confirmed || more.confirmed;
}

/// Errors of depth grow with its square, so their variance with its fourth power; below a metre
/// other errors outweigh them.
double weight_of(const ObjectSighting& sighting, double partial_weight) {
  const double d2 = std::max(1.0, sighting.distance_m * sighting.distance_m);
  return (sighting.whole ? 1.0 : partial_weight) / (d2 * d2);
}

}  // namespace

FoundObjects::FoundObjects(const FoundObjectsOptions& options) : options_(options) {
  check_options(options_, "found objects");
}

std::vector<int> FoundObjects::update(std::span<const ObjectSighting> sightings) {
  std::vector<int> ids;
  for (const ObjectSighting& sighting : sightings) {
    FoundObject seen{.p_world_object_m = sighting.p_world_object_m,
                     .support_z_m = sighting.support_z_m,
                     .radius_m = sighting.radius_m,
                     .height_m = sighting.height_m,
                     .sightings = 1,
                     .whole_sightings = sighting.whole ? 1 : 0,
                     .weight = weight_of(sighting, options_.partial_weight),
                     .confirmed = options_.min_sightings == 1};
    ids.push_back(take(std::move(seen)));
  }
  merge_neighbours(ids);
  return ids;
}

int FoundObjects::take(FoundObject seen) {
  FoundObject* nearest = nullptr;
  double least_m = options_.gate_m;
  for (FoundObject& object : objects_) {
    const double off_m = level_distance_m(object.p_world_object_m, seen.p_world_object_m);
    if (off_m < least_m) {
      least_m = off_m;
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

std::optional<std::pair<std::size_t, std::size_t>> FoundObjects::neighbours() const {
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
void FoundObjects::merge_neighbours(std::vector<int>& ids) {
  while (const auto pair = neighbours()) {
    auto [kept, gone] = *pair;
    if (objects_[gone].confirmed && !objects_[kept].confirmed) std::swap(kept, gone);
    std::ranges::replace(ids, objects_[gone].id, objects_[kept].id);
    join(objects_[kept], objects_[gone]);
    confirm(objects_[kept]);
    objects_.erase(objects_.begin() + static_cast<std::ptrdiff_t>(gone));
  }
}

void FoundObjects::confirm(FoundObject& object) const {
  object.confirmed = object.confirmed || object.sightings >= options_.min_sightings;
}

std::vector<FoundObject> FoundObjects::confirmed() const {
  std::vector<FoundObject> sure;
  std::ranges::copy_if(objects_, std::back_inserter(sure), &FoundObject::confirmed);
  return sure;
}

const FoundObject* FoundObjects::find(int id) const {
  const auto found = std::ranges::find(objects_, id, &FoundObject::id);
  return found == objects_.end() ? nullptr : &*found;
}

}  // namespace vantage
