#include "vantage/tasks/trajectory/trajectory_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "vantage/core/log.hpp"
#include "vantage/tasks/trajectory/flight_layout.hpp"

namespace vantage {
namespace {

/// Beyond the horizon, so that it is not about to stop at its end.
constexpr int kFollowedBeyond = 2;

std::vector<Eigen::Vector4d> columns_of(const std::vector<FlightWaypoint>& path) {
  std::vector<Eigen::Vector4d> columns;
  for (const FlightWaypoint& waypoint : path) {
    columns.emplace_back(waypoint.p_world_m.x(), waypoint.p_world_m.y(), waypoint.p_world_m.z(),
                         waypoint.yaw_rad);
  }
  return columns;
}

FlightPlanning planning_of(const TrajectoryFlight& task) {
  return {.method = task.method,
          .options = task.planner,
          .horizon = task.horizon,
          .known_below_nats = task.observations.known_below_nats};
}

}  // namespace

TrajectoryParts::TrajectoryParts(const TrajectoryContext& context,
                                 const std::vector<FlightWaypoint>& path)
    : task_(context.task),
      robot_(context.robot),
      evaluator_(context.evaluator),
      recorder_(context.recorder),
      nominal_(columns_of(path)),
      plan_(nominal_),
      map_(flight_region(path), task_.map),
      tracker_(task_.tracker),
      observations_(context.recogniser, task_.observations, task_.transition),
      planner_(planning_of(task_),
               flight_camera(robot_.T_body_camera(), task_.camera.width_px, task_.camera.height_px,
                             task_.camera.fovy_rad),
               Rng::stream(context.options.seed, "trajectory planner")),
      observation_rng_(Rng::stream(context.options.seed, "looks")),
      buffer_(task_.observations) {
  recorder_.set_panel([this] { return panel(); });
}

WaypointReached TrajectoryParts::observe() {
  const ImageCallback on_image = [this](const FlightImage& image) { process_image(image); };
  if (at_ < 0) {
    robot_.capture_now(on_image);
    robot_.follow(followed(plan_, 0));
  } else {
    robot_.fly_past(1, on_image);
  }
  const bool last = at_ + 2 >= static_cast<int>(nominal_.size());
  if (last) apply_observations(buffer_.take_all());
  return {.waypoint = ++at_, .time_s = robot_.time_s(), .T_world_body = robot_.estimated_body()};
}

void TrajectoryParts::process_image(const FlightImage& taken) {
  FlightImage image = taken;
  if (!gate_.admit(image.arrived, image.depth)) return;
  map_.insert(image.depth, image.T_world_camera);
  const std::vector<SeenObject> seen =
      find_objects(image.depth, image.T_world_camera, task_.search);
  const std::vector<int> ids = tracker_.update(detections_of(seen));
  for (const TrackedObject& object : tracker_.confirmed()) {
    observations_.found(object.id, object.p_world_object_m);
  }
  std::vector<int> gone;
  for (const RecognisedObject& object : observations_.objects()) {
    if (tracker_.find(object.id) == nullptr) gone.push_back(object.id);
  }
  for (const int id : gone) {
    observations_.forget(id);
    buffer_.forget(id);
  }
  const auto direction_of = [&](int id) {
    return observations_.direction(id, image.T_world_camera);
  };
  for (const int id : ids) buffer_.detected(id, image.time_s);
  apply_observations(buffer_.take_due(image.time_s, direction_of));  // before images from elsewhere
  buffer_observations(image, ids, seen);
  apply_observations(buffer_.take_due(image.time_s, direction_of));
}

void TrajectoryParts::buffer_observations(const FlightImage& image, const std::vector<int>& ids,
                                          const std::vector<SeenObject>& seen) {
  std::optional<CameraImages> coloured;  // not drawn yet
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!observations_.wants(ids[i], seen[i].detection, image.T_world_camera)) continue;
    const int direction = observations_.direction(ids[i], image.T_world_camera);
    if (!buffer_.improves(ids[i], direction, seen[i].detection.distance_m)) continue;
    if (!coloured) coloured = image.with_colour();
    BufferedObservation buffered{.id = ids[i],
                                 .direction = direction,
                                 .seen = seen[i],
                                 .T_world_camera = image.T_world_camera,
                                 .time_s = image.time_s};
    take_colour(*coloured, buffered.seen.view);
    buffer_.keep(std::move(buffered));
  }
}

void TrajectoryParts::apply_observations(const std::vector<BufferedObservation>& due) {
  for (const BufferedObservation& buffered : due) {
    // Where the object is believed to be may have moved it into a direction that was used.
    if (!observations_.wants(buffered.id, buffered.seen.detection, buffered.T_world_camera))
      continue;
    const ObjectObservation& observation =
        observations_.take(buffered.id, buffered.seen.detection, buffered.seen.view,
                           buffered.T_world_camera, buffered.time_s, observation_rng_);
    recorder_.observation(buffered.id, observation, observations_.total(), buffered.seen.view);
  }
}

void TrajectoryParts::update(const WaypointReached& reached) {
  current_.waypoint = reached.waypoint;
  current_.time_s = reached.time_s;
  current_.T_world_body = reached.T_world_body;
  current_.objects = static_cast<int>(observations_.objects().size());
  current_.observations = observations_.total();
  double sum_nats = 0.0;
  for (const RecognisedObject& object : observations_.objects()) {
    sum_nats += observations_.entropy_nats(object);
    current_.known += observations_.known(object) ? 1 : 0;
  }
  if (current_.objects > 0) current_.mean_entropy_nats = sum_nats / current_.objects;
  evaluator_.measure(current_);
}

void TrajectoryParts::record() {
  records_.push_back(std::exchange(current_, {}));
  if (recorder_.flight().wanted()) recorder_.flight().map(map_.grid(), records_.back().waypoint);
  recorder_.waypoint(records_.back(), static_cast<int>(nominal_.size()));
}

std::string TrajectoryParts::finished() const {
  if (at_ + 1 < static_cast<int>(nominal_.size())) return {};
  return fmt::format("end of the path, {} waypoints", nominal_.size());
}

std::vector<PlannableObject> TrajectoryParts::plannable() const {
  const double at_first_nats = observations_.prior_entropy_nats();
  std::vector<PlannableObject> objects;
  for (const RecognisedObject& object : observations_.objects()) {
    PlannableObject& plannable = objects.emplace_back();
    plannable = {.id = object.id,
                 .p_world_m = object.p_world_m,
                 .entropy_nats = at_first_nats,
                 .used = object.used,
                 .gain_nats = every_direction(at_first_nats)};
    if (!task_.planner.cost.information) continue;  // each as if it had never been looked at
    plannable.entropy_nats = observations_.entropy_nats(object);
    plannable.gain_nats = object.gain_nats;
    for (std::size_t d = 0; d < object.used.size(); ++d) {
      if (object.gain_nats[d] < task_.observations.min_gain_nats) plannable.used[d] = true;
    }
  }
  return objects;
}

std::vector<CandidatePlan> TrajectoryParts::propose() {
  planning_since_s_ = wall_s();
  return planner_.propose({.at = at_, .nominal = nominal_, .plan = plan_}, plannable(), map_);
}

/// Flies each in thought as it will be flown: from where the plan before has led by then.
void TrajectoryParts::score(std::vector<CandidatePlan>& candidates) {
  const double latency_s = task_.latency_s;
  const int missed = robot_.passed(latency_s) - robot_.passed();
  for (CandidatePlan& candidate : candidates) {
    const auto on = candidate.same_spline ? robot_.path_on(latency_s) : std::nullopt;
    candidate.same_spline = on.has_value();
    const MinimumJerkTrajectory path =
        on ? *on
           : robot_.path_in(latency_s, followed(plan_with(candidate, missed), at_after(missed)));
    const std::vector<double>& knots_s = path.knots_s();
    const auto planned =
        std::clamp(candidate.points.cols() - missed, Eigen::Index{1}, std::ssize(knots_s) - 1);
    candidate.clearance_m = planner_.clearance_m(path, knots_s[static_cast<std::size_t>(planned)]);
    candidate.clear = planner_.clear(candidate.clearance_m);
  }
}

std::size_t TrajectoryParts::choose(const std::vector<CandidatePlan>& candidates) {
  const std::size_t chosen = safest_of_best(candidates);
  current_.plan_time_s = wall_s() - planning_since_s_;
  recorder_.decision(candidates, chosen);
  current_.target = planner_.target();
  if (recorder_.flight().wanted()) {
    const double highest_m = nominal_[static_cast<std::size_t>(at_)].z();
    recorder_.flight().decision(view_decision(plannable(), robot_.T_body_camera(),
                                              task_.planner.observation_distance_m, highest_m,
                                              planner_.target()));
  }
  return chosen;
}

void TrajectoryParts::act(const CandidatePlan& candidate) {
  const ImageCallback on_image = [this](const FlightImage& image) { process_image(image); };
  const double latency_s = task_.latency_s;
  const int passed = robot_.passed();
  robot_.fly_for(latency_s, on_image);  // on the plan before
  const int missed = robot_.passed() - passed;
  plan_ = plan_with(candidate, missed);
  at_ = at_after(missed);
  current_.planner = candidate.planner;
  current_.cost = candidate.cost;
  current_.planned_clearance_m = candidate.clearance_m;
  current_.latency_s = latency_s;
  current_.late = current_.plan_time_s > latency_s;
  current_.missed = missed > 0;
  current_.plan.assign(plan_.begin() + at_ + 1, plan_.end());
  if (!candidate.same_spline) robot_.follow(followed(plan_, at_));
  if (recorder_.flight().wanted()) {
    recorder_.flight().plan(plan_, static_cast<std::size_t>(at_),
                            static_cast<std::size_t>(task_.horizon) + 1);
  }
}

/// Once the way is taken so many waypoints later than it was made for.
std::vector<Eigen::Vector4d> TrajectoryParts::plan_with(const CandidatePlan& candidate,
                                                        int missed) const {
  std::vector<Eigen::Vector4d> plan = plan_;
  for (Eigen::Index i = missed; i < candidate.points.cols(); ++i) {
    plan[static_cast<std::size_t>(at_ + 1 + i)] = candidate.points.col(i);
  }
  return plan;
}

/// The waypoint that is then behind; there is always one to fly to.
int TrajectoryParts::at_after(int missed) const {
  return std::min(at_ + missed, static_cast<int>(nominal_.size()) - 2);
}

/// The plan from the waypoint after that one on.
std::vector<FlightWaypoint> TrajectoryParts::followed(const std::vector<Eigen::Vector4d>& plan,
                                                      int from) const {
  const auto first = static_cast<std::size_t>(from) + 1;
  const auto beyond = static_cast<std::size_t>(task_.horizon) + kFollowedBeyond;
  std::vector<FlightWaypoint> waypoints;
  for (std::size_t i = first; i < std::min(plan.size(), first + beyond); ++i) {
    waypoints.push_back({.p_world_m = plan[i].head<3>(), .yaw_rad = plan[i][3]});
  }
  return waypoints;
}

TrajectoryPanelInput TrajectoryParts::panel() const {
  TrajectoryPanelInput input{
      .observations = observations_, .nominal = nominal_, .plan = plan_, .at = at_};
  input.T_world_body = robot_.estimated_body();
  input.target = planner_.target();
  input.method = task_.method_name();
  input.range_m = task_.observations.range_m;
  const RgbdOptions& camera = task_.camera;
  input.half_width_rad =
      std::atan(std::tan(0.5 * camera.fovy_rad) * camera.width_px / camera.height_px);
  return input;
}

}  // namespace vantage
