#include "vantage/tasks/trajectory/trajectory_metrics.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "vantage/information/quantile.hpp"
#include "vantage/runtime/json.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

/// Farther off it is another object, or none.
constexpr double kSameObject_m = 0.5;

/// For each true object the index of the found one that is nearest; -1: none.
std::vector<int> matches(const std::vector<ObjectOnSupport>& truth,
                         const std::vector<RecognisedObject>& found) {
  std::vector<int> match(truth.size(), -1);
  std::vector<bool> taken(found.size(), false);
  for (;;) {
    double min_m = kSameObject_m;
    std::size_t best_true = truth.size();
    std::size_t best_found = 0;
    for (std::size_t t = 0; t < truth.size(); ++t) {
      for (std::size_t f = 0; f < found.size(); ++f) {
        if (match[t] >= 0 || taken[f]) continue;
        const double off_m = (truth[t].p_world_m - found[f].p_world_m).head<2>().norm();
        if (off_m < min_m) std::tie(min_m, best_true, best_found) = std::tuple(off_m, t, f);
      }
    }
    if (best_true == truth.size()) return match;
    match[best_true] = static_cast<int>(best_found);
    taken[best_found] = true;
  }
}

Json observation_json(const ObjectObservation& observation) {
  return {{"time_s", observation.time_s},
          {"bearing_rad", observation.bearing_rad},
          {"direction", observation.direction},
          {"distance_m", observation.distance_m},
          {"elevation_rad", observation.elevation_rad},
          {"pixels", observation.pixels},
          {"features", observation.report.features},
          {"feature_time_s", observation.report.feature_time_s},
          {"entropy_nats", observation.entropy_nats},
          {"estimate", observation.estimate},
          {"map_probability", observation.map_probability},
          {"unknown_probability", observation.unknown_probability},
          {"view", view_json(observation.T_world_camera)}};
}

/// One that stands there, and what was made of it.
Json object_json(const ObjectOnSupport& truth, const RecognisedObject* found,
                 const TrajectoryParts& run) {
  const ObjectObservations& observations = run.observations();
  const auto& known = observations.recogniser().states.objects;
  const bool is_known = std::ranges::find(known, truth.object) != known.end();
  const bool seen = found != nullptr && !found->observations.empty();
  const std::string estimate = seen ? observations.estimate(*found).object : "";
  Json json = {{"truth", truth.object},
               {"estimate", seen ? Json(estimate) : Json(nullptr)},
               {"correct", seen && estimate == (is_known ? truth.object : kUnknown)},
               {"unknown_probability",
                seen ? Json(observations.unknown_probability(*found)) : Json(nullptr)},
               {"entropy_nats",
                seen ? observations.entropy_nats(*found) : observations.prior_entropy_nats()},
               {"observations", found == nullptr ? 0 : found->observations.size()},
               {"found", found != nullptr},
               {"x_m", truth.p_world_m.x()},
               {"y_m", truth.p_world_m.y()},
               {"z_m", truth.p_world_m.z()},
               {"position_error_m", nullptr},
               {"looks", Json::array()}};
  if (found == nullptr) return json;
  json["position_error_m"] = (truth.p_world_m - found->p_world_m).head<2>().norm();
  for (const ObjectObservation& observation : found->observations)
    json["looks"].push_back(observation_json(observation));
  return json;
}

/// All that was found, whether it is there or not.
Json found_json(const RecognisedObject& found, const TrajectoryParts& run) {
  const ObjectObservations& observations = run.observations();
  const bool seen = !found.observations.empty();
  return {
      {"x_m", found.p_world_m.x()},
      {"y_m", found.p_world_m.y()},
      {"z_m", found.p_world_m.z()},
      {"estimate", seen ? Json(observations.estimate(found).object) : Json(nullptr)},
      {"unknown_probability", seen ? Json(observations.unknown_probability(found)) : Json(nullptr)},
      {"entropy_nats", observations.entropy_nats(found)},
      {"object", nullptr}};
}

/// An object never observed has the prior's entropy, which would drown that of the others: so the
/// observed ones are told apart.
void add_entropies(Json& metrics) {
  double observed = 0.0;
  double observed_nats = 0.0;
  double all = 0.0;
  double all_nats = 0.0;
  for (const Json& object : metrics["objects"]) {
    const double nats = object["entropy_nats"].get<double>();
    all += 1.0;
    all_nats += nats;
    if (object["observations"].get<int>() == 0) continue;
    observed += 1.0;
    observed_nats += nats;
  }
  metrics["mean_entropy_observed_nats"] =
      observed > 0.0 ? Json(observed_nats / observed) : Json(nullptr);
  metrics["objects_unseen"] = static_cast<int>(all - observed);
  metrics["mean_entropy_nats"] = all_nats / std::max(all, 1.0);
}

void add_planning(Json& json, const std::vector<WaypointRecord>& records) {
  std::vector<double> time_s;
  int late = 0;
  int missed = 0;
  for (const WaypointRecord& record : records) {
    if (record.planner.empty()) continue;
    time_s.push_back(record.plan_time_s);
    late += record.late ? 1 : 0;
    missed += record.missed ? 1 : 0;
  }
  const auto share_s = [&](double share) { return time_s.empty() ? 0.0 : quantile(time_s, share); };
  json["plan_time_s"] = {{"median", share_s(0.5)}, {"p95", share_s(0.95)}};
  json["replans"] = time_s.size();
  json["late_plans"] = late;
  json["missed_deadlines"] = missed;
}

Json waypoint_json(const Eigen::Vector4d& q) { return {q[0], q[1], q[2], q[3]}; }

void add_path(Json& json, const TrajectoryParts& run) {
  json["path"] = Json::array();
  json["plan"] = Json::array();
  for (const Eigen::Vector4d& q : run.nominal()) json["path"].push_back(waypoint_json(q));
  for (const Eigen::Vector4d& q : run.plan()) json["plan"].push_back(waypoint_json(q));
}

std::optional<double> inner_number(const MeasuredEpisode& episode, const char* key,
                                   const char* inner) {
  return episode.metrics.at(key).at(inner).get<double>();
}

/// Kinds of collisions are not told apart: one ends the flight.
std::optional<double> ended_by_collision(const MeasuredEpisode& episode) {
  return episode.metrics.at("collisions").get<double>() > 0.0 ? 1.0 : 0.0;
}

const auto kScalars = std::to_array<ScalarMeasure>({
    kPathLength,
    kCollisions,
    kSimulatedTime,
    {{"accuracy", "objects of the scene recognised, share", Better::higher},
     [](const MeasuredEpisode& e) { return number_of(e, "accuracy"); }},
    {{"observations", "observations of all objects"},
     [](const MeasuredEpisode& e) { return number_of(e, "observations_total"); }},
    {{"mean_entropy_observed_nats", "mean entropy of the scene's objects that were observed, nats",
      Better::lower},
     [](const MeasuredEpisode& e) { return number_of(e, "mean_entropy_observed_nats"); }},
    {{"objects_unseen", "objects of the scene never observed", Better::lower},
     [](const MeasuredEpisode& e) { return number_of(e, "objects_unseen"); }},
    {{"mean_entropy_nats",
      "mean entropy of all of the scene's objects, that of the prior for those never observed, "
      "nats"},
     [](const MeasuredEpisode& e) { return number_of(e, "mean_entropy_nats"); }},
    {{"objects_found", "objects of the scene found", Better::higher},
     [](const MeasuredEpisode& e) { return number_of(e, "objects_found"); }},
    {{"false_objects", "objects found where there are none", Better::lower},
     [](const MeasuredEpisode& e) { return number_of(e, "false_objects"); }},
    {{"flight_time_s", "flight time, s", Better::lower},
     [](const MeasuredEpisode& e) { return number_of(e, "flight_time_s"); }},
    {{"minimum_clearance_m", "minimum clearance, m", Better::higher},
     [](const MeasuredEpisode& e) { return number_of(e, "minimum_clearance_m"); }},
    {{"collided", "flights that touched something, share", Better::lower}, ended_by_collision},
    {{"tracking_error_m", "mean distance from the reference, m", Better::lower},
     [](const MeasuredEpisode& e) { return inner_number(e, "tracking_error_m", "mean"); }},
    {{"replan_time_s", "median time of a replan, s", Better::lower, true},
     [](const MeasuredEpisode& e) { return inner_number(e, "plan_time_s", "median"); }},
    {{"replan_time_p95_s", "95 % quantile of the time of a replan, s", Better::lower, true},
     [](const MeasuredEpisode& e) { return inner_number(e, "plan_time_s", "p95"); }},
    {{"late_plans", "replans that took longer than the latency charged", Better::lower, true},
     [](const MeasuredEpisode& e) { return number_of(e, "late_plans"); }},
    {{"missed_deadlines", "replans that came after the next waypoint", Better::lower},
     [](const MeasuredEpisode& e) { return number_of(e, "missed_deadlines"); }},
    {{"energy_j", "energy used, J", Better::lower},
     [](const MeasuredEpisode& e) { return number_of(e, "energy_j"); }},
});

constexpr auto kHeadlines = std::to_array<std::string_view>(
    {"accuracy", "mean_entropy_observed_nats", "objects_unseen", "path_length_m", "flight_time_s",
     "minimum_clearance_m", "collisions"});

}  // namespace

void add_trajectory_metrics(const FlightTruth& truth, const TrajectoryParts& run, Json& metrics) {
  const auto& found = run.observations().objects();
  const std::vector<int> match = matches(truth.objects, found);
  metrics["objects"] = Json::array();
  metrics["found"] = Json::array();
  for (const RecognisedObject& object : found) metrics["found"].push_back(found_json(object, run));
  double correct = 0.0;
  for (std::size_t i = 0; i < match.size(); ++i) {
    const RecognisedObject* object =
        match[i] < 0 ? nullptr : &found[static_cast<std::size_t>(match[i])];
    const Json& entry = metrics["objects"].emplace_back(object_json(truth.objects[i], object, run));
    if (object != nullptr) metrics["found"][static_cast<std::size_t>(match[i])]["object"] = i;
    correct += entry["correct"].get<bool>() ? 1.0 : 0.0;
  }
  metrics["accuracy"] = correct / static_cast<double>(std::max<std::size_t>(match.size(), 1));
  add_entropies(metrics);
  metrics["objects_found"] = std::ranges::count_if(match, [](int m) { return m >= 0; });
  metrics["false_objects"] = found.size() - metrics["objects_found"].get<std::size_t>();
  metrics["observations_total"] = run.observations().total();
  metrics["flight_time_s"] = metrics["simulated_time_s"];
  metrics["minimum_clearance_m"] = truth.vehicle.minimum_clearance_m;
  metrics["tracking_error_m"] = {{"mean", truth.vehicle.tracking_error_mean_m},
                                 {"max", truth.vehicle.tracking_error_max_m}};
  metrics["energy_j"] = truth.vehicle.energy_j;
  metrics["waypoints_reached"] = run.waypoints().empty() ? 0 : run.waypoints().back().waypoint + 1;
  add_planning(metrics, run.waypoints());
  add_path(metrics, run);
}

std::string trajectory_outcome(const Json& metrics) {
  const auto number = [&](const char* key) { return metrics[key].get<double>(); };
  const Json& observed_nats = metrics["mean_entropy_observed_nats"];
  int correct = 0;
  for (const auto& object : metrics["objects"]) correct += object["correct"].get<bool>() ? 1 : 0;
  return fmt::format(
      "{}: {} after {:.1f} s, recognised {} of {} objects in {} observations\n"
      "mean entropy {} nats of the objects observed, {} unseen, clearance {:.2f} m, path {:.2f} m, "
      "{} collisions, {:.1f} x real "
      "time\n",
      metrics["method"].get<std::string>(), metrics["status"].get<std::string>(),
      number("flight_time_s"), correct, metrics["objects"].size(),
      metrics["observations_total"].get<int>(),
      observed_nats.is_null() ? "-" : fmt::format("{:.3f}", observed_nats.get<double>()),
      metrics["objects_unseen"].get<int>(), number("minimum_clearance_m"), number("path_length_m"),
      metrics["collisions"].get<int>(), number("real_time_factor"));
}

Measures trajectory_measures() { return {kScalars, {}, nullptr, kHeadlines}; }

}  // namespace vantage
