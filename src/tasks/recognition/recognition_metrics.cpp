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

Json observation_json(const ObservationRecord& observation_record, int bins) {
  const ViewReport& report = observation_record.report;
  Json json = {{"view_rad", report.view_rad},
               {"features", report.features},
               {"entropy_bits", report.entropy_bits},
               {"feature_time_s", report.feature_time_s},
               {"selection_time_s", report.selection_time_s},
               {"view_time_s", report.view_time_s},
               {"time_s", observation_record.time_s},
               {"chosen_view", observation_record.bearing_id},
               {"gain_bits", observation_record.gain_bits},
               {"estimate", observation_record.estimate},
               {"map_probability", observation_record.map_probability},
               {"object_px", observation_record.object_px},
               {"position_error_m", observation_record.position_error_m},
               {"angle_error_rad", observation_record.angle_error_rad},
               {"true_yaw_rad", observation_record.true_yaw_rad},
               {"estimated_bin", observation_record.estimated_bin},
               {"bin_error", observation_record.bin_error},
               {"bins", bins},
               {"collisions", observation_record.collisions},
               {"view", view_json(line_of_sight(observation_record.T_world_camera))}};
  if (observation_record.change) {
    json["change_probability"] = observation_record.change->probability;
    json["decision"] = to_string(observation_record.change->verdict);
  }
  json["skipped"] = Json::array();
  for (const SkippedFeature& skipped : report.skipped) {
    json["skipped"].push_back({{"feature", skipped.feature}, {"reason", skipped.reason}});
  }
  if (const auto& flight = observation_record.flight) {
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
  if (!run.observation_records().empty()) {
    const SuspectedChange& change = run.observation_records().back().change.value();
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
  if (run.observation_records().empty()) {  // ended before the first view
    for (const char* key : {"estimate", "map_probability", "bin_error"}) json[key] = nullptr;
    if (!run.inquiry().of_change()) json["correct"] = json["category_correct"] = false;
    json["entropy_bits"] = state_entropy_bits(run.recognition().belief);
    return;
  }
  const ObservationRecord& last = run.observation_records().back();
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
  const auto& observation_records = run.observation_records();
  Json json = summary_json(resolved, summary);
  const ObjectOnTable& truth = run.truth();
  json["truth"] = truth.object.empty() ? Json(nullptr) : Json(truth.object);
  json["true_yaw_rad"] = truth.object.empty() ? Json(nullptr) : Json(truth.yaw_rad);
  if (run.inquiry().of_change()) add_change(resolved, run, json);
  add_estimate(run, json);
  json["observations"] = Json::array();
  for (const ObservationRecord& observation_record : observation_records) {
    json["observations"].push_back(observation_json(observation_record, states.bins));
  }
  json["candidates"] = candidates_json(run.places());
  json["region"] = box_json(object_column(resolved.episode.recognition));
  return json;
}

}  // namespace vantage
