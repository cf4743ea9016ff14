#include "vantage/tasks/trajectory/trajectory_metrics.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "vantage/information/quantile.hpp"

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
          {"view", view_json(observation.T_world_camera)}};
}

/// One that stands there, and what was made of it.
Json object_json(const ObjectOnSupport& truth, const RecognisedObject* found,
                 const TrajectoryFlight& run) {
  const ObjectObservations& observations = run.observations();
  const double prior_nats =
      std::log(static_cast<double>(observations.recogniser().states.object_count()));
  const bool seen = found != nullptr && !found->observations.empty();
  const std::string estimate = seen ? observations.estimate(*found) : "";
  Json json = {{"truth", truth.object},
               {"estimate", seen ? Json(estimate) : Json(nullptr)},
               {"correct", seen && estimate == truth.object},
               {"entropy_nats", seen ? observations.entropy_nats(*found) : prior_nats},
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

void add_path(Json& json, const TrajectoryFlight& run) {
  json["path"] = Json::array();
  json["plan"] = Json::array();
  for (const Eigen::Vector4d& q : run.nominal()) json["path"].push_back(waypoint_json(q));
  for (const Eigen::Vector4d& q : run.plan()) json["plan"].push_back(waypoint_json(q));
}

}  // namespace

Json trajectory_metrics(const ResolvedEpisode& resolved, const RunSummary& summary,
                        const TrajectoryRobotInterface& robot, const TrajectoryFlight& run) {
  Json json = summary_json(resolved, summary);
  const TrajectoryTruth truth = robot.truth();
  const auto& found = run.observations().objects();
  const std::vector<int> match = matches(run.truth(), found);
  json["objects"] = Json::array();
  double correct = 0.0;
  double sum_nats = 0.0;
  for (std::size_t i = 0; i < match.size(); ++i) {
    const RecognisedObject* object =
        match[i] < 0 ? nullptr : &found[static_cast<std::size_t>(match[i])];
    json["objects"].push_back(object_json(run.truth()[i], object, run));
    correct += json["objects"].back()["correct"].get<bool>() ? 1.0 : 0.0;
    sum_nats += json["objects"].back()["entropy_nats"].get<double>();
  }
  const auto count = static_cast<double>(std::max<std::size_t>(match.size(), 1));
  json["accuracy"] = correct / count;
  json["mean_entropy_nats"] = sum_nats / count;
  json["objects_found"] = std::ranges::count_if(match, [](int m) { return m >= 0; });
  json["false_objects"] = found.size() - json["objects_found"].get<std::size_t>();
  json["observations_total"] = run.observations().total();
  json["flight_time_s"] = summary.simulated_time_s;
  json["minimum_clearance_m"] = truth.minimum_clearance_m;
  json["tracking_error_m"] = {{"mean", truth.tracking_error_mean_m},
                              {"max", truth.tracking_error_max_m}};
  json["energy_j"] = truth.energy_j;
  json["waypoints_reached"] = run.waypoints().empty() ? 0 : run.waypoints().back().waypoint + 1;
  add_planning(json, run.waypoints());
  add_path(json, run);
  return json;
}

}  // namespace vantage
