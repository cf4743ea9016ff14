#include "vantage/tasks/object_flight/object_flight_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "vantage/core/log.hpp"
#include "vantage/perception/search/object_search.hpp"
#include "vantage/tasks/flight/full_turn.hpp"

namespace vantage {
ObjectFlightParts::ObjectFlightParts(const ObjectFlightContext& context, const FlightGoal& goal,
                                     const ObjectInquiry& inquiry, double first_rad,
                                     Expectation expectation)
    : task_(context.task),
      goal_(goal),
      recogniser_(context.recogniser),
      robot_(context.robot),
      evaluator_(context.evaluator),
      recorder_(context.recorder),
      tour_(goal, inquiry),
      first_rad_(first_rad),
      at_orbit_(orbit(0)),
      at_rad_(robot_.start_bearing_rad()),
      expectation_(std::move(expectation)),
      choice_rng_(choice_stream(context.task.decision.views.choice, context.options.seed)),
      segmentation_rng_(Rng::stream(context.options.seed, "segmentation")) {
  if (goal_.among_others) map_.emplace(task_.p_world_table_m(), goal_.among_others->map);
  recorder_.set_panel([this] { return panel(); });
}

FlightObservation ObjectFlightParts::observe() {
  if (records_.empty() && at_rad_ != first_rad_) {
    current_.flight = robot_.fly_along(orbit_arc(at_orbit_, at_rad_, first_rad_, task_.arc_rad));
    at_rad_ = first_rad_ + missed_by_rad(first_rad_);
  }
  return gate_.first_admitted([this] { return robot_.observe(); });
}

/// Cuts the target out of the image; among others, the map takes the image in too.
void ObjectFlightParts::look_at(const FlightObservation& observation) {
  TourTarget& target = tour_.current();
  const Pose& T_world_camera = observation.T_world_camera;
  const double distance_m = (target.p_world_m - T_world_camera.translation()).norm();
  const ObjectSegmentationOptions cut = cut_at({.cut = task_.segmentation}, distance_m);
  if (!map_) {
    seen_ = segment_object(observation.images, T_world_camera, target.p_world_m, cut,
                           segmentation_rng_);
    return;
  }
  ObjectAmongOthers found =
      find_among_others(observation.images, T_world_camera, target.p_world_m, cut,
                        goal_.among_others->separation, target.shape, segmentation_rng_);
  seen_ = std::move(found.object);
  target.shape = found.shape;
  current_.seen_share = found.seen_share;
  // The table is where it is: an error of the estimated height.
  const double off_m = target.p_world_m.z() - found.table_height_m.value_or(target.p_world_m.z());
  Pose T_world_levelled = T_world_camera;
  T_world_levelled.translation().z() += off_m;
  map_->insert(observation.images, T_world_levelled);
  if (found.outline.size() < 3) return;
  target.outline.insert(target.outline.end(), found.outline.begin(), found.outline.end());
  target.outline = convex_hull(std::move(target.outline));
  target.own_cells = map_->cells_over(target.outline, target.expected_shape().height_m);
}

void ObjectFlightParts::update(const FlightObservation& observation) {
  look_at(observation);
  camera_image_ = observation.images;
  TourTarget& target = tour_.current();
  target.inquiry.observe(extract_from(recogniser_, seen_), at_rad_, next_.time_s, choice_rng_);
  target.bearing_ids.push_back(current_.bearing_id);
  target.bearing_rad = at_rad_;
  current_.target = tour_.current_id();
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
  const ObjectInquiry& inquiry = tour_.current().inquiry;
  if (inquiry.of_change()) current_.change = {inquiry.p_changed(), inquiry.verdict()};
  current_.not_segmented = seen_.reason;
  current_.object_px = seen_.view ? static_cast<int>(std::ranges::count(seen_.view->mask, 1)) : 0;
  const ObjectEstimate estimate = estimate_of(states, belief);
  current_.estimate = estimate.object;
  current_.category = estimate.category;
  current_.map_probability = estimate.probability;
  current_.unknown_probability = p_unknown(states, belief);
  const int state = expected_state(states, belief);
  current_.estimated_bin = states.bin_of(state);
  evaluator_.measure(states, object, state, current_.target, current_);
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
  if (map_) recorder_.map(map_->grid());
}

std::string ObjectFlightParts::finished() {
  // One whose ways are blocked is left until the map shows a way, if views of the others do.
  for (const std::vector<std::size_t>& targets : {tour_.open(), tour_.not_over()}) {
    options_ = options_to(targets);
    if (!options_.empty()) return "";
  }
  for (const std::size_t target : tour_.not_over()) tour_.give_up(target, why_unreachable(target));
  return tour_.reason();
}

/// To that whose nearest view is reached soonest, or to any.
std::vector<BearingOption> ObjectFlightParts::options_to(
    const std::vector<std::size_t>& targets) const {
  std::vector<BearingOption> to_all;
  double soonest_s = std::numeric_limits<double>::infinity();
  for (const std::size_t target : targets) {
    std::vector<BearingOption> options = options_of(target);
    if (goal_.all_at_once) {
      std::ranges::move(options, std::back_inserter(to_all));
      continue;
    }
    double nearest_s = std::numeric_limits<double>::infinity();
    for (const BearingOption& o : options) nearest_s = std::min(nearest_s, o.action.time_s);
    if (nearest_s >= soonest_s) continue;
    soonest_s = nearest_s;
    to_all = std::move(options);
  }
  return to_all;
}

std::string ObjectFlightParts::why_unreachable(std::size_t target) const {
  for (int id = 0; id < task_.bearings; ++id) {
    if (!is_at(target, id) && clear_option(target, id)) {
      return fmt::format("no view is reached within time_limit_s = {:g}", goal_.time_limit_s);
    }
  }
  return "no view is reached clear of obstacles";
}

std::vector<BearingOption> ObjectFlightParts::options_of(std::size_t target) const {
  std::vector<BearingOption> options;
  for (int id = 0; id < task_.bearings; ++id) {
    if (is_at(target, id)) continue;
    auto found = clear_option(target, id);
    if (found && goal_.allows(robot_.time_s() + found->action.time_s))
      options.push_back(std::move(*found));
  }
  return options;
}

/// By the first way that is clear; nothing if none is.
std::optional<BearingOption> ObjectFlightParts::clear_option(std::size_t target, int id) const {
  constexpr double kRise_m = 0.35;
  static constexpr std::array<OrbitWay, 5> kWays{
      {{}, {true, 0.0}, {false, kRise_m}, {true, kRise_m}, {false, 2.0 * kRise_m}}};
  const TourTarget& looked_at = tour_.targets()[target];
  BearingOption option{.id = id, .bearing_rad = bearing_rad(id), .action = {}, .target = target};
  const Orbit there = orbit(target);
  for (const OrbitWay& way : kWays) {
    option.T_world_way =
        orbit_way(at_orbit_, at_rad_, there, option.bearing_rad, task_.arc_rad, way);
    const FlightPlan plan = robot_.plan(option.T_world_way);
    if (map_ && !is_clear(plan)) continue;
    const double from_rad = looked_at.looked_at() ? looked_at.bearing_rad : at_rad_;
    option.action = {.yaw_rad = wrap_angle(option.bearing_rad - from_rad),
                     .time_s = plan.duration_s + task_.settle_s,
                     .path_m = plan.path_m,
                     .energy_j = plan.energy_j,
                     .visited = looked_at.visited(id)};
    if (map_) {
      option.action.visible = map_->visible_share(looked_at.expected_shape(), looked_at.own_cells,
                                                  there.place(option.bearing_rad).translation());
    }
    return option;
  }
  return std::nullopt;
}

bool ObjectFlightParts::is_clear(const FlightPlan& plan) const {
  std::vector<Eigen::Vector3d> path_m{robot_.estimated_body().translation()};
  for (const FlightWaypoint& waypoint : plan.waypoints) path_m.push_back(waypoint.p_world_m);
  return map_->is_clear(path_m);
}

void ObjectFlightParts::score(std::vector<BearingOption>& options) {
  next_ = next_view(tour_, recogniser_, task_.decision, options, choice_rng_);
}

std::size_t ObjectFlightParts::choose(const std::vector<BearingOption>& options) {
  const std::size_t chosen = next_.decision.action;
  recorder_.decision(options, next_.decision, orbit(options[chosen].target));
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
    place.T_world_sensor = orbit(options[i].target).place(options[i].bearing_rad);
    place.gain_bits = next_.decision.scores[i].gain.bits;
  }
  PlannedFlight way;
  for (const FlightWaypoint& waypoint : robot_.plan(options[chosen].T_world_way).waypoints) {
    way.path_m.push_back(waypoint.p_world_m);
  }
  recorder_.show(std::move(decision), std::move(way));
}

void ObjectFlightParts::act(const BearingOption& option) {
  tour_.go_to(option.target);
  current_.bearing_id = option.id;
  current_.expected_visible = option.action.visible;
  current_.flight = robot_.fly_along(option.T_world_way);
  at_orbit_ = orbit(option.target);
  const double beyond_rad = missed_by_rad(option.bearing_rad);
  at_rad_ = option.bearing_rad + beyond_rad;
  if (current_.flight->status == FlightStatus::arrived) {
    tour_.current().inquiry.turned(option.action.yaw_rad);
    return;
  }
  tour_.current().inquiry.turned(wrap_angle(option.action.yaw_rad + beyond_rad));
  log_warning(fmt::format("bearing {}: {} on the way there", option.id,
                          to_string(current_.flight->status)));
}

double ObjectFlightParts::missed_by_rad(double bearing_rad) const {
  if (current_.flight->status == FlightStatus::arrived) return 0.0;
  return wrap_angle(at_orbit_.bearing_rad(robot_.estimated_body().translation()) - bearing_rad);
}

Orbit ObjectFlightParts::orbit(std::size_t target) const {
  return task_.orbit_round(tour_.targets()[target].p_world_m);
}

double ObjectFlightParts::bearing_rad(int id) const {
  return std::fmod(first_rad_ + id * kTurn_rad / task_.bearings, kTurn_rad);
}

std::vector<Candidate> ObjectFlightParts::places() const {
  std::vector<Candidate> places;
  for (std::size_t target = 0; target < tour_.targets().size(); ++target) {
    for (int id = 0; id < task_.bearings; ++id) {
      Candidate& place = places.emplace_back();
      place.id = static_cast<int>(places.size()) - 1;
      place.T_world_sensor = orbit(target).place(bearing_rad(id));
    }
  }
  return places;
}

RecognitionPanelInput ObjectFlightParts::panel() const {
  RecognitionPanelInput input{.observation_records = records_, .orbit = at_orbit_};
  for (int id = 0; id < task_.bearings; ++id) {
    input.bearings_rad.push_back(bearing_rad(id));
  }
  input.goal_rad = at_rad_;
  input.T_world_body = robot_.estimated_body();
  input.camera_image = &camera_image_;
  input.cut = seen_.view ? &*seen_.view : nullptr;
  input.set_belief(recogniser_.states, recognition().belief);
  input.expected = expectation_.object;
  input.threshold = expectation_.threshold;
  input.method = task_.method_name();
  for (const TourTarget& target : tour_.targets()) input.targets_m.push_back(target.p_world_m);
  input.target = tour_.current_id();
  if (!map_) return input;
  input.map = &map_->grid();
  for (const double bearing_rad : input.bearings_rad) {
    input.visible.push_back(map_->visible_share(tour_.current().expected_shape(),
                                                tour_.current().own_cells,
                                                at_orbit_.place(bearing_rad).translation()));
  }
  return input;
}

}  // namespace vantage
