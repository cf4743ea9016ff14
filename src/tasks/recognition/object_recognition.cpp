#include "vantage/tasks/recognition/object_recognition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "vantage/core/data_root.hpp"
#include "vantage/core/log.hpp"
#include "vantage/recognition/lean_recogniser.hpp"
#include "vantage/tasks/flight/recognition_model_file.hpp"

namespace vantage {
namespace {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;

int bin_of(double yaw_rad, int bins) {
  return static_cast<int>(std::lround(yaw_rad / kTurn_rad * bins)) % bins;
}

/// Where it began. If something is expected, the nearest bearing from which that is in the middle
/// of a yaw bin: from there a turn by more than half a bin shows.
double first_bearing_rad(const Episode& episode, double start_rad, double bin_rad) {
  if (!episode.detects_change()) return start_rad;
  const double seen_rad = draw_expected_object(episode).yaw_rad - start_rad;
  const double first_rad = start_rad + std::remainder(seen_rad, bin_rad);
  return first_rad - kTurn_rad * std::floor(first_rad / kTurn_rad);
}

/// Of a view without an object in it.
ExtractFeature extract_nothing(const std::string& reason) {
  return [reason](std::size_t) { return ExtractedFeature{.result = FeatureResult::skip(reason)}; };
}

}  // namespace

Recogniser load_episode_recogniser(const ResolvedEpisode& resolved) {
  const Episode& episode = resolved.episode;
  const auto path =
      find_recognition_model(episode.recognition.model, "recognition.model",
                             episode.detects_change() ? "change_detection" : "recognition");
  Recogniser recogniser = load_lean_recogniser(path, episode.recognition.recogniser);
  require_known(recogniser, path, draw_object_on_table(episode).object, "stands on the table",
                "recognition");
  if (episode.detects_change()) {
    require_known(recogniser, path, draw_expected_object(episode).object, "is expected there",
                  "recognition");
  }
  return recogniser;
}

ObjectRecognition::ObjectRecognition(const ResolvedEpisode& resolved, const Recogniser& recogniser,
                                     OrbitRobotInterface& robot, RecognitionRecorder& recorder)
    : episode_(resolved.episode),
      robot_(robot),
      recorder_(recorder),
      truth_(draw_object_on_table(episode_)),
      first_rad_(
          first_bearing_rad(episode_, robot_.start_bearing_rad(), recogniser.states.bin_rad())),
      recogniser_(recogniser),
      inquiry_(recogniser_, episode_, first_rad_),
      choice_rng_(Rng::stream(episode_.seed, "recognition")),
      segmentation_rng_(Rng::stream(episode_.seed, "segmentation")) {
  recorder_.set_panel([this] { return panel(); });
}

FlightObservation ObjectRecognition::observe() {
  if (observation_records_.empty() && robot_.bearing_rad() != first_rad_) {
    current_.flight = robot_.fly_to(first_rad_);
  }
  return robot_.observe();
}

void ObjectRecognition::update(const FlightObservation& observation) {
  const RecognitionTask& task = episode_.recognition;
  seen_ = segment_object(observation.images, observation.T_world_camera, robot_.p_world_table_m(),
                         task.segmentation, segmentation_rng_);
  camera_image_ = observation.images;
  const ExtractFeature extract =
      seen_.view ? extract_from(recogniser_, *seen_.view) : extract_nothing(seen_.reason);
  inquiry_.observe(extract, observation.bearing_rad, next_.time_s, choice_rng_);
  current_.T_world_camera = observation.T_world_camera;
  conclude();
}

/// What is believed now, beside the truth.
void ObjectRecognition::conclude() {
  const ObjectStates& states = recogniser_.states;
  const ObjectBelief& belief = recognition().belief;
  const int object = most_probable_object(states, belief);
  current_.time_s = robot_.world().time_s();
  current_.report = recognition().views.back();
  if (inquiry_.of_change()) current_.change = {inquiry_.p_changed(), inquiry_.verdict()};
  current_.not_segmented = seen_.reason;
  current_.object_px = seen_.view ? static_cast<int>(std::ranges::count(seen_.view->mask, 1)) : 0;
  current_.estimate = states.objects[static_cast<std::size_t>(object)];
  current_.map_probability = std::min(1.0, p_object(states, belief)[object]);
  const int state = expected_state(states, belief);
  current_.estimated_bin = states.bin_of(state);
  current_.category = states.categories[static_cast<std::size_t>(
      states.category_of[static_cast<std::size_t>(object)])];
  const FlightTruth truth = robot_.truth();
  current_.position_error_m = truth.position_error_m;
  current_.angle_error_rad = truth.angle_error_rad;
  current_.true_yaw_rad = truth.object_angle_rad;
  current_.bin_error =
      bin_error(states, state, states.state(object, bin_of(truth.object_angle_rad, states.bins)));
  current_.collisions = truth.collisions;
}

void ObjectRecognition::record() {
  observation_records_.push_back(std::exchange(current_, {}));
  const ObservationRecord& observation_record = observation_records_.back();
  if (!observation_record.not_segmented.empty()) {
    log_warning(
        fmt::format("view {}: {}", observation_records_.size(), observation_record.not_segmented));
  }
  recorder_.observation_record(observation_record, observation_records_.size() - 1, camera_image_,
                               seen_.view);
}

bool ObjectRecognition::finished() const { return inquiry_.over(); }

std::vector<BearingOption> ObjectRecognition::propose() {
  std::vector<BearingOption> options;
  for (int id = 0; id < episode_.recognition.bearings; ++id) {
    if (id == observation_records_.back().bearing_id) continue;
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

void ObjectRecognition::score(std::vector<BearingOption>& options) {
  std::vector<ObjectViewAction> actions;
  for (const BearingOption& option : options) actions.push_back(option.action);
  next_ =
      next_view(recogniser_, episode_.recognition.decision, recognition(), actions, choice_rng_);
}

std::size_t ObjectRecognition::choose(const std::vector<BearingOption>&) {
  const std::size_t chosen = next_.decision.action;
  current_.gain_bits = next_.decision.scores[chosen].gain.bits;
  return chosen;
}

void ObjectRecognition::act(const BearingOption& option) {
  current_.bearing_id = option.id;
  current_.flight = robot_.fly_to(option.bearing_rad);
  inquiry_.turned(option.action.yaw_rad);
  if (current_.flight->status == FlightStatus::arrived) return;
  log_warning(fmt::format("bearing {}: {} on the way there", option.id,
                          to_string(current_.flight->status)));
}

double ObjectRecognition::bearing_rad(int id) const {
  return std::fmod(first_rad_ + id * kTurn_rad / episode_.recognition.bearings, kTurn_rad);
}

bool ObjectRecognition::visited(int id) const {
  return std::ranges::find(observation_records_, id, &ObservationRecord::bearing_id) !=
         observation_records_.end();
}

std::vector<Candidate> ObjectRecognition::places() const {
  std::vector<Candidate> places;
  for (int id = 0; id < episode_.recognition.bearings; ++id) {
    Candidate& place = places.emplace_back();
    place.id = id;
    place.T_world_sensor = robot_.orbit().place(bearing_rad(id));
  }
  return places;
}

RecognitionPanelInput ObjectRecognition::panel() const {
  RecognitionPanelInput input{.observation_records = observation_records_, .orbit = robot_.orbit()};
  for (int id = 0; id < episode_.recognition.bearings; ++id) {
    input.bearings_rad.push_back(bearing_rad(id));
  }
  input.goal_rad = robot_.bearing_rad();
  input.T_world_body = robot_.estimated_body();
  input.camera_image = &camera_image_;
  input.cut = seen_.view ? &*seen_.view : nullptr;
  input.objects = recogniser_.states.objects;
  input.p_object = p_object(recogniser_.states, recognition().belief);
  if (inquiry_.of_change()) {
    input.expected = draw_expected_object(episode_).object;
    input.threshold = episode_.change_detection.options.threshold;
  }
  input.method = method_name(episode_);
  return input;
}

}  // namespace vantage
