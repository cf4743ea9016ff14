#include "vantage/tasks/recognition/recognition_metrics.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

/// Where the camera is, x axis level the way it looks.
Pose line_of_sight(const Pose& T_world_camera) {
  const Eigen::Vector3d ahead = T_world_camera.linear().col(2);
  return make_pose(T_world_camera.translation(), std::atan2(ahead.y(), ahead.x()));
}

Json observation_json(const Sighting& sighting, int bins) {
  const ViewReport& report = sighting.report;
  Json json = {{"view_rad", report.view_rad},
               {"features", report.features},
               {"entropy_bits", report.entropy_bits},
               {"feature_time_s", report.feature_time_s},
               {"selection_time_s", report.selection_time_s},
               {"view_time_s", report.view_time_s},
               {"time_s", sighting.time_s},
               {"chosen_view", sighting.bearing_id},
               {"gain_bits", sighting.gain_bits},
               {"estimate", sighting.estimate},
               {"map_probability", sighting.map_probability},
               {"object_px", sighting.object_px},
               {"position_error_m", sighting.position_error_m},
               {"angle_error_rad", sighting.angle_error_rad},
               {"true_yaw_rad", sighting.true_yaw_rad},
               {"estimated_bin", sighting.estimated_bin},
               {"bin_error", sighting.bin_error},
               {"bins", bins},
               {"collisions", sighting.collisions},
               {"view", view_json(line_of_sight(sighting.T_world_camera))}};
  if (sighting.change) {
    json["change_probability"] = sighting.change->probability;
    json["decision"] = to_string(sighting.change->verdict);
  }
  json["skipped"] = Json::array();
  for (const SkippedFeature& skipped : report.skipped) {
    json["skipped"].push_back({{"feature", skipped.feature}, {"reason", skipped.reason}});
  }
  if (const auto& flight = sighting.flight) {
    json["flight"] = {
        {"status", to_string(flight->status)},          {"duration_s", flight->duration_s},
        {"path_length_m", flight->path_length_m},       {"rms_error_m", flight->rms_error_m},
        {"greatest_error_m", flight->greatest_error_m}, {"energy_j", flight->energy_J}};
  }
  return json;
}

/// Where the robot looks for the object.
Eigen::AlignedBox3d object_column(const RecognitionTask& task) {
  const double radius_m = task.segmentation.radius_m;
  const Eigen::Vector3d foot_m = Eigen::Map<const Eigen::Vector3d>(task.table_m.data());
  const Eigen::Vector3d half_m(radius_m, radius_m, 0.0);
  const Eigen::Vector3d top_m(0.0, 0.0, task.segmentation.max_height_m);
  return {foot_m - half_m, foot_m + half_m + top_m};
}

/// What was decided of the change, beside what has changed.
void add_change(const ResolvedEpisode& resolved, const ObjectRecognition& run, Json& json) {
  const std::string& scenario = resolved.episode.change_detection.scenario;
  const ObjectOnTable expected = draw_expected_object(resolved.episode);
  json["scenario"] = scenario;
  json["decision"] = json["change_probability"] = nullptr;
  json["correct"] = json["changed_correct"] = false;
  if (!run.sightings().empty()) {
    const SuspectedChange& change = run.sightings().back().change.value();
    json["decision"] = to_string(change.verdict);
    json["correct"] = to_string(change.verdict) == scenario;
    json["changed_correct"] =
        (change.verdict == Change::none) == (scenario == to_string(Change::none));
    json["change_probability"] = change.probability;
  }
  json["expected"] = {{"object", expected.object}, {"yaw_rad", expected.yaw_rad}};
}

/// What was recognised, beside what is there.
void add_estimate(const ObjectRecognition& run, Json& json) {
  if (run.sightings().empty()) {  // ended before the first view
    for (const char* key : {"estimate", "map_probability", "bin_error"}) json[key] = nullptr;
    if (!run.inquiry().of_change()) json["correct"] = json["category_correct"] = false;
    json["entropy_bits"] = state_entropy_bits(run.recognition().belief);
    return;
  }
  const Sighting& last = run.sightings().back();
  json["estimate"] = last.estimate;
  if (!run.inquiry().of_change()) {
    json["correct"] = last.estimate == run.truth().object;
    json["category_correct"] = last.category == run.truth().category;
  }
  json["entropy_bits"] = last.report.entropy_bits;
  json["map_probability"] = last.map_probability;
  json["bin_error"] = run.truth().object.empty() ? Json(nullptr) : Json(last.bin_error);
}

}  // namespace

Json recognition_metrics(const ResolvedEpisode& resolved, const RunSummary& summary,
                         const ObjectRecognition& run) {
  const ObjectStates& states = run.recogniser().states;
  const auto& sightings = run.sightings();
  Json json = summary_json(resolved, summary);
  const ObjectOnTable& truth = run.truth();
  json["truth"] = truth.object.empty() ? Json(nullptr) : Json(truth.object);
  json["true_yaw_rad"] = truth.object.empty() ? Json(nullptr) : Json(truth.yaw_rad);
  if (run.inquiry().of_change()) add_change(resolved, run, json);
  add_estimate(run, json);
  json["observations"] = Json::array();
  for (const Sighting& sighting : sightings) {
    json["observations"].push_back(observation_json(sighting, states.bins));
  }
  json["candidates"] = candidates_json(run.places());
  json["region"] = box_json(object_column(resolved.episode.recognition));
  return json;
}

}  // namespace vantage
