#include "vantage/recognition/object_observations.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vantage {
namespace {

/// Share of the entropy that a first observation removes: two usually identify an object.
constexpr double kFirstObservation = 0.75;

/// From the object to the camera.
double bearing_from(const Eigen::Vector3d& p_world_object_m, const Pose& T_world_camera) {
  const Eigen::Vector3d d = T_world_camera.translation() - p_world_object_m;
  return std::atan2(d.y(), d.x());
}

int direction_from(const Eigen::Vector3d& p_world_object_m, const Pose& T_world_camera) {
  const ObservationRing ring{.p_world_object_m = p_world_object_m};
  return ring.direction_of(T_world_camera.translation());
}

}  // namespace

ObjectObservations::ObjectObservations(const Recogniser& recogniser,
                                       const ObservationOptions& options,
                                       const TransitionModel& transition)
    : recogniser_(recogniser), options_(options) {
  recognition_.all_features = true;
  recognition_.transition = transition;
}

const RecognisedObject* ObjectObservations::find(int id) const {
  const auto found = std::ranges::find(objects_, id, &RecognisedObject::id);
  return found == objects_.end() ? nullptr : &*found;
}

RecognisedObject& ObjectObservations::of(int id) {
  const auto found = std::ranges::find(objects_, id, &RecognisedObject::id);
  expects(found != objects_.end(), "an object that was found");
  return *found;
}

void ObjectObservations::found(int id, const Eigen::Vector3d& p_world_m) {
  if (find(id) == nullptr) {
    objects_.push_back(
        {.id = id, .p_world_m = p_world_m, .recognition = begin_recognition(recogniser_)});
    objects_.back().gain_nats = every_direction(kFirstObservation * entropy_nats(objects_.back()));
  }
  of(id).p_world_m = p_world_m;
}

void ObjectObservations::forget(int id) {
  std::erase_if(objects_, [id](const RecognisedObject& object) { return object.id == id; });
}

bool ObjectObservations::wants(int id, const ObjectDetection& detection,
                               const Pose& T_world_camera) const {
  const RecognisedObject* object = find(id);
  if (object == nullptr || !detection.whole || detection.distance_m > options_.range_m)
    return false;
  const double bearing_rad = bearing_from(object->p_world_m, T_world_camera);
  const auto direction =
      static_cast<std::size_t>(direction_from(object->p_world_m, T_world_camera));
  const bool hardly_another_side =
      std::ranges::any_of(object->observations, [&](const ObjectObservation& observation) {
        return std::abs(wrap_angle(bearing_rad - observation.bearing_rad)) < options_.apart_rad;
      });
  return !hardly_another_side && !object->used[direction] &&
         object->gain_nats[direction] >= options_.min_gain_nats &&
         (options_.observe_known || !known(*object));
}

int ObjectObservations::direction(int id, const Pose& T_world_camera) const {
  const RecognisedObject* object = find(id);
  expects(object != nullptr, "an object that was found");
  return direction_from(object->p_world_m, T_world_camera);
}

const ObjectObservation& ObjectObservations::take(int id, const ObjectDetection& detection,
                                                  const ObjectView& view,
                                                  const Pose& T_world_camera, double time_s,
                                                  Rng& rng) {
  RecognisedObject& object = of(id);
  const double bearing_rad = bearing_from(object.p_world_m, T_world_camera);
  if (!object.observations.empty()) {
    predict_motion(recogniser_, recognition_,
                   wrap_angle(bearing_rad - object.observations.back().bearing_rad),
                   object.recognition);
  }
  update_with_view(recogniser_, recognition_, extract_from(recogniser_, view), bearing_rad,
                   object.recognition, rng);
  const ObjectEstimate now = estimate(object);
  const Eigen::Vector3d up = T_world_camera.translation() - detection.p_world_object_m;
  ObjectObservation observation{.time_s = time_s,
                                .bearing_rad = bearing_rad,
                                .direction = direction_from(object.p_world_m, T_world_camera),
                                .distance_m = detection.distance_m,
                                .elevation_rad = std::atan2(up.z(), up.head<2>().norm()),
                                .pixels = detection.pixels,
                                .report = object.recognition.views.back(),
                                .entropy_nats = entropy_nats(object),
                                .estimate = now.object,
                                .map_probability = now.probability,
                                .unknown_probability = unknown_probability(object),
                                .T_world_camera = T_world_camera};
  object.used[static_cast<std::size_t>(observation.direction)] = true;
  object.observations.push_back(std::move(observation));
  object.gain_nats = gains_nats(object);
  ++total_;
  return object.observations.back();
}

std::array<double, kObservationDirections> ObjectObservations::gains_nats(
    const RecognisedObject& object) const {
  std::array<double, kObservationDirections> gains{};
  std::vector<ObjectViewAction> actions;
  for (int d = 0; d < kObservationDirections; ++d) {
    const double to_rad = d * 2.0 * std::numbers::pi / kObservationDirections;
    actions.push_back({.yaw_rad = wrap_angle(to_rad - object.observations.back().bearing_rad)});
  }
  Rng unused(0);  // the measure does not sample
  const NextView next = next_view(recogniser_, recognition_, object.recognition, actions, unused);
  for (std::size_t d = 0; d < gains.size(); ++d) {
    gains[d] = std::numbers::ln2 * std::max(0.0, next.decision.scores[d].gain.bits);
  }
  return gains;
}

double ObjectObservations::entropy_nats(const RecognisedObject& object) const {
  return std::numbers::ln2 * object_entropy_bits(recogniser_.states, object.recognition.belief);
}

bool ObjectObservations::known(const RecognisedObject& object) const {
  return entropy_nats(object) < options_.known_below_nats;
}

ObjectEstimate ObjectObservations::estimate(const RecognisedObject& object) const {
  return estimate_of(recogniser_.states, object.recognition.belief);
}

double ObjectObservations::unknown_probability(const RecognisedObject& object) const {
  return p_unknown(recogniser_.states, object.recognition.belief);
}

double ObjectObservations::prior_entropy_nats() const {
  const ObjectStates& states = recogniser_.states;
  if (states.unknown_size() == 0) return std::log(static_cast<double>(states.object_count()));
  return std::numbers::ln2 * object_entropy_bits(states, begin_recognition(recogniser_).belief);
}

}  // namespace vantage
