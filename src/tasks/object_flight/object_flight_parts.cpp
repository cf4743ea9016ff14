#include "vantage/tasks/object_flight/object_flight_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "vantage/core/log.hpp"

namespace vantage {
namespace {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;

/// Of a view without an object in it.
ExtractFeature extract_nothing(const std::string& reason) {
  return [reason](std::size_t) { return ExtractedFeature{.result = FeatureResult::skip(reason)}; };
}

}  // namespace

ObjectFlightParts::ObjectFlightParts(const ObjectFlightContext& context, ObjectInquiry inquiry,
                                     double first_rad, Expectation expectation)
    : task_(context.task),
      recogniser_(context.recogniser),
      robot_(context.robot),
      evaluator_(context.evaluator),
      recorder_(context.recorder),
      inquiry_(std::move(inquiry)),
      first_rad_(first_rad),
      expectation_(std::move(expectation)),
      choice_rng_(Rng::stream(context.options.seed, "recognition")),
      segmentation_rng_(Rng::stream(context.options.seed, "segmentation")) {
  recorder_.set_panel([this] { return panel(); });
}

FlightObservation ObjectFlightParts::observe() {
  if (records_.empty() && robot_.bearing_rad() != first_rad_) {
    current_.flight = robot_.fly_to(first_rad_);
  }
  return robot_.observe();
}

void ObjectFlightParts::update(const FlightObservation& observation) {
  seen_ = segment_object(observation.images, observation.T_world_camera, task_.p_world_table_m(),
                         task_.segmentation, segmentation_rng_);
  camera_image_ = observation.images;
  const ExtractFeature extract =
      seen_.view ? extract_from(recogniser_, *seen_.view) : extract_nothing(seen_.reason);
  inquiry_.observe(extract, observation.bearing_rad, next_.time_s, choice_rng_);
  current_.T_world_camera = observation.T_world_camera;
  conclude();
}

/// What is believed now, beside the truth.
void ObjectFlightParts::conclude() {
  const ObjectStates& states = recogniser_.states;
  const ObjectBelief& belief = recognition().belief;
  const int object = most_probable_object(states, belief);
  current_.time_s = robot_.time_s();
  current_.report = recognition().views.back();
  if (inquiry_.of_change()) current_.change = {inquiry_.p_changed(), inquiry_.verdict()};
  current_.not_segmented = seen_.reason;
  current_.object_px = seen_.view ? static_cast<int>(std::ranges::count(seen_.view->mask, 1)) : 0;
  const ObjectEstimate estimate = estimate_of(states, belief);
  current_.estimate = estimate.object;
  current_.category = estimate.category;
  current_.map_probability = estimate.probability;
  current_.unknown_probability = p_unknown(states, belief);
  const int state = expected_state(states, belief);
  current_.estimated_bin = states.bin_of(state);
  evaluator_.measure(states, object, state, current_);
}

void ObjectFlightParts::record() {
  current_.path_length_m = recorder_.path_length_m();
  current_.leg_length_m =
      current_.path_length_m - (records_.empty() ? 0.0 : records_.back().path_length_m);
  records_.push_back(std::exchange(current_, {}));
  const ObservationRecord& record = records_.back();
  if (!record.not_segmented.empty()) {
    log_warning(fmt::format("view {}: {}", records_.size(), record.not_segmented));
  }
  recorder_.observation(record, records_.size(), camera_image_, seen_.view);
}

std::vector<BearingOption> ObjectFlightParts::propose() {
  std::vector<BearingOption> options;
  for (int id = 0; id < task_.bearings; ++id) {
    if (id == records_.back().bearing_id) continue;
    BearingOption option{.id = id, .bearing_rad = bearing_rad(id), .action = {}};
    const FlightPlan plan = robot_.plan(option.bearing_rad);
    option.action = {.yaw_rad = wrap_angle(option.bearing_rad - robot_.bearing_rad()),
                     .time_s = plan.duration_s,
                     .path_m = plan.path_m,
                     .energy_j = plan.energy_j,
                     .visited = visited(id)};
    options.push_back(option);
  }
  return options;
}

void ObjectFlightParts::score(std::vector<BearingOption>& options) {
  std::vector<ObjectViewAction> actions;
  for (const BearingOption& option : options) actions.push_back(option.action);
  next_ = next_view(recogniser_, task_.decision, recognition(), actions, choice_rng_);
}

std::size_t ObjectFlightParts::choose(const std::vector<BearingOption>& options) {
  const std::size_t chosen = next_.decision.action;
  recorder_.decision(options, next_.decision, task_.orbit());
  current_.gain_bits = next_.decision.scores[chosen].gain.bits;
  tell_decision(options, chosen);
  return chosen;
}

/// Places with their gains, as those who look on see them.
void ObjectFlightParts::tell_decision(const std::vector<BearingOption>& options,
                                      std::size_t chosen) {
  Decision decision{{}, chosen};
  for (std::size_t i = 0; i < options.size(); ++i) {
    Candidate& place = decision.candidates.emplace_back();
    place.id = static_cast<int>(i);
    place.T_world_sensor = task_.orbit().place(options[i].bearing_rad);
    place.gain_bits = next_.decision.scores[i].gain.bits;
  }
  PlannedFlight way;
  for (const FlightWaypoint& waypoint : robot_.plan(options[chosen].bearing_rad).waypoints) {
    way.path_m.push_back(waypoint.p_world_m);
  }
  recorder_.show(std::move(decision), std::move(way));
}

void ObjectFlightParts::act(const BearingOption& option) {
  current_.bearing_id = option.id;
  current_.flight = robot_.fly_to(option.bearing_rad);
  inquiry_.turned(option.action.yaw_rad);
  if (current_.flight->status == FlightStatus::arrived) return;
  log_warning(fmt::format("bearing {}: {} on the way there", option.id,
                          to_string(current_.flight->status)));
}

double ObjectFlightParts::bearing_rad(int id) const {
  return std::fmod(first_rad_ + id * kTurn_rad / task_.bearings, kTurn_rad);
}

bool ObjectFlightParts::visited(int id) const {
  return std::ranges::find(records_, id, &ObservationRecord::bearing_id) != records_.end();
}

std::vector<Candidate> ObjectFlightParts::places() const {
  std::vector<Candidate> places;
  for (int id = 0; id < task_.bearings; ++id) {
    Candidate& place = places.emplace_back();
    place.id = id;
    place.T_world_sensor = task_.orbit().place(bearing_rad(id));
  }
  return places;
}

RecognitionPanelInput ObjectFlightParts::panel() const {
  RecognitionPanelInput input{.observation_records = records_, .orbit = task_.orbit()};
  for (int id = 0; id < task_.bearings; ++id) {
    input.bearings_rad.push_back(bearing_rad(id));
  }
  input.goal_rad = robot_.bearing_rad();
  input.T_world_body = robot_.estimated_body();
  input.camera_image = &camera_image_;
  input.cut = seen_.view ? &*seen_.view : nullptr;
  input.objects = recogniser_.states.objects;
  input.p_object = p_object(recogniser_.states, recognition().belief);
  if (recogniser_.states.unknown_size() > 0) {
    input.objects.emplace_back(kUnknown);
    input.p_object.conservativeResize(input.p_object.size() + 1);
    input.p_object[input.p_object.size() - 1] = p_unknown(recogniser_.states, recognition().belief);
  }
  input.expected = expectation_.object;
  input.threshold = expectation_.threshold;
  input.method = task_.method_name();
  return input;
}

}  // namespace vantage
